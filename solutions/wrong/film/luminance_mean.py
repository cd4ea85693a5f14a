"""The mean of the channels."""

import numpy as np

FUNCTION = "luminance"
CAUGHT_BY = "primaries"
MISTAKE = "mean"
SAYS = "You average the channels: green looks much brighter than blue."


def luminance(rgb):
    """With a mistake."""
    _check_batch("rgb", rgb)
    return rgb.mean(axis=0)
