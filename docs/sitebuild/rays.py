"""The rays of a pixel in their scene, as `course pixel --html` writes them."""

import re
from functools import cache
from hashlib import sha256
from pathlib import Path

from course import pixel
from course.base.atomic import write_text
from course.base.errors import CourseError
from course.benchmarking.references import scene_hash
from course.engine.formats.yaml.loading import load_description
from course.engine.functions.effects import PACKAGE, PROJECT, Effects
from course.engine.recording.view import page
from sitebuild.pictures import scene_path
from sitebuild.place import Place

KEPT = PROJECT / "out" / "docs" / "rays"

LATER = """<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8"><title>{title}</title><style>
body {{ background: #b0b0b0 }}
@media (prefers-color-scheme: dark) {{ body {{ background: #505050 }} }}
</style></head><body></body></html>
"""
"""Stands for the rays where pictures are left blank."""


def rays(place: Place, name: str, words: str) -> str:
    """Show the rays of a pixel; ``words`` are its column and row, such as "300,300".

    Raises
    ------
    CourseError
        There is no such scene or pixel.
    """
    x, _, y = words.partition(",")
    if not (x.isdigit() and y.isdigit()):
        raise CourseError(f"{words!r} is not a pixel: expected X,Y")
    shown = f"rays-{name.replace('/', '-')}-{x}-{y}.html"
    at = name, int(x), int(y)
    file = _later(place.made / shown, *at) if place.blank else view(*at)
    (title,) = re.findall("<title>(.*?)</title>", file.read_text(encoding="utf-8"))
    address = place.address(f"rays/{shown}", file)
    return (
        f'<iframe class="rays" src="{address}" title="The rays of {title}" loading="lazy">'
        f'</iframe>\n\n<a href="{address}">The view by itself</a>\n'
    )


def view(name: str, x: int, y: int, kept: Path = KEPT) -> Path:
    """Follow a pixel's rays, unless they are kept under a hash of all that decides them; return the page."""
    loaded = load_description(scene_path(name))
    scene = loaded.description
    seen = {"title": scene.title, "sampler": scene.sampler.type, "samples": scene.sampler.samples}
    key = scene_hash(loaded, Effects(), pixel=[x, y], seed=scene.seed, page=_sources(), **seen)
    file = kept / f"{key}.html"
    if not file.is_file():
        file.parent.mkdir(parents=True, exist_ok=True)
        write_text(file, _page(name, x, y))
    return file


@cache
def _sources() -> str:
    """Hash of all that records rays and shows them."""
    files = [path for path in (PACKAGE / "engine" / "recording").iterdir() if path.is_file()]
    return sha256(b"".join(path.read_bytes() for path in sorted(files))).hexdigest()


def _later(file: Path, name: str, x: int, y: int) -> Path:
    scene = scene_path(name)
    film = load_description(scene).description.film
    if x >= film.width or y >= film.height:
        raise CourseError(
            f"{scene.name} has {film.width}x{film.height} pixels; there is no {x},{y}"
        )
    file.parent.mkdir(parents=True, exist_ok=True)
    write_text(file, LATER.format(title=f"pixel {x},{y} of {scene.name}"))
    return file


def _page(name: str, x: int, y: int) -> str:
    return page(pixel(scene_path(name), x, y))
