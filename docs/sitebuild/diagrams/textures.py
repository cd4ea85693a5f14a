"""Figures of textures: three parametrisations, the steps of a lookup, the tents of the texels."""

import numpy as np

from sitebuild.diagrams.canvas import Canvas
from sitebuild.diagrams.figure import Figure, Panel
from sitebuild.diagrams.texels import draw_texels, draw_weights, first_of_four
from sitebuild.diagrams.view import View
from solutions import textures

TENTHS = np.linspace(0, 1, 9)
PATCH = (2 / 8, 3 / 8, 4 / 8, 6 / 8)
"""A part of the picture, marked wherever it comes to lie: u from, u to, v from, v to."""


def surfaces() -> Figure:
    """The picture, and the same lines of u and v on three surfaces."""
    picture = Canvas(172, 172, (-0.12, 1.06, -0.16, 1.04), 4)
    _lines(picture, lambda u, v: np.stack((u, v)))
    picture.label((0.5, 0), "$u$", "s", 4)
    picture.label((0, 0.5), "$v$", "w", 4)

    p1, p2, p3 = np.array([0.0, 0, 0]), np.array([1.5, 0, 0]), np.array([0.0, 0, 0.9])
    slab_view = View(-60, 24)
    slab = Canvas(172, 172, (-0.3, 1.7, -0.65, 1.3), 4)

    def on_slab(u: np.ndarray, v: np.ndarray) -> np.ndarray:
        return slab_view(p1[:, None] + u * (p2 - p1)[:, None] + v * (p3 - p1)[:, None])

    _lines(slab, on_slab)
    for p, name, side in ((p1, "$p_1$", "s"), (p2, "$p_2$", "s"), (p3, "$p_3$", "n")):
        slab.label(slab_view(p), name, side, 5)

    view = View(195, 22, up=1)
    ball = Canvas(172, 172, (-1, 1, -1, 1), 6)

    def on_ball(u: np.ndarray, v: np.ndarray) -> np.ndarray:
        turn, height = 2 * np.pi * u, np.pi * v
        points = np.stack(
            (np.sin(height) * np.cos(turn), -np.cos(height), -np.sin(height) * np.sin(turn))
        )
        return np.where(view.depth(points) >= -1e-3, view(points), np.nan)

    _lines(ball, on_ball)
    ball.circle((0, 0), 1, "ink")

    uv = [np.array(c) for c in ((0.1, 0.1), (0.95, 0.3), (0.35, 0.95))]
    at = [np.array(c) for c in ((-0.9, -0.6), (0.9, -0.35), (0.25, 0.85))]
    mesh = Canvas(172, 172, (-1.2, 1.45, -1.0, 1.25), 4)
    to_place = np.linalg.solve(np.stack((*[np.append(c, 1) for c in uv],), axis=1), np.eye(3))

    def on_triangle(u: np.ndarray, v: np.ndarray) -> np.ndarray:
        weights = to_place @ np.stack((u, v, np.ones_like(u)))
        inside = (weights >= -1e-9).all(axis=0)
        return np.where(inside, np.stack(at, axis=1) @ weights, np.nan)

    _lines(mesh, on_triangle)
    mesh.path(np.stack(at, axis=1), "ink", closed=True)
    for place, k, side in zip(at, range(3), ("s", "e", "n"), strict=True):
        mesh.label(place, f"$uv_{k}$", side, 5)
    return Figure(
        "A picture and where its lines of equal $u$ and of equal $v$ come to lie. The marked patch is the same one "
        "everywhere.",
        (
            Panel(
                picture,
                "The picture",
                "A square with lines of equal u and v and a marked patch.",
                "The picture.",
            ),
            Panel(
                slab,
                "A rectangle",
                "The lines on a rectangle in space: still straight, evenly spaced.",
                "A rectangle: along its edges.",
            ),
            Panel(
                ball,
                "A sphere",
                "The lines on a sphere are meridians and circles of latitude.",
                "A sphere: longitude and latitude.",
            ),
            Panel(
                mesh,
                "A triangle",
                "A part of the lines on a triangle, slanted as its corners' places demand.",
                "A triangle: between its corners.",
            ),
        ),
    )


