"""Lines and boxes in a plane, what leaves hold, and triangles that were found."""

from __future__ import annotations

from collections.abc import Callable
from types import ModuleType
from typing import TYPE_CHECKING, Any

import numpy as np
from PIL import Image

from sitebuild.mistakes.look import SIZE, Draw, Look
from sitebuild.mistakes.plots import INK, SECOND, Array, plot, square, view
from sitebuild.mistakes.rendered import shown

if TYPE_CHECKING:
    from matplotlib.axes import Axes

LO, HI = np.array((-1.0, -0.6, -1.0)), np.array((1.0, 0.6, 1.0))


def _lines(
    axes: Axes, made: ModuleType, starts: Array, towards: Array, lo: Array, hi: Array
) -> None:
    """Rays (2, N) in the plane, and the part of each that is said to be in its box."""
    zero = np.zeros(starts.shape[1])
    origins, directions = np.vstack((starts, zero)), np.vstack((towards, zero))
    near, far = made.slab_test(origins, directions, lo, hi)
    for number, (start, way) in enumerate(zip(starts.T, towards.T, strict=True)):
        color = (INK, SECOND)[number % 2]
        end = start + 9 * way / np.linalg.norm(way)
        axes.plot(*np.stack((start, end), axis=1), color="#999", linewidth=0.8, zorder=1)
        axes.plot(*start, "o", color=color, markersize=3.5, zorder=4)
        if near[number] <= far[number] and np.isfinite((near[number], far[number])).all():
            inside = np.stack((start + near[number] * way, start + far[number] * way), axis=1)
            axes.plot(*inside, color=color, linewidth=3.2, zorder=3, solid_capstyle="butt")
    view(axes, (-2.1, 2.1), (-1.4, 1.4))


def _one_box(starts: list[tuple[float, float]], towards: list[tuple[float, float]]) -> Any:
    def draw(axes: Axes, made: ModuleType, _: ModuleType) -> None:
        square(axes, LO[0], LO[1], HI[0], HI[1], color="#666")
        _lines(axes, made, np.array(starts).T, np.array(towards).T, LO, HI)

    return draw


FROM = [(-1.9, -1.1), (1.9, 0.9), (-0.2, 0.1), (-1.9, 1.0), (1.7, -1.2)]
TO = [(1.0, 0.45), (-1.0, -0.35), (0.6, 0.9), (1.0, 0.25), (-0.3, 1.0)]


def _own_boxes(axes: Axes, made: ModuleType, _: ModuleType) -> None:
    lo = np.array(((-1.7, -1.0, -1.0), (-0.4, 0.1, -1), (0.9, -1.0, -1))).T
    hi = lo + np.array(((0.8,), (0.8,), (2,)))
    for (x0, y0, _z0), (x1, y1, _z1) in zip(lo.T, hi.T, strict=True):
        square(axes, x0, y0, x1, y1, color="#666")
    starts = np.array(((-1.9, 0.2), (-1.2, 1.2), (2.0, 0.3))).T
    towards = np.array(((0.9, -1.0), (1.0, -0.7), (-0.7, -0.8))).T
    _lines(axes, made, starts, towards, lo, hi)


def _scattered() -> tuple[Array, Array]:
    """Small boxes, in no order."""
    rng = np.random.default_rng(8)
    x, y = (c.ravel() for c in np.meshgrid(np.arange(6), np.arange(4)))
    lo = np.stack((x + rng.uniform(0, 0.3, 24), y + rng.uniform(0, 0.3, 24), np.zeros(24)))
    hi = lo + np.stack((rng.uniform(0.3, 0.6, 24), rng.uniform(0.3, 0.6, 24), np.full(24, 0.1)))
    mixed = rng.permutation(24)
    return lo[:, mixed], hi[:, mixed]


def _row() -> tuple[Array, Array]:
    """Boxes one above the other, three beside one another."""
    lo, hi = _scattered()
    squeeze = np.array(((0.35,), (1.0,), (1.0,)))
    return lo * squeeze, hi * squeeze


