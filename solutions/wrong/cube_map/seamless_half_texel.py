"""Takes texels' corners for their centres, beyond the edges too."""

FUNCTION = "lookup_seamless"
CAUGHT_BY = "centres"
MISTAKE = "lookup_seamless-half-texel"
SAYS = "Your picture is shifted by half a texel or a whole one; whole numbers should be texels' centres, which are half a texel from the texels' edges."


def lookup_seamless(faces, direction):
    """What the environment looks like, without seams."""
    _check_faces(faces)
    _check_batch("direction", direction, 3)
    size = len(faces[0])
    face, u, v = face_and_uv(direction)
    return _weigh(faces, *_four_across(size, face, u * size, v * size))
