"""textures - pictures on surfaces: which place of a picture belongs to a point, and which colour it has there.

A picture has two coordinates, u to the right and v upwards, each from 0 to 1. To put one on a surface is to give each
point of the surface its u and v: to parametrise it. The colour there lies between texels, and is mixed from four.
"""

import numpy as np


def rectangle_uv(p, p1, p2, p3):
    """Where points lie on a rectangle: p = p1 + u (p2 - p1) + v (p3 - p1).

    Parameters
    ----------
    p : (3, N) floating
        Points on the rectangle's plane; those that are off it count as the nearest ones on it.
    p1, p2, p3 : (3,)
        The corner where u = v = 0, and its neighbours at u = 1 and at v = 1. The edges p2 - p1 and p3 - p1 are at
        right angles to each other.

    Returns
    -------
    (2, N), of the dtype of p
        u and v, from 0 to 1 on the rectangle; beyond its edges they go on.

    Raises
    ------
    ValueError
        An argument has another shape, or p2 or p3 is p1.

    Task: textures.rectangle_uv.
    """
    _check_batch("p", p, 3)
    for name, point in (("p1", p1), ("p2", p2), ("p3", p3)):
        _check_point(name, point)
    for name, point in (("p2", p2), ("p3", p3)):
        if np.array_equal(point, p1):
            raise ValueError(f"{name} must be another point than p1, got {point}")
    ### BEGIN SOLUTION
    p1, p2, p3 = (np.asarray(point, float) for point in (p1, p2, p3))
    edges = np.stack([p2 - p1, p3 - p1])
    # The part of p - p1 along an edge, in lengths of that edge.
    scaled = edges / (edges * edges).sum(axis=1, keepdims=True)
    return np.einsum("ij,jn->in", scaled.astype(p.dtype), p - p1.astype(p.dtype)[:, None])
    ### END SOLUTION


def sphere_uv(p, center):
    """Where points lie on a sphere, by their spherical coordinates; the poles are on y.

    From the centre, at unit distance, a point is (sin(theta) cos(phi), -cos(theta), -sin(theta) sin(phi)) with
    phi = 2 pi u and theta = pi v. So u goes once around, to the right as seen from outside with y up, from +x over -z;
    v goes from the south pole, -y, to the north pole, +y.

    Parameters
    ----------
    p : (3, N) floating
        Points other than the centre, at any distance from it.
    center : (3,)

    Returns
    -------
    (2, N) in [0, 1], of the dtype of p
        On the half circle through +x, where the picture's ends meet, u is 0 or 1; on the poles it is anything
        from 0 to 1. Next to the poles v keeps its digits, in float32, too.

    Raises
    ------
    ValueError
        An argument has another shape.

    Task: textures.sphere_uv.
    """
    _check_batch("p", p, 3)
    _check_point("center", center)
    ### BEGIN SOLUTION
    x, y, z = p - np.asarray(center, p.dtype)[:, None]
    u = np.arctan2(-z, x) / (2 * np.pi)
    # As an arcus tangent, since an arcus cosine loses half its digits at the poles.
    v = np.arctan2(y, np.hypot(x, z)) / np.pi + 0.5
    return np.stack((u + (u < 0), v))
    ### END SOLUTION


def triangle_uv(barycentric, uv0, uv1, uv2):
    """Where points lie on a triangle of a mesh, whose corners know their places.

    Parameters
    ----------
    barycentric : (3, N) floating
        The points' barycentric coordinates: the weights of the corners 0, 1 and 2, which sum to 1.
    uv0, uv1, uv2 : (2,), or (2, N) floating
        u and v of each corner; (2, N) where each point has a triangle of its own, and a batch argument then.

    Returns
    -------
    (2, N), of the dtype of the batch arguments, or NumPy's promotion of them

    Raises
    ------
    ValueError
        An argument has another shape.

    Task: textures.triangle_uv. Source: Moebius, "Der barycentrische Calcul", 1827.
    """
    _check_batch("barycentric", barycentric, 3)
    for name, uv in (("uv0", uv0), ("uv1", uv1), ("uv2", uv2)):
        _check_uv(name, uv, np.shape(barycentric)[1])
    ### BEGIN SOLUTION
    corners = [np.asarray(uv) for uv in (uv0, uv1, uv2)]
    dtype = np.result_type(barycentric, *(uv for uv in corners if uv.ndim == 2))
    first, second, third = (
        weight * uv.astype(dtype).reshape(2, -1)
        for weight, uv in zip(barycentric, corners, strict=True)
    )
    return first + second + third
    ### END SOLUTION


def texture_lookup(image, uv):
    """The picture's colours at places u, v: bilinear, repeated beyond its edges.

    Parameters
    ----------
    image : (H, W, 3)
        Linear RGB, row 0 on top. The texel in row j and column i has its centre at
        u = (i + 1/2) / W, v = 1 - (j + 1/2) / H.
    uv : (2, N) floating
        u to the right and v upwards; (0, 0) is the picture's bottom left corner, (1, 1) its top right one. Whole
        numbers more or less make no difference, so half a texel from an edge the opposite edge begins to mix in.

    Returns
    -------
    (3, N), of the dtype of uv

    Raises
    ------
    ValueError
        An argument has another shape.

    Task: textures.texture_lookup. Source: Heckbert, "Survey of texture mapping", 1986.
    """
    _check_image(image)
    _check_batch("uv", uv, 2)
    ### BEGIN SOLUTION
    height, width, channels = image.shape
    u, v = uv - np.floor(uv)
    # Where whole numbers are texels' centres.
    column, row = u * width - 0.5, (1 - v) * height - 0.5
    i, j = np.floor(column), np.floor(row)
    a, b = column - i, row - j
    # The neighbour beyond an edge is at the opposite one.
    left, top = i.astype(np.int32) % width, j.astype(np.int32) % height
    right, below = (left + 1) % width, (top + 1) % height
    top, below = top * width, below * width
    texels = np.stack((top + left, top + right, below + left, below + right))
    weights = np.stack(((1 - a) * (1 - b), a * (1 - b), (1 - a) * b, a * b))
    colors = image.reshape(-1, channels).take(texels, axis=0)
    # Channel by channel in memory, or else each sum would run over three numbers only.
    colors = np.ascontiguousarray(colors.transpose(0, 2, 1), uv.dtype)
    return np.einsum("kcn,kn->cn", colors, weights)
    ### END SOLUTION


def _check_batch(name, array, rows, columns=None):
    shape = np.shape(array)
    if len(shape) != 2 or shape[0] != rows or (columns is not None and shape[1] != columns):
        expected = f"({rows}, {'N' if columns is None else columns})"
        raise ValueError(f"{name} must have shape {expected}, got {shape}")


def _check_point(name, point):
    shape = np.shape(point)
    if shape != (3,):
        raise ValueError(f"{name} must have shape (3,), got {shape}")


def _check_uv(name, uv, columns):
    shape = np.shape(uv)
    if shape not in ((2,), (2, columns)):
        raise ValueError(f"{name} must have shape (2,) or (2, {columns}), got {shape}")


def _check_image(image):
    shape = np.shape(image)
    if len(shape) != 3 or shape[2] != 3 or 0 in shape:
        raise ValueError(f"image must have shape (H, W, 3) with H, W >= 1, got {shape}")
