"""Figures of the thin lens: what a lens does, our rays through the plane in focus, circles of confusion."""

import numpy as np

from sitebuild.diagrams.canvas import Canvas, between, unit
from sitebuild.diagrams.figure import Figure, Panel
from sitebuild.diagrams.lens import lens
from solutions import thin_lens

AXES = {"right": (1.0, 0, 0), "up": (0, 1.0, 0), "forward": (0, 0, 1.0)}


def rays() -> Figure:
    """The pinhole's ray and the rays from the lens, by the course's function."""
    canvas = Canvas(350, 190, (-0.75, 5.3, -1.05, 2.35), 4)
    focus = 3.6
    direction = unit((0, 0.30, 1))
    points = np.array([[0, 0, 0, 0], [-0.6, -0.25, 0.3, 0.6]])
    many = np.repeat(direction[:, None], 4, axis=1)
    starts, ways = thin_lens.lens_rays(
        np.zeros(3), *map(np.array, AXES.values()), many, points, focus
    )
    target = direction * focus / direction[2]
    far = 5.0
    canvas.line((-0.6, 0), (5.2, 0), "faint thin")
    for o, d in zip(starts.T, ways.T, strict=True):
        end = o + d * (far - o[2]) / d[2]
        canvas.line(o[[2, 1]], end[[2, 1]], "faint")
    o, d = starts[:, 3], ways[:, 3]
    canvas.arrow(o[[2, 1]], (o + d * (far - o[2]) / d[2])[[2, 1]], "accent")
    canvas.arrow((0, 0), (direction * far / direction[2])[[2, 1]])
    canvas.line((0, -0.75), (0, 0.75), "ink thick")
    canvas.line((focus, -0.6), (focus, 1.85), "ink dashed")
    canvas.dot(target[[2, 1]], "ink", 3.5)
    canvas.dot((0, 0), "ink", 3.5)
    canvas.dot(o[[2, 1]], "accent", 3.5)
    canvas.label((0, 0), "origin", "sw", 6)
    canvas.label(o[[2, 1]], "$o(q)$", "nw", 7, "accent")
    canvas.label((focus, 1.85), "plane in focus", "n", 3)
    canvas.label(between(o[[2, 1]], target[[2, 1]], 0.45), "$ω(x, q)$", "n", 6, "accent")
    canvas.length((0, -0.6), (focus, -0.6), "focus_distance", -9, 4)
    return Figure(
        "The renderer's view, before the lens. All rays of one point of the picture, wherever they start on the lens, "
        "pass through one point of the plane in focus: that of the pinhole's ray, which starts at the origin.",
        (
            Panel(
                canvas,
                "Rays from the lens through the plane in focus",
                "A pinhole's ray from the middle of the lens meets a plane in one point. Rays from other places of the "
                "lens pass through the same point and go apart behind it.",
            ),
        ),
    )


def steps() -> Figure:
    """The algorithm, one ray."""
    focus, direction = 2.6, unit((0, 0.28, 1))
    u = np.random.default_rng(4).random((2, 40))
    disk = thin_lens.point_on_disk(u)
    chosen = disk[:, disk[1].argmax()]
    q = 0.55 * np.array([0.0, chosen[1]])
    start, way = (
        v[:, 0]
        for v in thin_lens.lens_rays(
            np.zeros(3), *map(np.array, AXES.values()), direction[:, None], q[:, None], focus
        )
    )
    target = direction * focus / direction[2]
    drawn = []
    for step in (1, 2, 3, 4):
        if step == 3:
            canvas = Canvas(172, 130, (-1.2, 1.2, -1.2, 1.2), 4)
            canvas.circle((0, 0), 1, "wash ink")
            canvas.dot(disk, "faint", 2)
            canvas.dot(chosen, "accent", 4)
            canvas.label(chosen, "$q$", "e", 7)
            drawn.append(canvas)
            continue
        canvas = Canvas(172, 130, (-0.45, 3.45, -1.0, 1.75), 2)
        canvas.line((0, -0.6), (0, 0.6), "ink thick")
        last = direction * 3.3 / direction[2]
        canvas.arrow((0, 0), last[[2, 1]], "accent" if step == 1 else "faint")
        if step > 1:
            canvas.line((focus, -0.8), (focus, 1.4), "ink dashed")
            canvas.dot(target[[2, 1]], "accent" if step == 2 else "ink", 3.4)
        if step == 2:
            canvas.length((0, -0.7), (focus, -0.7), "focus_distance", -1, 4)
        if step == 4:
            canvas.arrow(start[[2, 1]], (start + way * 3.3 / way[2])[[2, 1]], "accent")
            canvas.dot(start[[2, 1]], "accent", 3.4)
            canvas.label(start[[2, 1]], "$q$", "w", 6)
        drawn.append(canvas)
    return Figure(
        "The first four steps. Step 3 looks at the lens from the front, the others from the side.",
        (
            Panel(
                drawn[0],
                "Step 1: the pinhole's ray",
                "A ray leaves the middle of the lens.",
                "1. The pinhole's ray.",
            ),
            Panel(
                drawn[1],
                "Step 2: the point in focus",
                "The ray meets the plane in focus in a point.",
                "2. Where it meets the plane in focus.",
            ),
            Panel(
                drawn[2],
                "Step 3: a point of the lens",
                "A disk with uniform points, one of them chosen.",
                "3. A uniform point $q$ of the lens.",
            ),
            Panel(
                drawn[3],
                "Step 4: the new ray",
                "A ray from the chosen point of the lens through the point in focus.",
                "4. From there through the point of step 2.",
            ),
        ),
    )


def confusion() -> Figure:
    """Two similar triangles with their tip at the point out of focus."""
    canvas = Canvas(350, 200, (-0.9, 6.4, -2.1, 1.85), 4)
    radius, focus, depth = 0.9, 3.2, 5.4
    width = float(thin_lens.circle_of_confusion(np.array([depth]), radius, focus)[0])
    tip = (depth, 0.0)
    canvas.path(np.array([[0, 0, depth], [radius, -radius, 0]]), "shade", closed=True)
    canvas.path(np.array([[focus, focus, depth], [width / 2, -width / 2, 0]]), "wash", closed=True)
    for y in (radius, -radius):
        canvas.line((0, y), tip)
    canvas.line((-0.3, 0), (6.2, 0), "faint thin")
    canvas.line((0, -radius), (0, radius), "ink thick")
    canvas.line((focus, -1.15), (focus, 1.25), "ink dashed")
    canvas.line((focus, -width / 2), (focus, width / 2), "accent thick")
    canvas.dot(tip, "ink", 3.5)
    canvas.label((focus, 1.25), "plane in focus", "n", 3)
    canvas.label(tip, "point", "ne", 6)
    canvas.length((0, -radius), (0, radius), "$2R$", 8, 3)
    canvas.length((focus, width / 2), (focus, -width / 2), "$c$", 8)
    canvas.length((0, -1.15), (focus, -1.15), "$z_f$", -1, 3)
    canvas.length((0, -1.6), (depth, -1.6), "$z$", -1, 3)
    return Figure(
        "A point at depth $z$ spreads over a circle of diameter $c$ in the plane in focus. Both triangles have their "
        "tip at the point, so $c$ is to $2R$ as $|z_f - z|$ to $z$.",
        (
            Panel(
                canvas,
                "The circle of confusion",
                "From a point behind the plane in focus two lines go to the lens's rim. Where they pass the plane they "
                "are the distance c apart.",
            ),
        ),
    )


FIGURES = {"lens": lens, "rays": rays, "steps": steps, "confusion": confusion}
