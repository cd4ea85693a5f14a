"""Small lights of an environment that are seen directly: how likely a sample of each pixel meets them."""

import numpy as np

from course.engine.core.environment import CubeEnvironment
from course.engine.core.types import Floats64, Mask
from course.engine.render.adaptive.bright import EVEN
from course.engine.render.adaptive.glimpses import ALL, Chances, averaged
from course.engine.render.adaptive.seen_ahead import CameraAxes, nearest
from course.engine.terms.environments.sampling import FRAMES
from course.engine.terms.world import FullWorld

RARE = 1 / 64
"""Lights are small if so few of all directions lead to them."""

EACH = 64
"""Points of a texel at most."""


def small_lights(world: FullWorld, bright: float) -> Mask | None:
    """Texels (6, S, S) of which a single pixel matters; None where there are none, or where they aren't few.

    ``bright``: mean square of a radiance from which on a pixel of it matters
    """
    if not isinstance(world.environment, CubeEnvironment):
        return None
    square = _squares(world.environment)
    found: Mask = square > max(bright, 4 * float(square.mean()))
    return found if 0 < float(found.mean()) < RARE else None


def stars(world: FullWorld, view: CameraAxes, bright: float) -> Chances:
    """The chances of small lights whose texels are smaller than half a pixel, or what a lens makes of one.

    Each texel counts as even, though between texels radiance is interpolated.
    """
    none = Chances.none(view.height, view.width)
    lights, sky = small_lights(world, bright), world.environment
    if lights is None or not isinstance(sky, CubeEnvironment):
        return none
    texel, lens = 2 / len(sky.faces[0]), view.camera.lens
    blur = 0 if lens is None else 2 * lens.aperture_radius / lens.focus_distance
    if texel >= max(blur, np.sqrt(view.pixel)) / 2:
        return none
    texels = np.argwhere(lights)
    count = len(texels) * int(np.clip(ALL // len(texels), 1, EACH))
    which = np.arange(count) % len(texels)
    face, row, column = texels[which].T
    u = (np.arange(1, count + 1) * EVEN[:, None] + 0.5) % 1
    middle, right, below = FRAMES[face].transpose(1, 2, 0)
    way = middle + ((column + u[0]) * texel - 1) * right + ((row + u[1]) * texel - 1) * below
    eyes, on_lens = view.eyes(u[2:], u[0])
    places, forwards, seen = view.pixels(way, on_lens)
    some = np.flatnonzero(seen)
    some = some[nearest(world, eyes[:, some], way[:, some], u[0, some]).triangle < 0]
    if not len(some):
        return none
    far = np.sqrt((way * way).sum(axis=0))
    # As much of a pixel as a point stands for, on the plane at distance 1.
    share = texel**2 / (far * forwards) ** 3 / view.pixel * (len(texels) / count)
    x, y = np.floor(places[:, some]).astype(np.intp)
    pixel = y * view.width + x
    square = _squares(sky)[lights][which[some]]
    mean, squares = (
        averaged(pixel, share[some] * value, none.mean.shape) for value in (np.sqrt(square), square)
    )
    return Chances(mean, squares, count)


def _squares(sky: CubeEnvironment) -> Floats64:
    """(6, S, S) mean over the channels of the squared radiance."""
    squares: Floats64 = (sky.faces.astype(np.float64) ** 2).mean(axis=-1)
    return squares
