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
    # TODO cube_map.face_and_uv: write your solution here
    raise NotImplementedError("cube_map.face_and_uv: not written yet")


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
    # TODO cube_map.lookup: write your solution here
    raise NotImplementedError("cube_map.lookup: not written yet")


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
    # TODO cube_map.lookup_seamless: write your solution here
    raise NotImplementedError("cube_map.lookup_seamless: not written yet")


def _check_faces(faces):
    shape = np.shape(faces)
    if len(shape) != 4 or shape != (6, shape[1], shape[1], 3) or shape[1] < 1:
        raise ValueError(f"faces must have shape (6, S, S, 3) with S >= 1, got {shape}")


def _check_batch(name, array, rows, columns=None):
    shape = np.shape(array)
    if len(shape) != 2 or shape[0] != rows or (columns is not None and shape[1] != columns):
        expected = f"({rows}, {'N' if columns is None else columns})"
        raise ValueError(f"{name} must have shape {expected}, got {shape}")
