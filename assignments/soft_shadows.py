"""soft_shadows - lights that have a size.

A point light is either seen or hidden, so its shadow has a hard edge. A light with a size can be seen in part; the
share that is seen makes the penumbra. Either the light becomes many point lights (method 1), or each shading point
asks for one random place on it and the average does the rest (method 2).
"""

import numpy as np


def light_grid(corner, edge_u, edge_v, k):
    """The light as a grid of point lights: centres of k x k cells of a parallelogram (method 1).

    Parameters
    ----------
    corner, edge_u, edge_v : (3,) [m]
        One corner, and the two edges that leave it.
    k : int >= 1

    Returns
    -------
    (3, k * k) float32 [m], in any order

    Raises
    ------
    ValueError
        k < 1, or an argument is not (3,).

    Task: soft_shadows.light_grid.
    """
    _check_single(corner=corner, edge_u=edge_u, edge_v=edge_v)
    if not k >= 1:
        raise ValueError(f"k must be >= 1, got {k}")
    # TODO soft_shadows.light_grid: write your solution here
    raise NotImplementedError("soft_shadows.light_grid: not written yet")


def point_on_rectangle(corner, edge_u, edge_v, u):
    """Uniform points on a parallelogram.

    Parameters
    ----------
    corner, edge_u, edge_v : (3,) [m]
    u : (2, N) floating in [0, 1)

    Returns
    -------
    (3, N) [m], of the dtype of u

    Raises
    ------
    ValueError
        An argument has another shape.

    Task: soft_shadows.point_on_rectangle.
    """
    _check_single(corner=corner, edge_u=edge_u, edge_v=edge_v)
    _check_batch("u", u, 2)
    # TODO soft_shadows.point_on_rectangle: write your solution here
    raise NotImplementedError("soft_shadows.point_on_rectangle: not written yet")


def point_on_sphere(center, radius, u):
    """Uniform points on a sphere: one random light position for each shading point (method 2).

    Parameters
    ----------
    center : (3,) [m]
    radius : float >= 0 [m]
    u : (2, N) floating in [0, 1)

    Returns
    -------
    (3, N) [m], of the dtype of u

    Raises
    ------
    ValueError
        An argument has another shape, or radius is not a finite number >= 0.

    Task: soft_shadows.point_on_sphere. Source: Archimedes' hat box: z is uniform on a sphere.
    """
    _check_single(center=center)
    _check_batch("u", u, 2)
    _check_radius(radius)
    # TODO soft_shadows.point_on_sphere: write your solution here
    raise NotImplementedError("soft_shadows.point_on_sphere: not written yet")


def point_in_ball(center, radius, u):
    """Uniform points in a ball: a light that is brightest in the middle, seen from afar, and fades out.

    Parameters
    ----------
    center : (3,) [m]
    radius : float >= 0 [m]
    u : (3, N) floating in [0, 1)

    Returns
    -------
    (3, N) [m], of the dtype of u

    Raises
    ------
    ValueError
        An argument has another shape, or radius is not a finite number >= 0.

    Task: soft_shadows.point_in_ball.
    """
    _check_single(center=center)
    _check_batch("u", u, 3)
    _check_radius(radius)
    # TODO soft_shadows.point_in_ball: write your solution here
    raise NotImplementedError("soft_shadows.point_in_ball: not written yet")


def point_on_facing_disk(center, radius, point, u):
    """Uniform points on the disk that a sphere shows to each shading point.

    Parameters
    ----------
    center : (3,) [m]
    radius : float >= 0 [m]
    point : (3, N) floating [m]
        The shading points; the disk of each goes through the centre, orthogonal to the line between them.
    u : (2, N) floating in [0, 1)

    Returns
    -------
    (3, N) [m], of the dtype of point and u, or NumPy's promotion of the two
        A point at the centre itself gets a disk of some orientation

    Raises
    ------
    ValueError
        An argument has another shape, or radius is not a finite number >= 0.

    Task: soft_shadows.point_on_facing_disk. Source: Duff et al., "Building an orthonormal basis, revisited", 2017.
    """
    _check_single(center=center)
    _check_batch("point", point, 3)
    _check_batch("u", u, 2, np.shape(point)[1])
    _check_radius(radius)
    # TODO soft_shadows.point_on_facing_disk: write your solution here
    raise NotImplementedError("soft_shadows.point_on_facing_disk: not written yet")


def _check_single(**points):
    for name, point in points.items():
        if np.shape(point) != (3,):
            raise ValueError(f"{name} must have shape (3,), got {np.shape(point)}")


def _check_batch(name, array, rows, columns=None):
    shape = np.shape(array)
    if len(shape) != 2 or shape[0] != rows or (columns is not None and shape[1] != columns):
        expected = f"({rows}, {'N' if columns is None else columns})"
        raise ValueError(f"{name} must have shape {expected}, got {shape}")


def _check_radius(radius):
    if not 0 <= radius < np.inf:
        raise ValueError(f"radius must be finite and >= 0, got {radius}")
