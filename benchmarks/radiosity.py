"""Radiosity of a Cornell box: time and error over the shots, iterations and shots in pictures, and path tracing.

The error is the light that is still missing, as a share of all light, against a solution that went on for ten times
nearer to its limit. Beside it stands the bound that the solution itself gives. `out/bench/radiosity.png` shows the box
after 0, 1, 32 and 320 iterations of gathering, and under them after 1, 32 and 320 shots. Then the last solution is
compared with a picture of traced paths, channel by channel: by its mean, and by the means of squares of pixels.
"""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from time import perf_counter
from typing import Any

import numpy as np

from benchmarks.figures import Figure, summary
from benchmarks.report import OUT, Cell, draw_sheet, report
from course import Scene, load_scene, render
from course.benchmarking.plot_data import Plot, Series
from course.benchmarking.tables import Columns, Table, table_of
from course.engine.core.types import Floats32, Floats64
from course.engine.functions.effects import PROJECT
from course.engine.radiosity.hemicubes import Views, make_hemicube
from course.engine.radiosity.patches import Patches, RadiosityFunctions, make_patches
from course.engine.radiosity.radiosity import PATCHES, TOLERANCE, as_solution
from course.engine.radiosity.solving import GATHERED, Shooting, Solved, form_factors, with_ambient
from course.engine.radiosity.viewing import Solution, look, own_view

SCENE = PROJECT / "scenes" / "radiosity.yaml"
SHOWN = (1, 32, 320)
CHECKED = (*SHOWN, 1000, 3200, 10_000, 32_000)
GOAL = 60.0
"""Seconds to 1% of convergence."""

ITERATIONS = (0, 1, 2, 5, 10, 32, 320)
LIMIT = 400
"""Iterations whose radiosities are the limit: long before, none of their float32 bits changes any more."""

CELLS = 36
"""Along the top of these solutions' hemicubes: twice as many move no digit that is told of them."""

PIXELS = 64
"""Along the sides of the pictures that are compared with traced paths."""

PATHS = 4096
"""For each of these pixels."""

SQUARE = 8
LAMP = 2.0
"""Radiance over which a pixel shows the lamp, whose edge is as sharp as the pixels are."""

SIDE = 320
"""Pixels along a picture of the sheet."""


@dataclass(frozen=True)
class Point:
    """Where the solution stood."""

    shots: int
    seconds: float
    bound: float
    radiosity: Floats32
    unshot: Floats32


@dataclass(frozen=True)
class Difference:
    """How far a picture of a solution is from one of traced paths, in the worst channel.

    Attributes
    ----------
    mean : difference of the means of the squares that don't show the lamp, as a share of the paths' mean
    rms : root mean square of the squares' differences, as a share of the same
    """

    mean: float
    rms: float


def measure_radiosity() -> list[Figure]:
    """Seconds to convergence, the error that is left there, and how far traced paths are."""
    scene = load_scene(SCENE)
    functions = RadiosityFunctions(scene.effects)
    few = make_patches(scene, GATHERED)
    iterations = iterate(few, functions)
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
    shooting.run(TOLERANCE / 10)

    # Where light comes to in the end; the insides of the blocks stay dark.
    reached = np.asarray(shooting.radiosity.any(axis=0))
    guessed = [with_ambient(patches, p.radiosity, p.unshot, reached) for p in points]
    final = shooting.radiosity

    rows = [
        {
            "shots": p.shots,
            "seconds": p.seconds,
            "missing": missing(patches, p.radiosity, final),
            "missing_with_ambient": missing(patches, guess, final),
            "bound": p.bound,
        }
        for p, guess in zip(points, guessed, strict=True)
    ]
    about = f"{patches.size:,} patches"
    tables = [iteration_table(iterations, few), shot_table(rows, patches)]
    report("radiosity", about, tables, [plot(rows)])
    shots = [
        (Solved(p.radiosity, None, p.shots, p.bound, 0), guess)
        for p, guess in zip(points, guessed, strict=True)
        if p.shots in SHOWN
    ]
    pictures = [iteration_cells(scene, few, iterations), *shot_cells(scene, patches, shots)]
    print(f"written to {draw_sheet(pictures, OUT / 'radiosity.png')}")
    off = beside_paths(as_solution(scene, patches, shooting.solved), trace(scene, PATHS))
    last, end = points[-1], rows[-1]
    percent = [100 * end["missing"], 100 * end["bound"]]
    return [
        summary(
            f"radiosity: seconds to {TOLERANCE:.0%}, {patches.size} patches", [last.seconds], GOAL
        ),
        Figure("radiosity: light missing then, % of all", percent[0], *percent, 100 * TOLERANCE),
        *(
            summary(f"radiosity, beside path tracing: {name}, %", [100 * share], goal)
            for name, share, goal in (
                ("means differ by", off.mean, 1.0),
                ("squares differ by, RMS", off.rms, 2.0),
            )
        ),
    ]


Row = Mapping[str, float]
"""Where shooting stood: shots, seconds, and the shares of light that are missing."""


