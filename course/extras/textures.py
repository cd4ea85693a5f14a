"""Textures on shapes: from barycentrics to a place in the picture to a colour, through the `textures` module."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from course.core.types import Floats32, Floats64
from course.extras.painting import ColorAt

Places = Callable[..., Floats32]
"""A function of the `textures` module that finds places (2, N) in a picture."""


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


def on_rectangle(
    texture: Texture, p1: Floats32, p2: Floats32, p3: Floats32, rectangle_uv: Places
) -> ColorAt:
    """Colours of a rectangle whose corners carry their places in its own coordinates.

    ``p1``, ``p2``, ``p3``: (3,), where u = v = 0, u = 1 and v = 1.
    """
    return lambda barycentric, corners: texture(
        rectangle_uv(_points(barycentric, corners), p1, p2, p3)
    )


def on_sphere(texture: Texture, sphere_uv: Places) -> ColorAt:
    """Colours of a sphere about the origin whose corners carry their places in its own coordinates."""
    center = np.zeros(3, np.float32)
    return lambda barycentric, corners: texture(sphere_uv(_points(barycentric, corners), center))


def on_mesh(texture: Texture, triangle_uv: Places) -> ColorAt:
    """Colours of triangles whose corners carry u and v."""
    return lambda barycentric, corners: texture(triangle_uv(barycentric, *corners[:, :2]))


def places_on(name: str, function: Places, local: Floats64 | None) -> Places:
    """(barycentrics, what the corners carry) -> places, by the function of that name.

    ``local``: (V, 3) vertices of a sphere or a rectangle in its own coordinates.
    """
    if name == "triangle_uv" or local is None:
        return lambda weights, corners: function(weights, *corners[:, :2])
    if name == "sphere_uv":
        center = np.zeros(3, np.float32)
        return lambda weights, corners: function(_points(weights, corners), center)
    p1, p2, _, p3 = local.astype(np.float32)
    return lambda weights, corners: function(_points(weights, corners), p1, p2, p3)


def _points(barycentric: Floats32, corners: Floats32) -> Floats32:
    """Points (3, N) between the corners (3, 3, N)."""
    p: Floats32 = barycentric[0] * corners[0]
    p += barycentric[1] * corners[1]
    p += barycentric[2] * corners[2]
    return p
