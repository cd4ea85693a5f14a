"""Converged pictures, kept on disk by a hash of all that decides them and of the code; each knows its own error."""

import json
from dataclasses import dataclass
from functools import lru_cache
from hashlib import sha256
from importlib.metadata import version
from pathlib import Path

import numpy as np

from course.base.atomic import make_folder, replacing
from course.base.errors import CourseError, SceneError
from course.base.inputs import read_arrays
from course.engine.casters.choice import software
from course.engine.core.schedule import Progress
from course.engine.core.types import Floats32
from course.engine.formats.yaml.loading import Loaded, load_description
from course.engine.formats.yaml.named_files import named_files
from course.engine.formats.yaml.overriding import Overrides
from course.engine.functions.effects import PACKAGE, Effects
from course.engine.functions.sources import saved_files
from course.engine.render.render import render
from course.engine.scene.building.world import compile_scene
from course.engine.scene.scene import Scene

RENDERING = (
    *("casters", "core", "formats", "functions", "loops", "render", "scene", "shapes"),
    "terms",
)
"""The rooms of the engine that have a say in a picture."""

LIBRARIES = ("numpy", "pillow", "mapbox_earcut")


@lru_cache(maxsize=8)
def engine_hash(effects: Path) -> str:
    """Hash of the sources of all that renders: the engine, the effects' folder, the versions of the libraries.

    ``effects``: folder of the functions that the engine calls.
    """
    digest = sha256(f"{software()}\n".encode())
    for name in LIBRARIES:
        digest.update(f"{name} {version(name)}\n".encode())
    files = [path for name in RENDERING for path in (PACKAGE / "engine" / name).rglob("*.py")]
    for path in [*sorted(files), *sorted(saved_files(effects))]:
        digest.update(f"{path.parent.name}/{path.name}\n".encode())
        digest.update(sha256(path.read_bytes()).digest())
    return digest.hexdigest()


def scene_hash(loaded: Loaded, effects: Effects, **settings: object) -> str:
    """Hash of a scene as it was loaded, the files it names, the settings given here, and the engine.

    The scene's own sampler, number of samples, seed and title don't count: whoever renders it for a reference
    chooses the first three.
    Raises SceneError: a file that the scene names can't be read.
    ``settings``: plain values.
    """
    data = {k: v for k, v in loaded.document.data.items() if k not in ("sampler", "seed", "title")}
    files = {
        name: _file_hash(loaded.path.parent / name)
        for name in named_files(loaded.description, loaded.path.parent)
    }
    everything = [data, files, settings, engine_hash(effects.folder.resolve())]
    text = json.dumps(everything, sort_keys=True, allow_nan=False)
    return sha256(text.encode()).hexdigest()


def _file_hash(path: Path) -> str:
    try:
        return sha256(path.read_bytes()).hexdigest()
    except OSError as error:
        raise SceneError(f"{path}: can't be read: {error.strerror}") from error


FOLDER = Path("out", "references")
SAMPLES = 8192
HALVES = (0x5EED0001, 0x5EED0002)
"""Seeds of the two halves; nobody measures with these."""


@dataclass(frozen=True)
class Reference:
    """A converged picture.

    Attributes
    ----------
    linear : (H, W, 3) float32 linear radiance
    error : its own RMSE, estimated from its two independent halves
    samples : a pixel
    key : hash of all that decides it
    """

    linear: Floats32
    error: float
    samples: int
    key: str


def reference(
    scene_path: str | Path,
    *,
    samples: int = SAMPLES,
    size: tuple[int, int] | None = None,
    folder: str | Path = FOLDER,
    overrides: Overrides | None = None,
    effects: str | Path | Effects | None = None,
    progress: Progress | None = None,
) -> Reference:
    """The converged picture of a scene, from the folder or else rendered now and kept there.

    The mean of two independent halves a and b has the error variance E (a - b)^2 / 4, so the root of the mean of
    that over pixels and channels is its RMSE; what both halves have in common (a bias) it can't tell.

    Parameters
    ----------
    scene_path : the YAML file
    samples : a pixel, an even number; Sobol points whatever the scene says, half of them with one seed, half with
        another
    size : (width, height) [pixels]; as the scene says if None
    folder : where references are kept, as KEY.npz; made if it isn't there
    overrides : other values at some key paths of the scene
    effects : as `course.load_scene` takes it
    progress : as `course.render` takes it, called for each half

    Raises
    ------
    CourseError
        An odd number of samples, a scene that can't be rendered, or a folder that can't be written.
    KeyboardInterrupt
        Ctrl-C; the half that was done is kept, and the next call goes on from there.
    """
    if samples < 2 or samples % 2:
        raise CourseError(f"a reference of {samples} samples has no two equal halves")
    bound = effects if isinstance(effects, Effects) else Effects(effects)
    loaded = _evenly_sampled(load_description(Path(scene_path), overrides), overrides)
    film = loaded.description.film
    size = size or (film.width, film.height)
    key = scene_hash(loaded, bound, samples=samples, size=size)
    path = Path(folder) / f"{key[:32]}.npz"
    found = _read(path, key)
    if found is not None:
        return found
    make_folder(path.parent)
    scene = Scene(loaded, compile_scene(loaded, bound), bound)
    halves = []
    parts = [path.with_name(f"{path.stem}.half{number}.npz") for number in range(2)]
    for part, seed in zip(parts, HALVES, strict=True):
        half = _read(part, key)
        if half is None:
            picture = render(
                scene,
                spp=samples // 2,
                size=size,
                sampler="sobol",
                seed=seed,
                progress=progress,
                denoise=False,
            )
            if picture.interrupted:
                raise KeyboardInterrupt
            half = Reference(picture.linear, float("nan"), samples // 2, key)
            _write(part, half)
        halves.append(half.linear.astype(np.float64))
    linear = (0.5 * (halves[0] + halves[1])).astype(np.float32)
    error = 0.5 * float(np.sqrt(np.mean((halves[0] - halves[1]) ** 2)))
    whole = Reference(linear, error, samples, key)
    _write(path, whole)
    for part in parts:
        part.unlink(missing_ok=True)
    return whole


def _evenly_sampled(loaded: Loaded, overrides: Overrides | None) -> Loaded:
    """The scene without an error to aim at: all pixels of a reference have all its samples."""
    film = loaded.document.data.get("film") or {}
    if film.get("error") is None:
        return loaded
    return load_description(loaded.path, {**(overrides or {}), ("film", "error"): None})


def _read(path: Path, key: str) -> Reference | None:
    """The contents of a file; None if there is none, or not the one that is looked for."""
    try:
        data = read_arrays(path, "reference")
        head = json.loads(str(data["head"]))
        linear = np.ascontiguousarray(data["linear"], np.float32)
    except (CourseError, ValueError, KeyError):
        return None  # Missing, or damaged: rendered anew and replaced.
    if head.get("key") != key:
        return None
    return Reference(linear, float(head["error"]), int(head["samples"]), key)


def _write(path: Path, item: Reference) -> None:
    head = json.dumps({"key": item.key, "error": item.error, "samples": item.samples})
    with replacing(path) as temporary, temporary.open("wb") as file:
        np.savez(file, head=np.array(head), linear=item.linear)
