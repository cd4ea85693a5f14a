"""Tables of triangles are made piece by piece: the pieces don't show, and little memory is needed beside the tables."""

from __future__ import annotations

import tracemalloc
from dataclasses import fields

import numpy as np
import pytest

from course.engine import shapes
from course.engine.shapes.mesh import Mesh
from course.engine.terms.surfaces import tables
from course.engine.terms.surfaces.surface import FullPart, build_surface
from course.engine.terms.surfaces.tables import Part, join_tables, make_tables


def parts() -> list[Part]:
    """Smooth and flat, with triangles without area, vertices that nobody uses, and normals that have other lengths."""
    ball, box, field = shapes.sphere(0.3, 12), shapes.box([0.2, 0.3, 0.4]), shapes.height_field()
    corners = ball.triangles.copy()
    corners[5:40:3, 1] = corners[5:40:3, 0]
    assert ball.normals is not None
    stretched = ball.normals * np.linspace(0.3, 3, len(ball.normals))[:, None]
    unused = np.concatenate((ball.vertices, [[9, 9, 9]])), np.concatenate((stretched, [[0, 0, 1]]))
    return [
        Part(Mesh(unused[0], corners, unused[1]), 3),
        Part(Mesh(box.vertices, box.triangles), 1, (0.0, 0.1, 0.0)),
        Part(Mesh(ball.vertices, corners[5:6]), 4),
        Part(Mesh(field.vertices, field.triangles, field.normals), 2),
    ]


@pytest.mark.parametrize("chunk", [1, 7, 100, 8192])
def test_pieces_do_not_show(monkeypatch: pytest.MonkeyPatch, chunk: int) -> None:
    # A piece takes 300 microseconds, so the large part is not cut in small ones.
    some = parts() if chunk > 7 else parts()[:3]
    monkeypatch.setattr(tables, "CHUNK", 10**9)
    whole = join_tables(*make_tables(some))
    monkeypatch.setattr(tables, "CHUNK", chunk)
    pieces = join_tables(*make_tables(some))
    for each in fields(whole):
        mine, theirs = getattr(pieces, each.name), getattr(whole, each.name)
        if each.name == "parts":
            assert mine == theirs
        else:
            # To the last bit but one: NumPy sums three squares in an order that depends on the arrays' lengths.
            assert np.allclose(mine, theirs, rtol=3e-7, atol=1e-9)


def test_triangles_without_area_are_left_out() -> None:
    found, rows = make_tables(parts())
    # The static parts in their order, then the one that moves.
    sizes = [len(t.triangles) for t in found]
    assert sizes[0] == len(parts()[0].mesh.triangles) - 12
    assert sizes[1] == 0
    assert sizes[3] == 12
    assert len(rows.planes) == sum(sizes)
    assert np.allclose(np.linalg.norm(rows.planes[:, 3:6], axis=1), 1, atol=1e-6)


def test_no_parts_make_no_triangles() -> None:
    triangles = join_tables(*make_tables([]))
    assert (triangles.planes.shape, triangles.parts) == ((0, 8), ((0, 0, False),))
    assert triangles.corner_normals is None


def test_little_memory_is_needed_beside_the_tables() -> None:
    field = shapes.height_field(segments=400)
    count = len(field.triangles)
    build_surface([FullPart(shapes.box(), 0)])
    tracemalloc.start()
    try:
        surface = build_surface([FullPart(field, 0)])
        kept, peak = tracemalloc.get_traced_memory()
    finally:
        tracemalloc.stop()
    assert len(surface.triangles.planes) == count
    # 126 bytes of tables and 6 of float32 vertices; corners are the mesh's own. Made in one go, they took 600 more.
    assert kept / count < 145
    assert (peak - kept) / count < 60
