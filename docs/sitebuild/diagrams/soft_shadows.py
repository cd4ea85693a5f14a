"""Figures of soft shadows: the penumbra, what the integral's symbols are, the steps, places on lights."""

import numpy as np

from sitebuild.diagrams.canvas import Canvas, between, meeting, moved, unit
from sitebuild.diagrams.figure import Figure, Panel
from sitebuild.diagrams.penumbra import penumbra
from sitebuild.diagrams.view import View, ring
from solutions import soft_shadows


def symbols() -> Figure:
    """What stands where in the integral."""
    canvas = Canvas(350, 250, (-3, 3, -0.5, 3.8), 4)
    p, middle, radius = np.array([-0.9, 0.0]), np.array([1.2, 2.9]), 0.55
    free = middle + radius * np.array([-0.75, -0.1])
    hidden = middle + radius * np.array([0.65, -0.35])
    block = between(p, hidden, 0.55)
    canvas.circle(middle, radius, "wash ink")
    canvas.surface((-2.9, 0), (2.9, 0))
    canvas.arrow(p, moved(p, 0, 1.25))
    canvas.label(moved(p, 0, 1.25), "normal", "n", 4)
    canvas.arrow(p, free, "accent")
    lo, hi = moved(block, 0.0, -0.3), moved(block, 0.8, 0.15)
    canvas.rectangle(lo, hi, "shade ink")
    enter = meeting(p, hidden, lo, (lo[0], hi[1]))
    canvas.line(p, enter, "ink")
    canvas.line(enter, hidden, "faint dashed")
    canvas.cross(enter, "ink", 4)
    canvas.angle(p, moved(p, 0, 1), free, "$θ$", 34)
    canvas.dot(p, "ink", 3.5)
    canvas.dot(free, "accent", 3.5)
    canvas.dot(hidden, "open", 3.5)
    canvas.label(p, "$p$", "s", 12)
    canvas.label(free, "$x_1$", "w", 8)
    canvas.label(moved(hidden, 0.2, 0), "$x_2$", "e", 10)
    canvas.label(moved(middle, 0, radius), "$S$", "n", 4)
    canvas.label(between(p, free, 0.66), "$V(p, x_1) = 1$", "nw", 8)
    canvas.label((hi[0], (lo[1] + hi[1]) / 2), "$V(p, x_2) = 0$", "e", 7)
    return Figure(
        "The symbols: from $p$ one place $x_1$ of the lamp $S$ is seen, another one, $x_2$, is "
        "hidden. $θ$ is the angle "
        "between the normal and the way to $x_1$.",
        (
            Panel(
                canvas,
                "Shading point and lamp",
                "From a point p on the floor two lines go to places of a round lamp. The first arrives, V is 1. The "
                "second ends at a box that stands between, V is 0.",
            ),
        ),
    )


