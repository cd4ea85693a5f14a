"""Sample patterns on a page: some as one drawing, or any of them live (_static/pattern_explorer.js).

The drawing is made by the course's own functions, for readers without scripts.
"""

from collections.abc import Callable
from dataclasses import dataclass
from html import escape

import numpy as np

from course.base.errors import CourseError
from course.engine.core.types import Floats32, Floats64
from course.engine.functions.effects import PROJECT, Effects
from course.engine.terms.samplers.sobol import sobol_words
from sitebuild.place import Place

PATTERNS = ("regular", "random", "jittered", "sobol", "scrambled", "halton", "hammersley")
CELLS = ("none", "squares", "wide", "tall", "columns", "rows")

SEED = 1
K = 8
"""Each panel of the square has K * K points."""

MANY = 400
"""Points of a panel of the disk and the sphere."""

PANEL = 200
GAP = 20
RADIUS = 90


@dataclass(frozen=True)
class Panel:
    """One drawing of points.

    Attributes
    ----------
    name : what stands above it
    points : right and down, each in [-1, 1]
    measured : a sentence about all of the points, those behind a sphere too
    """

    name: str
    points: Floats64
    measured: str


def pattern_explorer(place: Place, name: str, words: str = "") -> str:  # noqa: ARG001
    """Show patterns on a domain; ``words`` may name the pattern, the number of points and the cells to begin with.

    Raises
    ------
    CourseError
        There is no such domain, pattern or kind of cells.
    """
    if name not in PANELS:
        raise CourseError(f"no domain {name!r}; there are {', '.join(PANELS)}")
    chosen = {"pattern": "jittered", "count": "64", "cells": "none"}
    for word in words.split():
        if word.isdecimal() and 1 <= int(word) <= 1024:
            chosen["count"] = word
        elif word in PATTERNS:
            chosen["pattern"] = word
        elif word in CELLS:
            chosen["cells"] = word
        else:
            raise CourseError(f"{word!r} is no pattern, no kind of cells and no count up to 1024")
    panels = PANELS[name]()
    data = " ".join(f'data-{key}="{value}"' for key, value in chosen.items())
    measured = " ".join(panel.measured for panel in panels)
    return f"""<figure class="pattern-explorer" data-domain="{name}" {data}>
{_drawing(name, panels)}
<figcaption><span class="what">{escape(measured)}</span></figcaption>
</figure>
"""


def _drawing(domain: str, panels: list[Panel]) -> str:
    """All panels, two in a row, as SVG on one line."""
    step = PANEL + GAP
    height = -(-len(panels) // 2) * (PANEL + 2 * GAP)
    names = ", ".join(panel.name for panel in panels)
    drawn = "".join(
        f'<g transform="translate({(i % 2) * step + PANEL / 2},{i // 2 * (PANEL + 2 * GAP) + GAP + PANEL / 2})">'
        f"{_panel(domain, panel)}</g>"
        for i, panel in enumerate(panels)
    )
    return (
        f'<svg class="still" viewBox="0 0 {2 * step - GAP} {height}" role="img"'
        f' aria-label="{escape(f"Points: {names}")}">{drawn}</svg>'
    )


def _panel(domain: str, panel: Panel) -> str:
    if domain == "square":
        outline = f'<rect x="{-RADIUS}" y="{-RADIUS}" width="{2 * RADIUS}" height="{2 * RADIUS}"/>'
    else:
        half = f"a{RADIUS} {RADIUS} 0 1 0"
        outline = (
            f'<path class="outline" d="M{-RADIUS} 0{half} {2 * RADIUS} 0{half} {-2 * RADIUS} 0"/>'
        )
    radius = 2.6 if domain == "square" else 1.6
    circles = "".join(
        f'<circle cx="{x:.1f}" cy="{y:.1f}" r="{radius}"/>' for x, y in RADIUS * panel.points.T
    )
    title = f'<text x="0" y="{-RADIUS - 7}" text-anchor="middle">{escape(panel.name)}</text>'
    return title + outline + circles


def _square() -> list[Panel]:
    module = Effects(PROJECT / "solutions")
    random, jittered, regular = (
        module.function("supersampling", each) for each in ("random", "jittered", "regular")
    )
    sets: dict[str, Floats32] = {
        "regular": regular(K, 1)[:, 0],
        "random": random(K, 1, np.random.default_rng(SEED))[:, 0],
        "jittered": jittered(K, 1, np.random.default_rng(SEED))[:, 0],
        "Sobol": sobol(K * K),
    }
    return [
        Panel(
            name,
            2 * points.astype(np.float64) - 1,
            f"{name.capitalize()}: of {K * K} cells, {K} by {K}, {_cells_hit(points)} hold a point.",
        )
        for name, points in sets.items()
    ]


def sobol(count: int) -> Floats32:
    """Return the first points of Sobol's sequence, (2, count) in [0, 1)."""
    words = sobol_words(np.arange(count, dtype=np.uint32))
    return (words >> np.uint32(8)).astype(np.float32) * np.float32(2**-24)


def _cells_hit(points: Floats32) -> int:
    column, row = np.minimum((points * K).astype(int), K - 1)
    return len(np.unique(K * row + column))


def _mean(name: str, square: str, coordinate: Floats64, right: str) -> str:
    mean = np.mean(coordinate**2)
    return f"{name.capitalize()}: of {MANY} points the mean of {square} is {mean:.3f}; it should be {right}."


def _disk() -> list[Panel]:
    u = np.random.default_rng(SEED).random((2, MANY))
    warp = Effects(PROJECT / "solutions").function("sampling", "disk_by_polar")
    angle = 2 * np.pi * u[1]
    sets = {
        "uniform": warp(u),
        "a common mistake: uniform radius": u[0] * np.stack((np.cos(angle), np.sin(angle))),
    }
    return [
        Panel(
            name,
            points,
            _mean(name, "x²", points[0], "0.250"),
        )
        for name, points in sets.items()
    ]


def _sphere() -> list[Panel]:
    u = np.random.default_rng(SEED).random((2, MANY))
    warp = Effects(PROJECT / "solutions").function("sampling", "sphere_by_polar")
    polar, turn = np.pi * u[0], 2 * np.pi * u[1]
    ring = np.sin(polar)
    mistaken = np.stack((ring * np.cos(turn), ring * np.sin(turn), np.cos(polar)))
    tilt = np.radians(50)
    panels = []
    for name, (x, y, z) in (
        ("uniform", warp(u)),
        ("a common mistake: uniform angle", mistaken),
    ):
        near = y * np.cos(tilt) + z * np.sin(tilt) >= 0
        seen = np.stack((x, y * np.sin(tilt) - z * np.cos(tilt)))[:, near]
        panels.append(
            Panel(
                name,
                seen,
                _mean(name, "z²", z, "0.333"),
            )
        )
    return panels


PANELS: dict[str, Callable[[], list[Panel]]] = {
    "square": _square,
    "disk": _disk,
    "sphere": _sphere,
}
"""By the domain: the panels of its drawing."""
