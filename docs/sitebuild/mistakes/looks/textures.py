"""A letter on a rectangle and on two triangles, a globe, and a picture of a few texels."""

from __future__ import annotations

from types import ModuleType
from typing import TYPE_CHECKING, Any

import numpy as np
from PIL import Image

from course.engine.functions.effects import PROJECT
from sitebuild.mistakes.look import SIZE, Look
from sitebuild.mistakes.plots import curves, label, plot
from sitebuild.mistakes.rendered import shown

if TYPE_CHECKING:
    from matplotlib.axes import Axes

Array = np.ndarray[Any, Any]

GLOBE = PROJECT / "scenes" / "textures" / "globe.png"

LETTER = (
    "ggggggg.",
    "g######.",
    "g#......",
    "g####...",
    "g#......",
    "g#....b.",
    "g#...bb.",
    "g.......",
)
PAINTS = {
    ".": (0.75, 0.70, 0.55),
    "#": (0.05, 0.1, 0.3),
    "b": (0.7, 0.08, 0.03),
    "g": (0.2, 0.45, 0.15),
}


def _letter(scale: int = 1) -> Array:
    """A letter that tells left from right and top from bottom, (H, W, 3)."""
    texels = np.array([[PAINTS[c] for c in row] for row in LETTER], np.float32)
    return np.ascontiguousarray(texels.repeat(scale, axis=0).repeat(scale, axis=1))


def _window(x: tuple[float, float], y: tuple[float, float]) -> tuple[Array, Array]:
    """Places of the picture's pixels, (N,) each; y grows upwards."""
    width, height = SIZE
    across = x[0] + (np.arange(width) + 0.5) / width * (x[1] - x[0])
    up = y[1] - (np.arange(height) + 0.5) / height * (y[1] - y[0])
    places = np.meshgrid(across, up)
    return places[0].ravel().astype(np.float32), places[1].ravel().astype(np.float32)


def _shown(colors: Array, inside: Array | None = None) -> Image.Image:
    """Colours (3, N) of all pixels; those outside are pale."""
    width, height = SIZE
    picture = np.array(colors).reshape(3, height, width)
    if inside is not None:
        picture = np.where(inside.reshape(height, width), picture, 0.35 * picture + 0.65)
    return shown(picture)


def _rectangle(made: ModuleType, right: ModuleType) -> Image.Image:
    """A rectangle of 1.8 x 1.2, seen face-on, with some of its plane around it."""
    x, y = _window((-0.6, 2.4), (-0.4, 1.6))
    shift = np.array((0.7, 0.4, 3.0), np.float32)
    p = np.stack((x, y, np.zeros_like(x))) + shift[:, None]
    corners = [shift + np.array(each, np.float32) for each in ((0, 0, 0), (1.8, 0, 0), (0, 1.2, 0))]
    uv = np.asarray(made.rectangle_uv(p, *corners), np.float32)
    inside = (x >= 0) & (x <= 1.8) & (y >= 0) & (y <= 1.2)
    return _shown(right.texture_lookup(_letter(8), uv), inside)


def _globe(made: ModuleType, right: ModuleType) -> Image.Image:
    """Two sides of a ball: as seen from +z, and from -z."""
    with Image.open(GLOBE) as opened:
        image = (np.asarray(opened.convert("RGB").resize((360, 180))) / 255.0).astype(
            np.float32
        ) ** 2.2
    picture = np.ones((3, SIZE[0] * SIZE[1]), np.float32)
    center = np.array((0.5, 0.3, 0.2), np.float32)
    for side, middle in ((1, -0.76), (-1, 0.76)):
        x, y = _window((-1.5, 1.5), (-1, 1))
        x, y = (x - middle) / 0.72, y / 0.72
        on = x * x + y * y < 1
        z = np.sqrt(np.maximum(1 - x * x - y * y, 0))
        p = 0.8 * np.stack((side * x, y, side * z))[:, on] + center[:, None]
        uv = np.asarray(made.sphere_uv(p.astype(np.float32), center), np.float32)
        picture[:, on] = right.texture_lookup(image, uv)
    return _shown(picture)


def _longitudes(axes: Axes, made: ModuleType, right: ModuleType) -> None:
    angle = np.linspace(0.5, 359.5, 360)
    p = np.stack((np.cos(np.radians(angle)), 0 * angle, -np.sin(np.radians(angle))))
    curves(axes, angle, made.sphere_uv(p, np.zeros(3))[0], right.sphere_uv(p, np.zeros(3))[0])
    label(axes, "degrees from +x, and the u there")


def _triangles(made: ModuleType, right: ModuleType) -> Image.Image:
    """A square of two triangles, each with its own corners."""
    x, y = _window((-0.3, 1.3), (-0.033, 1.033))
    upper = x + y > 1
    # The corner at the right angle first, then the two on the diagonal.
    a = np.where(upper, 1 - x, x)
    b = np.where(upper, 1 - y, y)
    weights = np.stack((1 - a - b, a, b)).astype(np.float32)
    places = [
        (0.1 + 0.8 * np.where(upper, np.array(second)[:, None], np.array(first)[:, None])).astype(
            np.float32
        )
        for first, second in (((0, 0), (1, 1)), ((1, 0), (0, 1)), ((0, 1), (1, 0)))
    ]
    uv = np.asarray(made.triangle_uv(weights, *places), np.float32)
    inside = (x >= 0) & (x <= 1) & (y >= 0) & (y <= 1)
    picture = np.where(inside, right.texture_lookup(_letter(8), uv), 1)
    # The diagonal, so that one sees the triangles.
    picture[:, inside & (np.abs(x + y - 1) < 0.008)] = 1
    return _shown(picture)


def _texels(made: ModuleType, _: ModuleType) -> Image.Image:
    u, v = _window((-0.5, 1.75), (-0.25, 1.25))
    inside = (u >= 0) & (u < 1) & (v >= 0) & (v < 1)
    return _shown(made.texture_lookup(_letter(), np.stack((u, v))), inside)


LOOKS = {
    "rectangle_uv": (
        Look("A picture on a rectangle; around it, paler, how it goes on in its plane", _rectangle),
    ),
    "sphere_uv": (
        Look("A globe from two sides", _globe, files=(GLOBE,)),
        Look(
            "u once around the equator; grey below: the right one",
            plot(_longitudes, curve=True),
            ("negative",),
        ),
    ),
    "triangle_uv": (Look("A picture on two triangles", _triangles),),
    "texture_lookup": (
        Look("A picture of 8 x 8 texels; around it, paler, how it repeats", _texels),
    ),
}
