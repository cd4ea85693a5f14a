"""radiosity - light that is worked out once for all surfaces, and then looked at from anywhere.

Surfaces are divided into patches. The radiosity B of a patch is the light that leaves it [W/m^2]: what it emits, and
its reflectance rho times what reaches it from all other patches. How much that is, tell the form factors: F[i, j] is
the share of the light that leaves patch i and reaches patch j. A hemicube over a patch finds one row of them: whatever
is seen through one of its cells has the form factor of that cell.
"""

import numpy as np


def hemicube_form_factors(k):
    """Delta form factors of a hemicube's cells: the share of a patch's light that goes out through each of them.

    The hemicube is half a cube over the patch: its base, of 2 x 2, is centred on the patch, and its top is 1 above
    it. The top has k x k square cells; each of the four sides has k along the base and k / 2 above one another.

    Parameters
    ----------
    k : int, even, >= 2

    Returns
    -------
    top : (k, k) float32
    side : (k / 2, k) float32
        One of the four, which are alike. Row 0 is the lowest, next to the base.
        sum(top) + 4 sum(side) is 1 but for the cells' size, whose square the error follows.

    Raises
    ------
    ValueError
        k is not an even number >= 2.

    Task: radiosity.hemicube_form_factors. Source: Cohen and Greenberg, "The hemi-cube: a radiosity solution for
    complex environments", 1985.
    """
    if not (k >= 2 and k % 2 == 0):
        raise ValueError(f"k must be even and >= 2, got {k}")
    # TODO radiosity.hemicube_form_factors: write your solution here
    raise NotImplementedError("radiosity.hemicube_form_factors: not written yet")


def gather(radiosity, emission, reflectance, form_factors):
    """One iteration for all patches: each gathers the light that all patches send it.

    Parameters
    ----------
    radiosity : (3, P) floating >= 0
        So far, in red, green and blue [W/m^2].
    emission : (3, P) floating >= 0
        What patches emit by themselves [W/m^2].
    reflectance : (3, P) floating in [0, 1]
    form_factors : (P, P) floating in [0, 1]
        [i, j] is the share of what leaves patch i that reaches patch j; of a hollow patch [i, i] is over 0.

    Returns
    -------
    (3, P) radiosity after the iteration, of NumPy's promotion of the four dtypes

    Raises
    ------
    ValueError
        An argument has another shape.

    Task: radiosity.gather. Source: Goral, Torrance, Greenberg and Battaile, "Modeling the interaction of light between
    diffuse surfaces", 1984.
    """
    _check_colors("radiosity", radiosity)
    patches = np.shape(radiosity)[1]
    _check_colors("emission", emission, patches)
    _check_colors("reflectance", reflectance, patches)
    _check_shape("form_factors", form_factors, (patches, patches))
    # TODO radiosity.gather: write your solution here
    raise NotImplementedError("radiosity.gather: not written yet")


def shoot(radiosity, unshot, reflectance, areas, form_factors, shooter):
    """One step of progressive refinement: one patch shoots the light that it has not sent out yet to all others.

    Parameters
    ----------
    radiosity : (3, P) floating >= 0
        So far, in red, green and blue [W/m^2].
    unshot : (3, P) floating >= 0
        The part of it that has not been shot yet [W/m^2]. At the beginning both are the emission.
    reflectance : (3, P) floating in [0, 1]
    areas : (P,) floating > 0
        Of the patches [m^2].
    form_factors : (P,) floating in [0, 1]
        The shooter's: [j] is the share of what leaves the shooter that reaches patch j.
    shooter : int
        Which patch shoots, 0 to P - 1.

    Returns
    -------
    radiosity, unshot : (3, P) each, of NumPy's promotion of the five dtypes
        Afterwards. What a patch receives and reflects is new radiosity, and unshot. The shooter has nothing left but
        what it may have sent to itself.

    Raises
    ------
    ValueError
        An argument has another shape, or there is no such shooter.

    Task: radiosity.shoot. Source: Cohen, Chen, Wallace and Greenberg, "A progressive refinement approach to fast
    radiosity image generation", 1988.
    """
    _check_colors("radiosity", radiosity)
    patches = np.shape(radiosity)[1]
    _check_colors("unshot", unshot, patches)
    _check_colors("reflectance", reflectance, patches)
    _check_shape("areas", areas, (patches,))
    _check_shape("form_factors", form_factors, (patches,))
    if not 0 <= shooter < patches:
        raise ValueError(f"shooter must be from 0 to {patches - 1}, got {shooter}")
    # TODO radiosity.shoot: write your solution here
    raise NotImplementedError("radiosity.shoot: not written yet")


def needs_split(patch_radiosity, threshold):
    """Which patches to divide: those over which the light changes quickly.

    Parameters
    ----------
    patch_radiosity : (3, K, n) floating >= 0
        Radiosity of n patches at K >= 1 points of each, such as their corners, in any order.
    threshold : float >= 0
        The contrast that is left alone. Contrast is the largest difference between two points in a channel, as a share
        of the largest value that the patch has anywhere in any channel: 0 for an even patch, at most 1.

    Returns
    -------
    (n,) bool
        A contrast that is the threshold exactly is left alone, and so is a black patch.

    Raises
    ------
    ValueError
        patch_radiosity has another shape, or threshold is not >= 0.

    Task: radiosity.needs_split. Source: Cohen, Greenberg, Immel and Brock, "An efficient radiosity approach for
    realistic image synthesis", 1986.
    """
    shape = np.shape(patch_radiosity)
    if len(shape) != 3 or shape[0] != 3 or shape[1] < 1:
        raise ValueError(f"patch_radiosity must have shape (3, K, n), got {shape}")
    if not threshold >= 0:
        raise ValueError(f"threshold must be >= 0, got {threshold}")
    # TODO radiosity.needs_split: write your solution here
    raise NotImplementedError("radiosity.needs_split: not written yet")


def _check_colors(name, array, patches=None):
    shape = np.shape(array)
    if len(shape) != 2 or shape[0] != 3 or (patches is not None and shape[1] != patches):
        expected = "P" if patches is None else patches
        raise ValueError(f"{name} must have shape (3, {expected}), got {shape}")


def _check_shape(name, array, expected):
    if np.shape(array) != expected:
        raise ValueError(f"{name} must have shape {expected}, got {np.shape(array)}")
