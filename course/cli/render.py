"""`course render SCENE`: a scene file in, a picture out."""

from __future__ import annotations

import json
import signal
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING, Any

import click

from course.cli import options
from course.cli.progress import progress_bar
from course.cli.tables import print_sections, receipt_sections
from course.errors import CourseError, SceneError
from course.imaging.atomic import check_writable, write_text

if TYPE_CHECKING:
    from course.scene.metu.converting import Converted

SAMPLERS = (
    "sobol",
    "random",
    "jittered",
    "regular",
    "halton",
    "hammersley",
    "chained",
    "xorshift",
)

ENDS = ("SIGTERM", "SIGHUP")
"""Signals that end a process, and have no exception as Ctrl-C has; not every system has both."""


@click.command()
@click.argument("scene", metavar="SCENE", type=click.Path(path_type=Path))
@click.option(
    "-o",
    "--out",
    type=click.Path(path_type=Path),
    help="Picture to write, .png (sRGB) or .exr (linear float).  [default: SCENE's name with .png]",
)
@click.option(
    "--camera", metavar="ID", help="Of a METU scene with several cameras, only this one's picture."
)
@click.option("--spp", type=click.IntRange(1, 65536), help="Samples a pixel.")
@click.option(
    "--size", metavar="WxH", callback=options.size, help="Size in pixels, such as 640x480."
)
@click.option("--sampler", type=click.Choice(SAMPLERS), help="Where the samples lie.")
@click.option("--seed", type=click.IntRange(0, 2**32 - 1), help="Seed of every random choice.")
@click.option(
    "--threads", type=click.IntRange(1, 1024), help="Threads to use.  [default: every core]"
)
@click.option(
    "--engine",
    type=click.Choice(["threads", "dask"]),
    default="threads",
    show_default=True,
    help="Where to render: on this machine or on a dask cluster.",
)
@click.option("--address", metavar="tcp://HOST:PORT", help="Of the dask scheduler.")
@click.option(
    "--effects",
    help="Whose functions to call: solutions, assignments, or a folder of modules."
    "  [default: solutions, or assignments where there are none]",
)
@click.option(
    "--time-limit",
    metavar="S",
    callback=options.seconds,
    help="Give the best picture in S seconds.",
)
@click.option(
    "--error",
    metavar="E",
    callback=options.radiance,
    help="Sample where the picture is wrong, until its root-mean-square error is about E (a radiance of 1 is white).",
)
@click.option(
    "--heat-map",
    type=click.Path(path_type=Path),
    help="Write where the samples went, as a picture; with `acceleration: {type: hierarchy}`, how many boxes the ray"
    " through the middle of each pixel is tested with.",
)
@click.option(
    "--receipt",
    "receipt_path",
    callback=options.json_path,
    help="Write what the render cost as JSON.",
)
def render(
    scene: Path,
    out: Path | None,
    camera: str | None,
    spp: int | None,
    size: tuple[int, int] | None,
    sampler: str | None,
    seed: int | None,
    threads: int | None,
    engine: str,
    address: str | None,
    effects: str | None,
    time_limit: float | None,
    error: float | None,
    heat_map: Path | None,
    receipt_path: Path | None,
) -> None:
    """Render a scene file to a picture.

    What the options leave open is as the scene file says. Ctrl-C ends early and keeps what there
    is as NAME.partial.png. A METU scene (.xml or .json) gives a picture for each camera, under
    the names that it has for them.
    """
    _check_engine(engine, address, threads)
    choices: dict[str, Any] = {
        "spp": spp,
        "size": size,
        "sampler": sampler,
        "seed": seed,
        "threads": threads,
        "time_limit": time_limit,
        "error": error,
        "address": address,
    }
    if scene.suffix.lower() not in (".xml", ".json"):
        if camera is not None:
            raise CourseError("--camera is for METU scenes, .xml or .json; others have one camera")
        out = Path(f"{scene.stem}.png") if out is None else out
        _render_one(scene, scene, out, effects, choices, heat_map, receipt_path)
        return
    with _told_to_end(), TemporaryDirectory(prefix="course-") as folder:
        chosen = _converted(scene, camera, Path(folder))
        for option, path in (("-o", out), ("--heat-map", heat_map), ("--receipt", receipt_path)):
            if len(chosen) > 1 and path is not None:
                names = ", ".join(one.camera for one in chosen)
                raise CourseError(
                    f"{option} names one file, but {scene} has {len(chosen)} cameras: choose one of"
                    f" them with --camera ({names})"
                )
        for one in chosen:
            picture = Path(one.image) if out is None else out
            _render_one(scene, one.path, picture, effects, choices, heat_map, receipt_path)


