"""What a hierarchy of boxes saves, counted; what it takes beside Embree; and what a second thread brings.

Counts are those of the student module's own walk, for rays from all around a knot. The lesson on threads is two lines
here, as it is with OpenMP: an executor, and a ``map`` over parts of the batch.
"""

from collections.abc import Callable, Iterable, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from time import perf_counter
from typing import Any

import numpy as np

from benchmarks.figures import Figure, summary
from benchmarks.report import report
from course.benchmarking.plot_data import Plot, Series
from course.benchmarking.tables import Columns, Table, table_of
from course.engine.casters.choice import static_accelerator
from course.engine.core.accelerator import QueryStats, StaticAccelerator
from course.engine.core.types import Floats32
from course.engine.functions.effects import PROJECT, Effects
from course.engine.shapes import torus_knot

MESHES = ((64, 16), (128, 32), (256, 64), (512, 64), (1024, 128))
"""Segments and sides of the knots: 2,048 triangles to 262,144."""

USUAL = (512, 64)
LEAF_SIZES = (1, 2, 4, 8, 16, 32)
LEAF_SIZE = 4
RAYS = 100_000
REPETITIONS = 5
MOST = 100
"""Tests a ray, boxes and triangles together; brute force takes as many as there are triangles."""

EMBREE_ROUNDS = 10
"""How often Embree is asked the same, since one batch takes it milliseconds."""

BOXES = Effects(PROJECT / "solutions")
build = BOXES.function("bounding_volumes", "build")
traverse = BOXES.function("bounding_volumes", "traverse")

Corners = tuple[Floats32, Floats32, Floats32]


@dataclass(frozen=True)
class Walk:
    """Mean tests a ray in one hierarchy."""

    triangles: int
    leaf_size: int
    nodes: int
    boxes: float
    tested: float


def measure_bounding_volumes() -> list[Figure]:
    """Report the counts; tests a ray, time against Embree, one thread against two."""
    o, d = _rays()
    walks = [
        walk(size, leaf_size, o, d)
        for size in MESHES
        for leaf_size in (LEAF_SIZES if size == USUAL else (LEAF_SIZE,))
    ]
    usual = [each for each in walks if each.leaf_size == LEAF_SIZE]
    about = f"{RAYS:,} rays, leaf size {LEAF_SIZE}"
    report("bounding_volumes", about, [table(walks)], [plot(usual)])
    counts = [
        summary(
            f"hierarchy: tests a ray, {each.triangles:,} triangles",
            [each.boxes + each.tested],
            MOST,
        )
        for each in usual
    ]
    return [*counts, *_times(o, d)]


def walk(size: tuple[int, int], leaf_size: int, o: Floats32, d: Floats32) -> Walk:
    """Count the tests of rays in the hierarchy of a knot of so many segments and sides."""
    _, corners = _knot(size)
    hierarchy = build(*_boxes(corners), leaf_size)
    _, _, boxes, tests = traverse(hierarchy, *corners, o, d)
    triangles, nodes = corners[0].shape[1], hierarchy[2].size
    return Walk(triangles, leaf_size, nodes, float(boxes.mean()), float(tests.mean()))


def table(walks: Iterable[Walk]) -> Table:
    """A row for each hierarchy; brute force tests every triangle."""
    columns: Columns[Walk] = (
        ("triangles", lambda each: f"{each.triangles:,}"),
        ("leaf size", lambda each: f"{each.leaf_size}"),
        ("nodes", lambda each: f"{each.nodes:,}"),
        ("boxes", lambda each: f"{each.boxes:.1f}"),
        ("triangles tested", lambda each: f"{each.tested:.1f}"),
        ("brute force", lambda each: f"{each.triangles:,}"),
    )
    title = f"Tests a ray, {RAYS:,} rays towards a knot that about two thirds of them hit"
    return table_of(title, walks, columns)


def plot(walks: Sequence[Walk]) -> Plot:
    """Tests of boxes and of triangles over the number of triangles, as the documentation's data files keep them."""
    triangles = tuple(each.triangles for each in walks)
    lines = {
        "brute force": triangles,
        "boxes": tuple(each.boxes for each in walks),
        "triangles": tuple(each.tested for each in walks),
    }
    series = tuple(
        Series(name, style, {"samples": triangles}, values)
        for style, (name, values) in zip((3, 1, 0), lines.items(), strict=True)
    )
    axes = {"samples": "triangles in the mesh"}
    return Plot("tests", "what a ray is tested against", axes, "tests a ray", series, slope=False)


def _times(o: Floats32, d: Floats32) -> list[Figure]:
    """Whole walks against Embree's, and each in one thread against two."""
    embree, corners = _knot(USUAL)
    hierarchy = build(*_boxes(corners), LEAF_SIZE)

    def ask_hierarchy(part: slice) -> Any:
        return traverse(hierarchy, *corners, o[:, part], d[:, part])

    def ask_embree(part: slice) -> None:
        origins, directions = (np.ascontiguousarray(v[:, part]) for v in (o, d))
        for _ in range(EMBREE_ROUNDS):
            embree.intersect(origins, directions, QueryStats())

    ratios, speedups, embree_speedups = [], [], []
    for _ in range(REPETITIONS):
        one, two = _seconds(ask_hierarchy, 1), _seconds(ask_hierarchy, 2)
        embree_one, embree_two = _seconds(ask_embree, 1), _seconds(ask_embree, 2)
        ratios.append(one / (embree_one / EMBREE_ROUNDS))
        speedups.append(one / two)
        embree_speedups.append(embree_one / embree_two)
    return [
        summary("hierarchy: walk in NumPy / Embree", ratios, 200),
        summary("hierarchy in NumPy: one thread / two", speedups, 1.1, at_least=True),
        summary("the same in Embree: one thread / two", embree_speedups, 1.7, at_least=True),
    ]


def _seconds(work: Callable[[slice], Any], threads: int) -> float:
    """Of the whole batch, in as many equal parts as there are threads."""
    size = -(-RAYS // threads)
    parts = [slice(start, start + size) for start in range(0, RAYS, size)]
    started = perf_counter()
    with ThreadPoolExecutor(threads) as executor:
        list(executor.map(work, parts))
    return perf_counter() - started


def _rays() -> tuple[Floats32, Floats32]:
    """From a sphere around the knot to points of a cube about it."""
    rng = np.random.default_rng(0)
    o = rng.standard_normal((3, RAYS))
    o *= 3 / np.linalg.norm(o, axis=0)
    d = rng.uniform(-1, 1, o.shape) - o
    return o.astype(np.float32), (d / np.linalg.norm(d, axis=0)).astype(np.float32)


def _knot(size: tuple[int, int]) -> tuple[StaticAccelerator, Corners]:
    mesh = torus_knot(segments=size[0], sides=size[1])
    vertices, faces = mesh.vertices.astype(np.float32), mesh.triangles.astype(np.int32)
    p0, p1, p2 = (np.ascontiguousarray(vertices[faces[:, k]].T) for k in range(3))
    return static_accelerator(vertices, faces), (p0, p1, p2)


def _boxes(corners: Corners) -> tuple[Floats32, Floats32]:
    return np.min(corners, axis=0), np.max(corners, axis=0)
