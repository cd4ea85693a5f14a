"""`course radiosity SCENE`: the light on all surfaces, worked out once and looked at from any camera."""

from __future__ import annotations

import math
import re
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from course.base.errors import CourseError
from course.base.progress import progress_bar
from course.cli import options
from course.cli.metu import check_not_metu
from course.cli.outputs import check_outputs
from course.engine.functions.modules import COURSE

if TYPE_CHECKING:
    from course.engine.radiosity.viewing import Solution, View

NUMBER = r"[-+]?(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][-+]?[0-9]+)?"
POINT = rf"\s*({NUMBER})\s*,\s*({NUMBER})\s*,\s*({NUMBER})\s*"

Place = tuple[float, float, float]

SOLVING = ("patches", "method", "iterations", "tolerance", "split")
"""Options that say how a scene is worked out."""


def _cameras(
    _ctx: click.Context, _option: click.Parameter, texts: tuple[str, ...]
) -> list[tuple[Place, Place]]:
    """Return eyes and the points they look at."""
    found = []
    for text in texts:
        match = re.fullmatch(f"{POINT}:{POINT}", text)
        if match is None:
            raise click.BadParameter(
                f"{text!r} is no camera: expected EYE:LOOK_AT, such as 0,1,4:0,1,0"
            )
        x = [float(number) for number in match.groups()]
        found.append(((x[0], x[1], x[2]), (x[3], x[4], x[5])))
    return found


@click.command()
@options.scene_argument
@click.option(
    "-o",
    "--out",
    "outs",
    multiple=True,
    type=options.PATH,
    help="Picture (.png, .exr) or solution (.npz) to write; may be given for each."
    "  [default: SCENE's name with .png]",
)
@click.option(
    "--patches",
    type=click.IntRange(1, 100_000),
    help="Triangles to divide the surfaces into.  [default: 10000]",
)
@click.option(
    "--method",
    type=click.Choice(["auto", "gather", "shoot"]),
    help="Gather with all form factors at once, or shoot from patch after patch."
    "  [default: auto, gather up to 1000 patches]",
)
@click.option(
    "--iterations",
    type=click.IntRange(min=0),
    help="End after so many iterations of gathering, or so many shots.",
)
@click.option(
    "--tolerance",
    type=click.FloatRange(0, 1, min_open=True),
    help="End this near to convergence, as a share of all light.  [default: 0.01]",
)
@click.option(
    "--split",
    metavar="CONTRAST",
    type=click.FloatRange(0, 1),
    help="Begin with a fourth of the patches, and divide those with more contrast than this.",
)
@click.option(
    "--camera",
    "cameras",
    metavar="EYE:LOOK_AT",
    multiple=True,
    callback=_cameras,
    help="Look from there, such as 0,1,4:0,1,0; given more than once, a picture for each."
    "  [default: the scene's camera]",
)
@click.option(
    "--frames",
    type=click.IntRange(2, 10_000),
    help="Fly from the first camera to the last in so many pictures.",
)
@click.option("--size", metavar="WxH", callback=options.size, help="Size in pixels.")
@options.effects_option
def radiosity(
    scene: Path,
    outs: tuple[Path, ...],
    cameras: list[tuple[Place, Place]],
    frames: int | None,
    size: tuple[int, int] | None,
    effects: str | None,
    **solving: Any,
) -> None:
    """Work out the light on all surfaces of a scene, and look at it.

    SCENE is a scene file, or an .npz that was written before, which only has to be looked at.
    Several pictures are numbered: NAME_000.png, NAME_001.png.
    """
    check_not_metu(scene, "radiosity")
    outs = outs or (Path(f"{scene.stem}.png"),)
    pictures = [out for out in outs if out.suffix.lower() != ".npz"]
    solutions = [out for out in outs if out not in pictures]
    check_outputs([("-o", out) for out in pictures], [("-o", out) for out in solutions], scene)
    if frames is not None and len(cameras) < 2:
        raise CourseError("--frames needs two or more --camera to fly between")
    given = {name: value for name, value in solving.items() if value is not None}
    if given and scene.suffix.lower() == ".npz":
        name = next(name for name in SOLVING if name in given)
        raise CourseError(f"--{name} is for scene files; {scene} has been worked out already")
    solution = _solution(scene, effects, given)
    views = _views(solution, cameras, frames)
    for out in outs:
        if out in pictures:
            _write_pictures(solution, views, out, size)
        else:
            solution.save(out)
            click.echo(str(out))


def _solution(scene: Path, effects: str | None, given: dict[str, Any]) -> Solution:
    from course.engine.radiosity.viewing import load_solution

    if scene.suffix.lower() == ".npz":
        return load_solution(scene)
    from course import load_scene
    from course.engine.radiosity.radiosity import solve

    loaded = load_scene(scene, effects=effects)
    with progress_bar(scene.stem) as report:
        solution = solve(loaded, report=report, **given)
    left = float(solution.left[0])
    # Gathering learns how far it is by its first iteration.
    near = (
        f"within {left:.2%} of convergence"
        if math.isfinite(left)
        else "how far from convergence is not known"
    )
    click.echo(f"{len(solution.triangles)} patches, {int(solution.steps[0])} steps, {near}")
    said = [loaded.effects.stand_in("radiosity", name) for name in COURSE["radiosity"]]
    for each in dict.fromkeys(filter(None, said)):
        click.echo(f"not written yet: {each}")
    return solution


def _views(
    solution: Solution, cameras: list[tuple[Place, Place]], frames: int | None
) -> list[View]:
    import numpy as np

    from course.engine.radiosity.viewing import flight, own_view, views_of

    if not cameras:
        return [own_view(solution)]
    views = list(views_of(solution, [(np.array(eye), np.array(at)) for eye, at in cameras]))
    return views if frames is None else flight(views, frames)


def _write_pictures(
    solution: Solution, views: Sequence[View], out: Path, size: tuple[int, int] | None
) -> None:
    from course.engine.formats.pictures.files import save
    from course.engine.radiosity.viewing import look

    width, height = size or (int(solution.size[0]), int(solution.size[1]))
    digits = max(len(str(len(views) - 1)), 3)
    for number, view in enumerate(views):
        name = out.name if len(views) == 1 else f"{out.stem}_{number:0{digits}d}{out.suffix}"
        path = out.with_name(name)
        save(path, look(solution, view, width, height))
        click.echo(str(path))
