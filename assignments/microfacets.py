"""microfacets - metals and glass that are neither smooth nor matt: mirrors too small to be seen, turned every way.

The surface's normal is +z, wo looks to the viewer, wi to the light, and wm are the normals of the mirrors. Half of the
surface is turned by less than arctan(alpha). ValueError is raised for arrays of other shapes and for another alpha.
"""

import numpy as np


def ggx(cos, alpha):
    """D, the area of microfacets with normals at that angle: alpha^2 / (pi ((alpha^2 - 1) cos^2 + 1)^2).

    Parameters
    ----------
    cos : (N,) floating in [-1, 1], of the angle between wm and +z
    alpha : float, 0.001 to 1

    Returns
    -------
    (N,) [1/sr], of the dtype of cos; 0 where cos <= 0. Times the cosine it integrates to 1.
        It keeps its digits where alpha is small, in float32, too.

    Task: microfacets.ggx. Source: Walter et al., "Microfacet models for refraction through rough surfaces", 2007.
    """
    _check_alpha(alpha)
    _check_arrays(cos=(cos, "N"))
    # TODO microfacets.ggx: write your solution here
    raise NotImplementedError("microfacets.ggx: not written yet")


def smith_g1(cos, alpha):
    """Masking: the share of the microfacets turned to a direction that aren't hidden from it by others.

    Parameters
    ----------
    cos : (N,) floating in [-1, 1], of the angle between the direction and +z
    alpha : float, 0.001 to 1

    Returns
    -------
    (N,) in [0, 1], of the dtype of cos; 0 where cos <= 0
        1 / (1 + Lambda), Lambda = (sqrt(1 + alpha^2 tan^2) - 1) / 2.

    Task: microfacets.smith_g1. Source: Heitz, "Understanding the masking-shadowing function", 2014.
    """
    _check_alpha(alpha)
    _check_arrays(cos=(cos, "N"))
    # TODO microfacets.smith_g1: write your solution here
    raise NotImplementedError("microfacets.smith_g1: not written yet")


def smith_g2(cos_o, cos_i, alpha):
    """Masking and shadowing: the share of microfacets seen from two directions, correlated by height.

    Parameters
    ----------
    cos_o, cos_i : (N,) floating in [-1, 1], of the angles of wo and wi to +z
    alpha : float, 0.001 to 1

    Returns
    -------
    (N,) in [0, 1], of the dtype of the cosines, or NumPy's promotion of the two; 0 where one of them is <= 0
        1 / (1 + Lambda_o + Lambda_i), Lambda as in `smith_g1`: what lies low is hidden from both.

    Task: microfacets.smith_g2. Source: Heitz, 2014, section 5.3.
    """
    _check_alpha(alpha)
    _check_arrays(cos_o=(cos_o, "N"), cos_i=(cos_i, "N"))
    # TODO microfacets.smith_g2: write your solution here
    raise NotImplementedError("microfacets.smith_g2: not written yet")


def sample_visible_normal(wo, alpha, u):
    """Random microfacets, each as probable as it looks large from wo: those that rays from there meet.

    Parameters
    ----------
    wo : (3, N) floating, unit vectors with z > 0
    alpha : float, 0.001 to 1
    u : (2, N) floating in [0, 1)

    Returns
    -------
    (3, N) unit vectors wm with z >= 0 and dot(wo, wm) >= 0, of the dtype of wo and u, or NumPy's promotion of the two
        How u leads to them is free, as long as small steps within [0, 1) x [0, 1) are small steps of wm.

    Task: microfacets.sample_visible_normal. Source: Heitz, "Sampling the GGX distribution of visible normals", 2018.
    """
    _check_alpha(alpha)
    _check_arrays(wo=(wo, 3, "N"), u=(u, 2, "N"))
    # TODO microfacets.sample_visible_normal: write your solution here
    raise NotImplementedError("microfacets.sample_visible_normal: not written yet")


def visible_normal_pdf(wo, wm, alpha):
    """The density of sample_visible_normal: G1(wo) max(dot(wo, wm), 0) D(wm) / wo_z.

    Parameters
    ----------
    wo, wm : (3, N) floating, unit vectors, wo with z > 0
    alpha : float, 0.001 to 1

    Returns
    -------
    (N,) [1/sr], of the dtype of wo and wm, or NumPy's promotion of the two
        The directions that the microfacets mirror have this density over 4 dot(wo, wm).

    Task: microfacets.visible_normal_pdf. Source: Heitz, 2018.
    """
    _check_alpha(alpha)
    _check_arrays(wo=(wo, 3, "N"), wm=(wm, 3, "N"))
    # TODO microfacets.visible_normal_pdf: write your solution here
    raise NotImplementedError("microfacets.visible_normal_pdf: not written yet")


def fresnel_complex(cos, n, k):
    """The share of unpolarised light that a smooth surface mirrors, whose index is n + i k times that outside.

    Parameters
    ----------
    cos : (N,) floating, of the angle between light and normal; what lies beyond 0 or 1 counts as 0 or 1
    n, k : (3,) floating >= 0, not both 0, in red, green and blue; k = 0 is glass, with n < 1 seen from its inside

    Returns
    -------
    (3, N) in [0, 1], of the dtype of cos
        The mean of both polarisations.

    Task: microfacets.fresnel_complex. Source: Born and Wolf, "Principles of optics", 14.2.
    """
    _check_arrays(cos=(cos, "N"), n=(n, 3), k=(k, 3))
    if not (np.minimum(n, k) >= 0).all() or not np.maximum(n, k).all():
        raise ValueError(f"n and k must be >= 0, and not both 0, got {n} and {k}")
    # TODO microfacets.fresnel_complex: write your solution here
    raise NotImplementedError("microfacets.fresnel_complex: not written yet")


def brdf(wo, wi, alpha, n, k):
    """What the microfacets mirror from wi to wo: F(dot(wo, wm)) D(wm) G2 / (4 wo_z wi_z), wm halfway between the two.

    Parameters
    ----------
    wo, wi : (3, N) floating, unit vectors
    alpha : float, 0.001 to 1
    n, k : (3,) floating, as for `fresnel_complex`

    Returns
    -------
    (3, N) [1/sr], of the dtype of wo and wi, or NumPy's promotion of the two; 0 where one of them has z <= 0

    Task: microfacets.brdf. Source: Torrance and Sparrow, 1967; Walter et al., 2007.
    """
    _check_alpha(alpha)
    _check_arrays(wo=(wo, 3, "N"), wi=(wi, 3, "N"), n=(n, 3), k=(k, 3))
    # TODO microfacets.brdf: write your solution here
    raise NotImplementedError("microfacets.brdf: not written yet")


def _check_alpha(alpha):
    if not 0.001 <= alpha <= 1:
        raise ValueError(f"alpha must be from 0.001 to 1, got {alpha}")


def _check_arrays(**arrays):
    known = {}
    for name, (array, *sizes) in arrays.items():
        got = np.shape(array)
        wanted = tuple(known.get(size, size) for size in sizes)
        right = len(got) == len(sizes)
        if not right or any(
            isinstance(a, int) and a != b for a, b in zip(wanted, got, strict=True)
        ):
            text = ", ".join(map(str, wanted)) + "," * (len(sizes) == 1)
            raise ValueError(f"{name} must have shape ({text}), got {got}")
        known.update({size: n for size, n in zip(sizes, got, strict=True) if isinstance(size, str)})
