"""cube_map - a picture of the whole surroundings, on the six faces of a cube.

A ray that hits nothing still sees something: the environment, which is so far away that only the ray's direction
matters. Six square pictures around the origin, each of a quarter turn, hold every direction. A ray leaves the cube
through the face of its largest component, and the other two components say where on the face.
"""

import numpy as np


def face_and_uv(direction):
    """The face that each direction leaves the cube through, and the place on it.

    Parameters
    ----------
    direction : (3, N) floating
        Of any length but 0.

    Returns
    -------
    face : (N,) int
        0..5 = +x, -x, +y, -y, +z, -z. On an edge or a corner x comes before y, and y before z.
    u, v : (N,) in [0, 1], of the dtype of direction
        As OpenGL has them. Seen from outside the cube, y up, u is to the right and v down from the top row
        on the four sides; from the middle the faces are mirror images.

    Raises
    ------
    ValueError
        direction has another shape.

    Task: cube_map.face_and_uv. Source: the OpenGL specification, "Cube map texture selection".
    """
    _check_batch("direction", direction, 3)
    ### BEGIN SOLUTION
    # OpenGL's table, m the largest component: the coordinates (s, t) on the face, from -1 to 1, are
    #     x: (-z / m, -y / |m|)     y: (x / |m|, z / m)     z: (x / m, -y / |m|)
    x, y, z = direction
    size_x, size_y, size_z = np.abs(direction)
    is_x = (size_x >= size_y) & (size_x >= size_z)
    is_y = ~is_x & (size_y >= size_z)
    # Masks as numbers, 0 or 1: to multiply by them is much faster than np.where, and as exact.
    on_x, on_y = is_x.astype(direction.dtype), is_y.astype(direction.dtype)
    not_x, not_y = 1 - on_x, 1 - on_y
    m = x * on_x + y * on_y + z * (not_x - on_y)
    size = np.abs(m)
    s = (x * not_x - z * on_x) / (m * not_y + size * on_y)
    t = (z * on_y - y * not_y) / (m * on_y + size * not_y)
    face = 4 - 4 * is_x.view(np.int8) - 2 * is_y.view(np.int8) + (m < 0)
    return face.astype(np.intp), 0.5 * s + 0.5, 0.5 * t + 0.5
    ### END SOLUTION


def lookup(faces, direction):
    """What the environment looks like in each direction: bilinear, clamped at the face's edge.

    Parameters
    ----------
    faces : (6, S, S, 3)
        Linear RGB, row 0 the top row.
    direction : (3, N) floating
        Of any length but 0.

    Returns
    -------
    (3, N), of the dtype of direction

    Raises
    ------
    ValueError
        An argument has another shape.

    Task: cube_map.lookup. Source: Greene, "Environment mapping and other applications of world projections", 1986.
    """
    _check_faces(faces)
    _check_batch("direction", direction, 3)
    ### BEGIN SOLUTION
    return _weigh(faces, *_four_texels(len(faces[0]), *_in_texels(faces, direction)))
    ### END SOLUTION


def lookup_seamless(faces, direction):
    """As `lookup`, but continuous across the cube's edges and corners.

    Beyond an edge lies the neighbouring face's adjacent texel, at the same place along the edge. At a corner of the
    cube only three texels meet; there the weights of those three are scaled so that they sum to 1.

    Parameters
    ----------
    faces : (6, S, S, 3)
        Linear RGB, row 0 the top row.
    direction : (3, N) floating
        Of any length but 0.

    Returns
    -------
    (3, N), of the dtype of direction

    Raises
    ------
    ValueError
        An argument has another shape.

    Task: cube_map.lookup_seamless. Source: the OpenGL specification, "Seamless cube map filtering".
    """
    _check_faces(faces)
    _check_batch("direction", direction, 3)
    ### BEGIN SOLUTION
    size = len(faces[0])
    face, column, row = _in_texels(faces, direction)
    texel, weight = _four_texels(size, face, column, row)
    # Few rays come within half a texel of an edge, unless there are few texels.
    outside = (np.minimum(column, row) < 0) | (np.maximum(column, row) > size - 1)
    rays = np.flatnonzero(outside)
    if len(rays):
        texel[:, rays], weight[:, rays] = _four_across(size, face[rays], column[rays], row[rays])
    return _weigh(faces, texel, weight)
    ### END SOLUTION


