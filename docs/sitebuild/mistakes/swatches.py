"""Cells and patches in the colours of their corners, with marks on those that are to be divided."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from sitebuild.mistakes.plots import Array, square, view

if TYPE_CHECKING:
    from matplotlib.axes import Axes

ACROSS = 5


def swatches(axes: Axes, cells: Array, divided: Array) -> None:
    """Cells (3, 4, n), linear; those that are to be divided have a cross in them."""
    for number in range(cells.shape[2]):
        x, y = number % ACROSS, -(number // ACROSS)
        colors = np.clip(cells[:, :, number].T.reshape(2, 2, 3), 0, 1) ** (1 / 2.2)
        box = (x + 0.06, x + 0.94, y + 0.06, y + 0.94)
        axes.imshow(colors, extent=box, interpolation="bilinear", aspect="auto", zorder=1)
        if divided[number]:
            for at in (([x + 0.5] * 2, box[2:]), (box[:2], [y + 0.5] * 2)):
                axes.plot(*at, color="white", linewidth=3, zorder=2)
                axes.plot(*at, color="#c03000", linewidth=1.6, zorder=3)
            square(axes, box[0], box[2], box[1], box[3], color="#c03000", linewidth=1.6, zorder=3)
        else:
            square(axes, box[0], box[2], box[1], box[3], color="#999", linewidth=0.8)
    rows = -(-cells.shape[2] // ACROSS)
    view(axes, (0, ACROSS), (1.0 - rows, 1.0))
