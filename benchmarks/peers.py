"""`python -m benchmarks.peers`: the effects' scenes in Mitsuba 3 and here, on the same cores in turn.

For each effect: does Mitsuba show the same picture, and how long does each program take to the same error? The error
is the one that Mitsuba's best sampler has with 64 samples a pixel, over the whole picture in linear radiance; each
program is measured against its own converged picture, so that a difference between the two sets no floor. Times are
of warm renderers and rendering alone, and then of whole processes.

docs/peers.md says what the forms "llvm" and "scalar" are. Needs `pip install .[peers]`, and LLVM 17 for the former.
"""

from __future__ import annotations

import inspect
import json
import os
import subprocess
import sys
from collections.abc import Callable, Iterable
from dataclasses import asdict, dataclass
from hashlib import sha256
from importlib.metadata import version
from pathlib import Path
from statistics import median
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
    QUICK,
    Effort,
    Measured,
    Reached,
    Result,
    keep_cases,
)
from benchmarks.peer_document import SIZE, tables, write_document
from course import Scene, render
from course.benchmarking.machine import machine
from course.benchmarking.references import scene_hash
from course.benchmarking.tables import print_tables
from course.effects import PROJECT
from course.formats.yaml.description import rgb
from course.formats.yaml.loading import load_description
from course.formats.yaml.overriding import Overrides
from course.scene.scene import load_variant

SAMPLES = 64
"""A pixel, of Mitsuba's best sampler; its error is the one to reach."""

DIFFUSE = 0.73
"""What path tracing's mirror and glass return of the light, as surfaces that are diffuse."""

MOST_SAMPLES = 16384
OUT = Path("out/bench/peers")
DOCUMENT = PROJECT / "docs" / "peers.md"
DATA = PROJECT / "docs" / "data" / "peers.json"


@dataclass(frozen=True)
class Setting:
    """One way to render, with the knob that trades time for error: samples, or the error that is asked for.

    Those of one family make the same pictures, and differ in time only.
    """

    name: str
    family: str
    picture: Callable[[float, int], np.ndarray]
    first: float
    finer: float
    """Factor of the knob for a better picture."""


@dataclass(frozen=True)
class Case:
    """An effect's scene in the form that both programs render."""

    effect: str
    form: str
    threads: int
    effort: Effort
    scene: Scene
    without: list[str]

    @property
    def name(self) -> str:
        """For files."""
        return f"{self.effect}_{self.form}"

    def peer(self) -> LlvmScene | NativeScene:
        """The scene in Mitsuba, in the variant that is measured."""
        return self._loaded(start_llvm if self.form == "llvm" else start_scalar)

    def peer_for_reference(self) -> LlvmScene | NativeScene:
        """The same in the LLVM variant where there is one: the same plugins, many times as fast."""
        return self._loaded(start_fastest)

    def _loaded(self, start: Callable[[int], None]) -> LlvmScene | NativeScene:
        exported = export(self.scene, *SIZE)
        start(self.threads)
        own = self.form == "llvm" and not exported.paths
        return LlvmScene(exported) if own else NativeScene(exported)

    def our_reference(self) -> Converged:
        """Our converged picture."""
        samples, batches = self.effort.batch_samples, self.effort.batches
        key = scene_hash(self.scene.loaded, self.scene.effects, samples=samples, batches=batches)
        return converge(
            lambda seed: our_picture(self.scene, self.threads, spp=samples, seed=seed),
            batches,
            OUT / "references" / f"ours_{self.name}_{key[:24]}.npz",
        )

    def their_reference(self) -> Converged:
        """Mitsuba's converged picture."""
        samples, batches = self.effort.batch_samples, self.effort.batches
        loaded: list[LlvmScene | NativeScene] = []

        def picture(seed: int) -> np.ndarray:
            if not loaded:
                loaded.append(self.peer_for_reference())
            return loaded[0].render("multijitter", samples, seed)

        sources = b"".join(
            path.read_bytes() for path in sorted(Path(__file__).parent.glob("mitsuba_*.py"))
        )
        key = scene_hash(
            self.scene.loaded,
            self.scene.effects,
            samples=samples,
            batches=batches,
            mitsuba=version("mitsuba"),
            export=sha256(sources).hexdigest(),
        )
        path = OUT / "references" / f"mitsuba_{self.name}_{key[:24]}.npz"
        return converge(picture, batches, path)


def our_picture(scene: Scene, threads: int, **settings: Any) -> np.ndarray:
    """A picture of ours at the benchmark's size, with Sobol points."""
    return render(scene, size=SIZE, threads=threads, sampler="sobol", **settings).linear


