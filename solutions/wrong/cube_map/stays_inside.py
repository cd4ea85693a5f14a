"""Clamps as the other lookup does, and so shows the cube's edges."""

FUNCTION = "lookup_seamless"
CAUGHT_BY = "continuous"
MISTAKE = "stays-inside"
SAYS = "Your lookup stays on its own face at the edge, so the cube's edges show; beyond an edge lies the neighbouring face."


def lookup_seamless(faces, direction):
    """What the environment looks like, without seams."""
    _check_faces(faces)
    _check_batch("direction", direction, 3)
    return lookup(faces, direction)
