"""A scene as bytes: what it says, the files it names and its functions, for a machine that has none of them.

Workers are never asked for the scene's path: they may not share the file system, or have another file there. Sending
costs little beside what follows: measured on loopback with two busy cores, a mesh file of 35 MB is with the first
worker in 0.4 s and with the next in 0.2 s; either needs 5 s to build what rays meet from it.
"""

from __future__ import annotations

import pickle
from collections.abc import Mapping
from dataclasses import dataclass, replace
from hashlib import sha256
from pathlib import Path
from tempfile import TemporaryDirectory

import msgspec

from course.building.world import compile_scene
from course.effects import Effects
from course.formats.yaml.description import (
    CubeEnvironment,
    LatLongEnvironment,
    MeshFile,
    SceneDescription,
)
from course.formats.yaml.loading import Loaded
from course.scene.scene import Scene

EFFECTS = "effects"
"""Folder of the functions where a parcel is unpacked."""


@dataclass(frozen=True)
class Parcel:
    """A scene on its way to another machine.

    Attributes
    ----------
    content : what `unpack` takes
    digest : of the content; equal parcels have equal ones
    """

    content: bytes
    digest: str


def pack(scene: Scene) -> Parcel:
    """Put a scene, the meshes and pictures that it names, and its functions into one parcel.

    Raises OSError when a file has gone since the scene was loaded.
    """
    loaded = scene.loaded
    files = _Files(loaded.path.parent)
    description = _renamed(loaded.description, files)
    # Lines are for messages about mistakes, and a scene that has been compiled here has none.
    document = replace(loaded.document, lines={})
    functions = {path.name: path.read_bytes() for path in sorted(scene.effects.folder.glob("*.py"))}
    effects = (scene.effects.folder.resolve().name, scene.effects.trusted, functions)
    content = pickle.dumps((description, document, loaded.path.name, files.contents, effects))
    return Parcel(content, sha256(content).hexdigest())


def unpack(content: bytes, folder: Path) -> Scene:
    """Compile what `pack` has packed.

    ``folder``: an empty one for the functions, which must stay as long as the scene is used.
    """
    description, document, name, files, (effects, trusted, functions) = pickle.loads(content)
    home = folder / EFFECTS / (effects or "root")
    _write(functions, home)
    with TemporaryDirectory(dir=folder) as temporary:
        _write(files, Path(temporary))
        loaded = Loaded(description, document, Path(temporary, name))
        bound = Effects(home, trusted)
        return Scene(loaded, compile_scene(loaded, bound), bound)


def _write(files: Mapping[str, bytes], folder: Path) -> None:
    folder.mkdir(parents=True, exist_ok=True)
    for name, content in files.items():
        (folder / name).write_bytes(content)


class _Files:
    """Files that a scene names, each under a plain new name, wherever it lay."""

    def __init__(self, folder: Path) -> None:
        self._folder = folder
        self._names: dict[str, str] = {}
        self.contents: dict[str, bytes] = {}

    def add(self, name: str) -> str:
        """The name of a file in the parcel."""
        if name not in self._names:
            # The suffix says what is in it.
            new = f"file-{len(self._names)}{Path(name).suffix}"
            self.contents[new] = (self._folder / name).read_bytes()
            self._names[name] = new
        return self._names[name]


def _renamed(description: SceneDescription, files: _Files) -> SceneDescription:
    """The description with the parcel's names of its files."""
    change = msgspec.structs.replace
    objects = tuple(
        change(thing, file=files.add(thing.file)) if isinstance(thing, MeshFile) else thing
        for thing in description.objects
    )
    materials = dict(description.materials)
    for name in dict.fromkeys(thing.material for thing in objects):
        texture = materials[name].texture
        if texture is not None:
            texture = change(texture, image=files.add(texture.image))
            materials[name] = change(materials[name], texture=texture)
    environment = description.environment
    if isinstance(environment, LatLongEnvironment):
        environment = change(environment, image=files.add(environment.image))
    elif isinstance(environment, CubeEnvironment):
        if environment.cross is not None:
            environment = change(environment, cross=files.add(environment.cross))
        if environment.faces is not None:
            faces = tuple(files.add(face) for face in environment.faces)
            environment = change(environment, faces=faces)
    return change(description, objects=objects, materials=materials, environment=environment)
