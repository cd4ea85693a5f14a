"""Where the scenes of ``python -m benchmarks.peers`` are, and the meshes of one that has no named shape."""

from pathlib import Path

import numpy as np
import trimesh

from course.base.atomic import replacing
from course.engine.functions.effects import PROJECT

FOLDER = Path(__file__).parent / "scenes" / "peers"
SQUARES = 200
"""Along a side of the checkerboard: two triangles each."""

SIDE = 20.0


def scene_path(name: str) -> Path:
    """The file of a scene; meshes that it needs are written beside it the first time."""
    path = FOLDER / f"{name}.yaml"
    if not path.is_file():
        return PROJECT / "scenes" / f"{name}.yaml"
    if name == "checkerboard":
        for color, parity in (("light", 0), ("dark", 1)):
            _write_squares(FOLDER / f"checkerboard_{color}.ply", parity)
    return path


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
    board = trimesh.Trimesh(vertices, triangles.reshape(3, -1).T, process=False)
    with replacing(path) as unfinished:
        board.export(unfinished, file_type="ply")
