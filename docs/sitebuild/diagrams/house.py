"""The house: rooms of the package by floors, drawn from the imports in its source."""

import ast
from collections.abc import Iterator
from pathlib import Path

from course.engine.functions.effects import PACKAGE
from sitebuild.diagrams.canvas import Canvas
from sitebuild.diagrams.figure import Figure, Panel

WIDTH, FLOOR, ROOM = 350, 46, 24
"""Of the drawing; between floors; of a room's height: in units of the viewBox."""

Uses = dict[str, set[str]]


def imports(path: Path) -> Iterator[str]:
    """The dotted names that a file of the course imports from the course."""
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.ImportFrom) and str(node.module).startswith("course."):
            yield str(node.module)
        elif isinstance(node, ast.Import):
            yield from (each.name for each in node.names if each.name.startswith("course."))


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


def draw(canvas: Canvas, rooms: Uses, bottom: float, tall: dict[str, float], inset: float) -> float:
    """Draw the floors of a wing, and return where they end; ``tall`` has the heights of rooms that hold rooms."""
    places: dict[str, tuple[float, float, float, float]] = {}
    for floor in floors(rooms):
        height = max(tall.get(room, ROOM) for room in floor)
        share = (WIDTH - 2 * inset) / len(floor)
        for k, room in enumerate(floor):
            # A wing has the floor's whole width, a room as much as its name asks for.
            wide = share if room in tall else min(share - 12, 120)
            x = inset + share * (k + 0.5)
            places[room] = (x - wide / 2, bottom - height, x + wide / 2, bottom)
        bottom -= height + FLOOR - ROOM
    for room, other in direct(rooms):
        here, there = places[room], places[other]
        from_x, to_x = (here[0] + here[2]) / 2, (there[0] + there[2]) / 2
        if there[2] - there[0] > here[2] - here[0]:
            to_x = from_x
        elif here[2] - here[0] > there[2] - there[0]:
            from_x = to_x
        canvas.arrow((from_x, here[3]), (to_x, there[1]), "ink thin", head=5)
    for room, (x0, y0, x1, y1) in places.items():
        canvas.rectangle((x0, y0), (x1, y1), "faint" if room in tall else "wash")
        at = (x0 + 6, y0 + 12) if room in tall else ((x0 + x1) / 2, (y0 + y1) / 2)
        canvas.label(at, f"{room}/", "e" if room in tall else "c", gap=0)
    return bottom


def rooms() -> Figure:
    """The wings, and the rooms of the engine."""
    house, engine = uses("course"), uses("course.engine")
    tall = {"engine": len(floors(engine)) * FLOOR + 24.0}
    height = len(floors(house)) * FLOOR - ROOM + tall["engine"] + 12
    canvas = Canvas(WIDTH, height, (0, WIDTH, height, 0))
    draw(canvas, house, height - 6, tall, 6)
    below = floors(house).index(["engine"]) * FLOOR
    draw(canvas, engine, height - 6 - below - 14, {}, 20)
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
