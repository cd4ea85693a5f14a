"""Keeps the first faces that it sees."""

import numpy as np

FUNCTION = "lookup"
CAUGHT_BY = "all-around"
MISTAKE = None

_seen = []
_right = lookup


def lookup(faces, direction):
    """What the environment looks like."""
    _check_faces(faces)
    _seen.append(np.array(faces))
    return _right(_seen[0], direction)
