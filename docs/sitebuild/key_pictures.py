"""Small pictures of the values of one key, beside the key in the reference of scene files."""

import json
from copy import deepcopy
from functools import lru_cache
from hashlib import sha256
from html import escape
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import click
from PIL import Image

from course import load_scene, render
from course.benchmarking.references import engine_hash
from course.engine.functions.effects import PROJECT, Effects
from sitebuild import pictures, webp
from sitebuild.key_headings import link
from sitebuild.key_variants import COMMON, HEAT_MAPS, VARIANTS, Changes
from sitebuild.key_words import ELSEWHERE, WORDS
from sitebuild.place import Place

KEPT = PROJECT / "out" / "docs" / "keys"
SCENES = PROJECT / "scenes"
FOLDERS = ("textures/", "environments/")
"""Of `SCENES`; files in them are named relative to it."""

SIZE = (200, 133)
QUALITY = 88

RAYS = "number of rays, the most in white"
"""Under a heat map."""


def key_pictures(place: Place, definition: str, key: str) -> str:
    """Return the pictures of a key as HTML, or words in their place as Markdown; nothing where it has neither."""
    where = definition, key
    if where in WORDS:
        return WORDS[where]
    if where in ELSEWHERE:
        return f"Pictures: {link(ELSEWHERE[where][0])}."
    shown = VARIANTS.get(where, [])
    figures = [
        _figures(place, definition, said, changes, rays=where in HEAT_MAPS and adaptive(changes))
        for said, changes in shown
    ]
    if where in HEAT_MAPS:
        return "".join(_row(figure) for figure in figures)
    return _row("".join(figures)) if figures else ""


def _row(figures: str) -> str:
    return f'<div class="key-pictures">{figures}</div>'


def _figures(place: Place, definition: str, said: str, changes: Changes, *, rays: bool) -> str:
    """A picture and, beside it, its rays where they are asked for."""
    about = _about(definition) + said
    shown = _figure(place, about, said, changes)
    if rays:
        shown += _figure(place, f"{about}: {RAYS}", RAYS, changes, heat=True)
    return shown


def adaptive(changes: Changes) -> bool:
    """Whether pixels of a picture take different numbers of rays."""
    film = described(changes)["film"]
    return any(film.get(key) is not None for key in ("error", "subdivision"))


def _figure(
    place: Place, alternative: str, said: str, changes: Changes, *, heat: bool = False
) -> str:
    name, file = _file(place, changes, heat=heat)
    address = place.address(f"_keys/{name}", file)
    width, height = SIZE
    return (
        f'<figure><img src="{address}" alt="{escape(alternative)}" width="{width}" height="{height}"'
        f' loading="lazy"><figcaption>{escape(said)}</figcaption></figure>'
    )


def _about(definition: str) -> str:
    return f"{definition.removesuffix('Description')} with "


def _file(place: Place, changes: Changes, *, heat: bool) -> tuple[str, Path]:
    """The picture's name on the site, and where it is now."""
    name = _name(changes, heat=heat)
    if place.blank:
        return name, webp.save_blank(place.made / "key.webp", SIZE)
    return name, picture(changes, heat=heat)


def described(changes: Changes) -> dict[str, Any]:
    """Return the common scene with some of its values changed, as a scene file has it."""
    scene: Any = {"film": {"width": SIZE[0], "height": SIZE[1]}, **deepcopy(COMMON)}
    for where, value in changes.items():
        *way, last = where.split(".")
        at: Any = scene
        for step in way:
            at = at[int(step)] if isinstance(at, list) else at.setdefault(step, {})
        at[int(last) if isinstance(at, list) else last] = deepcopy(value)
    return scene  # type: ignore[no-any-return]


def image(
    changes: Changes,
    size: tuple[int, int] | None = None,
    samples: int | None = None,
    *,
    heat: bool = False,
) -> Image.Image:
    """Render the common scene with changes; without size and samples, as it says itself.

    Parameters
    ----------
    heat : return the heat map of its rays in its place
    """
    text = json.dumps(described(changes))
    for folder in FOLDERS:
        text = text.replace(f'"{folder}', f'"{(SCENES / folder).as_posix()}/')
    with TemporaryDirectory(prefix="course-") as folder:
        file = Path(folder, "key.yaml")
        file.write_text(text, encoding="utf-8")
        made = render(load_scene(file), size=size, spp=samples, threads=pictures.THREADS)
        shown = webp.on_screen(made)
        if heat:
            made.save_heat_map(file.with_suffix(".png"))
            shown = Image.open(file.with_suffix(".png")).convert("RGB")
    return shown


def picture(changes: Changes, kept: Path = KEPT, *, heat: bool = False) -> Path:
    """Render a picture or its heat map, unless it is kept; return the WebP file."""
    path = kept / _name(changes, heat=heat)
    if not path.is_file():
        if not kept.is_dir():
            click.echo("rendering the pictures of the keys of scene files", err=True)
        made = image(changes, heat=heat)
        if made.size != SIZE:
            # Pixels are meant to be seen.
            made = made.resize(SIZE, Image.Resampling.NEAREST)
        webp.save(made, path, QUALITY)
    return path


def _name(changes: Changes, *, heat: bool) -> str:
    """The file's name: a hash of all that decides the picture."""
    everything = [
        described(changes),
        _files(),
        engine_hash(Effects().folder.resolve()),
        SIZE,
        QUALITY,
    ]
    key = sha256(json.dumps(everything, sort_keys=True).encode()).hexdigest()[:16]
    return f"{key}-rays.webp" if heat else f"{key}.webp"


@lru_cache(maxsize=1)
def _files() -> dict[str, str]:
    """Hashes of the files that the scene may name."""
    return {
        path.name: sha256(path.read_bytes()).hexdigest()
        for folder in FOLDERS
        for path in sorted((SCENES / folder).iterdir())
        if path.is_file()
    }
