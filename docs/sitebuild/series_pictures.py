"""The pictures of a series, rendered once and kept under a hash of all that decides them."""

from dataclasses import replace
from functools import lru_cache
from pathlib import Path

import click
import yaml
from PIL import Image

from course import Picture, render
from course.benchmarking.references import scene_hash
from course.engine.formats.yaml.document import spell
from course.engine.formats.yaml.loading import Loaded, load_description
from course.engine.functions.effects import PROJECT, Effects
from course.engine.scene.scene import Scene, load_variant
from sitebuild import pictures, webp
from sitebuild.place import Place
from sitebuild.series_file import PATTERN, SAMPLES, Series

KEPT = PROJECT / "out" / "docs" / "series"

QUALITY = 85

TONE = ("film", "tone")
"""Keys that decide how a picture is shown, and not what its rays bring."""

State = tuple[Path, int, str]
"""A scene file, when it was changed, and what a step overrides, as text."""


def picture(series: Series, step: tuple[int, ...], kept: Path = KEPT) -> Path:
    """Render the picture of one step, unless it is kept; return the WebP file.

    Raises
    ------
    CourseError
        The scene can't be rendered with these values, or nothing can be written to the folder.
    """
    path = pictures.scene_path(series.scene)
    samples = series.samples_of(step)
    state = (path, path.stat().st_mtime_ns, _text(series, step))
    loaded = _described(*state)
    settings = {
        "size": series.size,
        "sampler": series.overrides(step).get(PATTERN, loaded.description.sampler.type),
        "samples": samples,
        "seed": loaded.description.seed,
        "quality": QUALITY,
    }
    image = kept / f"{scene_hash(loaded, Effects(), **settings)}.webp"
    if not image.is_file():
        click.echo(f"rendering scenes/{series.scene}.yaml: {caption(series, step)}", err=True)
        made = _rendered(state, series.size, samples, settings["sampler"])
        webp.save(webp.on_screen(made), image, QUALITY)
    return image


def address(place: Place, name: str, series: Series, step: tuple[int, ...]) -> str:
    """Hand one step's picture over to the site, or a stand-in; return its address on the page."""
    file = f"{name}-{'-'.join(map(str, step))}.webp"
    path = (
        blank(series, step, place.made / "series" / file) if place.blank else picture(series, step)
    )
    return place.address(f"_series/{file}", path)


def blank(series: Series, step: tuple[int, ...], path: Path) -> Path:
    """Make a picture of the same size, in a grey that no other step of the series has."""
    steps = list(series.steps())
    grey = round(40 + 175 * steps.index(step) / (len(steps) - 1))
    path.parent.mkdir(parents=True, exist_ok=True)
    Image.new("RGB", series.size, (grey, grey, grey)).save(path, "WEBP", lossless=True)
    return path


def caption(series: Series, step: tuple[int, ...]) -> str:
    """Name a step by its values: radius: 0.4 world units, 16 samples."""
    return ", ".join(
        slider.words(place) if slider.key == SAMPLES else f"{slider.name}: {slider.words(place)}"
        for slider, place in zip(series.sliders, step, strict=True)
    )


def command(series: Series, step: tuple[int, ...]) -> str:
    """Write the line that renders the same picture, of the scene or of the copy that `change` asks for."""
    width, height = series.size
    name = "copy" if change(series, step) else series.scene
    pattern = series.overrides(step).get(PATTERN)
    sampler = f" --sampler {pattern}" if pattern else ""
    return (
        f"course render scenes/{name}.yaml --size {width}x{height} --spp {series.samples_of(step)}{sampler}"
        f" -o {series.scene}.png"
    )


def change(series: Series, step: tuple[int, ...]) -> str:
    """Write what has to stand in a copy of the scene, or nothing where options of the command line do."""
    return "; ".join(
        f"{spell(key)}: {_flow(value)}"
        for key, value in series.overrides(step).items()
        if key != PATTERN
    )


def _flow(value: object) -> str:
    """Write a value as YAML on one line; PyYAML marks a document's end after a plain number."""
    return yaml.safe_dump(value, default_flow_style=True, sort_keys=False, width=1000).split("\n")[
        0
    ]


def _text(series: Series, step: tuple[int, ...]) -> str:
    """What a step overrides in the description, as a key for what is kept in memory."""
    changed = [[list(key), v] for key, v in series.overrides(step).items() if key != PATTERN]
    return yaml.safe_dump(changed)


def _overrides(text: str) -> dict[tuple[str | int, ...], object]:
    return {tuple(key): value for key, value in yaml.safe_load(text)}


def _rendered(state: State, size: tuple[int, int], samples: int, sampler: str) -> Picture:
    """A step's picture; steps that differ in tone mapping alone share their rays."""
    path, changed, text = state
    values = _overrides(text)
    rays = [[list(key), value] for key, value in values.items() if key[:2] != TONE]
    if len(rays) == len(values):
        return _of_rays(state, size, samples, sampler)
    film = _of_rays((path, changed, yaml.safe_dump(rays)), size, samples, sampler).film
    return replace(_of_rays(state, size, 1, sampler), film=film)


@lru_cache(maxsize=2)
def _of_rays(state: State, size: tuple[int, int], samples: int, sampler: str) -> Picture:
    scene = _compiled(*state)
    return render(scene, size=size, spp=samples, sampler=sampler, threads=pictures.THREADS)


@lru_cache(maxsize=64)
def _described(path: Path, _: int, text: str) -> Loaded:
    return load_description(path, _overrides(text))


@lru_cache(maxsize=1)
def _compiled(path: Path, _: int, text: str) -> Scene:
    return load_variant(path, _overrides(text))
