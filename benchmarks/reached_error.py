"""How near the error of a picture by `--error` is to what was asked for: 300 runs over 30 scenes.

Each scene is asked for the error that uniform sampling reaches with 64 samples, by ten seeds. The error that is
reached is measured against a converged picture, whose own error is taken off in squares. In some scenes light is rare
and bright: caustics of a small lamp, a lamp that paths find by chance, lights that few directions of a sky hold. In
those of `scenes/unseen` small bright things are met by one sample in ten to a million: there even the error of a
uniform picture is chance, so a fourth of what is asked for is measured with 1,024 samples.
"""

import math
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from benchmarks.figures import Figure, summary
from course import Picture, render
from course.benchmarking.references import Reference, reference
from course.benchmarking.tables import Table, print_tables
from course.engine.formats.yaml.overriding import Overrides
from course.engine.functions.effects import PROJECT
from course.engine.scene.scene import load_variant

UNIFORM = 64
"""Samples whose error is asked for."""

MANY = 16 * UNIFORM
"""Samples by which a fourth of the error is measured where things are rarely met."""

MOST = 16 * UNIFORM
"""Samples a pixel may take on average."""

NEAR = 0.9, 1.1
"""What is reached over what is asked shall lie between these."""

GOAL = 0.95
"""In this share of the runs."""

SCENES = PROJECT / "scenes"
_SMALL_LAMP = {
    "type": "rectangle",
    "corner": [-0.1, 1.995, -0.1],
    "edge_u": [0.2, 0, 0],
    "edge_v": [0, 0, 0.2],
    "radiance": [119, 101, 73],
}
_STUDIO = {
    "type": "lat_long",
    "image": str(SCENES / "environments" / "studio.exr"),
    "lights": True,
    "sampling": "cosine",
}


def _plain(*names: str) -> dict[str, tuple[Path, Overrides]]:
    return {name: (SCENES / f"{name}.yaml", {}) for name in names}


UNSEEN = Path(__file__).parent / "scenes" / "unseen"

BOTH: Overrides = {("integrator", "gloss_sampling"): "automatic"}
"""Samples lamps and lobes together, which finds a lamp in rough metal."""

CASES: Mapping[str, tuple[Path, Overrides]] = {
    **_plain("supersampling", "soft_shadows", "glossy", "thin_lens", "motion_blur", "cube_map"),
    **_plain("path_tracing", "cornell_box", "mesh_light", "blurred_transparency"),
    **_plain("microfacets", "multiple_importance", "many_lights"),
    **_plain("gallery/everything", "gallery/flight", "gallery/focus_row", "gallery/frosted_metals"),
    **_plain("gallery/glass_still_life", "gallery/night_bokeh", "gallery/penumbra_study"),
    "caustics of a small lamp": (SCENES / "path_tracing.yaml", {("lights", 0): _SMALL_LAMP}),
    "a lamp found by chance": (SCENES / "mesh_light.yaml", {("lights",): []}),
    "small lights in a sky": (
        SCENES / "importance_sampling.yaml",
        {("environment",): _STUDIO, ("sampler",): {"type": "sobol", "samples": 64}},
    ),
    **{path.stem.replace("_", " "): (path, {}) for path in sorted(UNSEEN.glob("*.yaml"))},
}


@dataclass(frozen=True)
class Effort:
    """Height of the pictures [pixels], seeds of each scene, samples of references, and the scenes."""

    height: int = 128
    seeds: int = 10
    reference: int = 4096
    names: tuple[str, ...] = tuple(CASES)


QUICK = Effort(
    48, 3, 1024, ("soft_shadows", "motion_blur", "path_tracing", "a lamp found by chance")
)


