"""Looks in single precision, whatever comes."""

import numpy as np

FUNCTION = "lookup_seamless"
CAUGHT_BY = "contract"
MISTAKE = "other-dtype"

_right = lookup_seamless


def lookup_seamless(faces, direction):
    """What the environment looks like, without seams."""
    return _right(faces, direction).astype(np.float32)
