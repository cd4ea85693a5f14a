"""Visible normals by spherical caps (Dupuy and Benyoub, 2023), and tangents in place of cosines."""

import numpy as np


def _above(cos):
    return np.float64(1) * (cos > 0)


def _tangent(cos):
    """Of the angle; of no meaning below the horizon."""
    safe = np.where(cos > 0, np.minimum(cos, 1), 1).astype(np.float64)
    return np.sqrt((1 - safe) * (1 + safe)) / safe, safe


def ggx(cos, alpha):
    """By the slopes: their density is 1 / (pi alpha^2 (1 + slope^2 / alpha^2)^2), over cos^4."""
    _check_alpha(alpha)
    _check_arrays(cos=(cos, "N"))
    slope, safe = _tangent(cos)
    relative = slope / float(alpha)
    per_slope = 1 / (np.pi * float(alpha) ** 2) / (1 + relative**2) ** 2
    return (_above(cos) * per_slope / safe**4).astype(cos.dtype)


def _hidden(cos, alpha):
    slope, _ = _tangent(cos)
    return (np.hypot(1, float(alpha) * slope) - 1) / 2


def smith_g1(cos, alpha):
    """By Lambda."""
    _check_alpha(alpha)
    _check_arrays(cos=(cos, "N"))
    return (_above(cos) / (1 + _hidden(cos, alpha))).astype(cos.dtype)


def smith_g2(cos_o, cos_i, alpha):
    """By both Lambdas."""
    _check_alpha(alpha)
    _check_arrays(cos_o=(cos_o, "N"), cos_i=(cos_i, "N"))
    both = 1 + _hidden(cos_o, alpha) + _hidden(cos_i, alpha)
    return (_above(cos_o) * _above(cos_i) / both).astype(np.result_type(cos_o, cos_i))


def sample_visible_normal(wo, alpha, u):
    """The view mirrored by visible normals of a hemisphere is uniform over a cap."""
    _check_alpha(alpha)
    _check_arrays(wo=(wo, 3, "N"), u=(u, 2, "N"))
    kind = np.promote_types(wo.dtype, u.dtype)
    squeezed = wo.astype(np.float64)
    squeezed[:2] *= float(alpha)
    squeezed /= np.sqrt(np.square(squeezed).sum(0))
    height = 1 - u[0].astype(np.float64) * (1 + squeezed[2])
    turn = 2 * np.pi * u[1].astype(np.float64)
    round_the_axis = np.sqrt(np.clip((1 - height) * (1 + height), 0, None))
    found = squeezed + [round_the_axis * np.cos(turn), round_the_axis * np.sin(turn), height]
    found[:2] *= float(alpha)
    length = np.sqrt(np.square(found).sum(0))
    nowhere = length < 1e-12
    found[2, nowhere] = 1
    return (found / np.where(nowhere, 1, length)).astype(kind)


def visible_normal_pdf(wo, wm, alpha):
    """What is seen of a microfacet over what is seen of all: the latter is cos (1 + Lambda)."""
    _check_alpha(alpha)
    _check_arrays(wo=(wo, 3, "N"), wm=(wm, 3, "N"))
    cos = wo[2].astype(np.float64)
    all_of_it = (cos + np.sqrt(cos**2 + float(alpha) ** 2 * (1 - cos) * (1 + cos))) / 2
    slant = np.einsum("ij,ij->j", wo.astype(np.float64), wm.astype(np.float64))
    seen = np.clip(slant, 0, None) * ggx(wm[2].astype(np.float64), alpha)
    return (seen / all_of_it).astype(np.promote_types(wo.dtype, wm.dtype))


def brdf(wo, wi, alpha, n, k):
    """By the density of visible normals, which has all but the shadowing in it."""
    _check_alpha(alpha)
    _check_arrays(wo=(wo, 3, "N"), wi=(wi, 3, "N"), n=(n, 3), k=(k, 3))
    kind = np.promote_types(wo.dtype, wi.dtype)
    o, i = (w.astype(np.float64) for w in (wo, wi))
    both = (o[2] > 0) & (i[2] > 0)
    up = np.array([[0.0], [0], [1]])
    o, i = (np.where(both, w, up) for w in (o, i))
    middle = o + i
    middle /= np.linalg.norm(middle, axis=0)
    slant = np.einsum("ij,ij->j", o, middle)
    mirrored = visible_normal_pdf(o, middle, alpha) / (4 * slant)
    lit = smith_g2(o[2], i[2], alpha) / smith_g1(o[2], alpha)
    return (both * mirrored * lit / i[2] * fresnel_complex(slant, n, k)).astype(kind)