def steps() -> Figure:
    """One sample, then many."""
    u = np.random.default_rng(5).random((2, 64))
    lamp, radius = np.array([0.75, 2.55, 0]), 0.6
    places = soft_shadows.point_on_sphere(lamp, radius, u)[:2]
    p, eye = np.array([-0.9, 0.0]), np.array([-1.55, 1.3])
    post = (np.array([-0.06, 0.0]), np.array([0.1, 1.32]))
    blocked = np.array([_blocked(p, x, *post) for x in places.T])
    first = int(np.flatnonzero(~blocked)[0])
    drawn = []
    for step in range(1, 5):
        canvas = Canvas(172, 172, (-1.75, 1.75, -0.5, 3.2), 2)
        canvas.surface((-1.7, 0), (1.7, 0))
        canvas.rectangle(*post, "shade ink")
        canvas.circle(lamp[:2], radius, "wash ink")
        if step < 4:
            canvas.arrow(eye, p, "accent" if step == 1 else "faint")
            canvas.label(eye, "eye", "n", 4)
        if step in (2, 3):
            canvas.dot(places[:, first], "accent", 3.2)
            canvas.label(places[:, first], "$x$", "w", 9)
        if step == 3:
            canvas.arrow(p, places[:, first], "accent")
        if step == 4:
            for x, hit in zip(places.T[:24], blocked[:24], strict=True):
                end = _meets(p, x, *post) if hit else x
                canvas.line(p, end, "faint" if hit else "accent thin")
            canvas.circle(lamp[:2], radius, "ink")
        canvas.dot(p, "ink", 3)
        canvas.label(p, "$p$", "s", 7)
        drawn.append(canvas)
    seen = int((~blocked[:24]).sum())
    return Figure(
        "The steps at one place in the penumbra of a post.",
        (
            Panel(
                drawn[0],
                "Step 1: the camera ray",
                "A ray from the eye ends on the floor at p; a post stands between p and a lamp.",
                "1. A camera ray hits the scene at $p$.",
            ),
            Panel(
                drawn[1],
                "Step 2: a place on the lamp",
                "A point x on the lamp.",
                "2. Choose a place $x$ on the light.",
            ),
            Panel(
                drawn[2],
                "Step 3: the shadow ray",
                "A shadow ray from p reaches x, past the post.",
                "3. The shadow ray to $x$ gets through, or not.",
            ),
            Panel(
                drawn[3],
                "Step 4: the mean",
                f"24 shadow rays to 24 places: {seen} reach the lamp, the others end at the post.",
                f"4. The mean: here {seen} of 24 get through.",
            ),
        ),
    )


def methods() -> Figure:
    """A grid of point lights, and random places."""
    corner, edge_u, edge_v = (0, 0, 0), (1.5, 0, 0), (0.4, 1.05, 0)
    grid = soft_shadows.light_grid(corner, edge_u, edge_v, 4)
    u = np.random.default_rng(11).random((2, 48))
    panels = []
    for points, words, tells in (
        (
            grid,
            "Method 1: a grid of point lights, the same for all",
            "4 by 4 points in the middles of cells",
        ),
        (
            soft_shadows.point_on_rectangle(corner, edge_u, edge_v, u),
            "Method 2: one place for each sample, anywhere",
            "48 points, spread over the light by chance",
        ),
    ):
        canvas = Canvas(172, 130, (-0.25, 2.05, -0.3, 1.35), 2)
        a, b, c = (np.array(v[:2], float) for v in (corner, edge_u, edge_v))
        canvas.path(np.stack((a, a + b, a + b + c, a + c), axis=1), "wash ink", closed=True)
        if points is grid:
            for s in (0.25, 0.5, 0.75):
                canvas.line(s * b, s * b + c, "faint")
                canvas.line(s * c, s * c + b, "faint")
        canvas.arrow(a, a + b)
        canvas.arrow(a, a + c)
        canvas.dot(points[:2], "accent", 2.8)
        canvas.label(b / 2, "edge_u", "s", 5)
        canvas.label(c, "edge_v", "n", 4)
        panels.append(Panel(canvas, words, f"A parallelogram light with {tells}.", words + "."))
    return Figure(
        "A light that is a parallelogram, spanned by edge_u and edge_v from its corner.",
        tuple(panels),
    )


