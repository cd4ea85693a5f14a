"""The cells: which levels meet in which cell.

Every pair of levels of any two axes of a stage meets in at least one cell, unless no file can hold the two together.
The rows are chosen greedily: of some random ones, the one that covers the most new pairs.
"""

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, replace
from functools import lru_cache
from itertools import combinations
from random import Random
from typing import Any

import numpy as np
from numpy.typing import NDArray

from benchmarks.stress.axes import AXES, COARSE, ONE_POINT, TAME, VISIBLE_TWIN, Level, U, level

Row = tuple[str, ...]
"""Names of levels, one for each axis."""

Pair = tuple[str, str, str, str]
"""An axis and a level of it, another axis and a level of that."""

CANDIDATES = 16
"""Random rows of which the design takes the best."""

SPREAD = 2
"""By how many rows a level may be ahead of the rarest one of its axis."""


@dataclass(frozen=True)
class Cell:
    """One cell of the matrix.

    Attributes
    ----------
    name : the stage and a number, "room-0042"
    stage : which scene is built from the levels
    levels : axis -> level
    """

    name: str
    stage: str
    levels: dict[str, Level]

    def __getitem__(self, axis: str) -> Any:
        return self.levels[axis].value

    @property
    def shift(self) -> float:
        """How far the cell and its twin may lie apart [half extents], the rounding to float32 included."""
        shift = 2 * U + sum(each.shift for each in self.levels.values())
        if "light" in self.levels and self["light"].startswith("visible"):
            shift += VISIBLE_TWIN if self["light size"] < VISIBLE_TWIN else 0.0
        return shift

    @property
    def power(self) -> float:
        """By which share of it the light's power may differ from the twin's: that of an object, as its area does."""
        if self.levels.get("light") != level("light", "object"):
            return 0.0
        return self.rounding / float(self["light size"])

    @property
    def rounding(self) -> float:
        """By how much coordinates may err [half extents]."""
        kind, size = self["triangles"]
        return self.levels["offset"].shift + U * (1 + COARSE[size] if kind == "huge" else 1)

    @property
    def family(self) -> Row:
        """Names of the levels that the twin shares; cells of one family have one twin."""
        return tuple(each.name for axis, each in self.levels.items() if axis not in OUTER)

    def with_level(self, axis: str, name: str) -> "Cell":
        """The same but for one level."""
        return replace(self, levels=self.levels | {axis: level(axis, name)})

    def twin(self) -> "Cell":
        """Its well-conditioned twin."""
        twins = {axis: Level(each.name, each.twin, each.twin) for axis, each in self.levels.items()}
        return Cell(f"{self.name}-twin", self.stage, twins)

    def pairs(self) -> Iterable[Pair]:
        """Every two levels that meet in it."""
        names = [(axis, each.name) for axis, each in self.levels.items()]
        return ((*one, *other) for one, other in combinations(names, 2))


AROUND = "around the camera"
"""The level of glass in which the camera stands in it."""

ROUND = 4096
"""How much larger than the rounding of its corners an object is whose triangles are to stand as they are described."""

OUTER = ("scale", "offset", "triangles", "duration")
"""The axes on which the twin is always the same."""

_COMMON = (
    "angle",
    "resolution",
    "roughness",
    "aperture",
    "depth",
    "lobe",
    "lens",
    "near plane",
    "normals",
    "sampler",
    "orientation",
    "filter",
)
STAGES: dict[str, tuple[str, ...]] = {
    "room": (*OUTER, *_COMMON, "light", "light size", "motion", "glass", "environment"),
    "patch": (*OUTER[:3], *_COMMON),
    "box": (*OUTER[:3], *_COMMON, "light", "light size", "corner"),
    "optics": (
        *OUTER[:2],
        "resolution",
        "depth",
        "near plane",
        "normals",
        "sampler",
        "orientation",
        "filter",
        "substance",
        "incidence",
        "beyond",
    ),
}
"""The axes of each stage."""

