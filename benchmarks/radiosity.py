"""Radiosity of a Cornell box of 10,000 patches: time and error over the shots, and pictures of the first ones.

The error is the light that is still missing, as a share of all light, against a solution that went on for ten times
nearer to its limit. Beside it stands the bound that the solution itself gives. `out/bench/radiosity.json` and
`out/bench/data/radiosity.json` hold the curve, and `out/bench/radiosity.png` shows the box after 1, 32 and 320 shots.
"""

from __future__ import annotations

import json
from dataclasses import dataclass, replace
from pathlib import Path
from time import perf_counter

import numpy as np
from PIL import Image, ImageDraw, ImageFont

from benchmarks.curve_files import keep
from benchmarks.figures import Figure
from course import load_scene
from course.benchmarking.plot_data import Plot, Series
from course.core.types import Floats32
from course.effects import PROJECT
from course.imaging.srgb import linear_to_srgb8
from course.radiosity.functions import Functions
from course.radiosity.patches import make_patches
from course.radiosity.radiosity import PATCHES, TOLERANCE, as_solution
from course.radiosity.solving import Shooting, with_ambient
from course.radiosity.viewing import look, own_view

OUT = Path("out/bench")
SCENE = PROJECT / "scenes" / "radiosity.yaml"
SHOWN = (1, 32, 320)
CHECKED = (*SHOWN, 1000, 3200, 10_000, 32_000)
GOAL = 60.0
"""Seconds to 1% of convergence."""

SIDE = 320
GAP = 8
CAPTION = 34


@dataclass(frozen=True)
class Point:
    """Where the solution stood."""

    shots: int
    seconds: float
    bound: float
    radiosity: Floats32
    unshot: Floats32


def measure_radiosity() -> list[Figure]:
    """Seconds to convergence, and the error that is left there."""
    scene = load_scene(SCENE)
    functions = Functions(scene.effects)
    started = perf_counter()
    patches = make_patches(scene, PATCHES)
    shooting = Shooting(patches, functions)
    spent = perf_counter() - started
    points: list[Point] = []
    for most in (*CHECKED, None):
        before, started = shooting.steps, perf_counter()
        shooting.run(TOLERANCE, most)
        spent += perf_counter() - started
        if shooting.steps > before:
            points.append(
                Point(
                    shooting.steps,
                    spent,
                    shooting.left,
                    shooting.radiosity.copy(),
                    shooting.unshot.copy(),
                )
            )
    solved = shooting.solved
    shooting.run(TOLERANCE / 10)
    areas = np.concatenate([patches.triangles.areas()] * 2)
    light = shooting.radiosity @ areas

    # Where light comes to in the end; the insides of the blocks stay dark.
    reached = shooting.radiosity.any(axis=0)
    guessed = [with_ambient(patches, p.radiosity, p.unshot, reached) for p in points]

    def missing(radiosity: Floats32) -> float:
        return float(np.abs((shooting.radiosity - radiosity) @ areas / light).max())

    rows = [
        {
            "shots": p.shots,
            "seconds": round(p.seconds, 3),
            "missing": missing(p.radiosity),
            "missing_with_ambient": missing(guess),
            "bound": p.bound,
        }
        for p, guess in zip(points, guessed, strict=True)
    ]
    for row in rows:
        print(
            f"{row['shots']:>7} shots {row['seconds']:8.2f} s  missing {row['missing']:7.2%}"
            f"  with the ambient term {row['missing_with_ambient']:7.2%}  bound {row['bound']:8.2%}"
        )
    (OUT / "radiosity.json").write_text(json.dumps(rows, indent=2))
    keep("radiosity", f"{patches.size:,} patches", [plot(rows)])
    first = [number for number, p in enumerate(points) if p.shots in SHOWN]
    pictures = [
        [
            look(as_solution(scene, patches, replace(solved, radiosity=radiosity)), own, SIDE, SIDE)
            for radiosity in row
        ]
        for own in [own_view(as_solution(scene, patches, solved))]
        for row in ([points[n].radiosity for n in first], [guessed[n] for n in first])
    ]
    _write(pictures, [f"{points[n].shots} shot{'s' * (points[n].shots > 1)}" for n in first])
    last = points[-1]
    return [
        Figure(
            f"radiosity: seconds to {TOLERANCE:.0%}, {patches.size} patches",
            last.seconds,
            last.seconds,
            last.seconds,
            GOAL,
        ),
        Figure(
            "radiosity: light missing then, % of all",
            100 * missing(last.radiosity),
            100 * missing(last.radiosity),
            100 * last.bound,
            100 * TOLERANCE,
        ),
    ]


def plot(rows: list[dict[str, float]]) -> Plot:
    """The curve as the documentation's data files keep it."""
    places = {axis: tuple(row[axis] for row in rows) for axis in ("shots", "seconds")}
    names = {
        "bound": "bound",
        "missing": "light missing",
        "missing_with_ambient": "with the ambient term",
    }
    series = tuple(
        Series(name, style, places, tuple(row[key] for row in rows))
        for style, (key, name) in zip((3, 0, 1), names.items(), strict=True)
    )
    axes = {"shots": "shots", "seconds": "seconds"}
    title = "the light that is still missing"
    return Plot("shots", title, axes, "share of all light", series, slope=False)


def _write(rows: list[list[Floats32]], names: list[str]) -> None:
    """Pictures side by side, each under its name."""
    labels = [names, [f"{name}, with the ambient term" for name in names]]
    width = len(names) * (SIDE + GAP) + GAP
    page = Image.new("RGB", (width, len(rows) * (SIDE + CAPTION) + GAP), "white")
    draw, font = ImageDraw.Draw(page), ImageFont.load_default(size=16)
    for y, row in enumerate(rows):
        for x, picture in enumerate(row):
            left, top = GAP + x * (SIDE + GAP), y * (SIDE + CAPTION)
            draw.text((left, top + 8), labels[y][x], "black", font)
            page.paste(Image.fromarray(linear_to_srgb8(picture)), (left, top + CAPTION))
    path = OUT / "radiosity.png"
    page.save(path)
    print(f"written to {path}")
