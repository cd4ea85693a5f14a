"""Clamps as the other lookup does, and so shows the cube's edges."""

FUNCTION = "lookup_seamless"
CAUGHT_BY = "continuous"
MISTAKE = "stays-inside"


def lookup_seamless(faces, direction):
    """What the environment looks like, without seams."""
    _check_faces(faces)
    _check_batch("direction", direction, 3)
    return lookup(faces, direction)
