"""The square that directions jittered on a plane make: seen, checked, and what it looks like after a mistake.

How a square is turned or mirrored about its direction is free, so only what stays the same is looked at.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from course.grading.checks.check import Array, Failure, Trial
from course.grading.checks.contract import at, check_close
from course.grading.checks.statistics import check_uniform
from course.grading.checks.vectors import UNIT

CELLS = (12, 12)

NEAR = 1e-3
"""How well a square that shows a mistake has to fit."""

SIDE = "Roughness is the side of the square, at distance 1."


@dataclass(frozen=True)
class Square:
    """What fits the offsets best: offset = sides (u - 1/2) + centre, and rest.

    Attributes
    ----------
    axis : (3,), the direction that was jittered, of length 1
    u : (2, N), the numbers that did it
    sides : (3, 2)
    centre : (3,), from the axis' tip
    rest : (3, N), what the fit leaves
    lengths : (N,), of the directions that came back
    """

    axis: Array
    u: Array
    sides: Array
    centre: Array
    rest: Array
    lengths: Array

    def is_flat(self) -> bool:
        """The offsets grow evenly with both numbers."""
        return bool(np.abs(self.rest).max() < NEAR)

    def is_of(self, side: float) -> bool:
        """Both sides are that long, and at right angles."""
        return bool(np.abs(self.sides.T @ self.sides - side**2 * np.eye(2)).max() < NEAR)

    def at(self, u: Array) -> Array:
        """(3, N) places that numbers (2, N) have in it, as its fit has them, seen from the axis' tail."""
        return np.asarray(self.axis[:, None] + self.sides @ (u - 0.5) + self.centre[:, None])

    def off_centre(self) -> float:
        """How far the centre is from the axis."""
        return float(np.linalg.norm(self.centre))


def seen(axis: Array, u: Array, result: Array) -> Square:
    """The square on the plane at distance 1 from the tail of an axis (3,).

    Raises
    ------
    Failure
        A direction never meets the plane.
    """
    cos = axis @ result
    if not (cos > 0).all():
        raise Failure(
            "every direction to stay in front of the one it was jittered from",
            f"cosine {cos.min():.6g}",
            f"direction = {tuple(axis.round(6).tolist())}",
        )
    offset = result / cos - axis[:, None]
    design = np.stack((u[0] - 0.5, u[1] - 0.5, np.ones(u.shape[1])), axis=1)
    fit = np.linalg.lstsq(design, offset.T, rcond=None)[0].T
    return Square(
        axis, u, fit[:, :2], fit[:, 2], offset - fit @ design.T, np.linalg.norm(result, axis=0)
    )


def check_square(square: Square, roughness: float) -> None:
    """It is a square of that side around its direction.

    Raises
    ------
    Failure
    """
    (first, second), (x, y, z) = square.sides.T, square.axis
    tolerance = 2 * UNIT * (1 + roughness**2)
    for what, found, expected, hint in (
        (
            "centre's distance from the direction",
            square.off_centre(),
            0.0,
            "The square lies around the direction, so the mean of all offsets is nothing.",
        ),
        ("length of the first side", float(np.linalg.norm(first)), roughness, SIDE),
        ("length of the second side", float(np.linalg.norm(second)), roughness, SIDE),
        (
            "product of the sides",
            float(first @ second) / roughness,
            0.0,
            "The sides are at right angles to each other.",
        ),
    ):
        if not abs(found - expected) <= tolerance:
            raise Failure(
                f"the square's {what} {expected:.6g} within {tolerance:.1g}",
                f"{found:.6g}",
                f"roughness {roughness:.4g}, direction ({x:.4g}, {y:.4g}, {z:.4g})",
                hint,
            )
    check_close(
        square.rest,
        np.zeros_like(square.rest),
        tolerance,
        "offset from the place of u in the square:",
        at(u=square.u),
        "The offset grows evenly with both numbers: no angles, no other shapes.",
    )


def check_filled(trial: Trial, square: Square, roughness: float) -> None:
    """Its directions are uniform over it: one comparison of distributions.

    Raises
    ------
    Failure
    """
    length = np.linalg.norm(square.sides, axis=0)
    if not length.min() > 0.1 * roughness:
        raise Failure(
            f"a square of side {roughness:.4g}",
            f"sides of {length[0]:.4g} and {length[1]:.4g}",
            hint="Both numbers of u are needed, each for a side of its own.",
        )
    offset = square.at(square.u) + square.rest - square.axis[:, None]
    place = (square.sides / length).T @ offset / roughness + 0.5
    shown = place[:, (np.abs(place - 0.5) <= 0.5).all(axis=0)]
    trial.show("points", "where yours meet the square", yours=shown[:, :2000])
    far = np.abs(place - 0.5).max(axis=0)
    worst = int(far.argmax())
    if not far[worst] <= 0.5 + NEAR:
        raise Failure(
            f"all offsets within +-{roughness / 2:.4g} along both sides",
            f"{far[worst] * roughness:.4g}",
            at(u=square.u)(worst),
            SIDE,
        )
    check_uniform(place, CELLS, "places in the square", "Every place is as probable.")


def one_sided(square: Square, roughness: float) -> bool:
    """One of its corners is where its centre belongs."""
    corner = abs(square.off_centre() - roughness / np.sqrt(2)) < NEAR
    return square.is_flat() and corner and square.is_of(roughness)


def twice_as_wide(square: Square, roughness: float) -> bool:
    """Roughness was taken for half a side."""
    return square.is_flat() and square.off_centre() < NEAR and square.is_of(2 * roughness)


def one_number(square: Square, roughness: float) -> bool:
    """It is a line: the same number drives both sides."""
    lengths = np.sort(np.linalg.norm(square.sides, axis=0))
    return square.is_flat() and bool(lengths[0] < NEAR and lengths[1] > 0.5 * roughness)


def not_normalised(square: Square, roughness: float) -> bool:
    """It is right, but its directions end on the plane."""
    right = square.is_flat() and square.is_of(roughness) and square.off_centre() < NEAR
    shortest, longest = square.lengths.min(), square.lengths.max()
    return bool(right and shortest > 0.99 and 1.01 < longest < 1.5)
