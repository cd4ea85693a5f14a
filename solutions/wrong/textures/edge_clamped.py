"""Repeats, but never mixes across the edge."""

import numpy as np

FUNCTION = "texture_lookup"
CAUGHT_BY = "wraps"
MISTAKE = "edge-clamped"
SAYS = "At the picture's edge only its own texels count; the opposite ones have to mix in."


def texture_lookup(image, uv):
    """Colours of a picture."""
    _check_image(image)
    _check_batch("uv", uv, 2)
    height, width, _ = image.shape
    u, v = uv - np.floor(uv)
    column, row = u * width - 0.5, (1 - v) * height - 0.5
    left, top = np.floor(column), np.floor(row)
    a, b = column - left, row - top
    i, j = np.maximum(left.astype(int), 0), np.maximum(top.astype(int), 0)
    k, l = np.minimum(left.astype(int) + 1, width - 1), np.minimum(top.astype(int) + 1, height - 1)
    one = image[j, i].T * (1 - a) + image[j, k].T * a
    two = image[l, i].T * (1 - a) + image[l, k].T * a
    return (one * (1 - b) + two * b).astype(uv.dtype)
