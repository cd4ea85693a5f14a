"""Figures of many lights: boxes of a light tree and a walk down it, and the steps from lamps to a shadow ray."""

import numpy as np

from sitebuild.diagrams.canvas import Canvas
from sitebuild.diagrams.figure import Figure, Panel
from solutions import many_lights

PLACES = np.array(
    [
        [0.25, 0.75, 1.05, 2.05, 2.6, 2.9, 3.3, 3.75],
        [0.75, 1.05, 0.35, 0.55, 1.1, 0.3, 0.85, 0.45],
    ]
)
POINT = np.array([2.7, -0.35])
COUNT = PLACES.shape[1]


def tree() -> tuple[np.ndarray, ...]:
    """The light tree of eight bulbs in the plane."""
    place = np.vstack((PLACES, np.zeros(COUNT)))
    axis = np.repeat([[0.0], [-1.0], [0.0]], COUNT, axis=1)
    return many_lights.light_tree(place, place, axis, np.full(COUNT, np.pi), np.ones(COUNT))


def shares() -> np.ndarray:
    """Probability that a walk from the point comes to each node."""
    nodes = tree()
    column = np.ones((1, 2 * COUNT - 1))
    p, n = np.array([[*POINT, 0]]).T * column, np.array([[0, 1.0, 0]]).T * column
    sent = many_lights.importance(*nodes[:5], p, n)
    found = np.ones(2 * COUNT - 1)
    for k in range(COUNT - 1):
        both = sent[2 * k + 1] + sent[2 * k + 2]
        found[2 * k + 1], found[2 * k + 2] = found[k] * sent[2 * k + 1 : 2 * k + 3] / both
    return found


def way() -> list[int]:
    """Nodes of the most probable walk."""
    found, k = shares(), 0
    nodes = [k]
    while k < COUNT - 1:
        k = 2 * k + 1 + int(found[2 * k + 2] > found[2 * k + 1])
        nodes.append(k)
    return nodes


def _bulbs(canvas: Canvas, chosen: int | None = None) -> None:
    for k in range(COUNT):
        canvas.dot(PLACES[:, k], "accent" if k == chosen else "ink", 3.5)


def _box(canvas: Canvas, k: int, kind: str) -> None:
    lo, hi = (part[:2, k] for part in tree()[:2])
    # Outer boxes are drawn a little larger, so that none hides another.
    more = 0.05 * (4 - int(np.log2(k + 1)))
    canvas.rectangle(lo - more, hi + more, kind)


def figure_of_tree() -> Figure:
    """Boxes of the inner nodes, and the tree with the probabilities."""
    walk, found = way(), shares()
    order = tree()[5]
    plane = Canvas(350, 170, (-0.1, 4.1, -0.6, 1.4), 4)
    plane.surface((4.05, -0.35), (-0.05, -0.35))
    for k in range(COUNT - 1):
        _box(plane, k, "accent" if k in walk else "ink thin dashed")
    _bulbs(plane, int(order[walk[-1] - COUNT + 1]))
    plane.dot(POINT)
    plane.label(POINT, "$p$", "n", 6)
    chart = Canvas(350, 190, (-0.4, 7.4, 3.5, -0.5), 4, stretch=True)
    level = np.log2(np.arange(1, 2 * COUNT)).astype(int)
    places = [
        ((k + 1 - 2**depth + 0.5) * 8 / 2**depth - 0.5, float(depth))
        for k, depth in enumerate(level)
    ]
    for k in range(1, 2 * COUNT - 1):
        chart.line(places[(k - 1) // 2], places[k], "accent" if k in walk else "faint")
    for k, place in enumerate(places):
        chart.dot(place, "accent" if k in walk else "ink", 3.5)
        told = f"{100 * found[k]:.0f}%"
        side = "s" if depth_of(k) == 3 else "e" if k % 2 == 0 else "w"
        chart.label(place, told, side, 6, "accent" if k in walk else "")
    return Figure(
        "A light tree over eight bulbs, and the walk that is most probable from a point of the floor: at each node the "
        "child that can send more is taken more often. The percentages say how often a walk comes to a node. Outer "
        "boxes are drawn a little larger, so that none hides another.",
        (
            Panel(
                plane,
                "Boxes of a light tree",
                "Eight bulbs above a floor in nested boxes. The boxes of one walk are coloured; they end at a bulb "
                "near the point.",
                "The boxes.",
            ),
            Panel(
                chart,
                "The same tree",
                "A tree of four levels with the probability of each node. The coloured way leads to one leaf.",
                "The same nodes as a tree.",
            ),
        ),
    )


def depth_of(k: int) -> int:
    """Level of a node."""
    return int(np.log2(k + 1))


def steps() -> Figure:
    """From lamps to the shadow ray."""
    walk = way()
    chosen = int(tree()[5][walk[-1] - COUNT + 1])
    panels = []
    for number, (title, word, told) in enumerate(
        (
            (
                "Step 1: bounds",
                "1. Gather lamps in nodes, and bound them.",
                "Eight bulbs in nested boxes.",
            ),
            (
                "Step 2: a walk",
                "2. Walk down, from box to box.",
                "Of nested boxes one is entered on each level.",
            ),
            (
                "Step 3: a shadow ray",
                "3. Look whether anything is in the way.",
                "A ray from the point of the floor to the bulb that was chosen.",
            ),
        )
    ):
        canvas = Canvas(172, 100, (-0.1, 4.1, -0.6, 1.4), 4)
        canvas.surface((4.05, -0.35), (-0.05, -0.35))
        for k in range(COUNT - 1):
            if number == 0 or (number == 1 and k in walk):
                _box(canvas, k, "ink thin" if number == 0 else "accent")
        _bulbs(canvas, chosen if number == 2 else None)
        if number > 0:
            canvas.dot(POINT)
        if number == 2:
            canvas.arrow(
                POINT, PLACES[:, chosen] - 0.06 * np.sign(PLACES[:, chosen] - POINT), "accent"
            )
        panels.append(Panel(canvas, title, told, word))
    return Figure(
        "The first step is done once for a scene, the others for each hit.", tuple(panels)
    )


FIGURES = {"tree": figure_of_tree, "steps": steps}
