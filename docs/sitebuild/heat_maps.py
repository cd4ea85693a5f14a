"""A scene's picture under the heat map of its work: samples a pixel, or boxes that each pixel's ray was tested with."""

import json
from html import escape
from pathlib import Path
from tempfile import TemporaryDirectory

import click
import numpy as np
from PIL import Image

from course import load_scene, render
from course.base.atomic import replacing
from course.engine.core.types import Indices
from course.engine.formats.pictures.display import heat_map as colours
from course.engine.formats.pictures.display import linear_to_srgb8
from course.engine.formats.pictures.files import save
from course.engine.render.box_tests import box_tests
from sitebuild import pictures, webp
from sitebuild.place import Place
from sitebuild.shots import image, slider, tag

COUNTED = {"adaptive_sampling": "samples a pixel", "bounding_volumes": "boxes a ray"}
"""What the heat map of a scene counts."""

INSTEAD = {"bounding_volumes"}
"""Modules whose two scenes have the same picture: the heat map is what differs."""

STOPS = 25


def heat_map(place: Place, name: str, words: str = "") -> str:
    """Show a scene and its heat map, with a border that moves; ``words`` are the caption."""
    planned = pictures.shot(name)
    shown, _ = image(place, planned, f"{planned.title}: the picture")
    counted = COUNTED[name]
    ends = None
    if place.blank:
        file = webp.save_blank(place.made / f"{name}-heat.webp", planned.size)
    else:
        file, ends = kept(name, planned)
    address = place.address(f"_pictures/{name}-heat.webp", file)
    alternative = f"{planned.title}: {counted}, few are dark and many are light"
    heat = tag(address, alternative, planned.size)
    line = f"course render scenes/{name}.yaml --heat-map heat.png"
    caption = f"{escape(words)} <code>{line}</code>"
    return slider((shown, "picture"), (heat, counted), caption, f"{_scale(ends, counted)}\n")


def counts(name: str) -> Indices:
    """What the heat map shows, (H, W), for the scene as its file says."""
    scene = load_scene(pictures.scene_path(name))
    if scene.loaded.description.acceleration.type == "hierarchy":
        return box_tests(scene, scene.settings)
    return np.maximum(render(scene, threads=pictures.THREADS).film.samples, 1)


def kept(
    name: str, planned: pictures.Shot, folder: Path | None = None
) -> tuple[Path, tuple[int, int]]:
    """The heat map's file, and the fewest and the most that it shows; made unless it is kept."""
    folder = pictures.KEPT if folder is None else folder
    path = folder / f"{planned.key}-heat.webp"
    told = path.with_suffix(".json")
    if not (path.is_file() and told.is_file()):
        click.echo(f"rendering the heat map of scenes/{name}.yaml", err=True)
        work = counts(name)
        with TemporaryDirectory(prefix="course-") as made:
            save(Path(made, "heat.png"), colours(work))
            webp.save(
                Image.open(Path(made, "heat.png")).convert("RGB").resize(planned.size),
                path,
                pictures.QUALITY,
            )
        with replacing(told) as temporary:
            temporary.write_text(json.dumps([int(work.min()), int(work.max())]), encoding="utf-8")
    low, high = json.loads(told.read_text(encoding="utf-8"))
    return path, (low, high)


def _scale(ends: tuple[int, int] | None, counted: str) -> str:
    """The colours from the fewest to the most, with numbers at the ends and in the middle."""
    steps = linear_to_srgb8(colours(np.exp(np.linspace(0, 1, STOPS))[None]))[0]
    ramp = ", ".join(f"rgb({r} {g} {b})" for r, g, b in steps.tolist())
    low, high = ends or (0, 0)
    numbers = (
        [f"{low:,}", f"{round((low * high) ** 0.5):,}", f"{high:,} {counted}"]
        if ends
        else ["fewest", "", f"most {counted}"]
    )
    said = "".join(f"<b>{number}</b>" for number in numbers)
    return f'<p class="heat-scale"><i style="background: linear-gradient(90deg, {ramp})"></i>{said}</p>'
