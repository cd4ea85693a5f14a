"""The house: rooms of the package by floors, drawn from the imports in its source."""

import ast
from collections.abc import Iterator
from functools import cache
from itertools import permutations, product
from pathlib import Path

from course.engine.functions.effects import PACKAGE
from sitebuild.diagrams.canvas import Canvas
from sitebuild.diagrams.figure import Figure, Panel

WIDTH, FLOOR, ROOM, MARGIN = 350, 46, 24, 14
"""Of the drawing; between floors; of a room's height; and between it and an arrow: in units of the viewBox."""

Uses = dict[str, set[str]]


@cache
def imports(path: Path) -> frozenset[str]:
    """The dotted names that a file of the course imports from the course."""
    return frozenset(_imports(path))


def _imports(path: Path) -> Iterator[str]:
    for node in _statements(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.ImportFrom) and str(node.module).startswith("course."):
            yield str(node.module)
        elif isinstance(node, ast.Import):
            yield from (each.name for each in node.names if each.name.startswith("course."))


def _statements(node: ast.AST) -> Iterator[ast.AST]:
    """All statements of a file, at whatever depth: no expression imports, and ten of them stand in each statement."""
    for child in ast.iter_child_nodes(node):
        if isinstance(child, ast.stmt | ast.excepthandler | ast.match_case):
            yield child
            yield from _statements(child)


def uses(wing: str) -> Uses:
    """Which rooms each room of a wing imports; "course" is the whole house."""
    folder = PACKAGE.joinpath(*wing.split(".")[1:])
    rooms = sorted(path.name for path in folder.iterdir() if (path / "__init__.py").is_file())
    found: Uses = {}
    for room in rooms:
        names = {name for path in (folder / room).rglob("*.py") for name in imports(path)}
        found[room] = {
            other
            for other in rooms
            if any(f"{name}.".startswith(f"{wing}.{other}.") for name in names)
        }
        found[room] -= {room}
    return found


def floors(rooms: Uses) -> list[list[str]]:
    """Rooms from the lowest floor on; each is one above the highest that it imports."""
    placed: dict[str, int] = {}
    while len(placed) < len(rooms):
        ready = {
            room: 1 + max((placed[other] for other in used), default=-1)
            for room, used in rooms.items()
            if room not in placed and used <= placed.keys()
        }
        if not ready:
            raise ValueError(f"rooms import each other in a circle: {rooms.keys() - placed.keys()}")
        placed |= ready
    return [
        sorted(room for room, floor in placed.items() if floor == each)
        for each in range(max(placed.values()) + 1)
    ]


def direct(rooms: Uses) -> Iterator[tuple[str, str]]:
    """Imports that no longer way of imports says already."""

    def below(room: str) -> set[str]:
        return rooms[room].union(*map(below, rooms[room]))

    for room, used in rooms.items():
        for other in used:
            if not any(other in below(third) for third in used - {other}):
                yield room, other


Place = tuple[float, float, float, float]
"""Left, upper, right and lower edge of a room."""


def wide(room: str) -> float:
    """Width of a room, as its name asks for."""
    return 14 + 7.2 * len(room)


def arranged(rooms: Uses) -> dict[str, float]:
    """Which share of the floor's width lies to the left of each room's middle, so that arrows cross few rooms."""
    levels = floors(rooms)
    arrows = sorted(direct(rooms))
    height = {room: level for level, floor in enumerate(levels) for room in floor}
    passed = [(upper, lower, [*_between(height, upper, lower)]) for upper, lower in arrows]
    needed = {room: wide(room) / 2 + MARGIN for room in rooms}

    def badness(middle: dict[str, float]) -> tuple[int, float, float]:
        crossed, slanted = 0, 0.0
        for upper, lower, between in passed:
            start, slope = middle[upper], middle[lower] - middle[upper]
            slanted += abs(slope)
            for room, share in between:
                crossed += abs(start + share * slope - middle[room]) * WIDTH < needed[room]
        return crossed, slanted, abs(sum(middle.values()) - len(middle) / 2)

    ways = (
        [
            dict(zip(floor, shares, strict=True))
            for shares in permutations((0.22, 0.5, 0.78), len(floor))
        ]
        for floor in levels
    )
    together = (
        {room: x for floor in chosen for room, x in floor.items()} for chosen in product(*ways)
    )
    return min(together, key=badness)


def _between(height: dict[str, int], upper: str, lower: str) -> Iterator[tuple[str, float]]:
    """Rooms on the floors between two, and the share of the way down at which an arrow is at theirs."""
    for room, level in height.items():
        if height[lower] < level < height[upper]:
            yield room, (height[upper] - level) / (height[upper] - height[lower])


def draw(canvas: Canvas, rooms: Uses, bottom: float, tall: dict[str, float]) -> None:
    """Draw the floors of a wing; ``tall`` has the heights of rooms that hold rooms, and fill a floor."""
    middle, places = arranged(rooms), dict[str, Place]()
    for floor in floors(rooms):
        height = max(tall.get(room, ROOM) for room in floor)
        for room in floor:
            x, half = middle[room] * WIDTH, wide(room) / 2
            left, right = (6.0, WIDTH - 6.0) if room in tall else (x - half, x + half)
            places[room] = left, bottom - height, right, bottom
        bottom -= height + FLOOR - ROOM
    for room, other in direct(rooms):
        here, there = middle[room], middle[other]
        start, end = (there if room in tall else here), (here if other in tall else there)
        canvas.arrow(
            (start * WIDTH, places[room][3]), (end * WIDTH, places[other][1]), "ink thin", head=5
        )
    for room, (x0, y0, x1, y1) in places.items():
        canvas.rectangle((x0, y0), (x1, y1), "faint" if room in tall else "wash")
        at = (x0 + 6, y0 + 12) if room in tall else ((x0 + x1) / 2, (y0 + y1) / 2)
        canvas.label(at, f"{room}/", "e" if room in tall else "c", gap=0)


def rooms() -> Figure:
    """The wings, and the rooms of the engine."""
    house, engine = uses("course"), uses("course.engine")
    tall = {"engine": len(floors(engine)) * FLOOR + 24.0}
    height = len(floors(house)) * FLOOR - ROOM + tall["engine"] + 12
    canvas = Canvas(WIDTH, height, (0, WIDTH, height, 0))
    draw(canvas, house, height - 6, tall)
    below = floors(house).index(["engine"]) * FLOOR
    draw(canvas, engine, height - 6 - below - 14, {})
    listed = "; ".join(", ".join(floor) for floor in floors(engine))
    return Figure(
        "Rooms of the package. An arrow leads to what a room imports; an import that a longer way implies is left out.",
        (
            Panel(
                canvas,
                "The rooms of the course",
                f"Floors of the house from below: {'; '.join(', '.join(floor) for floor in floors(house))}."
                f" Floors of the engine from below: {listed}. All arrows lead downwards.",
            ),
        ),
    )


FIGURES = {"rooms": rooms}
