"""Where a logarithmic axis has its numbers, and how they are written."""

from __future__ import annotations

from collections.abc import Iterable
from math import ceil, floor, isclose, log, log10

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
    """Whether all values are 1, 4, 16, 64 and so on."""
    return all(
        value >= 1 and isclose(log(value, 4), round(log(value, 4)), abs_tol=1e-9)
        for value in values
    )


def plain(value: float) -> str:
    """Write a number without an exponent: 0.01, 16,384."""
    return f"{value:,.12f}".rstrip("0").rstrip(".")


def _within(low: float, high: float, values: Iterable[float]) -> list[float]:
    return [value for value in values if low <= value <= high]
