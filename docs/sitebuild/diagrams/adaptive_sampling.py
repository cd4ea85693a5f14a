"""Figures of adaptive sampling: alike or not, one pixel level by level, shared corners."""

import numpy as np

from sitebuild.diagrams.canvas import Canvas, clipped
from sitebuild.diagrams.figure import Figure, Panel
from solutions import adaptive_sampling

THRESHOLD = 0.1
DISK = np.array([0.95, 0.05, 0.62])
"""A dark disk in the pixel: its centre and its radius. All else is light."""

Cells = tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]


def corners_of(cells: Cells) -> np.ndarray:
    """The four corners (2, 4, n) of cells."""
    x0, y0, x1, y1 = cells
    return np.stack((np.stack((x0, x1, x0, x1)), np.stack((y0, y0, y1, y1))))


def seen(points: np.ndarray) -> np.ndarray:
    """What rays through points (2, ...) bring back, (3, ...)."""
    light = np.hypot(points[0] - DISK[0], points[1] - DISK[1]) > DISK[2]
    return np.broadcast_to(np.where(light, 1.0, 0.0), (3, *light.shape))


def levels(depth: int) -> list[tuple[Cells, list[tuple[float, float]]]]:
    """All cells of each level so far, and the corners that are new there, by the course's two functions."""
    whole = tuple(np.array([v]) for v in (0.0, 0.0, 1.0, 1.0))
    open_cells, closed, known, found = whole, [], set(), []
    for _ in range(depth + 1):
        corners = set(zip(*corners_of(open_cells).reshape(2, -1).tolist(), strict=True))
        everything = tuple(
            np.concatenate([cells[k] for cells in (*closed, open_cells)]) for k in range(4)
        )
        found.append((everything, sorted(corners - known)))
        known |= corners
        divide = adaptive_sampling.needs_subdivision(seen(corners_of(open_cells)), THRESHOLD)
        closed.append(tuple(v[~divide] for v in open_cells))
        children = adaptive_sampling.subdivide(*(v[divide] for v in open_cells))
        open_cells = tuple(v.ravel() for v in children)
    return found


def cells() -> Figure:
    """A cell that stays and one that is divided."""
    panels = []
    for lo, words in (
        ((-0.62, 0.6), "All alike: left as it is."),
        ((0.1, -0.1), "They differ: divided into four."),
    ):
        canvas = Canvas(172, 172, (lo[0] - 0.05, lo[0] + 0.65, lo[1] + 0.65, lo[1] - 0.05), 3)
        _disk(canvas, np.array(lo), 0.6)
        box = tuple(np.array([v]) for v in (*lo, lo[0] + 0.6, lo[1] + 0.6))
        corners = corners_of(box)
        values = seen(corners)
        canvas.rectangle(lo, np.array(lo) + 0.6, "ink")
        if adaptive_sampling.needs_subdivision(values, THRESHOLD)[0]:
            canvas.grid(lo, np.array(lo) + 0.6, 2, 2, "accent")
        for point, light in zip(corners[:, :, 0].T, values[0, :, 0], strict=True):
            canvas.dot(point, "open" if light else "ink", 4)
        panels.append(
            Panel(
                canvas,
                words,
                "A square cell with a ray through each corner. "
                + (
                    "None of them meets the disk."
                    if "alike" in words
                    else "Two of them meet a disk."
                ),
                words,
            )
        )
    return Figure(
        "Two cells with a ray through each corner: filled points have met the disk, rings have not.",
        tuple(panels),
    )


def steps() -> Figure:
    """One pixel, level by level."""
    panels, cast = [], 0
    for k, (boxes, new) in enumerate(levels(3)):
        canvas = Canvas(172, 172, (0, 1, 1, 0), 6)
        _disk(canvas, np.zeros(2), 1)
        for x0, y0, x1, y1 in zip(*boxes, strict=True):
            canvas.rectangle((x0, y0), (x1, y1), "ink thin")
        cast += len(new)
        canvas.dot(np.array(new).T, "accent", 3.2)
        words = (
            "One cell, a ray through each corner: 4 rays."
            if k == 0
            else f"{len(new)} new rays, {cast} in all."
        )
        panels.append(
            Panel(
                canvas,
                f"Level {k}: {cast} rays",
                f"A pixel with the rim of a disk in it, cut into {len(boxes[0])} cells; smaller ones lie along the "
                f"rim. {len(new)} corners are new.",
                f"Depth {k}. {words}",
            )
        )
    even = (2**3 + 1) ** 2
    return Figure(
        "A pixel with an edge, divided down to a depth of 3 by the course's functions. Marked are "
        "the rays that are new. "
        f"The same cells everywhere would take {even} rays.",
        tuple(panels),
    )


def shared() -> Figure:
    """The corners of four children."""
    x0, y0, x1, y1 = adaptive_sampling.subdivide(*(np.array([v]) for v in (0.0, 0.0, 1.0, 1.0)))
    children = (x0.ravel(), y0.ravel(), x1.ravel(), y1.ravel())
    every = corners_of(children)
    apart = Canvas(172, 172, (-0.1, 1.1, 1.1, -0.1), 4)
    for k, (a, b, c, d) in enumerate(zip(*children, strict=True)):
        shift = np.array([0.07 if a > 0 else -0.07, 0.07 if b > 0 else -0.07])
        apart.rectangle(np.array([a, b]) + shift, np.array([c, d]) + shift)
        apart.dot(every[:, :, k] + shift[:, None], "ink", 3)
        apart.label((np.array([a + c, b + d]) / 2) + shift, f"child {k}", "c")
    together = Canvas(172, 172, (-0.1, 1.1, 1.1, -0.1), 4)
    together.rectangle((0, 0), (1, 1))
    together.grid((0, 0), (1, 1), 2, 2, "ink")
    points = sorted(set(zip(*every.reshape(2, -1).tolist(), strict=True)))
    old = [p for p in points if set(p) <= {0.0, 1.0}]
    new = [p for p in points if p not in old]
    together.dot(np.array(old).T, "open", 4)
    together.dot(np.array(new).T, "accent", 4)
    return Figure(
        f"Four children have 16 corners, but only {len(points)} places. {len(old)} of them are the cell's own, so "
        f"{len(new)} rays are new.",
        (
            Panel(
                apart, "Four children, apart", "Four cells, each with four corners.", "16 corners."
            ),
            Panel(
                together,
                "Four children, together",
                "The same four cells side by side: nine corners, four of them those of the parent.",
                f"{len(points)} places, {len(new)} new rays.",
            ),
        ),
    )


def _disk(canvas: Canvas, lo: np.ndarray, size: float) -> None:
    """What of the disk lies in a cell."""
    turn = np.linspace(0, 2 * np.pi, 721)
    rim = DISK[:2, None] + DISK[2] * np.stack((np.cos(turn), np.sin(turn)))
    part = clipped(rim, lo, lo + size)
    if part.size:
        canvas.path(part, "shade faint", closed=True)


FIGURES = {"cells": cells, "steps": steps, "shared": shared}
