"""A room on its way to its light, by iterations and by shots, and frames of a flight through one solution.

The pictures are the ones that `course radiosity` makes; each is kept with the command that makes it.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import cache
from html import escape
from typing import TYPE_CHECKING, Literal

from PIL import Image

from sitebuild import other_shots, pictures, webp
from sitebuild.picture_grid import Cell, grid
from sitebuild.place import Place

if TYPE_CHECKING:
    from course.radiosity.viewing import Solution, View

STEPS = (1, 32, 320)
GATHERED = 1000
SHOT = 10_000
"""Patches whose light is gathered, and whose light is shot."""

TINY = 1e-9
"""Tolerance that ends no iteration before all bits of the light stay as they are."""

FLOWN = 4000
FRAMES = 8
EYES = (
    ((0.0, 1.0, 4.6), (0.0, 1.0, 0.0)),
    ((0.8, 1.5, 2.9), (-0.15, 0.75, -0.2)),
    ((-0.8, 1.4, 2.3), (0.15, 0.6, -0.1)),
    ((-0.8, 0.9, 1.0), (0.2, 0.5, -0.1)),
)
"""Where the flight passes, and what is looked at there."""

SIZE = (280, 280)


def radiosity_steps(place: Place, name: str, words: str = "") -> str:
    """Show a room after some iterations, and under them after as many shots; ``words`` are the title."""
    gathered = [_step(place, name, "gather", steps) for steps in (0, *STEPS)]
    shot = [_step(place, name, "shoot", steps) for steps in STEPS]
    same = (
        f"The last of each row: <code>{escape(_command(name, 'gather', STEPS[-1]))}</code> and"
        f" <code>{escape(_command(name, 'shoot', STEPS[-1]))}</code>"
    )
    cells = [*gathered, None, *shot]
    return grid(f"steps-{name}", words, len(gathered), cells, same)


def radiosity_flight(place: Place, name: str, words: str = "") -> str:
    """Show frames of a flight through a room that has been worked out once; ``words`` are the title."""
    solve = f"course radiosity scenes/{name}.yaml --patches {FLOWN} -o room.npz"
    cameras = " ".join(f"--camera={_numbers(eye)}:{_numbers(at)}" for eye, at in EYES)
    fly = f"course radiosity room.npz {cameras} --frames {FRAMES} --size {_size()} -o flight.png"

    @cache
    def flown() -> tuple[Solution, list[View]]:
        import numpy as np

        from course import load_scene
        from course.radiosity.radiosity import solve
        from course.radiosity.viewing import flight, views_of

        solution = solve(load_scene(pictures.scene_path(name)), patches=FLOWN)
        ends = [(np.array(eye), np.array(at)) for eye, at in EYES]
        return solution, flight(list(views_of(solution, ends)), FRAMES)

    def frame(number: int) -> Cell:
        def make() -> other_shots.Made:
            solution, views = flown()
            return _seen(solution, views[number]), fly

        address = _kept(place, name, f"flight-{number}", f"{solve}; {fly} #{number}", make)
        caption = f"frame {number + 1}"
        return Cell(address, caption, f"{words} Frame {number + 1} of {FRAMES}.", SIZE)

    same = f"The same pictures: <code>{escape(solve)}</code>, then <code>{escape(fly)}</code>"
    cells = [frame(number) for number in range(FRAMES)]
    return grid(f"flight-{name}", words, FRAMES // 2, cells, same)


def _step(place: Place, name: str, method: Literal["gather", "shoot"], steps: int) -> Cell:
    command = _command(name, method, steps)

    def make() -> other_shots.Made:
        from course import load_scene
        from course.radiosity.radiosity import TOLERANCE, solve
        from course.radiosity.viewing import own_view

        solution = solve(
            load_scene(pictures.scene_path(name)),
            patches=GATHERED if method == "gather" else SHOT,
            tolerance=TINY if method == "gather" else TOLERANCE,
            iterations=steps,
            method=method,
        )
        return _seen(solution, own_view(solution)), command

    what = "iteration" if method == "gather" else "shot"
    caption = f"{steps} {what}{'s' * (steps != 1)}" + ": the lamp alone" * (steps == 0)
    address = _kept(place, name, f"{method}-{steps}", command, make)
    return Cell(address, caption, f"The room after {caption}.", SIZE)


def _command(name: str, method: Literal["gather", "shoot"], steps: int) -> str:
    """The line that makes the same picture."""
    how = (
        f"--patches {GATHERED} --tolerance {TINY:.0e}"
        if method == "gather"
        else f"--patches {SHOT}"
    )
    return (
        f"course radiosity scenes/{name}.yaml --method {method} {how} --iterations {steps}"
        f" --size {_size()} -o room.png"
    )


def _kept(
    place: Place, name: str, which: str, command: str, make: Callable[[], other_shots.Made]
) -> str:
    """Have the picture made and copied, unless the build shows grey ones; return its address."""
    file = f"{name}-{which}.webp"
    if place.blank:
        path = webp.save_blank(place.made / "radiosity" / file, SIZE)
    else:
        path, _ = other_shots.kept_picture(pictures.scene_path(name), command, make)
    return place.address(f"_radiosity/{file}", path)


def _seen(solution: Solution, view: View) -> Image.Image:
    from course.formats.pictures.display import linear_to_srgb8
    from course.radiosity.viewing import look

    return Image.fromarray(linear_to_srgb8(look(solution, view, *SIZE)))


def _numbers(place: tuple[float, ...]) -> str:
    return ",".join(f"{value:g}" for value in place)


def _size() -> str:
    return f"{SIZE[0]}x{SIZE[1]}"
