"""environment_light - directions towards the light of a picture of the sky, as dense as the picture is bright.

A small sun in a wide sky is met by few directions that don't know of it. The picture does know: its texels are outcomes
of a discrete distribution, each as probable as it is bright and large. The picture is longitude by latitude: row 0 is
next to the top (+y), the middle column looks along -z, and columns go on to +x on the right.
"""

import numpy as np


def texel_weights(image):
    """Power of each texel: the mean of its three channels, times the solid angle that the texel covers.

    Parameters
    ----------
    image : (H, W, 3) floating >= 0
        Radiance [W/(m^2 sr)]. Row i lies between the angles pi i / H and pi (i + 1) / H from +y.

    Returns
    -------
    (H, W) [W/m^2], of the dtype of image

    Raises
    ------
    ValueError
        image has another shape, no texels, or is negative somewhere.

    Task: environment_light.texel_weights.
    """
    if np.ndim(image) != 3 or np.shape(image)[2] != 3 or not np.size(image):
        raise ValueError(f"image must have shape (H, W, 3), got {np.shape(image)}")
    if not (image >= 0).all():
        raise ValueError(f"image must be >= 0, got {np.min(image)}")
    # TODO environment_light.texel_weights: write your solution here
    raise NotImplementedError("environment_light.texel_weights: not written yet")


def cumulate(weights):
    """Cumulative distribution of the rows, and of the texels in each row.

    Parameters
    ----------
    weights : (H, W) floating >= 0, not all 0

    Returns
    -------
    rows : (H,) float64
        rows[i] is the share of the weights that lies in the rows 0 to i; the last is exactly 1. A row without weight
        adds nothing, but for rounding.
    columns : (H, W) float64
        columns[i, j] is the share of row i's weights that lies in its texels 0 to j; the last of each row is exactly 1.
        A texel without weight adds no more than rounding, but in a row without weight all texels count alike.

    Raises
    ------
    ValueError
        weights has another shape, is negative somewhere, or 0 everywhere.

    Task: environment_light.cumulate.
    """
    _check_weights(weights, "(H, W)", 2)
    # TODO environment_light.cumulate: write your solution here
    raise NotImplementedError("environment_light.cumulate: not written yet")


def sample_direction(rows, columns, u):
    """Random directions by inversion: a row, a texel in it, and a point that is uniform over the texel's solid angle.

    u[0] chooses the row, u[1] the texel. What is left of u[0], its place between the row's edges, says where in the row
    the point lies, from the top down; what is left of u[1] says the same from left to right. So even numbers give even
    directions. No direction lies in a texel without weight: a number equal to a sum belongs to what comes after it.

    Parameters
    ----------
    rows : (H,) float64
    columns : (H, W) float64
        Both as `cumulate` returns them.
    u : (2, N) floating in [0, 1)

    Returns
    -------
    (3, N) unit vectors, of the dtype of u

    Raises
    ------
    ValueError
        An argument has another shape.

    Task: environment_light.sample_direction.
    """
    if np.ndim(rows) != 1:
        raise ValueError(f"rows must have shape (H,), got {np.shape(rows)}")
    if np.ndim(columns) != 2 or len(columns) != len(rows):
        raise ValueError(f"columns must have shape ({len(rows)}, W), got {np.shape(columns)}")
    if np.ndim(u) != 2 or np.shape(u)[0] != 2:
        raise ValueError(f"u must have shape (2, N), got {np.shape(u)}")
    # TODO environment_light.sample_direction: write your solution here
    raise NotImplementedError("environment_light.sample_direction: not written yet")


def density(weights, direction):
    """The density of sample_direction: the texel's share of all weights, over the texel's solid angle.

    Parameters
    ----------
    weights : (H, W) floating >= 0, not all 0
        As `texel_weights` returns them.
    direction : (3, N) floating
        Unit vectors.

    Returns
    -------
    (N,) [1/sr], of the dtype of direction
        At the border of two texels that of either is right.

    Raises
    ------
    ValueError
        An argument has another shape, or weights is negative somewhere, or 0 everywhere.

    Task: environment_light.density.
    """
    _check_weights(weights, "(H, W)", 2)
    if np.ndim(direction) != 2 or np.shape(direction)[0] != 3:
        raise ValueError(f"direction must have shape (3, N), got {np.shape(direction)}")
    # TODO environment_light.density: write your solution here
    raise NotImplementedError("environment_light.density: not written yet")


def alias_table(weights):
    """Walker's table: K columns of equal width, each shared by its own outcome and one other, its alias.

    Parameters
    ----------
    weights : (K,) floating >= 0, not all 0

    Returns
    -------
    probability : (K,) float64 in [0, 1]
        Share of column k that belongs to outcome k.
    alias : (K,) whole, from 0 to K - 1
        Outcome that has the rest of column k. Many tables are right: each outcome gets its share of the weights in all.

    Raises
    ------
    ValueError
        weights has another shape, is negative somewhere, or 0 everywhere.

    Task: environment_light.alias_table. Source: Walker, "An efficient method for generating discrete random variables
    with general distributions", 1977; Vose, "A linear algorithm for generating random numbers with a given
    distribution", 1991.
    """
    _check_weights(weights, "(K,)", 1)
    # TODO environment_light.alias_table: write your solution here
    raise NotImplementedError("environment_light.alias_table: not written yet")


def draw_alias(probability, alias, u):
    """Random outcomes by an alias table, each with one number and without a search.

    K u says the column by its whole part. Its fraction says the outcome: the column's own where it is below the
    column's probability, else the alias. The place of the fraction within its part of the column is a number again.

    Parameters
    ----------
    probability : (K,) float64
    alias : (K,) whole
        Both as `alias_table` returns them.
    u : (N,) floating in [0, 1)

    Returns
    -------
    outcome : (N,) whole
    rest : (N,) in [0, 1], of the dtype of u
        Uniform, and independent of the outcome.

    Raises
    ------
    ValueError
        An argument has another shape.

    Task: environment_light.draw_alias.
    """
    if np.ndim(probability) != 1:
        raise ValueError(f"probability must have shape (K,), got {np.shape(probability)}")
    if np.shape(alias) != np.shape(probability):
        raise ValueError(f"alias must have shape {np.shape(probability)}, got {np.shape(alias)}")
    if np.ndim(u) != 1:
        raise ValueError(f"u must have shape (N,), got {np.shape(u)}")
    # TODO environment_light.draw_alias: write your solution here
    raise NotImplementedError("environment_light.draw_alias: not written yet")


def _check_weights(weights, shape, axes):
    if np.ndim(weights) != axes:
        raise ValueError(f"weights must have shape {shape}, got {np.shape(weights)}")
    if not (np.asarray(weights) >= 0).all() or not np.any(weights):
        raise ValueError("weights must be >= 0, and not 0 everywhere")
