"""Textures on shapes: from barycentrics to a place in the picture to a colour, through the `textures` module."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from course.engine.core.types import Floats32, Floats64

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


def on_rectangle(local: Floats64, rectangle_uv: Callable[..., Floats32]) -> Places:
    """Places on a rectangle whose corners carry their places in its own coordinates.

    ``local``: (4, 3) its corners in their order around it: u goes from the first to the second, v to the fourth.
    """
    p1, p2, _, p3 = local.astype(np.float32)
    return lambda weights, corners: rectangle_uv(_points(weights, corners), p1, p2, p3)


def on_sphere(sphere_uv: Callable[..., Floats32]) -> Places:
    """Places on a sphere about the origin whose corners carry their places in its own coordinates."""
    center = np.zeros(3, np.float32)
    return lambda weights, corners: sphere_uv(_points(weights, corners), center)


def on_mesh(triangle_uv: Callable[..., Floats32]) -> Places:
    """Places on triangles whose corners carry u and v."""
    return lambda weights, corners: triangle_uv(weights, *corners[:, :2])


def _points(barycentric: Floats32, corners: Floats32) -> Floats32:
    """Points (3, N) between the corners (3, 3, N)."""
    p: Floats32 = barycentric[0] * corners[0]
    p += barycentric[1] * corners[1]
    p += barycentric[2] * corners[2]
    return p
