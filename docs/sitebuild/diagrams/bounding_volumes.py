"""Figures of bounding volumes: boxes in boxes and a ray, the hierarchy level by level, slabs."""

import numpy as np

from sitebuild.diagrams.canvas import Canvas, unit
from sitebuild.diagrams.figure import Figure, Panel
from solutions import bounding_volumes

COUNT = 8
ORIGIN, TARGET = np.array([0.85, -0.12]), np.array([2.4, 0.4])

Hierarchy = tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray, np.ndarray]


def triangles() -> np.ndarray:
    """A handful of triangles (2, 3, T) of the plane."""
    rng = np.random.default_rng(21)
    middle = np.array(
        [
            [-0.5, -0.15, 0.35, 0.6, 1.0, 1.35, 1.75, 1.8],
            [0.95, 0.25, 0.85, 0.1, 0.62, 1.0, 0.15, 0.75],
        ]
    )
    turn = 2 * np.pi * (np.arange(3)[:, None] / 3 + rng.random(COUNT))
    return middle[:, None] + 0.17 * np.stack((np.cos(turn), np.sin(turn)))


def hierarchy() -> Hierarchy:
    """What `build` makes of their boxes; flat, for the drawing, so that z plays no part."""
    corners = triangles()
    lo, hi = (
        np.vstack((bound, np.zeros(COUNT))) for bound in (corners.min(axis=1), corners.max(axis=1))
    )
    return bounding_volumes.build(lo, hi, 2)


def met(tree: Hierarchy) -> np.ndarray:
    """Which nodes' boxes the ray meets."""
    lo, hi = tree[0], tree[1]
    count = lo.shape[1]
    origin = np.repeat(np.append(ORIGIN, 0)[:, None], count, axis=1)
    way = np.repeat(np.append(unit(TARGET - ORIGIN), 0)[:, None], count, axis=1)
    near, far = bounding_volumes.slab_test(origin, way, lo, hi)
    return (near <= far) & (far > 0)


def parents(tree: Hierarchy) -> np.ndarray:
    """Each node's parent; the root's is -1."""
    first, count = tree[2], tree[3]
    above = np.full(len(count), -1)
    for k in np.flatnonzero(count == 0):
        above[[first[k], first[k] + 1]] = k
    return above


def tested(tree: Hierarchy) -> np.ndarray:
    """Which nodes are asked: the root, and both children of a node that is met."""
    above, hit = parents(tree), met(tree)
    asked = np.zeros(len(above), bool)
    for k in range(len(above)):
        asked[k] = above[k] < 0 or (asked[above[k]] and hit[above[k]])
    return asked


def boxes() -> Figure:
    """Boxes around triangles, and the tree; a ray, and what it is tested with."""
    tree = hierarchy()
    asked, hit, above = tested(tree), met(tree), parents(tree)
    entered = asked & hit
    first, count, order = tree[2:]
    visited = {
        int(t)
        for k in np.flatnonzero(entered & (count > 0))
        for t in order[first[k] : first[k] + count[k]]
    }
    plane = plane_of(visited)
    for k in range(len(count)):
        kind = "accent" if entered[k] else "faint dashed" if not asked[k] else "ink thin dashed"
        box(plane, tree, k, kind)
        # Leaves are named at their lower left corner, where no triangle is, the others elsewhere.
        x, y, side = {
            0: (tree[0][0, 0], tree[1][1, 0], "nw"),
            1: (tree[1][0, 1], tree[1][1, 1], "sw"),
            2: (tree[1][0, 2], tree[1][1, 2], "sw"),
        }.get(k, (tree[0][0, k], tree[0][1, k], "ne"))
        plane.label((x, y), str(k), side, 8 if k == 0 else 5, "accent" if entered[k] else "")
    _ray(plane)

    chart = Canvas(350, 200, (0, 4, 2.75, -0.5), 4)
    places = tree_places(tree)
    for k in range(1, len(count)):
        chart.line(places[above[k]], places[k], "accent" if entered[k] else "faint")
    for k, place in enumerate(places):
        kind = "paper accent" if entered[k] else "paper ink" if asked[k] else "paper faint dashed"
        chart.circle(place, 0.21, kind)
        chart.label(place, str(k), "c")
        if count[k]:
            names = ", ".join("ABCDEFGH"[t] for t in order[first[k] : first[k] + count[k]])
            chart.label((place[0], place[1] + 0.21), names, "s", 5, "" if entered[k] else "faint")
    return Figure(
        "Eight triangles in a hierarchy that the course's build made, and a ray. It enters the coloured nodes and "
        "misses those in plain lines; what is below these is never looked at: it is tested with "
        f"{int(asked.sum())} of {len(count)} boxes and {len(visited)} of {COUNT} triangles. Outer boxes are drawn a "
        "little larger, so that none hides another.",
        (
            Panel(
                plane,
                "Boxes in boxes and a ray",
                "Eight triangles of the plane in nested boxes. A ray crosses some of the boxes; those it misses are "
                "dashed.",
                "The boxes.",
            ),
            Panel(
                chart,
                "The same hierarchy as a tree",
                "A tree with the root above and leaves of two triangles below. The branches that the "
                "ray does not enter "
                "are faint.",
                "The same hierarchy as a tree.",
            ),
        ),
    )


