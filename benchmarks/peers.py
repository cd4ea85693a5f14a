"""`python -m benchmarks.peers`: scenes in Mitsuba 3 and here, on the same cores in turn.

For each scene: does Mitsuba show the same picture, and how long does each program take to the same error? Three errors
are reached, those of Mitsuba's multijitter sampler with 16, 64 and 256 samples a pixel, over the whole picture in
linear radiance. At each, the fastest of all its samplers counts. Each program is measured against its own converged
picture, so that a difference between the two sets no floor. Times are of warm renderers and rendering alone, and then
of whole processes.

docs/peers.md says what the forms "llvm", "llvm-robust" and "scalar" are. Needs `pip install .[peers]`, LLVM 17 for the
former two, and `npm` to fetch two meshes the first time.
"""

import json
import os
import subprocess
import sys
from collections.abc import Callable, Iterable, Sequence
from dataclasses import asdict, dataclass
from functools import partial
from hashlib import sha256
from importlib.metadata import version
from pathlib import Path
from statistics import mean, median
from tempfile import TemporaryDirectory
from time import perf_counter
from typing import Any

import click
import numpy as np
import yaml

from benchmarks.mitsuba_agreement import Converged, compare, converge, save_difference
from benchmarks.mitsuba_export import export, write
from benchmarks.mitsuba_llvm import LlvmScene
from benchmarks.mitsuba_scalar import ALIKE, NativeScene, native_overrides
from benchmarks.mitsuba_variants import SAMPLERS, find_llvm, start_fastest, start_llvm, start_scalar
from benchmarks.peer_cases import (
    EFFECTS,
    FORMS,
    FURTHER,
    QUICK,
    SAMPLES,
    Effort,
    Measured,
    Reached,
    Result,
    Target,
    keep_cases,
    read_cases,
)
from benchmarks.peer_document import SIZE, tables, write_document
from benchmarks.peer_scenes import scene_path
from course import Scene, render
from course.base.processes import environment_apart
from course.benchmarking.machine import machine
from course.benchmarking.references import scene_hash
from course.benchmarking.tables import print_tables
from course.engine.formats.yaml.description import rgb
from course.engine.formats.yaml.loading import load_description
from course.engine.formats.yaml.overriding import Overrides
from course.engine.functions.effects import PROJECT
from course.engine.loops.embree_device import available
from course.engine.scene.scene import load_variant

MITSUBA_COUNTS = (4, *SAMPLES)
"""Samples a pixel with which each sampler of Mitsuba's is measured."""

RIVAL = 1.3
"""Samplers that seem this much slower than the fastest to one of the errors are timed in turn with ours, too."""

NEAR = 2.0
"""A squared error up to this far beyond those measured is reached by extrapolation."""

DIFFUSE = 0.73
"""What path tracing's mirror and glass return of the light, as surfaces that are diffuse."""

MOST_SAMPLES = 16384
OUT = Path("out/bench/peers")
DOCUMENT = PROJECT / "docs" / "peers.md"
DATA = PROJECT / "docs" / "data" / "peers.json"


@dataclass(frozen=True)
class Way:
    """One way to render, and the knobs at which it is measured: samples, or errors that are asked for.

    ``picture``: of a knob and a seed, (H, W, 3).
    """

    name: str
    picture: Callable[[float, int], np.ndarray]
    knobs: Sequence[float]


@dataclass(frozen=True)
class Point:
    """A knob, the mean squared error that it gives, and its seconds."""

    knob: float
    error: float
    seconds: float


