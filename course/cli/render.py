"""`course render SCENE`: a scene file in, a picture out."""

from __future__ import annotations

import json
import os
from contextlib import closing
from functools import cache
from pathlib import Path
from time import monotonic
from typing import TYPE_CHECKING, Any

import click

from course.base.atomic import write_text
from course.base.errors import CourseError, OutputError
from course.base.progress import progress_bar
from course.cli import options
from course.cli.metu import check_camera, converted, told_of
from course.cli.outputs import check_outputs, check_spared
from course.cli.tables import print_sections
from course.cli.watching import run_again_and_again, times
from course.engine.formats.metu.suffixes import is_metu
from course.engine.functions.effects import Effects
from course.engine.functions.sources import saved_files
from course.engine.render.sections import receipt_sections

if TYPE_CHECKING:
    from course.engine.render.picture import Picture
    from course.engine.scene.scene import SceneSettings

SAMPLERS = (
    *("sobol", "random", "jittered", "regular", "halton", "hammersley", "chained", "xorshift"),
    *("blue_noise", "dithered"),
)

TYPED = "course.render.typed"
"""Where a command's context has its arguments as they were typed."""


class _Typed(click.Command):
    def parse_args(self, ctx: click.Context, args: list[str]) -> list[str]:
        """Keep the arguments."""
        ctx.meta[TYPED] = [*args]
        return super().parse_args(ctx, args)


