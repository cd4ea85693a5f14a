"""Takes u for the row, on all faces."""

FUNCTION = "lookup_seamless"
CAUGHT_BY = "centres"
MISTAKE = "lookup_seamless-transposed"
SAYS = "Rows and columns are mixed up: u counts columns, v counts rows, and rows come first in the array."


def lookup_seamless(faces, direction):
    """What the environment looks like, without seams."""
    _check_faces(faces)
    _check_batch("direction", direction, 3)
    size = len(faces[0])
    face, u, v = face_and_uv(direction)
    return _weigh(faces, *_four_across(size, face, v * size - 0.5, u * size - 0.5))
