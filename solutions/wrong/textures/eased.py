"""Eases the weights in and out."""

import numpy as np

FUNCTION = "texture_lookup"
CAUGHT_BY = "picture"
MISTAKE = "eased-weights"
SAYS = "The weights between texels go in and out softly; bilinear ones are proportional to the distance."


def texture_lookup(image, uv):
    """Colours of a picture."""
    _check_image(image)
    _check_batch("uv", uv, 2)
    height, width, _ = image.shape
    u, v = uv - np.floor(uv)
    column, row = u * width - 0.5, (1 - v) * height - 0.5
    left, top = np.floor(column), np.floor(row)
    a, b = column - left, row - top
    a, b = a * a * (3 - 2 * a), b * b * (3 - 2 * b)
    i, j = left.astype(int) % width, top.astype(int) % height
    k, l = (i + 1) % width, (j + 1) % height
    one = image[j, i].T * (1 - a) + image[j, k].T * a
    two = image[l, i].T * (1 - a) + image[l, k].T * a
    return (one * (1 - b) + two * b).astype(uv.dtype)
