"""Shares, distances and densities as curves, over those of the right function."""

from __future__ import annotations

from types import ModuleType
from typing import TYPE_CHECKING

import numpy as np

from sitebuild.mistakes.look import Look
from sitebuild.mistakes.plots import Array, drawn, histogram, label, plot

if TYPE_CHECKING:
    from matplotlib.axes import Axes

SIGMA, WEIGHTS = np.array([0.4, 1.0, 2.4]), np.array([0.5, 0.3, 0.2])

DENSITIES = np.array([0.2, 1.6, 0.4, 1.2]).reshape(4, 1, 1)


T = np.linspace(0, 4, 161)
U = np.linspace(0.001, 0.98, 160)
COS = np.linspace(-1, 1, 161)


def _flights(module: ModuleType) -> Array:
    """Distances where red and where blue is chosen."""
    return np.stack(
        [
            module.free_flight(SIGMA, WEIGHTS, np.stack((np.full_like(U, first), U)))
            for first in (0.2, 0.9)
        ]
    )


def _one_clear(module: ModuleType) -> Array:
    found = module.free_flight(SIGMA * (1, 1, 0), WEIGHTS, np.stack((np.full_like(U, 0.9), U)))
    return np.minimum(found, 5.0)


def _rays(count: int) -> tuple[Array, ...]:
    return np.zeros((3, count)), np.repeat([[1.0], [0], [0]], count, 1), np.full(count, 1.0)


def _tracked(axes: Axes, made: ModuleType, right: ModuleType) -> None:
    u = np.random.default_rng(2).random((2, 40, 40_000))
    majorant = 5 * 1.6
    distance, stopped = made.delta_tracking(5 * DENSITIES, majorant, *_rays(40_000), u)
    x = np.linspace(0, 1, 2001)
    there = np.interp(x * 4 - 0.5, np.arange(4), 5 * DENSITIES.ravel())
    left = np.exp(-np.concatenate(([0], np.cumsum((there[1:] + there[:-1]) / 2 * np.diff(x)))))
    share = there * left / max(1 - left[-1], 1e-9)
    histogram(axes, distance[stopped], lambda c: np.interp(c, x, share), (0, 1))
    label(axes, "distance")
    del right


def _shares(module: ModuleType) -> Array:
    """The mean share by the limit."""
    found = []
    for limit in LIMITS:
        origin, way, one = _rays(2000)
        u = np.random.default_rng(5).random((40, 2000))
        share, _ = module.ratio_tracking(5 * DENSITIES, 8.0, origin, way, limit * one, u)
        found.append(share.mean())
    return np.array(found)


LIMITS = np.linspace(0.02, 1, 25)


def _places(module: ModuleType) -> Array:
    n = len(U)
    light = np.repeat([[1.2], [0.4], [0]], n, 1)
    rays = np.zeros((3, n)), np.repeat([[1.0], [0], [0]], n, 1)
    return np.stack(module.equiangular(*rays, light, np.full(n, 3.0), U))


def _added(module: ModuleType) -> Array:
    one = np.ones_like(T)
    return module.in_scattering(SIGMA * (0.9, 0.6, 0.4), SIGMA, T, 0.5 * one, 0.1 * one, 0.6 * one)


def _turned(axes: Axes, made: ModuleType, _: ModuleType) -> None:
    n = 40_000
    direction = np.repeat([[0.6], [0.0], [0.8]], n, 1)
    way = made.sample_henyey_greenstein(direction, 0.5, np.random.default_rng(1).random((2, n)))[0]
    histogram(
        axes,
        (way * direction).sum(axis=0),
        lambda c: 0.5 * 0.75 / (1.25 - c) ** 1.5 * (np.abs(c) <= 1),
        (-1, 1),
    )
    label(axes, "cosine to the way before, g = 0.5")


