"""Drawing directions towards a cube map's light, compiled by Numba; imported where it is used, and only then."""

from numba import njit

from course.compiled.daylight_kernels import directed
from course.compiled.options import OPTIONS


@njit(**OPTIONS)
def sample(normal, u, product, direction, weight):
    """Fill directions (3, n) and weights (n,) for normals (3, n) and numbers (2, n); see ``ProductSampling.sample``."""
    for i in range(normal.shape[1]):
        nx, ny, nz = normal[0, i], normal[1, i], normal[2, i]
        x, y, z, weight[i] = directed(product, nx, ny, nz, u[0, i], u[1, i])
        direction[0, i], direction[1, i], direction[2, i] = x, y, z
