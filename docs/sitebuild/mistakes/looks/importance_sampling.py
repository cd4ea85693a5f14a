"""Densities of directions as histograms, formulas as curves, and estimates over their number of samples."""

from __future__ import annotations

from types import ModuleType
from typing import TYPE_CHECKING

import numpy as np

from sitebuild.mistakes.look import Look
from sitebuild.mistakes.plots import INK, RIGHT, Array, Plot, curves, histogram, label, plot

if TYPE_CHECKING:
    from matplotlib.axes import Axes


def _u(count: int) -> Array:
    return np.random.default_rng(3).random((2, count), np.float32)


def _heights(function: str, cosine: bool) -> Plot:
    """Draw how many directions are how high above the horizon."""

    def draw(axes: Axes, made: ModuleType, _: ModuleType) -> None:
        height = getattr(made, function)(_u(60000))[2]
        histogram(
            axes, height, lambda c: (2 * c if cosine else 1.0) * ((c >= 0) & (c <= 1)), (-1, 1)
        )
        label(axes, "cosine: 0 the horizon, 1 the pole")

    return draw


def _density(axes: Axes, made: ModuleType, right: ModuleType) -> None:
    cos = np.linspace(-1, 1, 201)
    axes.axhline(0, color="#bbb", linewidth=0.7)
    curves(axes, cos, made.cosine_hemisphere_pdf(cos), right.cosine_hemisphere_pdf(cos))
    label(axes, "cosine: 0 the horizon, 1 the pole")


def _lobe(axes: Axes, made: ModuleType, right: ModuleType) -> None:
    cos = np.linspace(-1, 1, 201)
    curves(axes, cos, made.phong_lobe_pdf(cos, 2.0), right.phong_lobe_pdf(cos, 2.0))
    label(axes, "cosine of the angle to the axis, n = 2")


def _samples(count: int, zeros: bool) -> tuple[Array, Array]:
    """The integral of 3 x^2 from 0 to 1, which is 1, by samples of density 2 x; or with a half that brings nothing."""
    x = np.sqrt(np.random.default_rng(7).random(4096)[:count])
    f, pdf = 3 * x * x, 2 * x
    if zeros:
        f, pdf = (np.where(np.arange(count) % 2 == 0, 0, each) for each in (f, pdf))
    return f, pdf


def _estimates(zeros: bool) -> Plot:
    """Draw estimates with twice their predicted error, over the number of samples."""

    def draw(axes: Axes, made: ModuleType, right: ModuleType) -> None:
        counts = 2 ** np.arange(3, 13)
        for module, right_one in ((right, True), (made, False)):
            found = [module.estimate(*_samples(int(n), zeros)) for n in counts]
            mean, variance = (np.array(each, float) for each in zip(*found, strict=True))
            if right_one:
                axes.plot(counts, mean, color=RIGHT, linewidth=3.2, alpha=0.6)
            else:
                spread = 2 * np.sqrt(np.maximum(variance, 0))
                axes.errorbar(counts, mean, spread, color=INK, linewidth=1.2, capsize=2)
        axes.set_xscale("log", base=2)
        axes.set_ylim(0, 3)
        label(axes, "samples")

    return draw


def _variances(offset: float, most: int = 11) -> Plot:
    """Draw the predicted variance over the number of samples, in powers if there are many."""

    def draw(axes: Axes, made: ModuleType, right: ModuleType) -> None:
        counts = 2 ** np.arange(1, most)
        for module, right_one in ((right, True), (made, False)):
            found = []
            for n in counts:
                f, pdf = (each.astype(np.float32) for each in _samples(int(n), zeros=False))
                found.append(float(module.estimate(f + np.float32(offset) * pdf, pdf)[1]))
            if right_one:
                axes.plot(counts, found, color=RIGHT, linewidth=3.2, alpha=0.6)
            else:
                axes.plot(counts, np.maximum(found, 1e-9), color=INK, linewidth=1.4, marker=".")
        axes.set_xscale("log", base=2)
        if most > 5:
            axes.set_yscale("log")
            axes.set_ylim(1e-5, 3)
        else:
            axes.set_ylim(bottom=0)
        label(axes, "samples")

    return draw


def _weights(axes: Axes, made: ModuleType, right: ModuleType) -> None:
    a = np.linspace(0, 4, 200)
    b = np.ones_like(a)
    curves(axes, a, made.power_heuristic(a, b), right.power_heuristic(a, b))
    label(axes, "density a, where b = 1")


def _extremes(axes: Axes, made: ModuleType, right: ModuleType) -> None:
    power = np.linspace(-6, 6, 149)
    b = (10**power).astype(np.float32)
    curves(axes, power, made.power_heuristic(2 * b, b), right.power_heuristic(2 * b, b))
    axes.set_ylim(-0.05, 1.1)
    label(axes, "a = 2 b, and b is this power of 10")


_LINE = "the line is what it should be"
_GREY = "grey below: what is right"

LOOKS = {
    "uniform_hemisphere": (
        Look(
            f"How many directions are how high; {_LINE}",
            plot(_heights("uniform_hemisphere", cosine=False), curve=True),
        ),
    ),
    "cosine_hemisphere": (
        Look(
            f"How many directions are how high; {_LINE}",
            plot(_heights("cosine_hemisphere", cosine=True), curve=True),
        ),
    ),
    "cosine_hemisphere_pdf": (Look(f"The density; {_GREY}", plot(_density, curve=True)),),
    "phong_lobe_pdf": (Look(f"The density; {_GREY}", plot(_lobe, curve=True)),),
    "estimate": (
        Look(
            f"Estimates of an integral that is 1, with bars of twice their error; {_GREY}",
            plot(_estimates(zeros=False), curve=True),
            ("estimate_no_density", "estimate_times", "estimate_ratio"),
        ),
        Look(
            f"The variance that is returned, in powers; {_GREY}",
            plot(_variances(0), curve=True),
            ("estimate_one_sample", "estimate_deviation"),
        ),
        Look(
            f"The variance that is returned for few samples; {_GREY}",
            plot(_variances(0, 5), curve=True),
            ("estimate_biased",),
        ),
        Look(
            f"Estimates where every other sample brings 0, with bars of twice their error; {_GREY}",
            plot(_estimates(zeros=True), curve=True),
            ("estimate_drops_zeros",),
        ),
        Look(
            f"The variance that is returned, of samples that are nearly 2000 each; {_GREY}",
            plot(_variances(2000), curve=True),
            ("estimate_one_pass",),
        ),
    ),
    "power_heuristic": (
        Look(f"The weight; {_GREY}", plot(_weights, curve=True)),
        Look(
            f"The weight for small and large densities; {_GREY}",
            plot(_extremes, curve=True),
            ("power_enlarged",),
        ),
    ),
}