def _turns(axes: Axes, made: ModuleType, _: ModuleType) -> None:
    n = 40_000
    direction = np.repeat([[0.0], [0.0], [1.0]], n, 1)
    way = made.sample_henyey_greenstein(direction, 0.5, np.random.default_rng(1).random((2, n)))[0]
    histogram(
        axes,
        np.arctan2(way[1], way[0]) / (2 * np.pi) % 1,
        lambda c: 1.0 * (np.abs(c - 0.5) <= 0.5),
        (0, 1),
    )
    label(axes, "turn about the way before")


def _even_turned(axes: Axes, made: ModuleType, _: ModuleType) -> None:
    n = 40_000
    direction = np.repeat([[0.6], [0.0], [0.8]], n, 1)
    way = made.sample_henyey_greenstein(direction, 0.0, np.random.default_rng(1).random((2, n)))[0]
    histogram(
        axes,
        (way * direction).sum(axis=0),
        lambda c: 0.5 * (np.abs(c) <= 1),
        (-1, 1),
    )
    label(axes, "cosine to the way before, g = 0")


def _densities(module: ModuleType) -> Array:
    direction = np.repeat([[0.0], [0.0], [1.0]], len(U), 1)
    u = np.stack((U, np.full_like(U, 0.3)))
    return module.sample_henyey_greenstein(direction, 0.5, u)[1]


_GREY, _LINE = "grey below: what is right", "the line is what it should be"

LOOKS = {
    "transmittance": (
        Look(
            f"The shares of three channels; {_GREY}",
            drawn(T, lambda m: m.transmittance(SIGMA, T), "distance"),
        ),
    ),
    "free_flight": (
        Look(
            f"Distances of red and of blue by u[1]; {_GREY}",
            drawn(U, _flights, "the number u[1]"),
        ),
        Look(
            f"Distances of a channel that isn't stopped, cut off at 5; {_GREY}",
            drawn(U, _one_clear, "the number u[1]"),
            ("flight_never_ends",),
        ),
        Look(
            f"Distances for the same u[1] by u[0]; {_GREY}",
            drawn(
                U,
                lambda m: m.free_flight(SIGMA, WEIGHTS, np.stack((U, np.full_like(U, 0.6)))),
                "the number u[0]",
            ),
            ("flight_even_channels",),
        ),
    ),
    "free_flight_pdf": (
        Look(
            f"The density; {_GREY}",
            drawn(T, lambda m: m.free_flight_pdf(SIGMA, WEIGHTS, T), "distance"),
        ),
    ),
    "henyey_greenstein": (
        Look(
            f"The phase function for g = 0.5; {_GREY}",
            drawn(COS, lambda m: m.henyey_greenstein(COS, 0.5), "cosine: 1 is straight on"),
        ),
    ),
    "sample_henyey_greenstein": (
        Look(f"How many directions have which cosine; {_LINE}", plot(_turned, curve=True)),
        Look(
            f"How many directions have which turn; {_LINE}",
            plot(_turns, curve=True),
            ("scatter_half_turn",),
        ),
        Look(
            f"How many directions have which cosine where g is 0; {_LINE}",
            plot(_even_turned, curve=True),
            ("scatter_not_a_number",),
        ),
        Look(
            f"The density that is returned; {_GREY}",
            drawn(U, _densities, "the number u[0]"),
            ("scatter_pdf_of_cosine",),
        ),
    ),
    "delta_tracking": (
        Look(f"Where flights end in uneven fog; {_LINE}", plot(_tracked, curve=True)),
    ),
    "ratio_tracking": (
        Look(
            f"The mean share that gets through uneven fog; {_GREY}",
            drawn(LIMITS, _shares, "limit"),
        ),
    ),
    "equiangular": (
        Look(
            f"Distances and densities by u; {_GREY}",
            drawn(U, _places, "the number u"),
        ),
    ),
    "in_scattering": (
        Look(
            f"What is added in three channels; {_GREY}",
            drawn(T, _added, "distance from the eye"),
        ),
    ),
}
