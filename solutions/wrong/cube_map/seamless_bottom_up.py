"""Counts rows from the bottom, on all faces."""

FUNCTION = "lookup_seamless"
CAUGHT_BY = "centres"
MISTAKE = "lookup_seamless-upside-down"
SAYS = "Your faces are upside down; row 0 is the top row, and v is measured down from it."


def lookup_seamless(faces, direction):
    """What the environment looks like, without seams."""
    _check_faces(faces)
    _check_batch("direction", direction, 3)
    size = len(faces[0])
    face, u, v = face_and_uv(direction)
    return _weigh(faces, *_four_across(size, face, u * size - 0.5, (1 - v) * size - 0.5))