def steps() -> Figure:
    """Boxes of triangles, halved twice, then the ray."""
    tree = hierarchy()
    level = _levels(tree)
    corners = triangles()
    own = plane_of(set(), 172, 120)
    for k in range(COUNT):
        own.rectangle(corners[:, :, k].min(axis=1), corners[:, :, k].max(axis=1), "accent thin")
    drawn = [own]
    for deepest in (1, 2):
        canvas = plane_of(set(), 172, 120)
        for k in np.flatnonzero(level <= deepest):
            box(canvas, tree, k, "accent" if level[k] == deepest else "faint dashed")
        drawn.append(canvas)
    asked, hit = tested(tree), met(tree)
    visited = asked & hit
    first, count, order = tree[2:]
    reached = {
        int(t)
        for k in np.flatnonzero(visited & (count > 0))
        for t in order[first[k] : first[k] + count[k]]
    }
    walk = plane_of(reached, 172, 120)
    for k in np.flatnonzero(visited):
        box(walk, tree, k, "accent thin")
    _ray(walk)
    drawn.append(walk)
    words = (
        "1. A box around each triangle.",
        "2. Halve them along the longest axis ...",
        "... and both halves again: leaves of two.",
        "3. to 5. A ray goes down into boxes that it meets.",
    )
    tells = (
        "Eight triangles, each in a box of its own.",
        "Two large boxes with four triangles each.",
        "Four boxes with two triangles each.",
        "A ray, the boxes that it meets, and the triangles in the leaves among them.",
    )
    return Figure(
        "Build, then traverse. The boxes are those of the course's own function, with at most two triangles a leaf.",
        tuple(
            Panel(canvas, f"Picture {k} of {len(drawn)}", tell, word)
            for k, (canvas, word, tell) in enumerate(zip(drawn, words, tells, strict=True), 1)
        ),
    )


