"""Uses the seamless lookup for the clamped one too."""

FUNCTION = "lookup"
CAUGHT_BY = "clamped"
MISTAKE = "mixes-faces"
SAYS = "Near an edge you mix in the neighbouring face; this lookup stays on its own, the seamless one comes next."


def lookup(faces, direction):
    """What the environment looks like."""
    _check_faces(faces)
    _check_batch("direction", direction, 3)
    return lookup_seamless(faces, direction)