def make_case(effect: str, form: str, threads: int, effort: Effort) -> Case:
    """Load the scene: with a box filter, for that is what both programs have, and what the form asks for."""
    path = PROJECT / "scenes" / f"{effect}.yaml"
    values: Overrides = {}
    without: list[str] = []
    if effect == "path_tracing":
        values, without = diffuse_overrides(path)
    elif form == "scalar":
        values, without = native_overrides(path)
    scene = load_variant(path, {("film", "filter"): "box", **values})
    return Case(effect, form, threads, effort, scene, without)


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
    say("converged pictures")
    ours, theirs = case.our_reference(), case.their_reference()
    save_difference(theirs, ours, OUT / f"{case.name}.png")
    peer = case.peer()
    say("Mitsuba's samplers")
    sampler, samples, target = best_sampler(peer, theirs, case.effort.pictures)
    say(f"{sampler}, {samples} samples, error {target**0.5:.2e}; our errors")
    families: dict[str, Ends] = {}
    brackets = []
    for setting in our_settings(case, target):
        if setting.family not in families:
            families[setting.family] = bracket(setting, ours, target, case.effort.pictures)
        brackets.append((setting, families[setting.family]))
    say("times in turn")
    knobs = [
        (setting, knob)
        for setting, ends in brackets
        for knob in dict.fromkeys(end[0] for end in ends)
    ]
    rounds = []
    for number in range(case.effort.rounds):
        row = [seconds(lambda seed=number: peer.render(sampler, samples, seed))]
        row += [
            seconds(lambda s=setting, k=knob, seed=number: s.picture(k, seed))
            for setting, knob in knobs
        ]
        rounds.append(row)
    mitsuba_time, *our_times = [median(column) for column in zip(*rounds, strict=True)]
    times = {
        (setting.name, knob): time for (setting, knob), time in zip(knobs, our_times, strict=True)
    }
    reached = [interpolated(setting.name, ends, times, target) for setting, ends in brackets]
    reached.sort(key=lambda r: r.seconds)
    say("whole processes")
    process, our_process = processes(case, sampler, samples, brackets, target)
    return Result(
        case.effect,
        case.form,
        case.without,
        case.form == "scalar" and case.effect in ALIKE,
        sampler,
        samples,
        target**0.5,
        mitsuba_time,
        reached,
        process,
        our_process,
        compare(theirs, ours),
    )


def best_sampler(
    peer: LlvmScene | NativeScene, reference: Converged, pictures: int
) -> tuple[str, int, float]:
    """Sampler, its samples and its mean squared error, for the least product of error and time."""
    found = []
    for sampler in SAMPLERS:
        samples = peer.samples(sampler, SAMPLES)
        peer.render(sampler, samples, 0)
        errors, times = [], []
        for seed in range(1, pictures + 1):
            began = perf_counter()
            picture = peer.render(sampler, samples, seed)
            times.append(perf_counter() - began)
            errors.append(reference.mse(picture))
        error = float(np.mean(errors))
        # The fastest of a few: the slow ones tell of whatever else the machine does.
        found.append((error * min(times), sampler, samples, error))
    _, sampler, samples, error = min(found)
    return sampler, samples, error


def our_settings(case: Case, target: float) -> list[Setting]:
    """Our ways to render: uniform and adaptive, each without and with compiled loops where there are any."""
    known = inspect.signature(render).parameters
    engines: dict[str, dict[str, Any]] = {"": {"compiled": False} if "compiled" in known else {}}
    if "compiled" in known:
        from course.compiled.library import available

        if available():  # the fastest first: it finds the family's errors
            engines = {", compiled": {"compiled": True}, **engines}
    settings = []
    for engine, options in engines.items():

        def uniform(samples: float, seed: int, options: dict[str, Any] = options) -> np.ndarray:
            samples = int(samples)
            return our_picture(case.scene, case.threads, spp=samples, seed=seed, **options)

        def adaptive(error: float, seed: int, options: dict[str, Any] = options) -> np.ndarray:
            most = {"spp": MOST_SAMPLES, "error": float(error)}
            return our_picture(case.scene, case.threads, seed=seed, **most, **options)

        settings.append(Setting(f"uniform{engine}", "uniform", uniform, SAMPLES, 2))
        if "error" in known:
            settings.append(Setting(f"adaptive{engine}", "adaptive", adaptive, target**0.5, 0.8))
    return settings


Ends = list[tuple[float, float]]
"""One or two pairs of a knob and its mean squared error, around the target."""


