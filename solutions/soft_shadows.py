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
    ### BEGIN SOLUTION
    centre = (np.arange(k) + 0.5) / k
    a, b = np.meshgrid(centre, centre)
    corner, edge_u, edge_v = (np.reshape(x, (3, 1)) for x in (corner, edge_u, edge_v))
    return (corner + edge_u * a.ravel() + edge_v * b.ravel()).astype(np.float32)
    ### END SOLUTION


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
    ### BEGIN SOLUTION
    corner, edge_u, edge_v = (_column(x, u.dtype) for x in (corner, edge_u, edge_v))
    points = edge_u * u[0]
    points += corner
    points += edge_v * u[1]
    return points
    ### END SOLUTION


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
    ### BEGIN SOLUTION
    radius = float(radius)
    z = radius * (1 - 2 * u[0])
    # The circle at that height: r^2 = radius^2 - z^2, without the cancellation near the poles.
    r = 2 * radius * np.sqrt(u[0] * (1 - u[0]))
    phi = 2 * np.pi * u[1]
    points = np.stack((r * np.cos(phi), r * np.sin(phi), z))
    points += _column(center, u.dtype)
    return points
    ### END SOLUTION


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
    ### BEGIN SOLUTION
    # The volume inside radius r grows with r^3.
    points = point_on_sphere(np.zeros(3), 1, u[:2])
    points *= float(radius) * np.cbrt(u[2])
    points += _column(center, u.dtype)
    return points
    ### END SOLUTION


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
    ### BEGIN SOLUTION
    dtype = np.result_type(point, u)
    axis = _column(center, dtype) - point
    length = np.sqrt((axis * axis).sum(axis=0))
    axis /= np.where(length > 0, length, 1)
    x, y, z = axis
    # The disk in its own plane, and its (a, b, 0) in the basis of Duff et al. about (x, y, z).
    r = float(radius) * np.sqrt(u[0])
    phi = 2 * np.pi * u[1]
    a, b = r * np.cos(phi), r * np.sin(phi)
    sign = np.copysign(1.0, z)
    down = sign * x * a + y * b
    share = down / (sign + z)
    points = np.stack((a - x * share, sign * b - y * share, -down))
    points += _column(center, dtype)
    return points
    ### END SOLUTION


### BEGIN SOLUTION
def _column(point, dtype):
    """A single point as a (3, 1) column of the batch's dtype."""
    return np.asarray(point, dtype).reshape(3, 1)


### END SOLUTION


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