@dataclass(frozen=True)
class Runs:
    """Of one scene: the error asked for; by seed the errors told and reached, and the camera rays a pixel.

    ``bounded``: whether nothing was told as not bounded
    """

    name: str
    asked: float
    told: tuple[float, ...]
    reached: tuple[float, ...]
    samples: tuple[float, ...]
    bounded: bool

    @property
    def ratios(self) -> list[float]:
        """Reached over asked."""
        return [one / self.asked for one in self.reached]

    @property
    def apart(self) -> list[float]:
        """The larger of the two over the smaller."""
        return [max(ratio, 1 / ratio) for ratio in self.ratios]


def measure_reached_error() -> list[Figure]:
    """Print a table of scenes; figures are the same and the share of runs that are near."""
    return figures([measure(name, Effort()) for name in Effort().names])


def measure_quickly() -> list[Figure]:
    """Four scenes, three seeds, small pictures."""
    return figures([measure(name, QUICK) for name in QUICK.names])


def measure(name: str, effort: Effort) -> Runs:
    """Render a scene by all seeds."""
    path, overrides = CASES[name]
    scene = load_variant(path, overrides)
    settings = scene.settings
    size = max(effort.height * settings.width // settings.height, 1), effort.height
    rare = path.parent == UNSEEN
    surer = {**overrides, **BOTH} if rare and scene.compiled.world.microfacets else overrides
    ideal = reference(path, samples=effort.reference, size=size, overrides=surer)
    spp = MANY if rare else UNIFORM
    uniform = [
        error_of(render(scene, size=size, spp=spp, seed=100 + seed, sampler="sobol"), ideal)
        for seed in range(2)
    ]
    asked = math.sqrt(float(np.mean(np.square(uniform))) * spp / UNIFORM)
    pictures = [
        render(scene, size=size, spp=MOST, error=asked, seed=1 + seed, sampler="sobol")
        for seed in range(effort.seeds)
    ]
    told = [picture.receipt.error or {} for picture in pictures]
    return Runs(
        name,
        asked,
        tuple(float(one["estimated"]) for one in told),
        tuple(error_of(picture, ideal) for picture in pictures),
        tuple(picture.receipt.rays["camera"] / picture.receipt.pixels for picture in pictures),
        not any("not bounded" in one for one in told),
    )


def error_of(picture: Picture, ideal: Reference) -> float:
    """Root-mean-square error against the truth, of which the reference is off by its own error."""
    squared = float(((picture.linear.astype(np.float64) - ideal.linear) ** 2).mean())
    return math.sqrt(max(squared - ideal.error**2, 0.0))


def near(runs: list[Runs]) -> float:
    """Share of all runs whose reached error is near the one that was asked for."""
    ratios = np.concatenate([one.ratios for one in runs])
    low, high = NEAR
    return float(((ratios >= low) & (ratios <= high)).mean())


def figures(runs: list[Runs]) -> list[Figure]:
    """For each scene what was reached over what was asked, and the share that is near; printed as a table, too."""
    print_tables([table(runs)])
    count = sum(len(one.reached) for one in runs)
    share = near(runs)
    label = f"--error: share of {count} runs that reach {NEAR[0]} to {NEAR[1]} of it"
    rows = [
        summary(
            f"--error, {one.name}: reached and asked apart by", one.apart, NEAR[1], at_least=False
        )
        for one in runs
    ]
    return [Figure(label, share, share, share, GOAL, at_least=True), *rows]


def table(runs: list[Runs]) -> Table:
    """A row for each scene."""
    columns = ("scene", "asked", "reached / asked", "least", "most", "reached / told", "samples")
    rows = tuple(
        (
            one.name,
            f"{one.asked:.3g}",
            f"{np.median(one.ratios):.2f}",
            f"{min(one.ratios):.2f}",
            f"{max(one.ratios):.2f}",
            f"{np.median(np.divide(one.reached, one.told)):.2f}",
            f"{np.median(one.samples):.1f}",
        )
        for one in runs
    )
    return Table(f"The error of {UNIFORM} samples, asked for by --error", columns, rows)