FAMILIES, MEMBERS = 190, 7
PATCHES, BOXES, OPTICS = 500, 400, 300


@lru_cache(maxsize=1)
def all_cells() -> tuple[Cell, ...]:
    """The whole matrix, always the same."""
    return (
        *_numbered("room", _rooms(FAMILIES, MEMBERS)),
        *_numbered("patch", _any_rows("patch", PATCHES, Random(2))),
        *_numbered("box", _any_rows("box", BOXES, Random(3))),
        *_numbered("optics", _any_rows("optics", OPTICS, Random(4))),
    )


def cell_named(name: str) -> Cell:
    """A cell of the matrix; KeyError where there is none of that name."""
    for cell in all_cells():
        if cell.name == name:
            return cell
    raise KeyError(
        f"no cell {name}: they are called room-0000, patch-0000, box-0000, optics-0000 and so on"
    )


def tame(stage: str) -> Cell:
    """A cell that asks nothing of anybody."""
    return Cell(f"{stage}-tame", stage, {axis: level(axis, TAME[axis]) for axis in STAGES[stage]})


def short_form(cells: Sequence[Cell]) -> list[Cell]:
    """Few cells in which every level of every axis of each stage occurs."""
    chosen = []
    for stage in STAGES:
        there = [cell for cell in cells if cell.stage == stage]
        names = {cell.name: {(a, each.name) for a, each in cell.levels.items()} for cell in there}
        missing = set().union(*names.values())
        while missing:
            best = max(there, key=lambda cell: len(missing & names[cell.name]))
            missing -= names[best.name]
            chosen.append(best)
    return chosen


def legal(cell: Cell) -> bool:
    """Whether a file can hold the scene.

    An angle must be eight times as large as the rounding of the coordinates, and as the tilt that this rounding gives
    to a triangle of that length and width; where a plane lies along the axes it is exact and nothing tilts. What is
    huge has the colour of the background, so that the twin can do without it; so the background is constant, and
    lights nothing.

    A camera in glass is not near the floor or a mirror, and sees nothing without a bounce. The glass is so near that
    what lies as far apart as beside something huge has edges where no probe has found them.

    A light that is an object is not larger than the scene, of which it is a part, and so large that rounding does not
    put its triangles into other groups, where a number would choose another one. Points by rejection are all other ones
    as soon as one ray more or less meets something, so the room has them only where a light is so small that it does
    not matter.

    A frosted plate's radiance is known in a furnace, where its rays may get out.
    """
    if cell.stage == "optics":
        return cell["substance"] != "frosted glass" or (
            cell["beyond"] == "the same" and cell["depth"] >= 2
        )
    what, angle = cell["angle"]
    kind, size = cell["triangles"]
    if "light" in cell.levels:
        light, across = cell["light"], cell["light size"]
        if light == "object" and not ROUND * cell.rounding <= across <= 1:
            return False
        if cell.stage == "room" and light == "ball by rejection" and across > ONE_POINT:
            return False
    elsewhere = what in ("camera", "mirror") or cell["depth"] == 0
    if cell.stage == "room" and cell["glass"] == AROUND and elsewhere:
        return False
    thinness = {"strips": size, "needles": size, "fine": size, "graded": 1 / (size or 1)}.get(
        kind, 1.0
    )
    if kind == "huge":
        varied = "environment" in cell.levels and cell["environment"] != "constant"
        if varied or (cell.stage == "room" and (cell["light"] == "sky" or cell["glass"] == AROUND)):
            return False
    return bool(angle >= 8 * cell.rounding * (thinness if cell["orientation"] else 1))


def _numbered(stage: str, rows: Iterable[Row]) -> Iterable[Cell]:
    for number, row in enumerate(rows):
        yield _cell(f"{stage}-{number:04d}", stage, row)


def _cell(name: str, stage: str, row: Row) -> Cell:
    return Cell(name, stage, {a: level(a, n) for a, n in zip(STAGES[stage], row, strict=True)})


