"""Directions, places, powers and weights as curves and histograms, over those of the right function."""

from __future__ import annotations

from types import ModuleType
from typing import TYPE_CHECKING

import numpy as np

from sitebuild.mistakes.look import Look
from sitebuild.mistakes.plots import Array, drawn, histogram, label, plot

if TYPE_CHECKING:
    from matplotlib.axes import Axes

N = 40_000

AXIS, EDGE = np.array([0.6, 0.0, 0.8]), 0.4

POWER, ALBEDO = np.array([1.0, 0.6, 0.3]), np.array([0.3, 0.7, 0.5])

U = np.linspace(0.001, 0.998, 160)

COUNTS = np.array([1, 2, 3, 5, 8, 12, 20])


def _numbers(seed: int) -> Array:
    return np.random.default_rng(seed).random((2, N))


def _cosines(axes: Axes, made: ModuleType, _: ModuleType) -> None:
    way = made.emit_cone(AXIS, EDGE, np.ones(3), 1, _numbers(1))[0]
    histogram(axes, AXIS @ way, lambda c: ((c >= EDGE) & (c <= 1)) / (1 - EDGE), (-1, 1))
    label(axes, "cosine to the axis; the edge is at 0.4")


def _turns(axes: Axes, made: ModuleType, _: ModuleType) -> None:
    way = made.emit_cone(np.array([0.0, 0, 1]), EDGE, np.ones(3), 1, _numbers(2))[0]
    histogram(
        axes,
        np.arctan2(way[1], way[0]) / (2 * np.pi) % 1,
        lambda c: 1.0 * (np.abs(c - 0.5) <= 0.5),
        (0, 1),
    )
    label(axes, "turn about the axis")


def _cone_power(module: ModuleType) -> Array:
    """Of all photons together, by how many there are, when four of them are made at a time."""
    u = np.full((2, 4), 0.4)
    return np.array(
        [
            count * module.emit_cone(AXIS, EDGE, np.ones(3), int(count), u)[1][0, 0]
            for count in COUNTS
        ]
    )


def _area_power(module: ModuleType) -> Array:
    """Of photons by the number that drives their cosine."""
    normal = np.repeat([[0.0], [0], [1]], len(U), 1)
    u = np.stack((U, np.full_like(U, 0.3)))
    return module.emit_area(normal, np.ones(3), 2.0, 10, u)[1][0]


def _area_all(module: ModuleType) -> Array:
    """Of all photons together, by how many there are."""
    normal, u = np.array([[0.0], [0], [1]]), np.full((2, 1), 0.4)
    return np.array(
        [
            count * module.emit_area(normal, np.ones(3), 2.0, int(count), u)[1][0, 0]
            for count in COUNTS
        ]
    )


def _area_sizes(module: ModuleType) -> Array:
    normal, u = np.array([[0.0], [0], [1]]), np.full((2, 1), 0.4)
    return np.array([module.emit_area(normal, np.ones(3), area, 10, u)[1][0, 0] for area in AREAS])


AREAS = np.linspace(0.2, 3, 12)


def _to_normal(axes: Axes, made: ModuleType, _: ModuleType) -> None:
    normal = np.repeat(AXIS[:, None], N, 1)
    way = made.emit_area(normal, np.ones(3), 1.0, 1, _numbers(3))[0]
    histogram(axes, AXIS @ way, lambda c: 2 * c * ((c >= 0) & (c <= 1)), (-1, 1))
    label(axes, "cosine to the normal")


def _radii(axes: Axes, made: ModuleType, _: ModuleType) -> None:
    start = made.emit_directional(AXIS, np.ones(3), np.zeros(3), 1.0, 1, _numbers(4))[0]
    aside = start - AXIS[:, None] * (AXIS @ start)
    histogram(
        axes, np.linalg.norm(aside, axis=0), lambda r: 2 * r * ((r >= 0) & (r <= 1)), (0, 1.2)
    )
    label(axes, "distance from the middle of the disk")


def _disk_power(module: ModuleType) -> Array:
    u = np.full((2, 1), 0.4)
    return np.array(
        [
            count
            * module.emit_directional(AXIS, np.ones(3), np.zeros(3), 0.8, int(count), u)[1][0, 0]
            for count in COUNTS
        ]
    )


def _along(module: ModuleType) -> Array:
    """Where photons start, along the light's way, by the place of the scene's middle on it."""
    return np.array(
        [
            AXIS
            @ module.emit_directional(AXIS, np.ones(3), far * AXIS, 0.5, 1, np.full((2, 1), 0.4))[0]
            for far in FAR
        ]
    )[:, 0]


FAR = np.linspace(-2, 2, 40)


def _sent_on(module: ModuleType) -> Array:
    """Powers by u: 0 where a photon ends."""
    power, albedo = (np.repeat(each[:, None], len(U), 1) for each in (POWER, ALBEDO))
    return module.roulette(power, albedo, U)[1]


def _weak(module: ModuleType) -> Array:
    """The same for a photon of a hundredth of the power, a hundred times as large."""
    power, albedo = (np.repeat(each[:, None], len(U), 1) for each in (POWER / 100, ALBEDO))
    return 100 * module.roulette(power, albedo, U)[1]