def _leaves(boxes: Any) -> Any:
    """Draw boxes in the colour of their leaf, and the outline of each leaf."""

    def draw(axes: Axes, made: ModuleType, _: ModuleType) -> None:
        from matplotlib import colormaps

        lo, hi = boxes()
        box_lo, box_hi, first, count, order = made.build(lo, hi, 3)
        leaves = np.flatnonzero(count)
        for number, leaf in enumerate(leaves):
            color = colormaps["tab10"](number % 10)
            square(axes, *box_lo[:2, leaf], *box_hi[:2, leaf], color=color, linewidth=1.6)
            for box in order[first[leaf] : first[leaf] + count[leaf]]:
                (x0, y0), (x1, y1) = lo[:2, box], hi[:2, box]
                axes.fill([x0, x1, x1, x0], [y0, y0, y1, y1], color=color, alpha=0.55, linewidth=0)
        view(axes, (lo[0].min() - 0.2, hi[0].max() + 0.2), (-0.2, 4.1))

    return draw


def _held(boxes: Any, leaf_size: int) -> Any:
    """Draw how many boxes each leaf holds, and how many it may."""

    def draw(axes: Axes, made: ModuleType, _: ModuleType) -> None:
        lo, hi = boxes()
        count = np.asarray(made.build(lo, hi, leaf_size)[3])
        held = count[count > 0]
        axes.bar(np.arange(len(held)), held, 0.7, color=INK)
        axes.axhline(leaf_size, color="#3c8d40", linewidth=1.6)
        axes.set_xlim(-0.8, max(len(held), 6) - 0.2)
        axes.set_ylim(0, max(6, held.max() + 1.5))
        axes.set_xticks([])
        axes.set_xlabel(f"leaves; they hold {held.sum()} of {lo.shape[1]} boxes", fontsize=7.5)

    return draw


def _nested() -> tuple[Array, Array]:
    """Twelve boxes around one and the same middle."""
    half = np.linspace(0.2, 2, 12) * np.ones((3, 1))
    return -half, half


def _seven() -> tuple[Array, Array]:
    lo, hi = _scattered()
    return lo[:, :7], hi[:, :7]


def _twenty() -> tuple[Array, Array]:
    lo, hi = _scattered()
    return lo[:, :20], hi[:, :20]


ACROSS, DOWN = 75, 50

COUNT = 22
"""Triangles."""


def _triangles() -> tuple[Array, Array, Array]:
    """Triangles at all depths, some of them behind the rays' origins at z = 1."""
    rng = np.random.default_rng(11)
    middle = np.stack(
        (
            rng.uniform(-1.2, 1.2, COUNT),
            rng.uniform(-0.7, 0.7, COUNT),
            np.linspace(-1, 1.5, COUNT),
        )
    )
    p0, p1, p2 = (
        middle + rng.uniform(-0.75, 0.75, (3, COUNT)) * ((1,), (1,), (1.5,)) for _ in range(3)
    )
    return p0, p1, p2


def _rays(away: float) -> tuple[Array, Array]:
    """One for each pixel, all in one direction; away 1 begins at z = 1, and -1 looks from the other side."""
    x, y = np.meshgrid(
        (np.arange(ACROSS) + 0.5) / ACROSS * 3 - 1.5, 1 - (np.arange(DOWN) + 0.5) / DOWN * 2
    )
    origins = np.stack((x.ravel(), y.ravel(), np.full(x.size, away)))
    directions = np.repeat(np.array([[0.01], [0.013], [-away]]), x.size, axis=1)
    return origins, directions


def _layers() -> tuple[Array, Array, Array]:
    """Triangles one behind the other; the nearest hides nearly all."""
    rng = np.random.default_rng(6)
    depth = rng.permutation(np.linspace(-1, 0.8, COUNT))
    size = rng.uniform(1.2, 1.7, COUNT)
    p0, p1, p2 = (
        np.stack((x * size, y * size, depth)) for x, y in ((-1.1, -0.7), (1.1, -0.7), (0.0, 0.9))
    )
    return p0, p1, p2


def _crossed() -> tuple[Array, Array, Array]:
    """Pairs of triangles that pass through one another, so that their boxes are one and the same."""
    y = np.repeat(np.linspace(-0.9, 0.5, 6), 2)
    z = np.tile((-0.8, 0.8), 6)
    x = np.full(12, 1.35)
    return np.stack((-x, y, z)), np.stack((x, y, -z)), np.stack((0 * x, y + 0.4, 0 * x))


Corners = tuple[Array, Array, Array]


