"""Pictures of scenes, rendered once and kept under a hash of all that decides them."""

import json
import math
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import click

from course import load_scene, render
from course.base.atomic import replacing
from course.benchmarking.references import scene_hash
from course.engine.formats.yaml.loading import Loaded, load_description
from course.engine.functions.effects import PROJECT, Effects
from course.engine.render.sections import plain_text, receipt_sections
from sitebuild import webp

KEPT = PROJECT / "out" / "docs" / "pictures"

WIDTH = 1200
"""Pixels across at most, in the scene's proportions: on most screens two for each that a page shows."""

SMALL = 600
"""The same of scenes whose pixels are what one looks at, and of small ones."""

NARROW = 400
"""Columns of a scene's film below which it is small."""

SAMPLES = 256
"""Samples a pixel at most, where a scene is as large as it says."""

PATHS = 12_000_000
"""Of a picture at most: it has fewer pixels where each has many samples, so that the whole site is drawn in minutes."""

FEW = 4
"""Samples a pixel that stay as they are; of more, twice the pixels across have a quarter, which is the same light."""

QUALITY = 92

THREADS: int | None = None
"""That render; None for one a core. Where several processes draw (`sitebuild.ahead`), each has one."""


@dataclass(frozen=True)
class Shot:
    """A scene as the site shows it.

    Attributes
    ----------
    name : of the scene, in ``scenes/`` and without ``.yaml``
    title : what it shows
    size : width and height [pixels]
    samples : a pixel
    key : hash of all that decides the picture
    """

    name: str
    title: str
    size: tuple[int, int]
    samples: int
    key: str

    @property
    def scene(self) -> Path:
        """The scene file."""
        return scene_path(self.name)

    @property
    def command(self) -> str:
        """The line that renders the same picture."""
        width, height = self.size
        file = f"{self.name.rpartition('/')[2]}.png"
        return f"course render scenes/{self.name}.yaml --size {width}x{height} --spp {self.samples} -o {file}"

    @property
    def file(self) -> str:
        """Name of the picture on the site."""
        return f"{self.name.replace('/', '-')}.webp"


def scene_path(name: str) -> Path:
    """Where the scene of that name is."""
    return PROJECT / "scenes" / f"{name}.yaml"


def shot(name: str) -> Shot:
    """Plan the picture of a scene; nothing is rendered, no mesh is read.

    Raises
    ------
    SceneError
        The scene can't be read.
    """
    loaded = load_description(scene_path(name))
    scene = loaded.description
    size, samples = _size_and_samples(loaded)
    key = scene_hash(
        loaded,
        Effects(),
        size=size,
        sampler=scene.sampler.type,
        samples=samples,
        seed=scene.seed,
        quality=QUALITY,
    )
    return Shot(name, scene.title or name, size, samples, key)


def _size_and_samples(loaded: Loaded) -> tuple[tuple[int, int], int]:
    film, sampler = loaded.description.film, loaded.description.sampler
    samples = min(sampler.samples, SAMPLES)
    width = min(film.width, SMALL)
    if film.width >= NARROW and film.subdivision is None and film.denoise is None:
        width = min(2 * film.width, WIDTH)
        if samples > FEW:
            samples = max(samples // 4, FEW)
        if sampler.type in ("regular", "jittered"):
            samples = max(math.isqrt(samples) ** 2, 1)
    paths = width**2 * film.height / film.width * samples
    width = round(width * min(1.0, math.sqrt(PATHS / paths)))
    return (width, round(width * film.height / film.width)), samples


def picture(planned: Shot, kept: Path = KEPT) -> tuple[Path, dict[str, Any]]:
    """Render the picture, unless it is kept.

    Returns
    -------
    path, receipt
        The WebP file, and `Receipt.to_dict` of the render that made it.

    Raises
    ------
    CourseError
        The scene can't be rendered, or nothing can be written to the folder.
    """
    image, receipt = kept / f"{planned.key}.webp", kept / f"{planned.key}.json"
    if not (image.is_file() and receipt.is_file()):
        click.echo(f"rendering scenes/{planned.name}.yaml", err=True)
        scene = load_scene(planned.scene)
        made = render(scene, size=planned.size, spp=planned.samples, threads=THREADS)
        webp.save(webp.on_screen(made), image, QUALITY)
        with replacing(receipt) as temporary:
            temporary.write_text(json.dumps(made.receipt.to_dict(), indent=1), encoding="utf-8")
    return image, json.loads(receipt.read_text(encoding="utf-8"))


def blank(planned: Shot, folder: Path) -> Path:
    """Make a grey picture of the same size, for builds that must not wait."""
    return webp.save_blank(folder / planned.file, planned.size)


def receipt_text(planned: Shot, receipt: Mapping[str, Any]) -> str:
    """Lay a receipt out as the command line does."""
    return plain_text(planned.title, receipt_sections(receipt))