def bracket(setting: Setting, reference: Converged, target: float, pictures: int) -> Ends:
    """Turn the knob until the target lies between two settings."""

    def at(knob: float) -> tuple[float, float]:
        errors = [reference.mse(setting.picture(knob, seed)) for seed in range(1, pictures + 1)]
        return knob, max(float(np.mean(errors)), 1e-12)

    coarse = fine = at(setting.first)
    for _ in range(20):
        if fine[1] > target:
            coarse, fine = fine, at(fine[0] * setting.finer)
        elif coarse[1] <= target:
            knob = coarse[0] / setting.finer
            if setting.finer > 1 and knob < 1:
                break
            coarse, fine = at(knob), coarse
        else:
            break
    return [coarse, fine]


def interpolated(
    name: str, ends: Ends, times: dict[tuple[str, float], float], target: float
) -> Reached:
    """Time and knob where the error is the target's."""
    (coarse, coarse_error), (fine, fine_error) = ends
    share = 0.0
    if coarse_error != fine_error:
        share = float(np.log(coarse_error / target) / np.log(coarse_error / fine_error))
    share = min(max(share, 0.0), 1.0)

    def between(a: float, b: float) -> float:
        return float(a ** (1 - share) * b**share)

    return Reached(name, between(times[name, coarse], times[name, fine]), between(coarse, fine))


def seconds(action: Callable[[], object]) -> float:
    """Wall clock."""
    began = perf_counter()
    action()
    return perf_counter() - began


def processes(
    case: Case, sampler: str, samples: int, brackets: list[tuple[Setting, Ends]], target: float
) -> tuple[float, float]:
    """Median seconds of whole processes, theirs and ours (NumPy alone, adaptive where there is that), in turn."""
    name = "adaptive" if any(setting.name == "adaptive" for setting, _ in brackets) else "uniform"
    ends = next(ends for setting, ends in brackets if setting.name == name)
    knob = interpolated(name, ends, {(name, end[0]): 1.0 for end in ends}, target).knob
    wanted = ["--spp", str(round(knob))]
    if name == "adaptive":
        wanted = ["--error", f"{knob:.4g}", "--spp", str(MOST_SAMPLES)]
    with TemporaryDirectory() as folder:
        place = Path(folder)
        write(export(case.scene, *SIZE), place)
        threads = str(case.threads)
        theirs = ["benchmarks.mitsuba_process", str(place), case.form, sampler, str(samples)]
        theirs += [threads, str(place / "theirs.exr")]
        ours = ["course", "render", str(write_variant(case.scene, place)), *wanted]
        ours += ["--size", "{}x{}".format(*SIZE), "--sampler", "sobol", "--threads", threads]
        ours += ["-o", str(place / "ours.exr")]
        run_module(theirs)  # Dr.Jit keeps its kernels on disk
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
    path = folder / f"{scene.loaded.path.stem}.yaml"
    path.write_text(yaml.safe_dump(data, sort_keys=False))
    return path


def run_module(arguments: list[str]) -> None:
    """A Python process of its own."""
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join([str(PROJECT), *sys.path])}
    subprocess.run(
        [sys.executable, "-m", *arguments], check=True, capture_output=True, env=environment
    )


def versions(threads: int) -> dict[str, str]:
    """Machine and software."""
    library = find_llvm()
    peer = (
        f"Mitsuba {version('mitsuba')}, Dr.Jit {version('drjit')}, LLVM {library and library.name}"
    )
    return {**machine(), "threads": str(threads), "peer": peer}


@click.command(help=__doc__)
@click.option("--scene", "effects", multiple=True, type=click.Choice(EFFECTS), help="Only this.")
@click.option("--form", "forms", multiple=True, type=click.Choice(FORMS), help="Only this.")
@click.option("--quick", is_flag=True, help="Fewer pictures, rounds and samples.")
@click.option("--threads", default=2, show_default=True, help="Of both programs.")
@click.option("--json", "json_path", type=click.Path(path_type=Path), help="Write the results.")
@click.option(
    "--write",
    "write_docs",
    is_flag=True,
    help="Keep the results in docs/data, and write them and those kept before to docs/peers.md.",
)
def main(
    effects: Iterable[str],
    forms: Iterable[str],
    quick: bool,
    threads: int,
    json_path: Path | None,
    write_docs: bool,
) -> None:
    """Measure what was asked for."""
    effort = QUICK if quick else Effort()
    forms = tuple(forms) or FORMS
    if "llvm" in forms and find_llvm() is None:
        click.echo("no LLVM that Mitsuba can use was found: scalar only", err=True)
        forms = tuple(form for form in forms if form != "llvm")
    about = versions(threads)
    results = []
    for effect in tuple(effects) or EFFECTS:
        for form in forms:
            case = make_case(effect, form, threads, effort)
            label = f"{effect}, {form}"
            result = measure(
                case, lambda text, label=label: click.echo(f"{label}: {text}", err=True)
            )
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
