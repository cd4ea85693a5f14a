"""Numbers along a logarithmic axis, and names of lines at the right of a plot."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from math import ceil, floor, isclose, log, log10
from typing import TYPE_CHECKING

FINE = (1, 1.5, 2, 3, 4, 5, 7)
COARSE = (1, 2, 5)


def ticks(low: float, high: float, most: int, *, fours: bool = False) -> list[float]:
    """Choose round numbers from low to high.

    Parameters
    ----------
    low, high : the ends of the axis, above 0
    most : how many numbers have room
    fours : whether powers of 4 are wanted, as where numbers of samples are such
    """
    if fours:
        powers = [4.0**power for power in range(ceil(log(low, 4)), floor(log(high, 4)) + 1)]
        return powers[:: max(ceil(len(powers) / most), 1)]
    decades = range(floor(log10(low)), floor(log10(high)) + 1)
    for factors in (FINE, COARSE):
        chosen = _within(low, high, (float(f"{f}e{d}") for d in decades for f in factors))
        if len(chosen) <= most:
            return chosen
    powers = _within(low, high, (float(f"1e{d}") for d in decades))
    return powers[:: max(ceil(len(powers) / most), 1)]


def powers_of_four(values: Iterable[float]) -> bool:
    """True if all values are 1, 4, 16, 64 and so on."""
    return all(
        value >= 1 and isclose(log(value, 4), round(log(value, 4)), abs_tol=1e-9)
        for value in values
    )


def plain(value: float) -> str:
    """Write a number without an exponent: 0.01, 16,384."""
    return f"{value:,.12f}".rstrip("0").rstrip(".")


def _within(low: float, high: float, values: Iterable[float]) -> list[float]:
    return [value for value in values if low <= value <= high]


if TYPE_CHECKING:
    from matplotlib.axes import Axes

GAP = 0.078
"""Height of a line of text as a share of the axes' height."""


def name_lines(
    axes: Axes, ends: Sequence[tuple[float, float]], names: Sequence[str], colors: Sequence[str]
) -> None:
    """Write each name to the right of the axes, with a thin line to the end (x, y) of its line."""
    # Limits that are set no longer move; the names are placed by them.
    axes.set(xlim=axes.get_xlim(), ylim=axes.get_ylim())
    share = axes.transData + axes.transAxes.inverted()
    placed = [share.transform(end) for end in ends]
    heights = spread([float(y) for _, y in placed], GAP)
    for name, color, end, height in zip(names, colors, placed, heights, strict=True):
        arrow = {"arrowstyle": "-", "color": color, "linewidth": 1, "alpha": 0.6, "shrinkA": 0}
        axes.annotate(
            "",
            (float(end[0]), float(end[1])),
            xytext=(1.025, height),
            xycoords="axes fraction",
            textcoords="axes fraction",
            arrowprops=arrow,
            annotation_clip=False,
        )
        axes.text(
            1.032,
            height,
            name,
            transform=axes.transAxes,
            color=color,
            fontsize=14,
            fontweight="bold",
            va="center",
        )


def spread(heights: Sequence[float], gap: float) -> list[float]:
    """Heights in the same order and at least a gap apart, each moved as little as possible.

    Neighbours that are too near are placed side by side about their mean, and are moved together from then on.
    """
    order = sorted(range(len(heights)), key=lambda number: heights[number])
    clusters: list[list[int]] = []
    for number in order:
        clusters.append([number])
        while len(clusters) > 1 and _touch(clusters[-2], clusters[-1], heights, gap):
            last = clusters.pop()
            clusters[-1] += last
    placed = [0.0] * len(heights)
    for cluster in clusters:
        for number, height in zip(cluster, _column(cluster, heights, gap), strict=True):
            placed[number] = height
    return placed


def _touch(lower: list[int], upper: list[int], heights: Sequence[float], gap: float) -> bool:
    top, bottom = _column(lower, heights, gap)[-1], _column(upper, heights, gap)[0]
    return bottom - top < gap


def _column(cluster: list[int], heights: Sequence[float], gap: float) -> list[float]:
    middle = sum(heights[number] for number in cluster) / len(cluster)
    first = middle - gap * (len(cluster) - 1) / 2
    return [first + gap * place for place in range(len(cluster))]