@contextmanager
def _told_to_end() -> Iterator[None]:
    """A process that is told to end, or whose terminal is closed, ends by an exception, and so deletes its folder."""
    known = [getattr(signal, name) for name in ENDS if hasattr(signal, name)]
    # What is ignored, as under nohup, stays so.
    taken = [number for number in known if signal.getsignal(number) is signal.SIG_DFL]
    for number in taken:
        signal.signal(number, _end)
    try:
        yield
    finally:
        for number in taken:
            signal.signal(number, signal.SIG_DFL)


def _end(number: int, _frame: object) -> None:
    # As shells say it of a process that a signal has ended.
    sys.exit(128 + number)


def _converted(scene: Path, camera: str | None, folder: Path) -> list[Converted]:
    """The scene files of a METU scene, one for each camera or for the one that is asked for."""
    from course.scene.metu.converting import convert

    converted, warnings = convert(scene, folder / "scene.yaml")
    for warning in warnings:
        click.echo(f"warning: {warning}", err=True)
    if camera is None:
        return converted
    chosen = [one for one in converted if one.camera == camera]
    if not chosen:
        names = ", ".join(one.camera for one in converted)
        raise CourseError(f"--camera {camera}: {scene} has the cameras {names}")
    return chosen[:1]


def _render_one(
    scene: Path,
    file: Path,
    out: Path,
    effects: str | None,
    choices: dict[str, Any],
    heat_map: Path | None,
    receipt_path: Path | None,
) -> None:
    """Render one scene file to one picture; `scene` is what messages call it."""
    from course import load_scene
    from course import render as render_picture
    from course.imaging.files import check_picture_path
    from course.scene.needs import why_black

    for path in (out, heat_map):
        if path is not None:
            check_picture_path(path)
    if receipt_path is not None:
        check_writable(receipt_path)
    try:
        world = load_scene(file, effects=effects)
    except SceneError as error:
        if file == scene:
            raise
        from course.scene.metu.converting import retold

        raise retold(error, scene, file) from error
    black = why_black(world)
    if black:
        click.echo(f"hint: {scene}: {black}", err=True)
    with progress_bar(out.name) as progress:
        picture = render_picture(world, progress=progress, **choices)
    if picture.interrupted:
        partial = out.with_name(f"{out.stem}.partial{out.suffix}")
        picture.save(partial)
        click.echo(f"interrupted: what there is was written to {partial}", err=True)
        raise click.exceptions.Exit(options.INTERRUPTED)
    picture.save(out)
    receipt = picture.receipt.to_dict()
    if heat_map is not None and "tests" in receipt:
        from course.rendering.box_tests import save_box_tests

        save_box_tests(world, picture.settings, heat_map)
    elif heat_map is not None:
        picture.save_heat_map(heat_map)
    if receipt_path is not None:
        write_text(receipt_path, json.dumps(receipt, indent=2, allow_nan=False) + "\n")
    print_sections(str(out), receipt_sections(receipt))


def _check_engine(engine: str, address: str | None, threads: int | None) -> None:
    if engine != "dask":
        if address is not None:
            raise CourseError("--address is for --engine dask")
        return
    if address is None:
        raise CourseError("--engine dask needs --address tcp://HOST:PORT, that of its scheduler")
    if threads is not None:
        raise CourseError("--threads is for --engine threads; a cluster has workers of its own")
