"""Headers of PLY files that are longer than any mesh needs are refused before they cost time."""

from __future__ import annotations

import time
from pathlib import Path

import pytest

from course.errors import GeometryError
from course.formats.meshes.files import read_mesh


def saved(folder: Path, content: str) -> Path:
    path = folder / "a.ply"
    path.write_text(content, encoding="ascii")
    return path


def test_a_header_of_very_many_properties_or_elements_is_refused_soon(tmp_path: Path) -> None:
    body = "property float x\nproperty float y\nproperty float z\n"
    for many in (
        "element vertex 1\n" + "".join(f"property float p{k}\n" for k in range(100_000)),
        "".join(f"element e{k} 0\n" for k in range(100_000)),
    ):
        path = saved(tmp_path, f"ply\nformat ascii 1.0\n{many}{body}end_header\n0 0 0\n")
        before = time.perf_counter()
        with pytest.raises(GeometryError, match="more than 1000 elements and prop") as caught:
            read_mesh(path)
        assert time.perf_counter() - before < 2
        assert len(str(caught.value)) < len(str(path)) + 300


def test_a_header_may_have_many_properties(tmp_path: Path) -> None:
    # Elements and properties are counted together, and these are one less than the most.
    many = "".join(f"property float p{k}\n" for k in range(990))
    header = (
        f"ply\nformat ascii 1.0\nelement vertex 3\n{many}property float x\nproperty float y\nproperty float z\n"
        "element face 1\nproperty list uchar int vertex_indices\nend_header\n"
    )
    rows = "".join("0 " * 990 + f"{x} {y} 0\n" for x, y in ((0, 0), (1, 0), (0, 1)))
    assert len(read_mesh(saved(tmp_path, f"{header}{rows}3 0 1 2\n")).triangles) == 1


def test_a_header_without_an_end_is_looked_for_in_the_first_megabytes(tmp_path: Path) -> None:
    path = saved(tmp_path, "ply\n" + "comment more\n" * 1_300_000 + "end_header\n")
    with pytest.raises(GeometryError, match="no line end_header in the first 16 MB"):
        read_mesh(path)
