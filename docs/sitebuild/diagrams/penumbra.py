"""The penumbra of a blocker under a lamp: similar triangles, and how much of the lamp a place of the floor sees."""

import numpy as np

from sitebuild.diagrams.canvas import meeting
from sitebuild.diagrams.figure import Figure, Panel
from sitebuild.diagrams.movable import Handle, Model, Movable, Movement, Value, Values
from solutions import soft_shadows

RAYS = 12
"""Points of the lamp that are asked from the place."""

PLOT, TALL = -1.35, 0.8
"""The line below the plot, and the height of what sees all of the lamp."""

SIDE = 2.25
"""Where the heights are measured."""

FLOOR = np.linspace(-2.6, 2.6, 105)


def penumbra_of(diameter: float, a: float, b: float) -> tuple[float, float]:
    """Where the penumbra begins and ends on the floor, for a lamp over an edge: the rays past the edge."""
    lamp = ((-diameter / 2, a + b), (diameter / 2, a + b))
    floor = ((0.0, 0.0), (1.0, 0.0))
    first, second = (float(meeting(end, (0, b), *floor)[0]) for end in lamp)
    return min(first, second), max(first, second)


def model(values: Values) -> Model:
    """The lamp is a line of this diameter, the blocker one from its left end to the edge."""
    lamp = np.array([values["lamp_x"], values["lamp_y"]])
    edge = np.array([values["edge_x"], values["edge_y"]])
    diameter, place = values["diameter"], np.array([values["place"], 0.0])
    other = edge - (values["width"], 0)
    rim = np.array([diameter / 2, 0.0])
    lo, hi = lamp - rim, lamp + rim
    a, b = lamp[1] - edge[1], edge[1]
    floor = ((0.0, 0.0), (1.0, 0.0))
    begin, end = (meeting(side, edge, *floor) for side in (hi, lo))
    left_begin, left_end = (meeting(side, other, *floor) for side in (hi, lo))
    # The umbra ends at the floor, or where the inner rays cross above it.
    tip = begin[0] < left_end[0]
    dark = [meeting(hi, edge, lo, other)] * 2 if tip else [begin, left_end]

    u = np.stack(((np.arange(RAYS) + 0.5) / RAYS, np.full(RAYS, 0.5)))
    corner, along = np.append(lo, 0.0), np.array([diameter, 0.0, 0.0])
    points = soft_shadows.point_on_rectangle(corner, along, np.zeros(3), u)[:2]
    way = points - place[:, None]
    crossing = place[:, None] + way * edge[1] / lamp[1]
    hidden = (other[0] <= crossing[0]) & (crossing[0] <= edge[0])
    squares = (way**2).sum(axis=0)
    arriving = np.where(hidden, 0, way[1] / squares**1.5)
    return Model(
        points={
            "lamp": lamp,
            "lo": lo,
            "hi": hi,
            "edge": edge,
            "other": other,
            "begin": begin,
            "end": end,
            "left_begin": left_begin,
            "left_end": left_end,
            "dark_right": dark[0],
            "dark_left": dark[1],
            "high": np.array([SIDE, lamp[1]]),
            "middle": np.array([SIDE, edge[1]]),
            "low": np.array([SIDE, 0.0]),
            "place": place,
            "free": np.where(hidden, place[:, None], points),
            "stopped": np.where(hidden, crossing, place[:, None]),
            "seen": np.stack((FLOOR, PLOT + TALL * share_seen(FLOOR, lo, hi, other, edge))),
            "plotted": np.array(
                [place[0], PLOT + TALL * share_seen(place[0], lo, hi, other, edge)]
            ),
        },
        numbers={
            "penumbra": diameter * b / a,
            "umbra": max(0.0, float(begin[0] - left_end[0])),
            "share": float(share_seen(place[0], lo, hi, other, edge)),
            "free": float((~hidden).sum()),
            "irradiance": float(arriving.mean()),
            "radius": diameter / 2,
        },
    )


def share_seen(
    x: np.ndarray | float, lo: np.ndarray, hi: np.ndarray, other: np.ndarray, edge: np.ndarray
) -> np.ndarray:
    """The part of the lamp, a line, that places of the floor see past the blocker."""
    far = lo[1] / edge[1]
    first, last = (x + (end - x) * far for end in (other[0], edge[0]))
    covered = np.minimum(last, hi[0]) - np.maximum(first, lo[0])
    return 1 - np.maximum(covered, 0) / (hi[0] - lo[0])


