"""Content hashes: of the code that renders, and of all that decides a scene's picture."""

from __future__ import annotations

import json
from functools import lru_cache
from hashlib import sha256
from importlib.metadata import version
from pathlib import Path

from course.effects import PROJECT, Effects
from course.errors import SceneError
from course.formats.yaml import description as d
from course.formats.yaml.loading import Loaded

RENDERING = (
    *("core", "extras", "compiled", "adaptive", "building", "formats", "shapes"),
    *("scene", "jobs", "rendering"),
)
"""The packages of the course that have a say in a picture."""

LIBRARIES = ("embreex", "numpy", "pillow", "trimesh")


@lru_cache(maxsize=8)
def engine_hash(effects: Path) -> str:
    """Hash of the sources of all that renders: the engine, the effects' folder, the versions of the libraries.

    Parameters
    ----------
    effects : folder of the functions that the engine calls
    """
    digest = sha256()
    for name in LIBRARIES:
        digest.update(f"{name} {version(name)}\n".encode())
    files = [path for name in RENDERING for path in (PROJECT / "course" / name).rglob("*.py")]
    for path in [*sorted(files), *sorted(effects.glob("*.py"))]:
        digest.update(f"{path.parent.name}/{path.name}\n".encode())
        digest.update(sha256(path.read_bytes()).digest())
    return digest.hexdigest()


def scene_hash(loaded: Loaded, effects: Effects, **settings: object) -> str:
    """Hash of a scene as it was loaded, the files it names, the settings given here, and the engine.

    The scene's own sampler, number of samples, seed and title don't count: whoever renders it for a reference
    chooses the first three.

    Parameters
    ----------
    settings : plain values

    Raises
    ------
    SceneError
        A file that the scene names can't be read.
    """
    data = {k: v for k, v in loaded.document.data.items() if k not in ("sampler", "seed", "title")}
    files = {
        name: _file_hash(loaded.path.parent / name) for name in named_files(loaded.description)
    }
    everything = [data, files, settings, engine_hash(effects.folder.resolve())]
    text = json.dumps(everything, sort_keys=True, allow_nan=False)
    return sha256(text.encode()).hexdigest()


def named_files(scene: d.SceneDescription) -> list[str]:
    """Every file that a scene names, as it names them, each once."""
    names = [thing.file for thing in scene.objects if isinstance(thing, d.MeshFile)]
    match scene.environment:
        case d.CubeEnvironment(faces=faces, cross=cross):
            names += [name for name in (*(faces or ()), cross) if name is not None]
        case d.LatLongEnvironment(image=image):
            names.append(image)
    return list(dict.fromkeys(names))


def _file_hash(path: Path) -> str:
    try:
        return sha256(path.read_bytes()).hexdigest()
    except OSError as error:
        raise SceneError(f"{path}: can't be read: {error.strerror}") from error
