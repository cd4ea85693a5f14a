"""Scenes that the gallery shows beside its own: METU's, by one of their cameras, and rooms lit by radiosity."""

import json
from collections.abc import Callable
from hashlib import sha256
from html import escape
from pathlib import Path
from tempfile import TemporaryDirectory

import click
from PIL import Image

from course import load_scene, render
from course.base.atomic import replacing
from course.base.errors import SceneError
from course.benchmarking.references import engine_hash
from course.engine.functions.effects import PACKAGE, PROJECT, Effects
from sitebuild import pictures, webp
from sitebuild.place import Place
from sitebuild.shots import laid_out

PATCHES = 4000
RADIOSITY_SIZE = (400, 400)

Made = tuple[Image.Image, str]
"""A picture and what the command prints about it."""


def metu_shot(place: Place, name: str, words: str = "") -> str:
    """Show ``scenes/NAME.xml`` by the camera whose id is the first of ``words``; the others are the title."""
    camera, _, title = words.partition(" ")
    scene = PROJECT / "scenes" / f"{name}.xml"
    with TemporaryDirectory(prefix="course-") as folder:
        loaded = load_scene(_converted(scene, camera, Path(folder)))
        settings = loaded.settings
        command = f"course render scenes/{name}.xml --camera {camera} -o {scene.stem}-{camera}.png"

        def make() -> Made:
            made = render(loaded, threads=pictures.THREADS)
            planned = pictures.Shot(name, title, (0, 0), 0, "")
            text = pictures.receipt_text(planned, made.receipt.to_dict())
            return webp.on_screen(made), text

        size = (settings.width, settings.height)
        return _shown(place, f"{name}-{camera}", title, scene, command, size, make)


def radiosity_shot(place: Place, name: str, words: str = "") -> str:
    """Show a room as ``course radiosity`` makes it; ``words`` are the title."""
    scene = pictures.scene_path(name)
    width, height = RADIOSITY_SIZE
    command = f"course radiosity scenes/{name}.yaml --patches {PATCHES} --size {width}x{height} -o room.png"

    def make() -> Made:
        from course.engine.formats.pictures.files import save
        from course.engine.radiosity.radiosity import solve
        from course.engine.radiosity.viewing import look, own_view

        solution = solve(load_scene(scene), patches=PATCHES)
        with TemporaryDirectory(prefix="course-") as folder:
            save(Path(folder, "room.png"), look(solution, own_view(solution), width, height))
            image = Image.open(Path(folder, "room.png")).convert("RGB")
        said = (
            f"{len(solution.triangles)} patches, {int(solution.steps[0])} steps, "
            f"within {float(solution.left[0]):.2%} of convergence"
        )
        return image, said

    return _shown(place, f"{name}-room", words, scene, command, RADIOSITY_SIZE, make)


def _converted(scene: Path, camera: str, folder: Path) -> Path:
    from course.engine.formats.metu.converting import convert

    converted, _ = convert(scene, folder / "scene.yaml")
    for one in converted:
        if one.camera == camera:
            return one.path
    raise SceneError(f"{scene}: there is no camera {camera!r}")


def _shown(
    place: Place,
    name: str,
    title: str,
    scene: Path,
    command: str,
    size: tuple[int, int],
    make: Callable[[], Made],
) -> str:
    flat = name.replace("/", "-")
    if place.blank:
        file = webp.save_blank(place.made / f"{flat}.webp", size)
        text = "not rendered in this build"
    else:
        file, text = kept_picture(scene, command, make)
    address = place.address(f"_pictures/{flat}.webp", file)
    image = f'<img src="{address}" alt="{escape(title)}" width="{size[0]}" height="{size[1]}" loading="lazy">'
    target = f"_scenes/{flat}{scene.suffix}"
    return laid_out(title, image, command, text, scene, place.address(target, scene))


def kept_picture(scene: Path, command: str, make: Callable[[], Made]) -> tuple[Path, str]:
    """Make the picture, unless it is kept with what was said about it."""
    files = [scene, *sorted(scene.parent.glob("*.ply"))]
    hashes = [sha256(path.read_bytes()).hexdigest() for path in files]
    solver = [
        sha256(path.read_bytes()).hexdigest()
        for path in sorted((PACKAGE / "engine" / "radiosity").rglob("*.py"))
    ]
    everything = [command, hashes, solver, engine_hash(Effects().folder.resolve())]
    key = sha256(json.dumps(everything).encode()).hexdigest()[:32]
    image, said = pictures.KEPT / f"{key}.webp", pictures.KEPT / f"{key}.txt"
    if not (image.is_file() and said.is_file()):
        click.echo(f"rendering {scene.relative_to(PROJECT)}", err=True)
        made, text = make()
        webp.save(made, image, pictures.QUALITY)
        with replacing(said) as temporary:
            temporary.write_text(text, encoding="utf-8")
    return image, said.read_text(encoding="utf-8")