### BEGIN SOLUTION
def _in_texels(faces, direction):
    """The face, and the place on it in texels (column, row); whole numbers are texels' centres."""
    size = len(faces[0])
    face, u, v = face_and_uv(direction)
    return face, u * size - 0.5, v * size - 0.5


def _four_texels(size, face, column, row):
    """The four texels around a place as indices (4, N), and their bilinear weights (4, N); clamped."""
    column, row = np.clip(column, 0, size - 1), np.clip(row, 0, size - 1)
    i, j = column.astype(np.int32), row.astype(np.int32)
    a, b = column - np.floor(column), row - np.floor(row)
    first = (face * size + j) * size + i
    right, down = (column < size - 1).view(np.int8), (row < size - 1) * np.int32(size)
    return (
        np.stack((first, first + right, first + down, first + (right + down))),
        np.stack(((1 - a) * (1 - b), a * (1 - b), (1 - a) * b, a * b)),
    )


def _four_across(size, face, column, row):
    """As `_four_texels`, with the neighbouring faces' texels for those that lie beyond an edge."""
    i = np.floor(column) + np.array([[0], [1], [0], [1]])
    j = np.floor(row) + np.array([[0], [0], [1], [1]])
    weight = (1 - np.abs(column - i)) * (1 - np.abs(row - j))
    # The texels' centres on a cube whose half side is size. One beyond an edge is folded down: it comes to lie
    # on the edge's other face, half a texel below the edge.
    s, t = 2 * i + 1 - size, 2 * j + 1 - size
    beyond_s, beyond_t = np.abs(s) > size, np.abs(t) > size
    weight *= ~(beyond_s & beyond_t)
    weight /= weight.sum(axis=0)
    m = size - (beyond_s | beyond_t)
    s, t = np.clip(s, -size, size), np.clip(t, -size, size)
    # From the face to the direction: OpenGL's table, backwards.
    sign = 1 - 2 * (face % 2)
    center = np.stack(
        (
            np.choose(face // 2, (sign * m, s, sign * s)),
            np.choose(face // 2, (-t, sign * m, -t)),
            np.choose(face // 2, (-sign * s, sign * t, sign * m)),
        )
    )
    face, u, v = face_and_uv(center.reshape(3, -1))
    # Clipped for the texels of weight 0, which lie nowhere.
    i, j = ((x * size).astype(np.intp).clip(0, size - 1) for x in (u, v))
    return ((face * size + j) * size + i).reshape(weight.shape), weight


def _weigh(faces, texel, weight):
    """The sum (3, N) of four texels each, (4, N), by their weights (4, N)."""
    colors = faces.reshape(-1, 3).take(texel, axis=0)
    # Channel by channel in memory, or else each sum would run over three numbers only.
    colors = np.ascontiguousarray(colors.transpose(0, 2, 1), weight.dtype)
    return np.einsum("kcn,kn->cn", colors, weight)


### END SOLUTION


def _check_faces(faces):
    shape = np.shape(faces)
    if len(shape) != 4 or shape != (6, shape[1], shape[1], 3) or shape[1] < 1:
        raise ValueError(f"faces must have shape (6, S, S, 3) with S >= 1, got {shape}")


def _check_batch(name, array, rows, columns=None):
    shape = np.shape(array)
    if len(shape) != 2 or shape[0] != rows or (columns is not None and shape[1] != columns):
        expected = f"({rows}, {'N' if columns is None else columns})"
        raise ValueError(f"{name} must have shape {expected}, got {shape}")