@click.command(cls=_Typed)
@options.scene_argument
@click.option(
    "-o",
    "--out",
    type=options.PATH,
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
@options.effects_option
@click.option(
    "--denoise",
    is_flag=True,
    default=None,
    help="Show means over neighbours that Welch's test doesn't separate: a preview, whose means are biased.",
)
@click.option(
    "--time-limit",
    metavar="S",
    callback=options.seconds,
    help="Give the best picture in S seconds, from reading the scene on; a tenth of them is for rays in any case.",
)
@click.option(
    "--error",
    metavar="E",
    callback=options.radiance,
    help="Sample where the picture is wrong, until its root-mean-square error is about E (a radiance of 1 is white).",
)
@click.option(
    "--heat-map",
    type=options.PATH,
    help="Write where the samples went, as a picture; with `acceleration: {type: hierarchy}`, how many boxes the ray"
    " through the middle of each pixel is tested with.",
)
@click.option(
    "--receipt",
    "receipt_path",
    callback=options.json_path,
    help="Write what the render cost as JSON, and why each effect was skipped that the scene doesn't need.",
)
@click.option(
    "--shafts",
    is_flag=True,
    help="Leave out shadow rays whose answer a shaft tells: the same picture, seldom sooner.",
)
@click.option(
    "--watch",
    is_flag=True,
    help="Render again whenever the scene or a function is saved, until Ctrl-C.",
)
def render(
    scene: Path,
    out: Path | None,
    camera: str | None,
    engine: str,
    effects: str | None,
    heat_map: Path | None,
    receipt_path: Path | None,
    watch: bool,
    **choices: Any,
) -> None:
    """Render a scene file to a picture.

    The scene file decides what the options leave open. Ctrl-C ends early and keeps what there
    is as NAME.partial.png. A METU scene (.xml or .json) gives a picture for each camera, under
    the names that it has for them.
    """
    _check_engine(engine, choices["address"], choices["threads"])
    check_camera(scene, camera)

    if watch:
        typed = click.get_current_context().meta[TYPED]
        arguments = ["render", *(each for each in typed if each != "--watch")]
        folder = Effects(effects).folder
        run_again_and_again(
            arguments, lambda: [scene, *saved_files(folder), *_named(scene, *times([scene]))]
        )
    _render_all(scene, out, camera, effects, choices, heat_map, receipt_path)


@cache
def _named(scene: Path, _saved: int) -> list[Path]:
    """The files that a scene names, as it was saved then; none where it can't be read."""
    from course.engine.formats.yaml.loading import load_description
    from course.engine.formats.yaml.named_files import named_files

    if is_metu(scene):
        return []
    try:
        description = load_description(scene).description
        return [scene.parent / name for name in named_files(description, scene.parent)]
    except CourseError:
        return []


def _render_all(
    scene: Path,
    out: Path | None,
    camera: str | None,
    effects: str | None,
    choices: dict[str, Any],
    heat_map: Path | None,
    receipt_path: Path | None,
) -> None:
    """Render the pictures of all cameras."""
    if not is_metu(scene):
        out = Path(f"{scene.stem}.png") if out is None else out
        pictures, files = [("-o", out), ("--heat-map", heat_map)], [("--receipt", receipt_path)]
        check_outputs(pictures, files, scene)
        _check_preview(out, choices)
        _render_one(scene, scene, out, effects, choices, heat_map, receipt_path)
        return
    with converted(scene, camera) as chosen:
        for option, path in (("-o", out), ("--heat-map", heat_map), ("--receipt", receipt_path)):
            if len(chosen) > 1 and path is not None:
                names = ", ".join(one.camera for one in chosen)
                raise CourseError(
                    f"{option} names one file, but {scene} has {len(chosen)} cameras: choose one of"
                    f" them with --camera ({names})"
                )
        outs = [
            (f"the picture of camera {one.camera},", Path(one.image))
            if out is None
            else ("-o", out)
            for one in chosen
        ]
        check_outputs([*outs, ("--heat-map", heat_map)], [("--receipt", receipt_path)], scene)
        for _, picture in outs:
            _check_preview(picture, choices)
        for one, (_, picture) in zip(chosen, outs, strict=True):
            _render_one(scene, one.path, picture, effects, choices, heat_map, receipt_path)


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
    from course.engine.render.job import EXTENSIBLE
    from course.engine.render.reading_ahead import ReadingAhead
    from course.engine.render.render import reads_loops_first
    from course.engine.scene.darkness import warn_of_darkness

    began, ahead, here = monotonic(), ReadingAhead(), Path.cwd()

    def described(settings: SceneSettings) -> None:
        if reads_loops_first(settings, **choices):
            ahead.begin()

    with closing(ahead):
        with told_of(scene, file), progress_bar(f"reading {scene.name}"):
            world = load_scene(file, effects=effects, described=described)
        outputs = [("-o", out), ("--heat-map", heat_map), ("--receipt", receipt_path)]
        check_spared(outputs, world.loaded)
        if file != scene:
            _check_error(scene, world.settings.sampler, world.settings.samples, choices)
        told = warn_of_darkness(world, scene, packets=ahead.begun)
    if choices["time_limit"] is not None:
        choices = choices | {"since": began}
    with progress_bar(out.name) as progress:
        picture = render_picture(world, progress=progress, **choices)
    # A function may have gone to another folder; outputs are named from this one.
    os.chdir(here)
    if picture.interrupted:
        partial = out.with_name(f"{out.stem}.partial{out.suffix}")
        picture.save(partial)
        click.echo(f"interrupted: what there is was written to {partial}", err=True)
        raise click.exceptions.Exit(options.INTERRUPTED)
    picture.save(out)
    if not told and (black := _why_black(picture, out)):
        click.echo(f"{out}: {black}", err=True)
    receipt = picture.receipt.to_dict()
    sampler = picture.settings.sampler
    if choices["time_limit"] is not None and choices["spp"] is None and sampler not in EXTENSIBLE:
        click.echo(
            f"the {sampler} sampler places all its samples at once, so the seconds add none: --spp says how many",
            err=True,
        )
    if receipt["samples"] < 1:
        click.echo(
            f"the time limit was over when {receipt['samples']:.0%} of the pixels had a sample; the others are black. "
            "More seconds, or a smaller --size, give a whole picture",
            err=True,
        )
    if choices["shafts"] and "spared" not in receipt:
        click.echo(
            "--shafts: all rays were sent; shafts are for compiled loops, a million samples or more, at most 16 lights",
            err=True,
        )
    if heat_map is not None and "tests" in receipt:
        from course.engine.render.box_tests import save_box_tests

        save_box_tests(world, picture.settings, heat_map)
    elif heat_map is not None:
        picture.save_heat_map(heat_map)
    if receipt_path is not None:
        write_text(receipt_path, json.dumps(receipt, indent=2, allow_nan=False) + "\n")
    print_sections(str(out), receipt_sections(receipt))


def _why_black(picture: Picture, out: Path) -> str:
    """What is to be said of a picture in which nothing is seen; empty where something is."""
    brightest, display = float(picture.linear.max()), picture.settings.display
    if brightest <= 0:
        return "every pixel is black; `course pixel` says why one is"
    # A hundredth of white is seen, however it is encoded.
    dim = out.suffix.lower() == ".png" and brightest < display.white / 100
    if not dim or display.codes(picture.shown).any():
        return ""
    return (
        f"every pixel shows as black, for the brightest is {brightest:.2g} and white is {display.white:g}; "
        "raise the light, set film.white lower, or write .exr"
    )


def _check_error(scene: Path, sampler: str, samples: int, choices: dict[str, Any]) -> None:
    """A METU scene has a grid of samples, which nobody chose who asks for an error to be aimed at."""
    from course.engine.render.adaptive.allocation import FIRST
    from course.engine.render.adaptive.rounds import ADAPTABLE

    if choices["error"] is None or choices["sampler"] is not None or sampler in ADAPTABLE:
        return
    more = " --spp 64" if choices["spp"] is None and samples < FIRST else ""
    raise CourseError(
        f"{scene}: --error adds samples where the error is, but NumSamples of a METU scene places them all at once"
        f" ({sampler}): say --sampler sobol{more}, too"
    )


def _check_preview(out: Path, choices: dict[str, Any]) -> None:
    if choices["denoise"] and out.suffix.lower() == ".exr":
        raise OutputError(
            f"{out}: an .exr holds the picture as it was rendered, and --denoise is for previews: write a .png, or"
            " leave --denoise out"
        )


def _check_engine(engine: str, address: str | None, threads: int | None) -> None:
    if engine != "dask":
        if address is not None:
            raise CourseError("--address is for --engine dask")
        return
    if address is None:
        raise CourseError("--engine dask needs --address tcp://HOST:PORT, that of its scheduler")
    if threads is not None:
        raise CourseError("--threads is for --engine threads; a cluster has workers of its own")
