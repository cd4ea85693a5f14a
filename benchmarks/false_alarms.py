"""How often `course compare` calls two pictures of one scene different: 10,000 pairs of small pictures, and more.

Pictures of a scene differ by seed and by samples, from 4 to 1,024 a pixel. Half of a scene's pairs have as many
samples, half haven't. Every picture is in several pairs, so false alarms seldom come alone, and 10,000 pairs tell less
than as many independent ones would.
"""

from collections.abc import Iterator
from dataclasses import dataclass, field
from itertools import combinations

import numpy as np

from benchmarks.figures import Figure
from benchmarks.peer_cases import EFFECTS
from course import load_scene, render
from course.benchmarking.tables import Table, print_tables
from course.engine.comparing.significance import SIGNIFICANCE, compare
from course.engine.core.types import Floats32
from course.engine.functions.effects import PROJECT

SIZE = (64, 48)

PICTURES = {4: 30, 16: 20, 64: 12, 256: 6, 1024: 3}
"""Samples a pixel -> pictures of each scene."""

PAIRS = 228
"""Of each scene with as many samples, and as many with others; fewer where there are none left."""

ERRORS = {0.2: 14, 0.1: 12, 0.05: 12, 0.02: 6}
"""The same for adaptive pictures, by the error that is asked for."""


@dataclass(frozen=True)
class Kind:
    """A scene, the sampler that isn't its own, and whether it is rendered to an error."""

    scene: str
    sampler: str | None = None
    adaptive: bool = False

    def __str__(self) -> str:
        return f"{self.scene}{f', {self.sampler}' if self.sampler else ''}{', adaptive' if self.adaptive else ''}"

    def pictures(self) -> Iterator[tuple[float, Floats32]]:
        """Samples or errors, and a picture."""
        scene = load_scene(PROJECT / "scenes" / f"{self.scene}.yaml")
        for level, count in (ERRORS if self.adaptive else PICTURES).items():
            asked = {"error": level} if self.adaptive else {"spp": int(level)}
            for seed in range(count):
                # Another seed for each number of samples: else one picture would be a part of the other.
                own = int(1000 * level) + seed
                yield (
                    level,
                    render(scene, size=SIZE, seed=own, sampler=self.sampler, **asked).linear,
                )


KINDS = (
    *map(
        Kind,
        (
            *EFFECTS,
            "cornell_box",
            "mesh_light",
            "multiple_importance",
            "microfacets",
            "textures",
            "importance_sampling",
            "many_lights",
            "gallery/night_bokeh",
            "gallery/everything",
        ),
    ),
    *(
        Kind("soft_shadows", sampler)
        for sampler in ("random", "jittered", "dithered", "blue_noise")
    ),
    Kind("soft_shadows", adaptive=True),
    Kind("path_tracing", adaptive=True),
)


@dataclass
class Counted:
    """p-values of pairs with as many samples, and with others."""

    equal: list[float] = field(default_factory=list)
    other: list[float] = field(default_factory=list)


def measure_false_alarms() -> list[Figure]:
    """Compare all pairs, and print a row for each scene."""
    found = {str(kind): _counted(kind, number) for number, kind in enumerate(KINDS)}
    print_tables([_table(found)])
    p = np.array([value for one in found.values() for value in (*one.equal, *one.other)])
    alarms = float((p < SIGNIFICANCE).sum())
    return [
        Figure(f"false alarms of `course compare` in {len(p):,} pairs", alarms, alarms, alarms, 0)
    ]


def _counted(kind: Kind, number: int) -> Counted:
    levels, pictures = zip(*kind.pictures(), strict=True)
    rng = np.random.default_rng(number)
    counted = Counted()
    for alike, into in ((True, counted.equal), (False, counted.other)):
        pairs = [
            (i, j)
            for i, j in combinations(range(len(levels)), 2)
            if (levels[i] == levels[j]) == alike
        ]
        for chosen in rng.permutation(len(pairs))[:PAIRS]:
            i, j = pairs[chosen]
            into.append(compare(pictures[i], pictures[j]).p_value)
    return counted


def _table(found: dict[str, Counted]) -> Table:
    rows = tuple(
        (
            name,
            *(
                cell
                for p in (one.equal, one.other)
                for cell in (
                    str(len(p)),
                    str(sum(value < SIGNIFICANCE for value in p)),
                    f"{min(p):.2g}",
                )
            ),
        )
        for name, one in found.items()
    )
    columns = ("scene", "as many samples", "alarms", "least p", "others", "alarms", "least p")
    return Table(f"Pairs of equal scenes that differ with p < {SIGNIFICANCE:g}", columns, rows)
