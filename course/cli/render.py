"""`course render SCENE`: a scene file in, a picture out."""

from __future__ import annotations

import json
from pathlib import Path

import click

from course.cli import options
from course.cli.progress import progress_bar
from course.cli.tables import print_sections, receipt_sections
from course.errors import CourseError
from course.imaging.atomic import check_writable, write_text

SAMPLERS = ("sobol", "random", "jittered", "regular")


@click.command()
@click.argument("scene", metavar="SCENE", type=click.Path(path_type=Path))
@click.option(
    "-o",
    "--out",
    type=click.Path(path_type=Path),
    help="Picture to write, .png (sRGB) or .exr (linear float).  [default: SCENE's name with .png]",
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
    help="Write where the samples went, as a picture.",
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
    is as NAME.partial.png.
    """
    from course import load_scene
    from course import render as render_picture
    from course.imaging.files import check_picture_path
    from course.scene.needs import why_black

    _check_engine(engine, address, threads)
    out = Path(f"{scene.stem}.png") if out is None else out
    for path in (out, heat_map):
        if path is not None:
            check_picture_path(path)
    if receipt_path is not None:
        check_writable(receipt_path)
    world = load_scene(scene, effects=effects)
    black = why_black(world)
    if black:
        click.echo(f"hint: {scene}: {black}", err=True)
    with progress_bar(out.name) as progress:
        picture = render_picture(
            world,
            spp=spp,
            size=size,
            sampler=sampler,
            seed=seed,
            threads=threads,
            time_limit=time_limit,
            error=error,
            progress=progress,
            address=address,
        )
    if picture.interrupted:
        partial = out.with_name(f"{out.stem}.partial{out.suffix}")
        picture.save(partial)
        click.echo(f"interrupted: what there is was written to {partial}", err=True)
        raise click.exceptions.Exit(options.INTERRUPTED)
    picture.save(out)
    if heat_map is not None:
        picture.save_heat_map(heat_map)
    receipt = picture.receipt.to_dict()
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
