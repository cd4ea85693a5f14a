"""Figures of sampling: two ways to a disk, the steps of a warp, a radius that crowds, slices of a sphere."""

import numpy as np

from sitebuild.diagrams.canvas import Canvas, turned
from sitebuild.diagrams.figure import Figure, Panel
from sitebuild.diagrams.soft_shadows import hat_box
from solutions import sampling


def ways() -> Figure:
    """Rejection, and the unit square before and after its warp."""
    candidates = np.random.default_rng(9).random((2, 60)) * 2 - 1
    inside = (candidates**2).sum(axis=0) < 1
    rejected = Canvas(172, 172, (-1, 1, -1, 1), 6)
    rejected.circle((0, 0), 1, "wash ink")
    rejected.rectangle((-1, -1), (1, 1), "ink")
    rejected.dot(candidates[:, inside], "accent", 2.6)
    rejected.cross(candidates[:, ~inside], "faint", 2.6)

    numbers = Canvas(172, 172, (0, 1, 0, 1), 6)
    numbers.rectangle((0, 0), (1, 1), "ink")
    warped = Canvas(172, 172, (-1, 1, -1, 1), 6)
    warped.circle((0, 0), 1, "ink")
    t = np.linspace(0, 1 - 1e-9, 97)
    for k in range(9):
        here = np.full_like(t, min(k / 8, 1 - 1e-9))
        for u in (np.stack((here, t)), np.stack((t, here))):
            numbers.path(u, "faint")
            warped.path(sampling.disk_by_polar(u), "faint")
    for lo, kind in (((1 / 8, 1 / 8), "wash accent"), ((6 / 8, 3 / 8), "wash accent")):
        s = np.linspace(0, 1 / 8, 9)
        zero, full = np.zeros(9), np.full(9, 1 / 8)
        around = (
            np.concatenate(([s, zero], [full, s], [s[::-1], full], [zero, s[::-1]]), axis=1)
            + np.array(lo)[:, None]
        )
        numbers.path(around, kind, closed=True)
        warped.path(sampling.disk_by_polar(around), kind, closed=True)
    return Figure(
        "Two ways to uniform points on a disk. A warp takes equal cells of the square of numbers to "
        "parts of equal area; "
        "two of the 64 are marked.",
        (
            Panel(
                rejected,
                "Rejection",
                f"60 points in a square; the {int(inside.sum())} in the disk are kept, the others crossed out.",
                f"Rejection: {int(inside.sum())} of 60 are kept.",
            ),
            Panel(
                numbers,
                "The square of numbers",
                "A unit square with 8 by 8 cells; two are marked.",
                "The square of numbers.",
            ),
            Panel(
                warped,
                "The warped square",
                "The same cells on a disk: parts of rings, outer ones thinner and longer, all of one area.",
                "The same cells, warped.",
            ),
        ),
    )


def steps() -> Figure:
    """From the share of the area to a point."""
    u = np.array([[0.42], [0.13]])
    point = sampling.disk_by_polar(u)[:, 0]
    r = float(np.hypot(*point))
    angle = float(np.degrees(np.arctan2(point[1], point[0])))
    drawn = []
    for step in (1, 2, 3, 4):
        if step in (2, 3):
            canvas = Canvas(172, 172, (-0.12, 1.1, -0.16, 1.12), 4)
            x = np.linspace(0, 1, 61)
            # The share of a disk's area within a radius.
            canvas.path((x, x**2), "ink")
            canvas.arrow((0, 0), (1.1, 0), "faint")
            canvas.arrow((0, 0), (0, 1.1), "faint")
            if step == 2:
                canvas.label((0.5, 0), "radius", "s", 4)
            canvas.label((0.05, 1.05), "share", "e", 2)
            canvas.line((0, u[0, 0]), (r, u[0, 0]), "accent")
            canvas.label((0, u[0, 0]), "$u$", "w", 3)
            if step == 3:
                canvas.arrow((r, u[0, 0]), (r, 0), "accent")
                canvas.label((r, 0), "$r$", "s", 4)
        else:
            canvas = Canvas(172, 172, (-1, 1, -1, 1), 6)
            canvas.circle((0, 0), 1, "ink")
            canvas.circle((0, 0), r, "wash accent" if step == 1 else "accent")
            if step == 1:
                canvas.line((0, 0), turned(40, r))
                canvas.label(turned(40, r / 2), "$r$", "nw", 5)
            else:
                canvas.line((0, 0), (1, 0), "faint")
                canvas.line((0, 0), point)
                canvas.angle((0, 0), (1, 0), point, "", 22)
                canvas.label(turned(angle / 2, 0.3), "$φ$", "e", 6)
                canvas.dot(point, "accent", 4)
        drawn.append(canvas)
    return Figure(
        "A warp, step by step, for a disk of radius 1.",
        (
            Panel(
                drawn[0],
                "Step 1: the share within a radius",
                "A disk with a smaller disk of radius r in it.",
                "1. What share lies within $r$?",
            ),
            Panel(
                drawn[1],
                "Step 2: a uniform number",
                "The share as a rising curve over the radius, with a number u on the share's axis.",
                "2. Set it equal to a number $u$.",
            ),
            Panel(
                drawn[2],
                "Step 3: the radius",
                "From u across to the curve, and down to the radius r.",
                "3. Solve: go back to the radius.",
            ),
            Panel(
                drawn[3],
                "Step 4: the angle",
                "A point at distance r from the centre, at a uniform angle.",
                "4. The angle gets its own number.",
            ),
        ),
    )


def crowded() -> Figure:
    """A uniform radius, and uniform points."""
    u = np.random.default_rng(12).random((2, 300))
    wrong = u[0] * np.array([np.cos(2 * np.pi * u[1]), np.sin(2 * np.pi * u[1])])
    panels = []
    for points, words in (
        (wrong, "a uniform radius"),
        (sampling.disk_by_polar(u), "uniform points"),
    ):
        within = int((np.hypot(*points) < 0.5).sum())
        canvas = Canvas(172, 172, (-1, 1, -1, 1), 6)
        canvas.circle((0, 0), 1, "ink")
        canvas.circle((0, 0), 0.5, "wash faint")
        canvas.dot(points, "accent", 1.7)
        panels.append(
            Panel(
                canvas,
                words.capitalize(),
                f"300 points on a disk, {within} of them within half the radius.",
                f"{words.capitalize()}: {within} of 300 within half the radius.",
            )
        )
    return Figure(
        "The inner disk has a quarter of the area. It should hold about 75 of 300 points.",
        tuple(panels),
    )


FIGURES = {"ways": ways, "steps": steps, "crowded": crowded, "slices": hat_box}
