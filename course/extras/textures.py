"""Textures on shapes: from barycentrics to a place in the picture to a colour, through the `textures` module."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from course.core.types import Floats32


@dataclass(frozen=True)
class Texture:
    """A picture that repeats.

    Attributes
    ----------
    image : (H, W, 3) float32, linear
    repeat : (2,) float32, how often along u and v
    lookup : (image, uv) -> (3, N)
    """

    image: Floats32
    repeat: Floats32
    lookup: Callable[[Floats32, Floats32], Floats32]

    def __call__(self, uv: Floats32) -> Floats32:
        """Colours (3, N) at places (2, N)."""
        return self.lookup(self.image, uv * self.repeat[:, None])


@dataclass(frozen=True)
class OnRectangle:
    """A rectangle whose corners carry their places in its own coordinates.

    Attributes
    ----------
    p1, p2, p3 : (3,), where u = v = 0, u = 1 and v = 1
    rectangle_uv : (p, p1, p2, p3) -> (2, N)
    """

    texture: Texture
    p1: Floats32
    p2: Floats32
    p3: Floats32
    rectangle_uv: Callable[[Floats32, Floats32, Floats32, Floats32], Floats32]

    def __call__(self, barycentric: Floats32, corners: Floats32) -> Floats32:
        """Colours (3, N), as `course.extras.painting` asks for them."""
        p = _points(barycentric, corners)
        return self.texture(self.rectangle_uv(p, self.p1, self.p2, self.p3))


@dataclass(frozen=True)
class OnSphere:
    """A sphere about the origin whose corners carry their places in its own coordinates.

    Attributes
    ----------
    sphere_uv : (p, center) -> (2, N)
    """

    texture: Texture
    sphere_uv: Callable[[Floats32, Floats32], Floats32]

    def __call__(self, barycentric: Floats32, corners: Floats32) -> Floats32:
        """Colours (3, N), as `course.extras.painting` asks for them."""
        center = np.zeros(3, np.float32)
        return self.texture(self.sphere_uv(_points(barycentric, corners), center))


@dataclass(frozen=True)
class OnMesh:
    """Triangles whose corners carry u and v.

    Attributes
    ----------
    triangle_uv : (barycentric, uv0, uv1, uv2) -> (2, N)
    """

    texture: Texture
    triangle_uv: Callable[[Floats32, Floats32, Floats32, Floats32], Floats32]

    def __call__(self, barycentric: Floats32, corners: Floats32) -> Floats32:
        """Colours (3, N), as `course.extras.painting` asks for them."""
        first, second, third = corners[:, :2]
        return self.texture(self.triangle_uv(barycentric, first, second, third))


def _points(barycentric: Floats32, corners: Floats32) -> Floats32:
    """Points (3, N) between the corners (3, 3, N)."""
    p: Floats32 = barycentric[0] * corners[0]
    p += barycentric[1] * corners[1]
    p += barycentric[2] * corners[2]
    return p