@dataclass(frozen=True)
class Case:
    """An effect's scene in the form that both programs render.

    ``native``: whether Mitsuba's own integrators render it in either form.
    """

    effect: str
    form: str
    threads: int
    effort: Effort
    scene: Scene
    without: list[str]
    native: bool

    @property
    def robust(self) -> bool:
        """Whether Mitsuba asks for Embree's robust mode."""
        return self.form == "llvm-robust"

    @property
    def name(self) -> str:
        """For files."""
        return f"{self.effect}_{self.form.removesuffix('-robust')}"

    def peer(self) -> LlvmScene | NativeScene:
        """The scene in Mitsuba, in the variant that is measured."""
        return self._loaded(start_scalar if self.form == "scalar" else start_llvm, self.robust)

    def _loaded(self, start: Callable[[int], None], robust: bool) -> LlvmScene | NativeScene:
        exported = export(self.scene, *SIZE)
        start(self.threads)
        return (NativeScene if self.native else LlvmScene)(exported, robust=robust)

    def our_reference(self) -> Converged:
        """Our converged picture."""
        samples, batches = self.effort.batch_samples, self.effort.batches
        key = scene_hash(self.scene.loaded, self.scene.effects, samples=samples, batches=batches)
        return converge(
            lambda seed: our_picture(self.scene, self.threads, spp=samples, seed=seed),
            batches,
            OUT / "references" / f"ours_{self.name}_{key[:24]}.npz",
        )

    def their_reference(self) -> tuple[Converged, dict[str, list[list[float]]]]:
        """Mitsuba's converged picture; each sampler's mean squared errors, as pairs with its samples.

        Both are kept in files. The LLVM variant makes them where there is one: the same plugins, many times as fast.
        Embree's robust mode has the same: of rays that aren't aimed at edges hardly any are lost.
        """
        key = self._key()
        folder = OUT / "references"
        peers: list[LlvmScene | NativeScene] = []

        def picture(sampler: str, samples: int, seed: int) -> np.ndarray:
            if not peers:
                peers.append(self._loaded(start_fastest, robust=False))
            return peers[0].render(sampler, samples, seed)

        converged = converge(
            partial(picture, "multijitter", self.effort.batch_samples),
            self.effort.batches,
            folder / f"mitsuba_{self.name}_{key}.npz",
        )
        path = folder / f"mitsuba_{self.name}_{key}.json"
        if not path.is_file():
            seeds = range(1, self.effort.pictures + 1)
            errors = {
                sampler: [
                    [n, mean(converged.mse(picture(sampler, n, seed)) for seed in seeds)]
                    for n in MITSUBA_COUNTS
                ]
                for sampler in SAMPLERS
            }
            path.write_text(json.dumps(errors))
        return converged, json.loads(path.read_text())

    def _key(self) -> str:
        """A hash of all that Mitsuba's pictures depend on."""
        digest = sha256(f"{self.effort} {version('mitsuba')} {self.native}".encode())
        for path in sorted(Path(__file__).parent.glob("mitsuba_*.py")):
            digest.update(path.read_bytes())
        add_arrays(digest, export(self.scene, *SIZE))
        return digest.hexdigest()[:24]


def add_arrays(digest: Any, value: Any) -> None:
    """Add an exported scene, or part of it, to a hash."""
    if isinstance(value, np.ndarray):
        digest.update(np.ascontiguousarray(value).tobytes())
    elif isinstance(value, dict | list | tuple):
        for each in value.items() if isinstance(value, dict) else value:
            add_arrays(digest, each)
    elif hasattr(value, "__dataclass_fields__"):
        add_arrays(digest, vars(value))
    else:
        digest.update(repr(value).encode())


def our_picture(scene: Scene, threads: int, **settings: Any) -> np.ndarray:
    """A picture of ours at the benchmark's size, with Sobol points."""
    return render(scene, size=SIZE, threads=threads, sampler="sobol", **settings).linear


def make_case(effect: str, form: str, threads: int, effort: Effort) -> Case:
    """Load the scene: with a box filter, for that is what both programs have, and what the form asks for."""
    path = scene_path(effect)
    values: Overrides = {}
    without: list[str] = []
    native = form == "scalar" or effect == "path_tracing" or effect in FURTHER
    if effect == "path_tracing":
        values, without = diffuse_overrides(path)
    elif form == "scalar" and effect in EFFECTS:
        values, without = native_overrides(path)
    scene = load_variant(path, {("film", "filter"): "box", **values})
    return Case(effect, form, threads, effort, scene, without, native)


