"""Glass that is rough by less than a twentieth is taken for smooth."""

FUNCTION = "jitter_refraction"
CAUGHT_BY = "sizes"
MISTAKE = None

_right = jitter_refraction


def jitter_refraction(direction, normal, roughness, u):
    """With a mistake."""
    return _right(direction, normal, 0.0 if 0 < roughness < 0.05 else roughness, u)
