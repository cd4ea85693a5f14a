"""Weights squared."""

import numpy as np

FUNCTION = "triangle_uv"
CAUGHT_BY = "inside"
MISTAKE = "weights-squared"
SAYS = "The corners' weights are squared: they must be the areas' shares themselves."


def triangle_uv(barycentric, uv0, uv1, uv2):
    """Places on a triangle."""
    _check_batch("barycentric", barycentric, 3)
    for name, uv in (("uv0", uv0), ("uv1", uv1), ("uv2", uv2)):
        _check_corner(name, uv, np.shape(barycentric)[1])
    corners = [np.asarray(uv) for uv in (uv0, uv1, uv2)]
    dtype = np.result_type(barycentric, *(uv for uv in corners if uv.ndim == 2))
    a, b, c = (uv.astype(dtype).reshape(2, -1) for uv in corners)
    w0, w1, w2 = barycentric
    return (w0**2 * a + w1**2 * b + w2**2 * c) / (w0**2 + w1**2 + w2**2)