def hat_box() -> Figure:
    """Slices of a sphere and of the cylinder around it."""
    view = View(-60, 16)
    canvas = Canvas(350, 230, (-1.75, 1.75, -1.2, 1.2), 4)
    for low, high in ((-0.1, 0.2), (0.62, 0.92)):
        turn = np.linspace(0, 2 * np.pi, 97)
        rows = [
            np.stack((r * np.cos(turn), r * np.sin(turn), np.full(97, z)))
            for z in np.linspace(low, high, 13)
            for r in [np.sqrt(1 - z * z)]
        ]
        front = [row[:, view.depth(row) > 0] for row in rows]
        if min(part.shape[1] for part in front) == 97:
            outline = np.concatenate((view(front[0]), view(front[-1])[:, ::-1]), axis=1)
        else:
            ends = [view(_in_order(part, view)) for part in front]
            left, right = (np.stack([end[:, k] for end in ends], axis=1) for k in (0, -1))
            outline = np.concatenate((ends[0], right, ends[-1][:, ::-1], left[:, ::-1]), axis=1)
        canvas.path(outline, "wash", closed=True)
        for z in (low, high):
            ring(canvas, view, z, float(np.sqrt(1 - z * z)), "accent", "")
            ring(canvas, view, z, 1, "ink thin", "faint dashed")
    canvas.circle((0, 0), 1)
    up = float(view([0, 0, 1])[1])
    for x in (-1, 1):
        canvas.line((x, -up), (x, up), "faint")
    for z in (-1, 1):
        ring(canvas, view, z, 1, "faint", "faint" if z > 0 else "faint dashed")
    for low, high in ((-0.1, 0.2), (0.62, 0.92)):
        canvas.length((1, high * up), (1, low * up), "$h$", 12, 6)
    return Figure(
        "Two slices of equal height $h$. The one near the pole is a shorter ring, but it slopes more and so is wider: "
        "both have the area of the cylinder's slice beside them.",
        (
            Panel(
                canvas,
                "Archimedes' sphere and cylinder",
                "A sphere in a cylinder of the same radius, cut at four heights. Two slices of equal "
                "height are marked, "
                "one about the equator, one next to the pole; on the cylinder both are the same band.",
            ),
        ),
    )


def facing_disk() -> Figure:
    """Each shading point has a disk of its own."""
    canvas = Canvas(350, 200, (-2.6, 2.6, -0.45, 2.95), 4)
    centre, radius = np.array([0.1, 2.0]), 0.55
    canvas.circle(centre, radius, "wash faint")
    canvas.surface((-2.5, 0), (2.5, 0))
    for k, x in enumerate((-1.9, 1.5), 1):
        p = np.array([x, 0.0])
        across = unit(centre - p)[::-1] * (-1, 1)
        ends = centre + radius * across, centre - radius * across
        for end in ends:
            canvas.line(p, end, "faint dashed")
        canvas.line(p, centre, "faint")
        canvas.line(*ends, "accent")
        canvas.right_angle(centre, p, ends[1 if k == 1 else 0], 7)
        canvas.dot(p, "ink", 3.2)
        canvas.label(p, f"$p_{k}$", "s", 9)
    canvas.dot(centre)
    canvas.label(moved(centre, 0, radius), "centre and radius as the ball's", "n", 4)
    return Figure(
        "Two shading points and their disks, seen from the edge. Each disk passes through the "
        "centre, at right angles to "
        "the line from its point.",
        (
            Panel(
                canvas,
                "A disk for each shading point",
                "A ball with two of its diameters. Each is at right angles to the line from the centre to one of two "
                "shading points on the floor.",
            ),
        ),
    )


def _in_order(points: np.ndarray, view: View) -> np.ndarray:
    """The near part of a ring, from left to right."""
    return points[:, np.argsort(view(points)[0])]


def _meets(p: np.ndarray, x: np.ndarray, lo: np.ndarray, hi: np.ndarray) -> np.ndarray:
    """Where the way from p to x enters a box."""
    with np.errstate(divide="ignore"):
        near = np.minimum((lo - p) / (x - p), (hi - p) / (x - p)).max()
    return p + near * (x - p)


def _blocked(p: np.ndarray, x: np.ndarray, lo: np.ndarray, hi: np.ndarray) -> bool:
    t = np.stack(((lo - p) / (x - p), (hi - p) / (x - p)))
    return bool(t.min(axis=0).max() < t.max(axis=0).min())


FIGURES = {
    "penumbra": penumbra,
    "symbols": symbols,
    "steps": steps,
    "methods": methods,
    "hat_box": hat_box,
    "facing_disk": facing_disk,
}
