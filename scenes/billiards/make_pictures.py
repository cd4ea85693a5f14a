"""Render ``gallery/1984.yaml``: the picture that the README shows, and one for each module that is written.

Run from the project's folder: ``python scenes/billiards/make_pictures.py``, which takes a quarter of an hour on two
cores. The pictures of ``docs/_static/1984`` are those of a student who has written the modules up to the one that gives
the picture its name, and nothing else: stand-ins switch off the effects of the others.
"""

import shutil
from pathlib import Path
from tempfile import TemporaryDirectory

import click
from PIL import Image

from course import Picture, load_scene, render
from course.engine.functions.effects import PROJECT, Alone

SCENE = PROJECT / "scenes" / "gallery" / "1984.yaml"
SHOWN = SCENE.with_suffix(".webp")
STEPS = PROJECT / "docs" / "_static" / "1984"
SIZE, SAMPLES = (800, 450), 48
"""Of the pictures of the modules; the README's has those of the scene file."""

MODULES = (
    "textures",
    "cube_map",
    "soft_shadows",
    "glossy",
    "thin_lens",
    "motion_blur",
    "supersampling",
    "film",
)
"""In the order in which they are written here."""


def save(picture: Picture, path: Path, quality: int) -> None:
    """Write a picture as screens show it."""
    path.parent.mkdir(parents=True, exist_ok=True)
    codes = picture.settings.display.codes(picture.shown)
    Image.fromarray(codes).save(path, quality=quality, method=6)
    click.echo(path)


def main() -> None:
    """Render all of them."""
    whole = load_scene(SCENE)
    save(render(whole), SHOWN, 90)
    save(render(whole, size=SIZE, spp=1), STEPS / "one_sample.webp", 85)
    with TemporaryDirectory() as folder:
        for module in ("nothing", *MODULES):
            if module != "nothing":
                shutil.copy(PROJECT / "solutions" / f"{module}.py", folder)
            made = render(load_scene(SCENE, Alone(folder)), size=SIZE, spp=SAMPLES)
            save(made, STEPS / f"{module}.webp", 85)


if __name__ == "__main__":
    main()