def diffuse_overrides(path: Path) -> tuple[Overrides, list[str]]:
    """The scene with diffuse surfaces only, as values and in words: the same for Mitsuba's `path` in both forms."""
    scene = load_description(path).description
    values: dict[tuple[str | int, ...], Any] = {}
    for name, material in scene.materials.items():
        if material.dielectric is not None or np.any(rgb(material.mirror)):
            values["materials", name] = {"color": DIFFUSE}
    return values, ["no mirrors and no glass: those are white"] if values else []


def measure(case: Case, say: Callable[[str], None]) -> Result:
    """Agreement, errors and times of one case."""
    say("converged pictures and Mitsuba's errors")
    ours, (theirs, their_errors) = case.our_reference(), case.their_reference()
    save_difference(theirs, ours, OUT / f"{case.name}.png")
    squares = {int(n): error for n, error in their_errors["multijitter"]}
    errors = [squares[n] for n in SAMPLES]
    peer = case.peer()
    say("Mitsuba's samplers")
    rivals = fast_samplers(peer, their_errors, errors)
    say(f"{', '.join(rivals)}; our knobs")
    ways = our_ways(case, ours, errors)
    say("times in turn")
    their_points, our_points = in_turn(case, peer, {n: their_errors[n] for n in rivals}, ways, ours)
    targets = [
        Target(
            samples,
            error**0.5,
            min(reached(their_points, error), key=lambda r: r.seconds),
            sorted(reached(our_points, error), key=lambda r: r.seconds),
        )
        for samples, error in zip(SAMPLES, errors, strict=True)
    ]
    say("whole processes")
    process, our_process = processes(case, targets[len(targets) // 2])
    return Result(
        case.effect,
        case.form,
        case.without,
        case.effect in ALIKE and (case.form == "scalar" or case.effect in FURTHER),
        targets,
        process,
        our_process,
        compare(theirs, ours),
    )


def fast_samplers(
    peer: LlvmScene | NativeScene, errors: dict[str, list[list[float]]], targets: list[float]
) -> list[str]:
    """The samplers that may be the fastest to one of the errors, by two pictures with 64 samples each."""
    points = {}
    for sampler, pairs in errors.items():
        drawn = peer.samples(sampler, SAMPLES[1])
        # The first one compiles a kernel.
        least = min(seconds(partial(peer.render, sampler, drawn, seed)) for seed in (0, 1))
        points[sampler] = [
            Point(n, error, least * peer.samples(sampler, int(n)) / drawn) for n, error in pairs
        ]
    rivals = set()
    for target in targets:
        times = {each.name: each.seconds for each in reached(points, target)}
        rivals |= {name for name, time in times.items() if time <= RIVAL * min(times.values())}
    return [sampler for sampler in SAMPLERS if sampler in rivals]


def our_ways(case: Case, reference: Converged, targets: list[float]) -> list[Way]:
    """Our ways to render, each with the knobs that lead to about the errors: adaptive, and uniform where it is fast.

    Without Numba nothing is compiled, and uniform sampling is measured in NumPy.
    """
    engines = {", compiled": True, "": False} if available() else {"": False}
    fastest = next(iter(engines.values()))

    def uniform(compiled: bool, samples: float, seed: int) -> np.ndarray:
        settings = {"spp": int(samples), "seed": seed, "compiled": compiled}
        return our_picture(case.scene, case.threads, **settings)

    def adaptive(compiled: bool, error: float, seed: int) -> np.ndarray:
        settings = {"spp": MOST_SAMPLES, "error": float(error), "seed": seed, "compiled": compiled}
        return our_picture(case.scene, case.threads, **settings)

    few, more = (reference.mse(uniform(fastest, n, 0)) for n in SAMPLES[:2])
    counts = [*([4] if few < targets[0] else []), *SAMPLES]
    # Each doubling of the samples divides the squared error by as much as the last two did on average.
    halved = min(more / few, 0.25) ** 0.5
    predicted = more * halved**2
    while predicted > NEAR**0.5 * targets[-1] and counts[-1] < MOST_SAMPLES:
        counts.append(2 * counts[-1])
        predicted *= halved
    middle = targets[1] ** 0.5
    missed = middle / max(reference.mse(adaptive(fastest, middle, 0)), 1e-12) ** 0.5
    asked = [missed * target**0.5 for target in targets]
    ways = [Way(f"adaptive{n}", partial(adaptive, c), asked) for n, c in engines.items()]
    name, compiled = next(iter(engines.items()))
    return [Way(f"uniform{name}", partial(uniform, compiled), counts), *ways]


def in_turn(
    case: Case,
    peer: LlvmScene | NativeScene,
    their_errors: dict[str, list[list[float]]],
    ways: list[Way],
    reference: Converged,
) -> tuple[dict[str, list[Point]], dict[str, list[Point]]]:
    """Points of Mitsuba's samplers and of our ways; in each round all of them are timed once."""
    their_times: dict[tuple[str, float], list[float]] = {}
    our_times: dict[tuple[str, float], list[tuple[float, float]]] = {}
    for seed in range(1, case.effort.rounds + 1):
        for sampler, pairs in their_errors.items():
            for n, _ in pairs:
                time = seconds(partial(peer.render, sampler, int(n), seed))
                their_times.setdefault((sampler, n), []).append(time)
        for way in ways:
            for knob in way.knobs:
                began = perf_counter()
                picture = way.picture(knob, seed)
                time = perf_counter() - began
                our_times.setdefault((way.name, knob), []).append((reference.mse(picture), time))
    theirs = {
        sampler: [Point(n, error, median(their_times[sampler, n])) for n, error in pairs]
        for sampler, pairs in their_errors.items()
    }
    ours: dict[str, list[Point]] = {}
    for (name, knob), found in our_times.items():
        errors, times = zip(*found, strict=True)
        ours.setdefault(name, []).append(Point(knob, max(mean(errors), 1e-12), median(times)))
    return theirs, ours


def reached(points: dict[str, list[Point]], target: float) -> list[Reached]:
    """Seconds and knob of each way where its squared error is the target; ways that don't come NEAR are left out."""
    found = []
    for name, measured in points.items():
        ordered = sorted(measured, key=lambda p: p.error)
        if not ordered[0].error / NEAR <= target <= ordered[-1].error * NEAR:
            continue
        # Between two neighbours, or beyond the end by the last two.
        after = sum(p.error < target for p in ordered)
        after = min(max(after, 1), len(ordered) - 1)
        a, b = ordered[after - 1], ordered[after]
        share = float(np.log(target / a.error) / np.log(b.error / a.error))
        found.append(
            Reached(
                name,
                a.seconds ** (1 - share) * b.seconds**share,
                a.knob ** (1 - share) * b.knob**share,
            )
        )
    return found


def seconds(action: Callable[[], object]) -> float:
    """Wall clock."""
    began = perf_counter()
    action()
    return perf_counter() - began


def processes(case: Case, target: Target) -> tuple[float, float]:
    """Median seconds of whole processes, theirs and ours as it is installed, adaptive, in turn."""
    asked = next(o.knob for o in target.ours if o.name.startswith("adaptive"))
    with TemporaryDirectory() as folder:
        place = Path(folder)
        write(export(case.scene, *SIZE), place)
        threads = str(case.threads)
        kind = "native" if case.native else "own"
        theirs = ["benchmarks.mitsuba_process", str(place), case.form, kind, target.theirs.name]
        theirs += [str(round(target.theirs.knob or 0)), threads, str(place / "theirs.exr")]
        ours = [
            "course",
            "render",
            str(write_variant(case.scene, place)),
            "--error",
            f"{asked:.4g}",
        ]
        ours += ["--spp", str(MOST_SAMPLES), "--size", "{}x{}".format(*SIZE), "--sampler", "sobol"]
        ours += ["--threads", threads, "-o", str(place / "ours.exr")]
        # Both programs keep what they have compiled on disk.
        run_module(theirs)
        run_module(ours)
        both = [
            (seconds(lambda: run_module(theirs)), seconds(lambda: run_module(ours)))
            for _ in range(case.effort.processes)
        ]
    return median(t for t, _ in both), median(o for _, o in both)


def write_variant(scene: Scene, folder: Path) -> Path:
    """The scene as it was loaded, as a file elsewhere."""
    data = dict(scene.loaded.document.data)
    environment = dict(data.get("environment") or {})
    for key in ("cross", "image"):
        if key in environment:
            environment[key] = str((scene.loaded.path.parent / environment[key]).resolve())
    data["environment"] = environment or {"type": "constant"}
    for thing in data.get("objects", ()):
        if "file" in thing:
            thing["file"] = str((scene.loaded.path.parent / thing["file"]).resolve())
    path = folder / f"{scene.loaded.path.stem}.yaml"
    path.write_text(yaml.safe_dump(data, sort_keys=False))
    return path


def run_module(arguments: list[str]) -> None:
    """A Python process of its own."""
    subprocess.run(
        [sys.executable, "-m", *arguments], check=True, capture_output=True, env=environment_apart()
    )


def versions(threads: int) -> dict[str, str]:
    """Machine and software."""
    library = find_llvm()
    peer = (
        f"Mitsuba {version('mitsuba')}, Dr.Jit {version('drjit')}, LLVM {library and library.name}"
    )
    return {**machine(), "threads": str(threads), "peer": peer}


@click.command(help=__doc__)
@click.option(
    "--scene", "effects", multiple=True, type=click.Choice([*EFFECTS, *FURTHER]), help="Only this."
)
@click.option("--form", "forms", multiple=True, type=click.Choice(FORMS), help="Only this.")
@click.option("--quick", is_flag=True, help="Fewer pictures, rounds and samples.")
@click.option("--threads", default=2, show_default=True, help="Of both programs.")
@click.option(
    "--prepare", is_flag=True, help="Only make and keep converged pictures and Mitsuba's errors."
)
@click.option("--json", "json_path", type=click.Path(path_type=Path), help="Write the results.")
@click.option(
    "--write",
    "write_docs",
    is_flag=True,
    help="Keep the results in docs/data, and write them and those kept before to docs/peers.md.",
)
@click.option("--tables", "only_tables", is_flag=True, help="Write what is kept to docs/peers.md.")
def main(
    effects: Iterable[str],
    forms: Iterable[str],
    quick: bool,
    threads: int,
    prepare: bool,
    json_path: Path | None,
    write_docs: bool,
    only_tables: bool,
) -> None:
    """Measure what was asked for."""
    if only_tables:
        write_document(read_cases(DATA), DOCUMENT)
        return
    # As installed: whole processes would else compile Python's files anew.
    os.environ.pop("PYTHONDONTWRITEBYTECODE", None)
    effort = QUICK if quick else Effort()
    forms = tuple(forms) or FORMS
    if {"llvm", "llvm-robust"} & {*forms} and find_llvm() is None:
        click.echo("no LLVM that Mitsuba can use was found: scalar only", err=True)
        forms = tuple(form for form in forms if form == "scalar")
    about = versions(threads)
    results = []
    for effect in tuple(effects) or (*EFFECTS, *FURTHER):
        for form in forms:
            case = make_case(effect, form, threads, effort)
            label = f"{effect}, {form}"
            began = perf_counter()

            def say(text: str, label: str = label, began: float = began) -> None:
                click.echo(f"{label}, {perf_counter() - began:.0f} s: {text}", err=True)

            if prepare:
                case.our_reference(), case.their_reference()
                say("prepared")
                continue
            result = measure(case, say)
            results.append(result)
            if write_docs:
                # At once, for all of them take an hour.
                write_document(keep_cases([Measured(effort, about, result)], DATA), DOCUMENT)
    print_tables(tables(results))
    if json_path is not None:
        json_path.parent.mkdir(parents=True, exist_ok=True)
        document = {**about, "results": [asdict(r) for r in results]}
        json_path.write_text(json.dumps(document, indent=2) + "\n")


if __name__ == "__main__":
    main()
