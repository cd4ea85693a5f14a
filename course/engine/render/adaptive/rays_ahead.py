"""Rays that are sent ahead through a picture, and what they come to."""

from dataclasses import dataclass

import numpy as np

from course.engine.core.types import Floats64, Indices
from course.engine.render.adaptive.lobes_ahead import Onward


@dataclass(frozen=True)
class Front:
    """Rays of all blocks at one depth, n of them in rows of the picture's blocks.

    Attributes
    ----------
    origin, way : (3, n)
    square : (n,) mean square of what they bring; 0 for rays that are no more
    blur : (n,) variance of their angle
    key : (n,) by which surfaces they have come
    depth : (n,) length of the way so far
    """

    origin: Floats64
    way: Floats64
    square: Floats64
    blur: Floats64
    key: Indices
    length: Floats64


@dataclass(frozen=True)
class Arrival:
    """Rays that have come to a surface, and go on from there.

    Attributes
    ----------
    before, after : all rays, before the surface and after it
    which : (n,) those of them that meet it
    on : how it sends them on
    normal, material : (3, n) and (n,) of the surface
    time : when, as a share of the time that the shutter is open
    """

    before: Front
    after: Front
    which: Indices
    on: Onward
    normal: Floats64
    material: Indices
    time: float


def scattered(
    front: Front, which: Indices, origin: Floats64, on: Onward, surface: Indices, far: Floats64
) -> Front:
    """Rays that go on from surfaces; the others are no more."""
    n = len(front.square)
    new = Front(
        np.zeros((3, n)), np.zeros((3, n)), np.zeros(n), np.zeros(n), np.full(n, -1), np.zeros(n)
    )
    new.origin[:, which], new.way[:, which] = origin, on.way
    new.square[which] = front.square[which] * on.square
    new.blur[which] = front.blur[which] + on.blur
    new.key[which] = front.key[which] * 1000003 + surface + 1
    new.length[which] = front.length[which] + far
    return new


def by_surfaces(key: Indices) -> list[Indices]:
    """Rays (n,) by the surfaces that they have come by."""
    order = np.argsort(key, kind="stable")
    return np.split(order, np.flatnonzero(np.diff(key[order])) + 1) if len(key) else []