def slabs() -> Figure:
    """Where a ray is between two pairs of faces, and in the box."""
    lo, hi = np.array([1.5, 1.2]), np.array([3.3, 2.1])
    origin, way = np.array([0.15, 0.3]), np.array([1.0, 0.52])
    t = np.sort(np.stack(((lo - origin) / way, (hi - origin) / way)), axis=0)
    flat = [np.append(v, 0.0)[:, None] for v in (origin, way)]
    near, far = (
        float(v[0]) for v in bounding_volumes.slab_test(*flat, np.append(lo, -1), np.append(hi, 1))
    )
    canvas = Canvas(350, 265, (-0.1, 4.6, -1.35, 2.55), 4)
    canvas.rectangle((lo[0], 0), (hi[0], 2.5), "shade")
    canvas.rectangle((0, lo[1]), (4.5, hi[1]), "shade")
    for x in (lo[0], hi[0]):
        canvas.line((x, 0), (x, 2.5), "faint dashed")
    for y in (lo[1], hi[1]):
        canvas.line((0, y), (4.5, y), "faint dashed")
    canvas.rectangle(lo, hi, "ink")
    canvas.arrow(origin, origin + 4.2 * way)
    canvas.line(origin + near * way, origin + far * way, "accent thick")
    canvas.dot(origin)
    canvas.label(origin, "$o$", "w", 6)
    for time, name, side in ((near, "$t_near$", "nw"), (far, "$t_far$", "se")):
        canvas.dot(origin + time * way, "accent", 3.5)
        canvas.label(
            origin + time * way,
            name.replace("_near", "_{near}").replace("_far", "_{far}"),
            side,
            6,
            "accent",
        )
    # The same three spans over t; a step of t is as wide as one of x.
    for row, (name, span, kind) in enumerate(
        (
            ("x slab", t[:, 0], "ink thick"),
            ("y slab", t[:, 1], "ink thick"),
            ("box", (near, far), "accent thick"),
        )
    ):
        y = -0.35 - 0.32 * row
        canvas.line((origin[0], y), (4.5, y), "faint")
        canvas.line((origin[0] + span[0], y), (origin[0] + span[1], y), kind)
        canvas.label((4.5, y + 0.04), name, "nw", 2)
    for time in (near, far):
        canvas.line((origin[0] + time, -1.1), origin + time * way, "faint dashed")
    canvas.label((origin[0] + 0.02, -1.1), "$t$", "s", 2)
    return Figure(
        "A box is where slabs cross. Below, over $t$: when the ray is in the slab between the two faces in x, when in "
        "that of y, and when in both. $t_{near}$ and $t_{far}$ are the ends of the last.",
        (
            Panel(
                canvas,
                "Two slabs and a ray",
                "A ray crosses an upright and a level strip. Where both strips overlap is the box. "
                "Below, the spans of t "
                "in each strip and, where they overlap, in the box.",
            ),
        ),
    )


def plane_of(filled: set[int], width: float = 350, height: float = 200) -> Canvas:
    """The triangles, some of them filled."""
    canvas = Canvas(width, height, (-1.05, 2.45, -0.2, 1.35), 3)
    corners = triangles()
    for k in range(COUNT):
        canvas.path(
            corners[:, :, k], "wash accent" if k in filled else "shade ink thin", closed=True
        )
        if width > 200:
            canvas.label(corners[:, :, k].mean(axis=1), "ABCDEFGH"[k], "c")
    return canvas


def box(canvas: Canvas, tree: Hierarchy, k: int, kind: str) -> None:
    """The box of a node."""
    # Boxes of one edge would hide each other: the nearer to the root, the larger they are drawn.
    away = 0.035 * (2 - _levels(tree)[k]) + 0.02
    canvas.rectangle(tree[0][:2, k] - away, tree[1][:2, k] + away, kind)


def _ray(canvas: Canvas) -> None:
    canvas.arrow(ORIGIN, TARGET)
    canvas.dot(ORIGIN)


def _levels(tree: Hierarchy) -> np.ndarray:
    above = parents(tree)
    level = np.zeros(len(above), int)
    for k in range(1, len(above)):
        level[k] = level[above[k]] + 1
    return level


def tree_places(tree: Hierarchy) -> list[tuple[float, float]]:
    """Where nodes stand in the drawing of the tree."""
    first, count = tree[2], tree[3]
    places: dict[int, tuple[float, float]] = {}

    def put(k: int, left: float, right: float, depth: int) -> None:
        places[k] = ((left + right) / 2, float(depth))
        if not count[k]:
            middle = (left + right) / 2
            put(int(first[k]), left, middle, depth + 1)
            put(int(first[k]) + 1, middle, right, depth + 1)

    put(0, 0, 4, 0)
    return [places[k] for k in range(len(count))]


FIGURES = {"boxes": boxes, "steps": steps, "slabs": slabs}
