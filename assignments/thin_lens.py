"""thin_lens - depth of field.

A pinhole camera shows everything sharp. A lens has a size: it gathers the light of one point of the scene from many
places, and brings it together again only where the point lies on the plane in focus. Any other point spreads over a
disk, its circle of confusion. So each ray starts at a random place on the lens, and goes through the point in focus.
"""

import numpy as np


def point_on_disk(u):
    """Uniform points on the unit disk.

    Parameters
    ----------
    u : (2, N) floating in [0, 1)

    Returns
    -------
    (2, N), of the dtype of u

    Raises
    ------
    ValueError
        u has another shape.

    Task: thin_lens.point_on_disk.
    """
    _check_batch("u", u, 2)
    # TODO thin_lens.point_on_disk: write your solution here
    raise NotImplementedError("thin_lens.point_on_disk: not written yet")


def lens_rays(origin, right, up, forward, directions, lens_points, focus_distance):
    """Rays that start on the lens and meet the pinhole's rays on the plane in focus.

    Parameters
    ----------
    origin : (3,) [m]
        Centre of the lens.
    right, up, forward : (3,)
        Orthonormal axes of the camera.
    directions : (3, N) floating
        Unit vectors of the pinhole's rays; dot(direction, forward) > 0.
    lens_points : (2, N) floating [m]
        Positions on the lens along right and up. At (0, 0) the pinhole's ray comes back, to within 4 units in the
        last place.
    focus_distance : float > 0 [m]
        From the lens to the plane in focus, along forward.

    Returns
    -------
    origins : (3, N) [m]
    directions : (3, N) unit vectors
        Both of the dtype of directions and lens_points, or NumPy's promotion of the two.

    Raises
    ------
    ValueError
        An argument has another shape, or focus_distance is not > 0.

    Task: thin_lens.lens_rays. Source: Cook, Porter and Carpenter, "Distributed ray tracing", 1984.
    """
    _check_single(origin=origin, right=right, up=up, forward=forward)
    _check_batch("directions", directions, 3)
    _check_batch("lens_points", lens_points, 2, np.shape(directions)[1])
    _check_positive("focus_distance", focus_distance)
    # TODO thin_lens.lens_rays: write your solution here
    raise NotImplementedError("thin_lens.lens_rays: not written yet")


def image_distance(focal_length, object_distance):
    """Where a lens brings an object into focus: 1 / focal_length = 1 / object_distance + 1 / image_distance.

    Parameters
    ----------
    focal_length : float > 0 [m]
    object_distance : float > 0 [m]
        May be inf.

    Returns
    -------
    float [m]
        inf for an object at the focal length, negative (a virtual image) for one nearer than that.

    Raises
    ------
    ValueError
        focal_length or object_distance is not > 0.

    Task: thin_lens.image_distance. Source: the Gaussian lens formula.
    """
    _check_positive("focal_length", focal_length)
    _check_positive("object_distance", object_distance)
    # TODO thin_lens.image_distance: write your solution here
    raise NotImplementedError("thin_lens.image_distance: not written yet")


def circle_of_confusion(depth, aperture_radius, focus_distance):
    """Diameter of the circle that a point spreads over: 2 aperture_radius |focus_distance - depth| / depth.

    Parameters
    ----------
    depth : (N,) floating > 0 [m]
        Distances of points from the lens, along forward.
    aperture_radius : float >= 0 [m]
    focus_distance : float > 0 [m]

    Returns
    -------
    (N,) [m], of the dtype of depth
        Measured in the plane in focus.

    Raises
    ------
    ValueError
        depth is not (N,), or an argument is out of range.

    Task: thin_lens.circle_of_confusion. Source: Potmesil and Chakravarty, "A lens and aperture camera model for
    synthetic image generation", 1981.
    """
    if np.ndim(depth) != 1:
        raise ValueError(f"depth must have shape (N,), got {np.shape(depth)}")
    if not (depth > 0).all():
        raise ValueError(f"depth must be > 0, got {depth.min()}")
    if not aperture_radius >= 0:
        raise ValueError(f"aperture_radius must be >= 0, got {aperture_radius}")
    _check_positive("focus_distance", focus_distance)
    # TODO thin_lens.circle_of_confusion: write your solution here
    raise NotImplementedError("thin_lens.circle_of_confusion: not written yet")


def _check_single(**points):
    for name, point in points.items():
        if np.shape(point) != (3,):
            raise ValueError(f"{name} must have shape (3,), got {np.shape(point)}")


def _check_batch(name, array, rows, columns=None):
    shape = np.shape(array)
    if len(shape) != 2 or shape[0] != rows or (columns is not None and shape[1] != columns):
        expected = f"({rows}, {'N' if columns is None else columns})"
        raise ValueError(f"{name} must have shape {expected}, got {shape}")


def _check_positive(name, number):
    if not number > 0:
        raise ValueError(f"{name} must be > 0, got {number}")
