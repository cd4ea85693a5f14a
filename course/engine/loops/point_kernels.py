"""The point and the shading normal of one hit, compiled by Numba; see ``course.engine.core.hits``."""

import numpy as np

from course.engine.loops.options import LEAN, njit

_LEAST = np.float32(1e-20)
_NOTHING, _ONE = np.float32(0), np.float32(1)


@njit(**LEAN)
def _pulled(x, y, z, a, b, c, plane, edges, inset):
    """A point next to an edge moved inwards, in float64; see ``course.engine.core.hits``."""
    e1x, e1y, e1z = np.float64(edges[0]), np.float64(edges[1]), np.float64(edges[2])
    e2x, e2y, e2z = np.float64(edges[3]), np.float64(edges[4]), np.float64(edges[5])
    nx, ny, nz = np.float64(plane[3]), np.float64(plane[4]), np.float64(plane[5])
    twice_area = (
        (e1y * e2z - e1z * e2y) * nx + (e1z * e2x - e1x * e2z) * ny + (e1x * e2y - e1y * e2x) * nz
    )
    px, py, pz = np.float64(x), np.float64(y), np.float64(z)
    for side in range(3):
        if side == 0:
            ex, ey, ez, lacking = e2x - e1x, e2y - e1y, e2z - e1z, max(inset[0] - c, _NOTHING)
        elif side == 1:
            ex, ey, ez, lacking = -e2x, -e2y, -e2z, max(inset[1] - a, _NOTHING)
        else:
            ex, ey, ez, lacking = e1x, e1y, e1z, max(inset[2] - b, _NOTHING)
        far = lacking * twice_area / (ex * ex + ey * ey + ez * ez)
        px += (ny * ez - nz * ey) * far
        py += (nz * ex - nx * ez) * far
        pz += (nx * ey - ny * ex) * far
    return np.float32(px), np.float32(py), np.float32(pz)


@njit(**LEAN)
def pull(k, a, b, x, y, z, planes, edges, inset):
    """Where rays begin above a point of triangle k with barycentrics a and b, pulled off its edges."""
    c = _ONE - a - b
    if c < inset[k, 0] or a < inset[k, 1] or b < inset[k, 2]:
        return _pulled(x, y, z, a, b, c, planes[k], edges[k], inset[k])
    return x, y, z


@njit(**LEAN)
def turned(nx, ny, nz, dx, dy, dz):
    """A unit normal, turned until it doesn't face away from a ray; see ``turn_to_viewer``."""
    away = nx * dx + ny * dy + nz * dz
    x, y, z = nx - away * dx, ny - away * dy, nz - away * dz
    scale = _ONE / np.sqrt(max(x * x + y * y + z * z, _LEAST))
    turns = away > 0
    return (x * scale if turns else nx, y * scale if turns else ny, z * scale if turns else nz)


@njit(**LEAN)
def to_viewer(nx, ny, nz, side, dx, dy, dz):
    """A normal of unit length on one side, turned to the viewer."""
    scale = _ONE / np.sqrt(max(nx * nx + ny * ny + nz * nz, _LEAST))
    return turned(nx * scale * side, ny * scale * side, nz * scale * side, dx, dy, dz)
