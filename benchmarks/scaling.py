"""Cost as work grows: triangles, lights, movers, samples, pixels and threads, each over its range, beside Mitsuba's.

Each point is a process of its own: seconds to read and build the scene, seconds of the second of two pictures, and peak
memory. The exponent is the slope of the last steps, both axes logarithmic: 1 where twice the work costs twice as much.
Mitsuba is its LLVM variant with its own integrators, where it can do the same. Of many lights both choose one for each
hit; ours asks all of up to 64, and as ``ALL`` any number.
"""

import json
import resource
import subprocess
import sys
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from importlib.util import find_spec
from pathlib import Path
from tempfile import TemporaryDirectory
from time import perf_counter
from typing import Any

import numpy as np
import yaml

from benchmarks.figures import Figure, summary
from benchmarks.mitsuba_export import export, read, write
from benchmarks.mitsuba_scalar import NativeScene
from benchmarks.mitsuba_variants import find_llvm, start_llvm
from benchmarks.report import report
from course import load_scene, render
from course.base.processes import environment_apart
from course.benchmarking.documents import replace_marked
from course.benchmarking.plot_data import Plot, Series
from course.benchmarking.tables import Table
from course.engine.loops.embree_device import available

SIZE, SAMPLES, THREADS = (200, 150), 16, 2
STEPS = 3
"""Of an axis, the last ones, whose slope is the exponent: what is small costs as much as nothing."""

ABOUT = f"{SIZE[0]} x {SIZE[1]} pixels, {SAMPLES} samples, {THREADS} threads; of pixels, one sample each"
TABLE = Path("out/bench/scaling.md")

OURS, ALL, MITSUBA = "ours", "ours, all lights sampled", "Mitsuba"
MOST_ASKED = 100
"""Lights up to which all are asked; ten times as many would take ten times as long."""

SUN = [{"type": "directional", "direction": [-0.4, -1, -0.3], "irradiance": 3}]


def _scene(objects: list[dict[str, Any]], lights: list[dict[str, Any]] = SUN) -> dict[str, Any]:
    return {
        "camera": {"eye": [0, 3, 5], "look_at": [0, 0, 0], "vertical_fov": 40},
        "film": {"filter": "box"},
        "materials": {"matt": {"color": 0.6}},
        "lights": lights,
        "objects": [{"material": "matt", **each} for each in objects],
    }


FLOOR = {"shape": "quad", "width": 8, "depth": 8}
BALL = {"shape": "sphere", "radius": 0.5, "transform": [{"translate": [0, 0.5, 0]}]}


def hills(triangles: int) -> dict[str, Any]:
    """Hills of about so many triangles."""
    segments = round((triangles / 2) ** 0.5)
    return _scene(
        [{"shape": "height_field", "size": [8, 8], "amplitude": 0.3, "segments": segments}]
    )


def lamps(count: int) -> dict[str, Any]:
    """A ball under a ceiling of lamps."""
    places = np.random.default_rng(1).uniform((-3, 3, -3), (3, 4, 3), (count, 3))
    lights = [
        {"type": "point", "position": place, "intensity": 60 / count} for place in places.tolist()
    ]
    return _scene([FLOOR, BALL], lights)


def movers(count: int) -> dict[str, Any]:
    """Balls in a square, each with a velocity of its own."""
    side = int(count**0.5)
    balls = []
    for number in range(count):
        x, z = (4 * (i + 0.5) / side - 2 for i in divmod(number, side))
        place = [{"translate": [x, 0.5, z]}]
        motion = {"velocity": [0.2 + 0.01 * number, 0, 0]}
        balls.append({**BALL, "radius": 1.2 / side, "transform": place, "motion": motion})
    return _scene([FLOOR, *balls])


@dataclass(frozen=True)
class Axis:
    """What grows.

    Attributes
    ----------
    counts : of it
    scene : of a count
    most : exponent of a picture's seconds that it should not exceed
    programs : that are measured; Mitsuba where it can do the same
    """

    counts: Sequence[int]
    scene: Callable[[int], dict[str, Any]]
    most: float
    programs: Sequence[str] = (OURS, MITSUBA)


AXES = {
    # Embree's hierarchy is as deep as the logarithm; building it takes in proportion.
    "triangles": Axis((10**3, 10**4, 10**5, 10**6, 10**7), hills, 0.3),
    "lights": Axis((1, 10, 100, 1000, 10**4, 10**5), lamps, 0.3, programs=(OURS, ALL, MITSUBA)),
    "movers": Axis((1, 4, 16, 64), movers, 0.5, programs=(OURS,)),
    "samples": Axis((4, 16, 64, 256, 1024), lambda _: _scene([FLOOR, BALL]), 1.05),
    # Powers of 4, times 512 x 256.
    "pixels": Axis((1, 4, 16, 64, 256), lambda _: _scene([FLOOR, BALL]), 1.05),
    "threads": Axis((1, 2, 4, 8, 16), lambda _: _scene([FLOOR, BALL]), 0.2, programs=(OURS,)),
}


@dataclass(frozen=True)
class Point:
    """What a count costs: seconds to read and build, seconds of a picture, and peak memory [MB]."""

    count: int
    building: float
    seconds: float
    memory: float


