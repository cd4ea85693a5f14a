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
    ### BEGIN SOLUTION
    height, width, _ = image.shape
    edge = np.cos(np.pi * np.arange(height + 1) / height)
    solid_angle = 2 * np.pi / width * (edge[:-1] - edge[1:])
    return (image.mean(axis=2, dtype=np.float64) * solid_angle[:, None]).astype(image.dtype)
    ### END SOLUTION


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
    ### BEGIN SOLUTION
    weights = np.asarray(weights, np.float64)
    each = weights.sum(axis=1)
    rows = np.cumsum(each / each.sum())
    # Even where there is nothing to be shared out.
    share = np.where(each[:, None] > 0, weights / np.where(each > 0, each, 1)[:, None], 1)
    columns = np.cumsum(share, axis=1)
    # Dividing by the last sum makes that one exactly 1, and keeps all in order.
    return rows / rows[-1], columns / columns[:, -1:]
    ### END SOLUTION


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
    ### BEGIN SOLUTION
    height, width = columns.shape
    # Numbers that are rounded to 1, or that become it when a row is added to them, lie in the last texel.
    u0, u1 = np.minimum(np.asarray(u, np.float64), 1 - 2.0**-40)
    row = np.searchsorted(rows, u0, side="right")
    # One search for all rows: the edges of row i are moved up by i, so that they stand in one rising list.
    texel = np.searchsorted((columns + np.arange(height)[:, None]).ravel(), u1 + row, side="right")
    column = np.minimum(texel - row * width, width - 1)
    low = np.where(row > 0, rows[row - 1], 0)
    left = np.where(column > 0, columns[row, column - 1], 0)
    down = (u0 - low) / (rows[row] - low)
    along = (u1 - left) / (columns[row, column] - left)
    # The height, not the angle, is uniform over a solid angle.
    top, bottom = np.cos(np.pi * row / height), np.cos(np.pi * (row + 1) / height)
    y = top + np.clip(down, 0, 1) * (bottom - top)
    phi = 2 * np.pi * ((column + np.clip(along, 0, 1)) / width - 0.5)
    ring = np.sqrt((1 - y) * (1 + y))
    return np.stack((ring * np.sin(phi), y, -ring * np.cos(phi))).astype(u.dtype)
    ### END SOLUTION


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
    ### BEGIN SOLUTION
    height, width = weights.shape
    weights = np.asarray(weights, np.float64)
    x, y, z = np.asarray(direction, np.float64)
    # By both components: the arccosine alone is inexact next to the poles.
    row = np.arctan2(np.hypot(x, z), y) / np.pi * height
    column = (0.5 + np.arctan2(x, -z) / (2 * np.pi)) * width
    row = np.clip(row.astype(np.intp), 0, height - 1)
    column = np.clip(column.astype(np.intp), 0, width - 1)
    edge = np.cos(np.pi * np.arange(height + 1) / height)
    solid_angle = 2 * np.pi / width * (edge[:-1] - edge[1:])
    found = weights[row, column] / (weights.sum() * solid_angle[row])
    return found.astype(direction.dtype)
    ### END SOLUTION


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
    ### BEGIN SOLUTION
    count = len(weights)
    scaled = np.asarray(weights, np.float64)
    # Two divisions: the sum of huge weights times their number may overflow.
    filled = (scaled / scaled.max() / (scaled / scaled.max()).mean()).tolist()
    probability, alias = [1.0] * count, list(range(count))
    small = [k for k in range(count) if filled[k] < 1]
    large = [k for k in range(count) if filled[k] >= 1]
    while small and large:
        poor, rich = small.pop(), large[-1]
        probability[poor], alias[poor] = filled[poor], rich
        filled[rich] -= 1 - filled[poor]
        if filled[rich] < 1:
            small.append(large.pop())
    # What is left is full but for rounding; an outcome without weight is never among it.
    for k in small:
        if weights[k] == 0:
            probability[k], alias[k] = 0.0, int(np.argmax(weights))
    return np.array(probability), np.array(alias)
    ### END SOLUTION


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
    ### BEGIN SOLUTION
    place = np.asarray(u, np.float64) * len(probability)
    column = np.minimum(place.astype(np.intp), len(probability) - 1)
    fraction, own = place - column, probability[column]
    kept = fraction < own
    share = np.where(kept, own, 1 - own)
    rest = np.where(kept, fraction, fraction - own) / np.where(share > 0, share, 1)
    return np.where(kept, column, alias[column]), rest.astype(u.dtype)
    ### END SOLUTION


def _check_weights(weights, shape, axes):
    if np.ndim(weights) != axes:
        raise ValueError(f"weights must have shape {shape}, got {np.shape(weights)}")
    if not (np.asarray(weights) >= 0).all() or not np.any(weights):
        raise ValueError("weights must be >= 0, and not 0 everywhere")
