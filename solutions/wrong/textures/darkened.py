"""No colour is brighter than 1."""

import numpy as np

FUNCTION = "texture_lookup"
CAUGHT_BY = "bright"
MISTAKE = "clipped"
SAYS = "You cut colours off at 1; a lamp in a picture is brighter, and to cut it off is the display's business."


def texture_lookup(image, uv):
    """Colours of a picture."""
    _check_image(image)
    _check_batch("uv", uv, 2)
    height, width, _ = image.shape
    u, v = uv - np.floor(uv)
    column, row = u * width - 0.5, (1 - v) * height - 0.5
    left, top = np.floor(column), np.floor(row)
    a, b = column - left, row - top
    i, j = left.astype(int) % width, top.astype(int) % height
    k, l = (i + 1) % width, (j + 1) % height
    one = image[j, i].T * (1 - a) + image[j, k].T * a
    two = image[l, i].T * (1 - a) + image[l, k].T * a
    return np.clip(one * (1 - b) + two * b, 0, 1).astype(uv.dtype)
