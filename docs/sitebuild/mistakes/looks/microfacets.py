"""Curves over angles, and normals seen from above."""

from __future__ import annotations

from types import ModuleType
from typing import TYPE_CHECKING, Any

import numpy as np

from sitebuild.mistakes.look import Look
from sitebuild.mistakes.plots import LINE, circle, curves, dots, label, plot, view

if TYPE_CHECKING:
    from matplotlib.axes import Axes

Array = np.ndarray[Any, Any]

ANGLE = np.linspace(-1.5, 1.9, 300)
ALPHA = 0.4
SHARP = 0.001
GOLD = np.array([0.18, 0.42, 1.37]), np.array([3.42, 2.35, 1.77])
FLAT = np.array([[0.95], [0.0], [np.sqrt(1 - 0.95**2)]])


def _in_plane(angle: Array) -> Array:
    return np.stack((np.sin(angle), 0 * angle, np.cos(angle)))


def _distribution(axes: Axes, made: ModuleType, right: ModuleType) -> None:
    curves(axes, np.degrees(ANGLE), *(m.ggx(np.cos(ANGLE), ALPHA) for m in (made, right)))
    label(axes, "angle of the microfacet, degrees")


def _sharp(axes: Axes, made: ModuleType, right: ModuleType) -> None:
    """At all cosines next to 1 that single precision has."""
    cos = (1 - np.arange(60) * 2.0**-24).astype(np.float32)
    exact = right.ggx(cos.astype(np.float64), SHARP)
    found = (m.ggx(cos, SHARP) / exact for m in (made, right))
    curves(axes, 1000 * np.arccos(cos.astype(np.float64)), *found)
    axes.set_ylim(0.97, 1.01)
    label(axes, "angle, thousandths of a radian")


def _masking(axes: Axes, made: ModuleType, right: ModuleType) -> None:
    curves(axes, np.degrees(ANGLE), *(m.smith_g1(np.cos(ANGLE), 0.8) for m in (made, right)))
    label(axes, "angle of the view, degrees")


def _both(axes: Axes, made: ModuleType, right: ModuleType) -> None:
    cos = np.cos(ANGLE)
    curves(axes, np.degrees(ANGLE), *(m.smith_g2(0 * cos + 0.35, cos, 0.8) for m in (made, right)))
    label(axes, "angle of the light, degrees")


def _drawn(axes: Axes, made: ModuleType, _: ModuleType) -> None:
    u = np.random.default_rng(4).random((2, 900))
    found = np.asarray(made.sample_visible_normal(np.repeat(FLAT, 900, axis=1), ALPHA, u))
    circle(axes, 0, 0, 1)
    dots(axes, found[:2], size=2)
    dots(axes, FLAT[:2], "#333333", 16)
    view(axes, (-1.05, 1.05), (-1.05, 1.05))


def _drawn_in_the_middle(axes: Axes, made: ModuleType, _: ModuleType) -> None:
    """Normals of a small alpha, seen from the right along the surface; a cross is at the middle."""
    u = np.random.default_rng(4).random((2, 900))
    wo = np.repeat(_in_plane(np.array([1.5])), 900, axis=1)
    found = np.asarray(made.sample_visible_normal(wo, 0.05, u))
    axes.axhline(0, color=LINE, linewidth=1)
    axes.axvline(0, color=LINE, linewidth=1)
    dots(axes, found[:2], size=2)
    view(axes, (-0.2, 0.2), (-0.2, 0.2))


def _density(axes: Axes, made: ModuleType, right: ModuleType) -> None:
    wo = np.repeat(FLAT, ANGLE.size, axis=1)
    found = (m.visible_normal_pdf(wo, _in_plane(ANGLE), ALPHA) for m in (made, right))
    curves(axes, np.degrees(ANGLE), *found)
    label(axes, "angle of the microfacet, degrees")


def _reflectance(axes: Axes, made: ModuleType, right: ModuleType) -> None:
    angle = np.linspace(0, np.pi / 2, 200)
    found = [m.fresnel_complex(np.cos(angle), *GOLD)[2] for m in (made, right)]
    curves(axes, np.degrees(angle), *found)
    label(axes, "angle of the light, degrees")


def _value(view: float, channel: int) -> Any:
    def draw(axes: Axes, made: ModuleType, right: ModuleType) -> None:
        angle = np.linspace(-1.9, 1.9, 300)
        wo = np.repeat(_in_plane(np.array([view])), angle.size, axis=1)
        found = (m.brdf(wo, _in_plane(angle), ALPHA, *GOLD)[channel] for m in (made, right))
        curves(axes, np.degrees(angle), *found)
        label(axes, "angle of the light, degrees")

    return draw


LOOKS = {
    "ggx": (
        Look("D over the angle", plot(_distribution, curve=True)),
        Look(
            "D of alpha 0.001 in single precision, over that in double precision",
            plot(_sharp, curve=True),
            ("ggx_loses_digits",),
        ),
    ),
    "smith_g1": (Look("What is seen over the angle of the view", plot(_masking, curve=True)),),
    "smith_g2": (Look("What both ends see, the view being flat", plot(_both, curve=True)),),
    "sample_visible_normal": (
        Look("Normals from above; the large dot is the view", plot(_drawn)),
        Look(
            "Normals of alpha 0.05 around the cross, from above; the view is flat, from the right",
            plot(_drawn_in_the_middle),
            ("sample_view_not_stretched",),
        ),
    ),
    "visible_normal_pdf": (Look("Densities in the plane of the view", plot(_density, curve=True)),),
    "fresnel_complex": (Look("What gold mirrors of blue light", plot(_reflectance, curve=True)),),
    "brdf": (
        Look("Values in the plane of the view", plot(_value(0.9, 0), curve=True)),
        Look(
            "Values for blue light in the plane of a flat view",
            plot(_value(1.2, 2), curve=True),
            ("brdf_fresnel_of_surface",),
        ),
    ),
}
