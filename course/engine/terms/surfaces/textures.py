"""Textures on shapes: from barycentrics to a place in the picture to a colour, through the `textures` module."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from course.engine.core.types import Floats32

Places = Callable[[Floats32, Floats32], Floats32]
"""(barycentrics (3, N), what the corners carry (3 corners, 3, N)) -> places (2, N) in a picture."""


@dataclass(frozen=True)
class Texture:
    """A picture that repeats.

    Attributes
    ----------
    image : (H, W, 3) float32, linear
    repeat : (2,) float32, how often along u and v
    lookup : (image, uv) -> (3, N)
    nearest : true if places are moved to the middles of their pixels first
    """

    image: Floats32
    repeat: Floats32
    lookup: Callable[[Floats32, Floats32], Floats32]
    nearest: bool = False

    def __call__(self, uv: Floats32) -> Floats32:
        """Colours (3, N) at places (2, N)."""
        uv = uv * self.repeat[:, None]
        if self.nearest:
            height, width = self.image.shape[:2]
            size = np.array([[width], [height]], np.float32)
            uv = (np.floor(uv * size) + np.float32(0.5)) / size
        return self.lookup(self.image, uv)


@dataclass(frozen=True)
class OnRectangle:
    """Places on a rectangle whose corners carry their places in its own coordinates.

    Attributes
    ----------
    corner, along, across : (3,) float32, the corner where u = v = 0, and its neighbours at u = 1 and at v = 1
    """

    corner: Floats32
    along: Floats32
    across: Floats32
    rectangle_uv: Callable[..., Floats32]

    def __call__(self, weights: Floats32, corners: Floats32) -> Floats32:
        """See ``Places``."""
        return self.rectangle_uv(_points(weights, corners), self.corner, self.along, self.across)


@dataclass(frozen=True)
class OnSphere:
    """Places on a sphere about the origin whose corners carry their places in its own coordinates."""

    sphere_uv: Callable[..., Floats32]

    def __call__(self, weights: Floats32, corners: Floats32) -> Floats32:
        """See ``Places``."""
        return self.sphere_uv(_points(weights, corners), np.zeros(3, np.float32))


@dataclass(frozen=True)
class OnMesh:
    """Places on triangles whose corners carry u and v."""

    triangle_uv: Callable[..., Floats32]

    def __call__(self, weights: Floats32, corners: Floats32) -> Floats32:
        """See ``Places``."""
        return self.triangle_uv(weights, *corners[:, :2])


@dataclass(frozen=True)
class Laid:
    """A texture that is laid on a shape, as a ``ColorAt``."""

    texture: Texture
    places: Places

    def __call__(self, weights: Floats32, corners: Floats32) -> Floats32:
        """See ``ColorAt``."""
        return self.texture(self.places(weights, corners))


def _points(barycentric: Floats32, corners: Floats32) -> Floats32:
    """Points (3, N) between the corners (3, 3, N)."""
    p: Floats32 = barycentric[0] * corners[0]
    p += barycentric[1] * corners[1]
    p += barycentric[2] * corners[2]
    return p