def _traversed(
    made: ModuleType, right: ModuleType, corners: Corners, away: float = 1, leaf_size: int = 3
) -> tuple[Array, Array, Array, Array]:
    lo, hi = np.min(corners, axis=0), np.max(corners, axis=0)
    found: tuple[Array, Array, Array, Array] = made.traverse(
        right.build(lo, hi, leaf_size), *corners, *_rays(away)
    )
    return found


def _blown_up(picture: Array) -> Image.Image:
    """Pixels (DOWN * ACROSS, 3), linear, as squares."""
    image = shown(picture.T.reshape(3, DOWN, ACROSS))
    return image.resize(SIZE, Image.Resampling.NEAREST)


def _hits(triangles: Callable[[], Corners], leaf_size: int) -> Draw:
    """Make a `Draw` of what each ray hits."""

    def draw(made: ModuleType, right: ModuleType) -> Image.Image:
        triangle, t, *_ = _traversed(made, right, triangles(), leaf_size=leaf_size)
        colors = np.random.default_rng(2).uniform(0.08, 0.9, (COUNT, 3))
        far = np.where(np.isfinite(t), np.clip(np.abs(t), 0, 2), 2)
        picture = colors[triangle] * (1 - 0.33 * far[:, None])
        return _blown_up(np.where((triangle >= 0)[:, None], picture, 0.012))

    return draw


def _counted(triangles: Callable[[], Corners], away: float = 1) -> Draw:
    """Make a `Draw` of how many triangles each ray was tested with."""

    def draw(made: ModuleType, right: ModuleType) -> Image.Image:
        from matplotlib import colormaps

        *_, tests = _traversed(made, right, triangles(), away)
        return _blown_up(colormaps["magma"](np.clip(tests / COUNT, 0, 1))[:, :3] ** 2.2)

    return draw


_INSIDE = "the thick part is where it is said to be in the box"

LOOKS = {
    "slab_test": (
        Look(f"Rays from their dots on; of each, {_INSIDE}", plot(_one_box(FROM, TO))),
        Look(
            f"Rays along the box's sides, two of them in its faces; of each, {_INSIDE}",
            plot(_one_box([(-1.9, y) for y in (-0.95, -0.6, 0.0, 0.6, 0.95)], [(1.0, 0.0)] * 5)),
            ("slab_nan", "slab_skips_zeros"),
        ),
        Look(f"Three rays, and a box for each; {_INSIDE}", plot(_own_boxes), ("slab_first_box",)),
        Look(
            f"A ray from inside, and two that have left the box behind; {_INSIDE}",
            plot(
                _one_box(
                    [(0.3, 0.1), (1.4, 0.75), (-1.5, -0.5)], [(0.9, 0.3), (0.9, 0.5), (-0.9, -0.2)]
                )
            ),
            ("slab_clamped",),
        ),
    ),
    "build": (
        Look(
            "24 boxes in the colours of their leaves, and the leaves' own boxes",
            plot(_leaves(_scattered)),
        ),
        Look(
            "24 boxes, one above the other, in the colours of their leaves",
            plot(_leaves(_row)),
            ("build_along_x",),
        ),
        Look(
            "Twelve boxes around the same middle: how many each leaf holds; the line is how many it may",
            plot(_held(_nested, 3), curve=True),
            ("build_between_middles",),
        ),
        Look(
            "Twenty boxes: how many each leaf holds; the line is how many it may",
            plot(_held(_twenty, 4), curve=True),
            ("build_one_more",),
        ),
        Look(
            "Seven boxes: how many each leaf holds; the line is how many it may",
            plot(_held(_seven, 2), curve=True),
            ("build_loses_one",),
        ),
    ),
    "traverse": (
        Look(
            "22 triangles, each of a colour, the darker the farther; some are behind the rays",
            _hits(_triangles, 3),
        ),
        Look(
            "Pairs of triangles that pass through one another, each of a colour",
            _hits(_crossed, 1),
            ("traverse_first_leaf",),
        ),
        Look(
            "How many triangles each ray says that it was tested with, the brighter the more",
            _counted(_triangles),
            ("traverse_brute_force",),
        ),
        Look(
            "Triangles one behind the other: how many each ray was tested with, the brighter the more",
            _counted(_layers, -1.2),
            ("traverse_unordered",),
        ),
    ),
}