def _any_rows(stage: str, least: int, random: Random) -> list[Row]:
    axes = STAGES[stage]
    decks = [_Deck(axis, random) for axis in axes]
    return _covering(
        stage, axes, decks, lambda _number: tuple(deck.peek() for deck in decks), least
    )


def _rooms(families: int, members: int) -> list[Row]:
    """Rows in groups that share all but the outer axes: a twin costs more than a cell."""
    axes = STAGES["room"]
    inner = tuple(axis for axis in axes if axis not in OUTER)
    # With most seeds a pair or two is left when the families are used up; with this one none is.
    random = Random(38)
    decks = [_Deck(axis, random) for axis in inner]
    rows = _covering("room", inner, decks, lambda _: tuple(deck.peek() for deck in decks), families)
    outer = [_Deck(axis, random) for axis in OUTER]

    def member(number: int) -> Row:
        return (*(deck.peek() for deck in outer), *rows[number // members])

    return _covering("room", axes, outer, member, members * len(rows), members * len(rows))


def _covering(
    stage: str,
    axes: Sequence[str],
    decks: "list[_Deck]",
    propose: Callable[[int], Row],
    least: int,
    most: int = 10**6,
) -> list[Row]:
    """At least that many legal rows over some of a stage's axes in which every legal pair of levels meets."""
    home = tame(stage)
    number = {each: k for k, each in enumerate((a, each.name) for a in axes for each in AXES[a])}
    uncovered = np.zeros((len(number), len(number)), np.bool_)
    for one, a, other, b in possible_pairs(home, axes):
        uncovered[number[one, a], number[other, b]] = True

    def pairs_of(row: Row) -> tuple[NDArray[np.intp], ...]:
        return np.ix_(*2 * ([number[each] for each in zip(axes, row, strict=True)],))

    def is_legal(row: Row) -> bool:
        levels = {axis: level(axis, name) for axis, name in zip(axes, row, strict=True)}
        return legal(Cell("", stage, home.levels | levels))

    rows: list[Row] = []
    chosen: set[Row] = set()
    while ((more := uncovered.any()) or len(rows) < least) and len(rows) < most:
        tries = [propose(len(rows)) for _ in range(CANDIDATES if more else 1)]
        tries = [row for row in tries if row not in chosen and is_legal(row)]
        if not tries:
            continue
        best = max(tries, key=lambda row: int(uncovered[pairs_of(row)].sum()))
        for deck in decks:
            deck.take(best[axes.index(deck.axis)])
        uncovered[pairs_of(best)] = False
        chosen.add(best)
        rows.append(best)
    return rows


def possible_pairs(home: Cell, axes: Sequence[str]) -> Iterable[Pair]:
    """The pairs of levels that meet in a legal cell, all else as in `home`, or all but that the light is small."""
    homes = [home.levels]
    if "light size" in home.levels:
        homes.append(home.levels | {"light size": level("light size", f"{ONE_POINT:g}")})
    for one, other in combinations(axes, 2):
        for a in AXES[one]:
            for b in AXES[other]:
                if any(legal(Cell("", home.stage, h | {one: a, other: b})) for h in homes):
                    yield (one, a.name, other, b.name)


class _Deck:
    """Hands out the levels of an axis so that none is far ahead of another."""

    def __init__(self, axis: str, random: Random) -> None:
        self.axis = axis
        self._random = random
        self._taken = {each.name: 0 for each in AXES[axis]}

    def peek(self) -> str:
        """A level that has not been taken too often."""
        fewest = min(self._taken.values())
        # Where a rare level is seldom legal the others may go on without it.
        names = [n for n, count in self._taken.items() if count <= fewest + SPREAD]
        if self._random.random() < 0.1:
            names = list(self._taken)
        # Of all methods of Random only random() is promised to stay the same in every version of Python.
        return names[int(self._random.random() * len(names))]

    def take(self, name: str) -> None:
        """It has been taken."""
        self._taken[name] += 1