def iteration_table(iterations: Mapping[int, Solved], patches: Patches) -> Table:
    """The light that is missing after iterations of gathering."""
    columns: Columns[tuple[int, Solved]] = (
        ("iterations", lambda found: f"{found[0]}"),
        ("missing", lambda found: f"{found[1].left:.2g}"),
    )
    return table_of(f"Gathering, {patches.size:,} patches", iterations.items(), columns)


def shot_table(rows: Iterable[Row], patches: Patches) -> Table:
    """Time and missing light over the shots."""
    columns: Columns[Row] = (
        ("shots", lambda row: f"{row['shots']}"),
        ("seconds", lambda row: f"{row['seconds']:.2f}"),
        ("missing", lambda row: f"{row['missing']:.2%}"),
        ("with the ambient term", lambda row: f"{row['missing_with_ambient']:.2%}"),
        ("bound", lambda row: f"{row['bound']:.2%}"),
    )
    return table_of(f"Shooting, {patches.size:,} patches", rows, columns)


# ---------------------------------------------------------------- iterations


def iterate(
    patches: Patches,
    functions: RadiosityFunctions,
    steps: Sequence[int] = ITERATIONS,
    cells: int = CELLS,
) -> dict[int, Solved]:
    """What gathering has after so many iterations; ``left`` is the light that is still missing then.

    ``cells``: along the top of the hemicubes.
    """
    factors = form_factors(Views(patches), make_hemicube(cells, functions), 2 * patches.size)
    emission = patches.both(patches.emission, patches.back_emission)
    reflectance = patches.both(patches.reflectance)
    found, radiosity = {0: emission}, emission
    for number in range(1, LIMIT + 1):
        radiosity = functions.gather(radiosity, emission, reflectance, factors)
        if number in steps:
            found[number] = radiosity
    return {
        number: Solved(found[number], None, number, missing(patches, found[number], radiosity), 0)
        for number in steps
    }


def missing(patches: Patches, radiosity: Floats32, final: Floats32) -> float:
    """Light that is missing from the final radiosities, as a share of all light; of the worst channel."""
    areas = np.concatenate([patches.triangles.areas()] * 2)
    return float(np.abs((final - radiosity) @ areas / (final @ areas)).max())


# ---------------------------------------------------------------- path tracing


def trace(scene: Scene, paths: int) -> Floats64:
    """(3, PIXELS, PIXELS) picture of the scene by that many paths a pixel."""
    picture = render(scene, size=(PIXELS, PIXELS), spp=paths, seed=7).linear
    return np.moveaxis(picture, -1, 0).astype(np.float64)


def beside_paths(solution: Solution, paths: Floats64) -> Difference:
    """Compare the solution, seen by the scene's own camera, with the picture of `trace`."""
    mine = look(solution, own_view(solution), PIXELS, PIXELS)
    lit = _squares(paths.max(axis=0) >= LAMP).any(axis=(-3, -1))
    theirs, ours = (_squares(picture).mean(axis=(-3, -1))[:, ~lit] for picture in (paths, mine))
    level = theirs.mean(axis=1)
    off = np.abs(ours.mean(axis=1) / level - 1)
    rms = np.sqrt(((ours - theirs) ** 2).mean(axis=1)) / level
    return Difference(float(off.max()), float(rms.max()))


def _squares(picture: Any) -> Any:
    """(..., n, SQUARE, n, SQUARE): the pixels, by the squares that they are in."""
    count = PIXELS // SQUARE
    return picture.reshape(*picture.shape[:-2], count, SQUARE, count, SQUARE)


# ---------------------------------------------------------------- the curve and the sheet


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


def iteration_cells(
    scene: Scene, patches: Patches, iterations: Mapping[int, Solved]
) -> list[Cell | None]:
    """The lamp alone, and what gathering has after the numbers of iterations that are shown."""
    return [
        (_named(steps, "iteration", patches), _look(scene, patches, iterations[steps]))
        for steps in (0, *SHOWN)
    ]


def shot_cells(
    scene: Scene, patches: Patches, shots: Sequence[tuple[Solved, Floats32]]
) -> list[list[Cell | None]]:
    """Two rows, without the ambient term and with it; the first place of each is empty, under the lamp alone."""
    rows: list[list[Cell | None]] = [[None], [None]]
    for solved, guess in shots:
        name = _named(solved.steps, "shot", patches)
        with_guess = replace(solved, radiosity=guess)
        rows[0].append((name, _look(scene, patches, solved)))
        rows[1].append((f"{name}, ambient term", _look(scene, patches, with_guess)))
    return rows


def _look(scene: Scene, patches: Patches, solved: Solved) -> Floats32:
    solution = as_solution(scene, patches, solved)
    return look(solution, own_view(solution), SIDE, SIDE)


def _named(steps: int, what: str, patches: Patches) -> str:
    """1 shot, 10,000 patches."""
    return f"{steps} {what}{'s' * (steps != 1)}, {patches.size:,} patches"