MOVEMENT = Movement(
    "soft_shadows/penumbra",
    model,
    {
        "lamp_x": Value(-1.2, 1.2, 0, 0.05),
        "lamp_y": Value(2.0, 3.3, 3.0, 0.05),
        "diameter": Value(0.05, 2.0, 1.1, 0.05),
        "edge_x": Value(-0.6, 1.2, 0.3, 0.05),
        "edge_y": Value(0.4, 1.7, 1.25, 0.05),
        "width": Value(0.1, 2.0, 0.8, 0.05),
        "place": Value(-2.5, 2.1, 0.75, 0.05),
    },
    (
        Handle(
            "Lamp", "lamp", ("lamp_x", "lamp_y"), "{lamp_x:.2f} to the right, {lamp_y:.2f} high"
        ),
        Handle("Rim of the lamp", "hi", ("diameter",), "diameter {diameter:.2f}"),
        Handle(
            "Edge of the blocker",
            "edge",
            ("edge_x", "edge_y"),
            "{edge_x:.2f} to the right, {edge_y:.2f} high; the penumbra is {penumbra:.2f} wide",
        ),
        Handle("Other end of the blocker", "other", ("width",), "blocker {width:.2f} wide"),
        Handle(
            "Place on the floor",
            "place",
            ("place",),
            "{place:.2f} to the right; sees {share:.2f} of the lamp",
        ),
    ),
    "The penumbra is {penumbra:.3f} wide on each side, and the umbra {umbra:.3f}. From the place $p$, {free:.0f} of "
    f"{RAYS} points of the lamp are seen, and {{share:.3f}} of the lamp. With an intensity of 1, "
    "$E(p)$ is {irradiance:.4f}.",
)


def penumbra() -> Figure:
    """Similar triangles with their tip at the edge."""
    rest = model(MOVEMENT.start)
    canvas = Movable(rest, 350, 324, (-2.75, 2.75, -1.42, 4.0), 2)
    canvas.path("other edge dark_right dark_left", "shade", closed=True)
    canvas.path("begin end edge", "wash", closed=True)
    canvas.path("lo hi edge", "wash", closed=True)
    canvas.lines("place", "stopped", "faint thin")
    canvas.lines("place", "free", "faint")
    canvas.line("lo", "left_end", "faint")
    canvas.line("hi", "left_begin", "faint")
    canvas.line("lo", "end", "accent")
    canvas.line("hi", "begin", "accent")
    canvas.circle("lamp", "radius")
    canvas.line("lo", "hi")
    canvas.line("other", "edge", "ink thick")
    canvas.surface((-2.7, 0), (2.7, 0))
    canvas.length("lo", "hi", "$D$", 42, 4)
    canvas.length("high", "middle", "$a$", 0)
    canvas.length("middle", "low", "$b$", 0)
    canvas.line("hi", "high", "faint dashed")
    canvas.line("edge", "middle", "faint dashed")
    canvas.label("other", "blocker", "w", 8)
    canvas.label("lamp", "lamp", "w", 42)
    canvas.line((-2.7, PLOT), (2.7, PLOT), "faint")
    canvas.path("seen", "accent")
    canvas.line("place", "plotted", "faint dashed")
    canvas.dot("plotted", "accent", 3)
    canvas.dot("place", "ink", 3)
    canvas.label("place", "$p$", "s", 9)
    canvas.label((-2.68, PLOT + 0.42), "seen", "e", 0, "accent")
    return Figure(
        "Two triangles with their tip at the edge: as wide as the lamp above it, as wide as the penumbra below. "
        "Widths are as distances: $D$ to $a$ as the penumbra to $b$. The curve tells how much of the lamp each "
        "place of the floor sees.",
        (
            Panel(
                canvas,
                "Similar triangles of a penumbra",
                "A lamp of diameter D stands at distance a above a blocker; the floor lies b below it. The rays from "
                "the lamp's two ends past the blocker's edge cross there and meet the floor at the two ends of the "
                "penumbra. Rays go from a place p on the floor to points of the lamp.",
            ),
        ),
        MOVEMENT,
    )
