"""Figures of photon_mapping: ways of light, the disk around a point, the cone filter, radii that shrink."""

import numpy as np

from sitebuild.diagrams.canvas import Canvas
from sitebuild.diagrams.figure import Figure, Panel
from solutions import photon_mapping


def _refracted(way: np.ndarray, normal: np.ndarray, eta: float) -> np.ndarray:
    """A unit way (2,) bent at a surface; the normal is on the side that it comes from."""
    cos = -float(way @ normal)
    rest = np.sqrt(1 - eta * eta * (1 - cos * cos))
    return eta * way + (eta * cos - rest) * normal


def _through_ball(
    lamp: np.ndarray, way: np.ndarray, middle: np.ndarray, radius: float
) -> list[np.ndarray]:
    """Places of a photon that flies through a glass ball to the floor; it must meet the ball."""
    back = lamp - middle
    b = float(back @ way)
    first = lamp + (-b - np.sqrt(b * b - back @ back + radius**2)) * way
    normal = (first - middle) / radius
    inner = _refracted(way, normal, 1 / 1.5)
    second = first - 2 * float((first - middle) @ inner) * inner
    out = _refracted(inner, (middle - second) / radius, 1.5)
    return [lamp, first, second, second - out * second[1] / out[1]]


def ways() -> Figure:
    """Photons through a glass ball."""
    lamp, middle, radius = np.array([1.5, 2.3]), np.array([1.5, 0.95]), 0.5
    canvas = Canvas(350, 236, (-0.2, 3.2, -0.25, 2.45), 6)
    canvas.surface((0, 0), (3, 0))
    canvas.circle(middle, radius, "wash")
    canvas.circle(middle, radius, "ink thin")
    for angle in np.linspace(-0.27, 0.27, 9):
        way = np.array([np.sin(angle), -np.cos(angle)])
        places = _through_ball(lamp, way, middle, radius)
        canvas.path(np.stack(places, axis=1), "accent thin")
        canvas.dot(places[-1], "accent", 2.6)
    for angle in (-0.52, 0.52):
        way = np.array([np.sin(angle), -np.cos(angle)])
        canvas.line(lamp, lamp - way * lamp[1] / way[1], "faint thin")
    canvas.dot(lamp, "ink", 4)
    canvas.label(lamp, "lamp", "e", 7)
    canvas.label((0.5, 0.16), "LD", "n", 2)
    canvas.label((2.4, 0.16), "LSSD", "n", 2)
    return Figure(
        "Photons from a lamp. Those that a glass ball bends gather on the floor: a caustic, LSSD. Dots are photons"
        " that are kept. Thin grey ways come straight from the lamp, and are left to shadow rays.",
        (
            Panel(
                canvas,
                "Ways of photons",
                "Nine lines go from a lamp through a ball and meet the floor near each other; two others go past it.",
            ),
        ),
    )


def steps() -> Figure:
    """Photons around a point, in three passes."""
    rng = np.random.default_rng(5)
    panels = []
    radius = np.array([0.62])
    for number in (1, 2, 3):
        canvas = Canvas(172, 150, (-1.1, 1.1, -1.0, 1.0), 4)
        places = rng.uniform(-1, 1, (2, 60)) * np.array([[1.1], [0.95]])
        r = float(radius[0])
        near = np.hypot(*places) <= r
        canvas.circle((0, 0), r, "wash")
        canvas.circle((0, 0), r, "ink thin")
        for place, inside in zip(places.T, near, strict=True):
            canvas.dot(place, "accent" if inside else "faint", 2.4)
        canvas.cross((0, 0), "ink", 4)
        panels.append(
            Panel(
                canvas,
                f"Pass {number}",
                f"{near.sum()} of 60 photons lie in a disk of radius {r:.2f}.",
                f"Pass {number}: {near.sum()} photons",
            )
        )
        radius = photon_mapping.shrunk_radius(radius, np.array([number]), 0.3)
    return Figure(
        "Three passes. Each has new photons and a smaller disk; the irradiance at the cross is the mean over the"
        " passes of the photons' power over the disk's area. Here $α$ is 0.3, so that it shrinks fast.",
        tuple(panels),
    )


def cone() -> Figure:
    """Weights of the filter, for three k."""
    panels = []
    distance = np.linspace(0, 1.3, 260)
    for k in (1.0, 1.5, 4.0):
        canvas = Canvas(172, 120, (-0.08, 1.4, -0.18, 1.05), 4, stretch=True)
        weight = photon_mapping.cone_weights(distance, np.ones_like(distance), k)
        canvas.path(np.stack((np.r_[0, distance], np.r_[0, weight])), "wash", closed=True)
        edge = weight[distance <= 1][-1]
        canvas.path(np.stack((distance, weight)), "accent")
        canvas.line((0, 1 / np.pi), (1, 1 / np.pi), "ink dashed")
        canvas.arrow((0, 0), (1.36, 0))
        canvas.label((1, 0), "$r$", "s", 5)
        panels.append(
            Panel(
                canvas,
                f"k = {k:g}",
                f"The weight falls from {weight[0]:.2f} in the middle to {edge:.2f} at the radius.",
                f"$k$ = {k:g}",
            )
        )
    return Figure(
        "Weights of the cone filter by the course's function, over the distance. The dashed line is the disk, 1 over"
        " its area. Turned about its axis, each shape has the volume 1.",
        tuple(panels),
    )


def radii() -> Figure:
    """Radii of a hundred passes for three alpha."""
    count = 100
    canvas = Canvas(350, 170, (-4, 116, -0.1, 1.1), 12, stretch=True)
    passes = np.arange(1, count + 1)
    for alpha, kind in ((0.9, "ink"), (2 / 3, "accent"), (0.1, "faint")):
        radius = np.ones(1)
        found = []
        for number in passes:
            found.append(radius[0])
            radius = photon_mapping.shrunk_radius(radius, np.array([number]), alpha)
        canvas.path(np.stack((passes, np.array(found))), kind)
        canvas.label((passes[-9], found[-9]), f"$α$ = {alpha:.2g}", "n", 8)
    canvas.arrow((0, 0), (112, 0))
    canvas.label((50, 0), "pass", "s", 5)
    return Figure(
        "Radii of a hundred passes, over the first. The smaller alpha, the faster they shrink: less blur and more"
        " noise.",
        (
            Panel(
                canvas,
                "Radii",
                "Three curves begin at 1 and fall, the one of the smallest alpha fastest.",
            ),
        ),
    )


FIGURES = {"ways": ways, "steps": steps, "cone": cone, "radii": radii}
