"""No colour of the seamless lookup is brighter than 1."""

import numpy as np

FUNCTION = "lookup_seamless"
CAUGHT_BY = "bright"
MISTAKE = "lookup_seamless-clipped"
SAYS = "You cut colours off at 1; the sun is brighter, and to cut it off is the display's business."

_unclipped = lookup_seamless


def lookup_seamless(faces, direction):
    """What the environment looks like, without seams."""
    return np.clip(_unclipped(faces, direction), 0, 1)
