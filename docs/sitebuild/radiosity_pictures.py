"""A room on its way to its light, by iterations and by shots, and frames of a flight through one solution.

The pictures are the ones that `course radiosity` makes; each is kept with the command that makes it.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from functools import cache, cached_property
from html import escape
from typing import TYPE_CHECKING, Any, Literal

from PIL import Image

from sitebuild import other_shots, pictures, webp
from sitebuild.picture_grid import Cell, grid
from sitebuild.place import Place

if TYPE_CHECKING:
    from course.engine.radiosity.patches import Patches
    from course.engine.radiosity.solving import Solved
    from course.engine.radiosity.viewing import Solution, View
    from course.engine.scene.scene import Scene

Method = Literal["gather", "shoot"]

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
    room = Room(name)
    gathered = [step(place, room, "gather", steps) for steps in (0, *STEPS)]
    shot = [step(place, room, "shoot", steps) for steps in STEPS]
    same = (
        f"The last of each row: <code>{escape(command(name, 'gather', STEPS[-1]))}</code> and"
        f" <code>{escape(command(name, 'shoot', STEPS[-1]))}</code>"
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
        from course.engine.radiosity.radiosity import solve
        from course.engine.radiosity.viewing import flight, views_of

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


class Room:
    """A scene whose light is gathered once, however many iterations are looked at.

    Parameters
    ----------
    name : in ``scenes/``
    """

    def __init__(self, name: str) -> None:
        self.name = name

    def after(self, method: Method, steps: int) -> Solution:
        """The light after so many iterations or shots."""
        from course import load_scene
        from course.engine.radiosity.radiosity import as_solution, solve

        if method == "gather":
            scene, patches, solved = self._gathered
            return as_solution(scene, patches, solved[min(steps, len(solved) - 1)])
        scene = load_scene(pictures.scene_path(self.name))
        return solve(scene, patches=SHOT, iterations=steps, method=method)

    @cached_property
    def _gathered(self) -> tuple[Scene, Patches, list[Solved]]:
        """The scene in patches, and the light of these after each iteration."""
        from course import load_scene
        from course.engine.radiosity.patches import RadiosityFunctions, make_patches
        from course.engine.radiosity.radiosity import solve_patches

        scene = load_scene(pictures.scene_path(self.name))
        patches, functions = make_patches(scene, GATHERED), RadiosityFunctions(scene.effects)
        gather = functions.gather
        given: list[Any] = []

        def remembered(radiosity: Any, *others: Any) -> Any:
            if not given:
                given.append(radiosity)
            given.append(gather(radiosity, *others))
            return given[-1]

        functions.gather = remembered  # type: ignore[method-assign]
        solved = solve_patches(patches, functions, TINY, STEPS[-1], "gather")
        return scene, patches, [replace(solved, radiosity=each) for each in given]


def step(place: Place, room: Room, method: Method, steps: int) -> Cell:
    """The picture of a room after so many iterations or shots."""
    line = command(room.name, method, steps)

    def make() -> other_shots.Made:
        from course.engine.radiosity.viewing import own_view

        solution = room.after(method, steps)
        return _seen(solution, own_view(solution)), line

    what = "iteration" if method == "gather" else "shot"
    caption = f"{steps:,} {what}{'s' * (steps != 1)}" + ": the lamp alone" * (steps == 0)
    address = _kept(place, room.name, f"{method}-{steps}", line, make)
    return Cell(address, caption, f"The room after {caption}.", SIZE)


def command(name: str, method: Method, steps: int) -> str:
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
    from course.engine.formats.pictures.display import linear_to_srgb8
    from course.engine.radiosity.viewing import look

    return Image.fromarray(linear_to_srgb8(look(solution, view, *SIZE)))


def _numbers(place: tuple[float, ...]) -> str:
    return ",".join(f"{value:g}" for value in place)


def _size() -> str:
    return f"{SIZE[0]}x{SIZE[1]}"
