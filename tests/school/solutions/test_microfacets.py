"""Microfacets against integrals and samples: areas, the white furnace in closed form, moments, and reciprocity."""

import numpy as np
import pytest

from solutions import microfacets as reference
from tests.school.solutions.contract import assert_mean, unit

NODES = 4000
SKY = np.zeros(3), np.ones(3)
"""n and k of a metal that mirrors all."""


def above(n: int, seed: int) -> np.ndarray:
    v = np.random.default_rng(seed).normal(size=(3, n))
    v[2] = np.abs(v[2])
    return v / np.linalg.norm(v, axis=0)


@pytest.mark.parametrize("alpha", [0.02, 0.3, 1.0])
def test_the_microfacets_cover_the_surface_once(alpha: float) -> None:
    """Nodes are equally probable by D cos, so each has the same share of the area."""
    x = (np.arange(NODES) + 0.5) / NODES
    cos = np.sqrt((1 - x) / (1 + (alpha**2 - 1) * x))
    slope = -(alpha**2) / (2 * cos * (1 + (alpha**2 - 1) * x) ** 2)
    whole = 2 * np.pi * (reference.ggx(cos, alpha) * cos * np.abs(slope)).mean()
    assert whole == pytest.approx(1, abs=1e-9)


@pytest.mark.parametrize("alpha", [0.1, 0.5, 1.0])
def test_what_is_seen_of_all_microfacets_is_the_surface_itself(alpha: float) -> None:
    """G1 is what makes it so: the sum of the visible microfacets' areas is the cosine of the view."""
    theta, phi = np.meshgrid(
        (np.arange(1500) + 0.5) / 1500 * np.pi / 2, (np.arange(600) + 0.5) / 600 * 2 * np.pi
    )
    theta, phi = theta.ravel(), phi.ravel()
    wm = np.stack((np.sin(theta) * np.cos(phi), np.sin(theta) * np.sin(phi), np.cos(theta)))
    wo = np.repeat([[0.8], [0.0], [0.6]], theta.size, axis=1)
    area = np.maximum((wo * wm).sum(axis=0), 0) * reference.ggx(wm[2], alpha)
    whole = (area * np.sin(theta)).mean() * np.pi**2
    masked = reference.smith_g1(np.array([0.6]), alpha)[0] * whole
    assert masked == pytest.approx(0.6, rel=1e-4)


def test_a_perfect_metal_seen_from_above_returns_1_minus_ln_2() -> None:
    """Of alpha 1: the mean of G2 / G1, whose variance is at most 1/4; false-fail rate 1e-6."""
    n = 200_000
    wo = np.repeat([[0.0], [0.0], [1.0]], n, axis=1)
    wm = reference.sample_visible_normal(wo, 1.0, unit(2, n, np.float64, 5))
    wi = 2 * (wo * wm).sum(axis=0) * wm - wo
    returned = reference.smith_g2(wo[2], wi[2], 1.0) / reference.smith_g1(wo[2], 1.0)
    assert_mean(returned, 1 - np.log(2), 0.25)


def test_the_value_over_its_density_is_what_samples_count() -> None:
    """F D G2 / (4 cos cos) cos_i over G1 dot D / cos_o / (4 dot) is F G2 / G1."""
    alpha, n, k = 0.4, np.array([0.2, 1.0, 2.0]), np.array([3.0, 2.0, 4.0])
    wo = above(2000, 1)
    wm = reference.sample_visible_normal(wo, alpha, unit(2, 2000, np.float64, 2))
    slant = (wo * wm).sum(axis=0)
    wi = 2 * slant * wm - wo
    density = reference.visible_normal_pdf(wo, wm, alpha) / (4 * slant)
    seen = wi[2] > 1e-6
    found = (reference.brdf(wo, wi, alpha, n, k) * wi[2] / density)[:, seen]
    ratio = reference.smith_g2(wo[2], wi[2], alpha) / reference.smith_g1(wo[2], alpha)
    expected = (reference.fresnel_complex(slant, n, k) * ratio)[:, seen]
    np.testing.assert_allclose(found, expected, rtol=1e-6)


def test_exchanging_both_directions_changes_nothing() -> None:
    wo, wi = above(3000, 3), above(3000, 4)
    index = np.array([0.2, 1.5, 3.0]), np.array([3.0, 0.0, 2.0])
    one, other = (reference.brdf(*pair, 0.3, *index) for pair in ((wo, wi), (wi, wo)))
    np.testing.assert_allclose(one, other, rtol=1e-6)


def test_glass_is_that_of_blurred_transparency() -> None:
    from solutions import blurred_transparency

    cos = np.linspace(0.01, 1, 300)
    for n in (1.5, 1 / 1.5):
        found = reference.fresnel_complex(cos, np.full(3, n), np.zeros(3))
        # At the critical angle both lose digits.
        np.testing.assert_allclose(found[0], blurred_transparency.fresnel(cos, 1 / n), atol=1e-7)


def test_metals_are_those_of_the_renderer() -> None:
    from course.engine.terms.scattering.conductors import conductor_reflectance

    cos = np.linspace(0.01, 1, 300)
    n, k = np.array([0.18, 0.42, 1.37]), np.array([3.42, 2.35, 1.77])
    expected = conductor_reflectance(
        cos.astype(np.float32), *(np.repeat(x[:, None], 300, 1).astype(np.float32) for x in (n, k))
    )
    np.testing.assert_allclose(reference.fresnel_complex(cos, n, k), expected, atol=2e-6)
