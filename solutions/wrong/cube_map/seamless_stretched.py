"""Puts the outermost texels' centres on the edges, where nothing is left to mix."""

FUNCTION = "lookup_seamless"
CAUGHT_BY = "centres"
MISTAKE = "lookup_seamless-stretched"
SAYS = "You stretch the face so that the outermost texels' centres lie on its edges; they should lie half a texel inside."


def lookup_seamless(faces, direction):
    """What the environment looks like, without seams."""
    _check_faces(faces)
    _check_batch("direction", direction, 3)
    size = len(faces[0])
    face, u, v = face_and_uv(direction)
    return _weigh(faces, *_four_across(size, face, u * (size - 1), v * (size - 1)))
