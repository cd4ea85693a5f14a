"""No colour is brighter than 1."""

import numpy as np

FUNCTION = "lookup"
CAUGHT_BY = "bright"
MISTAKE = "lookup-clipped"
SAYS = "You cut colours off at 1; the sun is brighter, and to cut it off is the display's business."

_unclipped = lookup


def lookup(faces, direction):
    """What the environment looks like."""
    return np.clip(_unclipped(faces, direction), 0, 1)