def measure_scaling() -> list[Figure]:
    """Measure all axes, draw them, and give their exponents."""
    figures, rows, plots = [], [], []
    for name, axis in AXES.items():
        programs = [p for p in axis.programs if p != MITSUBA or _has_mitsuba()]
        series = []
        for style, program in enumerate(programs):
            # Loops that are compiled take memory: not in a process that is measured.
            _process(name, axis.counts[0], program)
            counts = [n for n in axis.counts if program != ALL or n <= MOST_ASKED]
            points = [_process(name, count, program) for count in counts]
            exponents = {
                key: exponent([p.count for p in points], [getattr(p, key) for p in points])
                for key in ("building", "seconds", "memory")
            }
            for p in points:
                cells = (f"{p.building:.2f}", f"{p.seconds:.3f}", f"{p.memory:.0f}")
                rows.append((name, program, f"{_units(name, p.count):,}", *cells))
            told = tuple(f"{exponents[key]:.2f}" for key in ("building", "seconds", "memory"))
            rows.append((name, program, "exponent", *told))
            x = tuple(_units(name, p.count) for p in points)
            seconds = tuple(p.seconds for p in points)
            series.append(Series(program, style, {"count": x}, seconds, exponents["seconds"]))
            if program == OURS:
                value = exponents["seconds"]
                figures.append(summary(f"{name}: exponent of seconds", [value], axis.most))
        axes = {"count": name}
        plots.append(
            Plot(name, f"Seconds over {name}", axes, "seconds", tuple(series), slope=False)
        )
    columns = ("what grows", "program", "count", "building [s]", "picture [s]", "memory [MB]")
    found = Table(f"cost as work grows, {ABOUT}", columns, tuple(rows))
    report("scaling", ABOUT, [found], plots)
    TABLE.write_text(found.markdown(), encoding="utf-8")
    return figures


def write_scaling(machine: Mapping[str, str], folder: Path) -> None:
    """Put the last table, and where its plots are, into performance.md of the documentation's folder."""
    made = f"Made by `python -m benchmarks scaling --write-docs` on {', '.join(machine.values())}."
    about = f"{ABOUT[0].upper()}{ABOUT[1:]}."
    plots, table = "<!-- site: convergence scaling -->", TABLE.read_text(encoding="utf-8")
    replace_marked(folder / "performance.md", "scaling", f"{made}\n\n{about}\n\n{plots}\n\n{table}")


def _has_mitsuba() -> bool:
    return find_spec("mitsuba") is not None and find_llvm() is not None


def exponent(counts: Sequence[float], values: Sequence[float]) -> float:
    """Slope of the last STEPS steps, both axes logarithmic."""
    logs = np.log(counts[-STEPS - 1 :]), np.log(values[-STEPS - 1 :])
    return float(np.polyfit(*logs, 1)[0])


def _units(name: str, count: int) -> int:
    return 512 * 256 * count if name == "pixels" else count


def _process(name: str, count: int, program: str) -> Point:
    """Measure in a process of its own."""
    factor = round(count**0.5) if name == "pixels" else 1
    size = (512 * factor, 256 * factor) if name == "pixels" else SIZE
    samples = {"pixels": 1, "samples": count}.get(name, SAMPLES)
    threads = count if name == "threads" else THREADS
    with TemporaryDirectory() as folder:
        path = Path(folder, "scene.yaml")
        scene = AXES[name].scene(count)
        if program == ALL:
            scene["integrator"] = {"light_sampling": "all"}
        path.write_text(yaml.safe_dump(scene))
        if program == MITSUBA:
            write(export(load_scene(path), *size), path.parent)
        arguments = [program, str(path), *map(str, (*size, samples, threads))]
        done = subprocess.run(
            [sys.executable, "-m", "benchmarks.scaling", *arguments],
            capture_output=True,
            check=True,
            env=environment_apart(),
        )
    return Point(count, **json.loads(done.stdout.splitlines()[-1]))


def main(program: str, path: str, *numbers: str) -> None:
    """Build, render twice, and print what that took."""
    width, height, samples, threads = map(int, numbers)
    began = perf_counter()
    if program != MITSUBA:
        scene = load_scene(path)

        def picture(seed: int) -> object:
            settings = {"spp": samples, "seed": seed, "sampler": "sobol", "compiled": available()}
            return render(scene, size=(width, height), threads=threads, **settings)
    else:
        start_llvm(threads)
        peer = NativeScene(read(Path(path).parent))

        def picture(seed: int) -> object:
            return peer.render("independent", samples, seed)

    building = perf_counter() - began
    picture(0)
    began = perf_counter()
    picture(1)
    seconds = perf_counter() - began
    print(json.dumps({"building": building, "seconds": seconds, "memory": peak_memory()}))


def peak_memory() -> float:
    """Of this process [MB]."""
    try:
        lines = Path("/proc/self/status").read_text().splitlines()
        return next(int(line.split()[1]) for line in lines if line.startswith("VmHWM")) / 1024
    except OSError:
        # It also counts what the parent had when it forked.
        return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024


if __name__ == "__main__":
    main(*sys.argv[1:])