WORDS = np.arange(12)


def _kept(module: ModuleType) -> Array:
    """Both masks for a few words, one above the other."""
    matte = WORDS % 2 == 0
    specular, diffuse = np.array([0, 0, 1, 1, 2, 2, 0, 0, 1, 1, 2, 2]), np.repeat([0, 1], 6)
    caustic, indirect = module.stored(matte, specular, diffuse)
    return np.stack((caustic + 2.0, 1.0 * indirect))


SLANT = np.linspace(-1, 1, 160)


def _by_slant(module: ModuleType) -> Array:
    """The irradiance by photons that come at a cosine; below 0 from behind."""
    n = len(SLANT)
    way = np.stack((np.sqrt(1 - SLANT**2), 0 * SLANT, -SLANT))
    power = np.ones((3, 3, n))
    distance = np.repeat([[0.3], [1.0], [0.6]], n, 1)
    normal = np.repeat([[0.0], [0], [1]], n, 1)
    return module.density_estimate(power, np.stack([way] * 3, axis=1), distance, normal)[0]


D = np.linspace(0, 1.6, 200)


def _weights(module: ModuleType) -> Array:
    return module.cone_weights(D, np.full_like(D, 1.2), 1.1)


BRIGHT = np.linspace(0, 4, 40)


def _gathered(module: ModuleType) -> Array:
    """Radiance by the irradiance that two of three rays meet."""
    n = len(BRIGHT)
    irradiance = np.repeat(BRIGHT[None, None], 3, 0) * np.array([1, 1, 0])[None, :, None]
    albedo = np.repeat([[0.8], [0.5], [0.3]], n, 1)
    return module.final_gather(albedo, np.full((3, 3, n), 0.7), irradiance)


PASSES = np.arange(1, 41)


def _shrinking(module: ModuleType) -> Array:
    """The radii of forty passes."""
    radius, found = np.ones(1), []
    for number in PASSES:
        found.append(radius[0])
        radius = module.shrunk_radius(radius, np.array([number]), 2 / 3)
    return np.minimum(np.array(found), 3)


_GREY, _LINE = "grey below: what is right", "the line is what it should be"

LOOKS = {
    "emit_cone": (
        Look(f"How many directions have which cosine; {_LINE}", plot(_cosines, curve=True)),
        Look(
            f"The power of all photons, by how many there are; {_GREY}",
            drawn(COUNTS, _cone_power, "photons"),
            (
                "cone_power_not_divided",
                "cone_divided_by_batch",
                "cone_without_solid_angle",
            ),
        ),
        Look(
            f"How many directions have which turn; {_LINE}",
            plot(_turns, curve=True),
            ("cone_half_turn",),
        ),
    ),
    "emit_area": (
        Look(f"How many directions have which cosine; {_LINE}", plot(_to_normal, curve=True)),
        Look(
            f"The power of all photons, by how many there are; {_GREY}",
            drawn(COUNTS, _area_all, "photons"),
            ("area_without_pi", "area_two_pi"),
        ),
        Look(
            f"The power of a photon, by the size of the lamp; {_GREY}",
            drawn(AREAS, _area_sizes, "area"),
            ("area_without_area",),
        ),
        Look(
            f"The power of photons, by the number that drives their cosine; {_GREY}",
            drawn(U, _area_power, "the number u[0]"),
            ("area_cosine_twice",),
        ),
    ),
    "emit_directional": (
        Look(f"How far photons start from the middle; {_LINE}", plot(_radii, curve=True)),
        Look(
            f"The power of all photons, by how many there are; {_GREY}",
            drawn(COUNTS, _disk_power, "photons"),
            ("directional_without_area",),
        ),
        Look(
            f"Where photons start along the light's way; {_GREY}",
            drawn(FAR, _along, "where the scene's middle is"),
            ("directional_behind", "directional_through_middle"),
        ),
    ),
    "roulette": (
        Look(
            f"Powers that go on, in three channels; {_GREY}",
            drawn(U, _sent_on, "the number u"),
        ),
        Look(
            f"The same of a photon with a hundredth of the power, a hundred times as large; {_GREY}",
            drawn(U, _weak, "the number u"),
            ("roulette_by_power",),
        ),
    ),
    "stored": (
        Look(
            f"Which of twelve photons are in the map of caustics, above, and in the other, below; {_GREY}",
            drawn(WORDS, _kept, "photon"),
        ),
    ),
    "density_estimate": (
        Look(
            f"The irradiance of three photons, by the cosine at which they come; {_GREY}",
            drawn(SLANT, _by_slant, "cosine: below 0 from behind"),
        ),
    ),
    "cone_weights": (
        Look(f"The weight of a photon; {_GREY}", drawn(D, _weights, "distance; the radius is 1.2")),
    ),
    "final_gather": (
        Look(
            f"The radiance in three channels, where one of three rays meets nothing; {_GREY}",
            drawn(BRIGHT, _gathered, "irradiance where the other two land"),
        ),
    ),
    "shrunk_radius": (
        Look(
            f"The radii of forty passes, cut off at 3; {_GREY}",
            drawn(PASSES, _shrinking, "pass"),
        ),
    ),
}
