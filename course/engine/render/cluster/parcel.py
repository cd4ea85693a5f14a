"""A scene as bytes: what it says, the files it names and its functions, for a machine that has none of them.

Workers are never asked for the scene's path: they may not share the file system, or have another file there. Sending
costs little beside what follows: measured on loopback with two busy cores, a mesh file of 35 MB is with the first
worker in 0.4 s and with the next in 0.2 s; either needs 5 s to build what rays meet from it.
"""

import pickle
import threading
from collections import OrderedDict
from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cache
from hashlib import sha256
from importlib.metadata import version
from pathlib import Path
from tempfile import TemporaryDirectory

from course.base.errors import CourseError
from course.base.version import __version__
from course.engine.casters.choice import software
from course.engine.core.tracer import Tracer
from course.engine.formats.meshes.gltf import files_beside
from course.engine.formats.yaml.loading import Loaded
from course.engine.formats.yaml.named_files import with_files
from course.engine.functions.effects import PACKAGE, Effects
from course.engine.functions.sources import saved_files
from course.engine.loops.embree_device import available as packets_available
from course.engine.render.binding import bind
from course.engine.render.memory import keep_freed_memory
from course.engine.scene.building.world import compile_scene
from course.engine.scene.scene import Scene, SceneSettings

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
    description = with_files(loaded.description, files.add)
    # Lines are for messages about mistakes, and a scene that has been compiled here has none.
    document = replace(loaded.document, lines={})
    functions = {path.name: path.read_bytes() for path in sorted(saved_files(scene.effects.folder))}
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
        path = folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(content)


class _Files:
    """Files that a scene names, each under a plain new name, wherever it lay."""

    def __init__(self, folder: Path) -> None:
        self._folder = folder
        self._names: dict[str, str] = {}
        self.contents: dict[str, bytes] = {}

    def add(self, name: str) -> str:
        """The name of a file in the parcel."""
        if name not in self._names:
            path = self._folder / name
            # The suffix says what is in it; what lies beside it is found there again.
            home = f"file-{len(self._names)}"
            new = f"{home}/file{path.suffix}"
            self.contents[new] = path.read_bytes()
            for other in files_beside(path):
                self.contents[f"{home}/{other}"] = (path.parent / other).read_bytes()
            self._names[name] = new
        return self._names[name]


MOST = 2
"""Scenes that a worker keeps: those of two people who render at the same time."""


@dataclass(frozen=True)
class WorkOrder:
    """The work that is to be done with the scene of a parcel.

    Attributes
    ----------
    settings : of the render
    packets : whether compiled loops shall be used where they are installed
    edition : of the course that gave the order; see `edition`
    """

    settings: SceneSettings
    packets: bool
    edition: str


@cache
def edition() -> str:
    """The versions that a picture's bits depend on beside the scene: those of the course, NumPy and the caster."""
    digest = sha256()
    for path in sorted(PACKAGE.rglob("*.py")):
        name = path.relative_to(PACKAGE)
        # Whoever works at the school or the command line doesn't change a picture.
        if name.parts[0] in ("base", "engine"):
            digest.update(f"{name.as_posix()}\n".encode())
            # A checkout on Windows may have other line ends.
            digest.update(path.read_bytes().replace(b"\r\n", b"\n"))
    return (
        f"course {__version__} ({digest.hexdigest()[:8]}), NumPy {version('numpy')}, "
        f"rays by {software()}"
    )


class KeptScenes:
    """Scenes by the digest of their parcels; all threads of a process share them."""

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._kept: OrderedDict[str, _Kept] = OrderedDict()

    def tracer(self, parcel: Parcel, order: WorkOrder) -> Tracer:
        """The scene of a parcel bound to these settings; compiled if this is the first time.

        Raises CourseError when this process runs another edition of the course than who gave the order.
        """
        if order.edition != edition():
            raise CourseError(
                f"a worker runs {edition()}, and here is {order.edition}: "
                "their pictures might differ; install the same on both"
            )
        # One thread compiles, the others wait for what it makes.
        with self._lock:
            kept = self._kept.get(parcel.digest)
            if kept is None:
                self._drop_all_but(MOST - 1)
                kept = self._kept[parcel.digest] = _Kept(parcel)
            self._kept.move_to_end(parcel.digest)
            return kept.tracer(order)

    def close(self) -> None:
        """Forget all scenes and delete what was written for them."""
        with self._lock:
            self._drop_all_but(0)

    def _drop_all_but(self, count: int) -> None:
        """Drop those that were used longest ago."""
        while len(self._kept) > count:
            self._kept.popitem(last=False)[1].folder.cleanup()


class _Kept:
    """One scene, and the tracer that was asked for last."""

    def __init__(self, parcel: Parcel) -> None:
        keep_freed_memory()
        # Modules of functions are imported when a render needs them, so the folder stays.
        self.folder = TemporaryDirectory(prefix="course-", ignore_cleanup_errors=True)
        self._scene: Scene = unpack(parcel.content, Path(self.folder.name))
        self._last: tuple[WorkOrder, Tracer] | None = None

    def tracer(self, order: WorkOrder) -> Tracer:
        if self._last is None or self._last[0] != order:
            compiled = order.packets and packets_available()
            self._last = order, bind(self._scene, order.settings, compiled=compiled)
        return self._last[1]