def steps() -> Figure:
    """From a hit to a colour."""
    size = 4
    uv = np.array([2.3, 1.45])
    kept = uv % 1
    place = np.array([kept[0] * size, (1 - kept[1]) * size])

    hit = Canvas(172, 150, (-0.05, 3.05, -0.05, 2.05), 6)
    hit.grid((0, 0), (3, 2), 3, 2, "ink")
    hit.rectangle((0, 0), (3, 2), "ink")
    hit.dot(uv, "accent", 3.6)
    hit.label((0, 0), "$0$", "s", 4)
    hit.label((3, 0), "$3$", "s", 4)
    hit.label(uv, "$u, v$", "w", 7)

    whole = Canvas(172, 150, (-0.2, 1.05, -0.15, 1.05), 4)
    whole.rectangle((0, 0), (1, 1), "wash ink")
    whole.dot(kept, "accent", 3.6)
    whole.line((kept[0], 0), kept, "accent")
    whole.line((0, kept[1]), kept, "accent")
    whole.label((kept[0], 0), f"{kept[0]:.2f}", "s", 3)
    whole.label((0, kept[1]), f"{kept[1]:.2f}", "w", 4)

    grid = Canvas(172, 150, (0, size, size, 0), 8)
    low = first_of_four(place)
    grid.rectangle(low, low + 2, "wash")
    draw_texels(grid, size, place)

    mix = Canvas(172, 150, (low[0], low[0] + 2, low[1] + 2, low[1]), 8)
    draw_weights(mix, place)
    return Figure(
        f"One lookup in a picture of 4 by 4 texels that repeats, at $u$ = {uv[0]:.2f} and $v$ = {uv[1]:.2f}.",
        (
            Panel(
                hit,
                "Step 1: u and v",
                "Three by two copies of a picture with a point in the last of the upper row.",
                "1. The point's $u$ and $v$.",
            ),
            Panel(
                whole,
                "Step 2: one copy",
                f"A unit square with a point at {kept[0]:.2f} and {kept[1]:.2f}.",
                "2. Drop the whole numbers.",
            ),
            Panel(
                grid,
                "Step 3: four texels",
                "The same point on a grid of texels with marked centres; the four nearest are filled.",
                "3. Find the four texels around it.",
            ),
            Panel(
                mix,
                "Step 4: weights",
                "A square as large as a texel about the point overlaps four texels; the overlaps are the weights.",
                "4. Mix them by their overlaps.",
            ),
        ),
    )


def tents() -> Figure:
    """The weights of a row of texels."""
    count = 5
    canvas = Canvas(350, 130, (-0.4, count + 0.4, -0.34, 1.32), 4, stretch=True)
    x = np.linspace(0.5, count - 0.5, 401)
    for i in range(count):
        # The weight of texel i, asked of the course's lookup with a picture that is 1 there and 0 elsewhere.
        image = np.zeros((1, count, 3))
        image[0, i] = 1
        weight = textures.texture_lookup(image, np.stack((x / count, np.full_like(x, 0.5))))[0]
        if i == 2:
            canvas.path(
                np.concatenate(([x, weight], [[x[-1], x[0]], [0, 0]]), axis=1), "wash", closed=True
            )
        canvas.path((x, weight), "accent" if i == 2 else "faint")
    canvas.line((-0.2, 0), (count + 0.2, 0))
    for i in range(count + 1):
        canvas.line(canvas.away((i, 0), 0, -5), canvas.away((i, 0), 0, 5))
    for i in range(count):
        canvas.dot((i + 0.5, 0), "ink", 2.6)
        canvas.label((i + 0.5, 0), f"${i}$", "s", 8)
    canvas.label((2.5, 1), "$w_2(u)$", "n", 3, "accent")
    return Figure(
        "The weights $w_i$ of five texels in a row: tents with their tips at the centres. At any "
        "place two of them sum to 1.",
        (
            Panel(
                canvas,
                "Tents of five texels",
                "A line cut into five texels. Above each centre a weight rises to 1 and falls to 0 at its neighbours' "
                "centres.",
            ),
        ),
    )


def _lines(canvas: Canvas, place: object) -> None:
    """Lines of equal u and of equal v, and the patch, wherever `place` puts them; NaN is hidden."""
    u0, u1, v0, v1 = PATCH
    s = np.linspace(0, 1, 25)
    around = np.concatenate(
        (
            [u0 + (u1 - u0) * s, np.full(25, v0)],
            [np.full(25, u1), v0 + (v1 - v0) * s],
            [u1 - (u1 - u0) * s, np.full(25, v1)],
            [np.full(25, u0), v1 - (v1 - v0) * s],
        ),
        axis=1,
    )
    patch = place(*around)
    canvas.path(patch[:, ~np.isnan(patch[0])], "wash accent", closed=True)
    t = np.linspace(0, 1, 129)
    for k in TENTHS:
        for u, v in ((np.full_like(t, k), t), (t, np.full_like(t, k))):
            points = place(u, v)
            shown = ~np.isnan(points[0])
            for run in np.split(np.arange(t.size), np.flatnonzero(np.diff(shown)) + 1):
                if shown[run[0]] and run.size > 1:
                    canvas.path(points[:, run], "ink thin" if k in (0.0, 1.0) else "faint")


FIGURES = {"surfaces": surfaces, "steps": steps, "tents": tents}
