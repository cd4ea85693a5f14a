"""Directions towards a picture's light by the functions of the `environment_light` module.

The functions get the environment as it is looked up, longitude by latitude, each texel the mean of itself and its eight
neighbours. So a texel has weight wherever an interpolated lookup finds light. And densities of neighbours differ by
little, so that a direction whose rounding takes it across a border has nearly the right one.
"""

from dataclasses import dataclass
from math import ceil

import numpy as np

from course.engine.core.environment import Environment
from course.engine.core.types import Floats32, Floats64, Functions, Indices
from course.engine.core.vectors import dot

FINEST = 256
"""Most rows of the picture."""

OF_ONE_COLOR = 8
"""Rows where the environment has the same radiance everywhere."""


@dataclass(frozen=True)
class PictureSampling:
    """Draws directions by inversion, or by an alias table.

    Attributes
    ----------
    environment_light : functions of the module
    weights : (H, W) of the texels
    tables : rows and columns of ``cumulate``, or probability and alias of ``alias_table``
    by_alias : which of them
    """

    environment_light: Functions
    weights: Floats32
    tables: tuple[Floats64, Floats64]
    by_alias: bool

    def sample(self, normal: Floats32, u: Floats32) -> tuple[Floats32, Floats32]:
        """See ``course.engine.terms.environments.sky.SkySampling``."""
        if self.by_alias:
            texel, rest = self.environment_light.draw_alias(
                *self.tables, np.ascontiguousarray(u[0])
            )
            direction = _in_texels(texel, rest, u[1], *self.weights.shape)
        else:
            u = np.ascontiguousarray(u)
            direction = self.environment_light.sample_direction(*self.tables, u)
        density = self.environment_light.density(self.weights, direction)
        scale = density * np.float32(np.pi)
        cosine = dot(normal, direction)
        weight = np.divide(cosine, scale, out=np.zeros_like(cosine), where=scale > 0)
        return direction, weight


def picture_sampling(
    environment: Environment, functions: Functions, by_alias: bool
) -> PictureSampling:
    """The sampling of an environment that isn't black."""
    weights = functions.texel_weights(_picture(environment))
    tables = functions.alias_table(weights.ravel()) if by_alias else functions.cumulate(weights)
    return PictureSampling(functions, weights, tables, by_alias)


def _picture(environment: Environment) -> Floats32:
    """Radiance (H, 2 H, 3): means over the texels, and then over each with its neighbours."""
    faces = getattr(environment, "faces", None)
    finest = OF_ONE_COLOR if faces is None else 2 * faces.shape[1]
    # Each of the cube's texels is looked at, however large the picture's are.
    parts = ceil(finest / FINEST)
    height = ceil(finest / parts)
    rows = []
    for row in range(height):
        y, x = np.mgrid[row * parts : (row + 1) * parts, : 2 * height * parts] + 0.5
        theta, phi = np.pi * y / (height * parts), np.pi * (x / (height * parts) - 1)
        direction = np.stack(
            (np.sin(theta) * np.sin(phi), np.cos(theta), -np.sin(theta) * np.cos(phi))
        )
        flat = np.ascontiguousarray(direction.reshape(3, -1), np.float32)
        found = np.broadcast_to(environment.radiance(flat), flat.shape)
        rows.append(found.reshape(3, parts, 2 * height, parts).mean(axis=(1, 3)).T)
    picture = np.stack(rows)
    padded = np.pad(picture, ((1, 1), (0, 0), (0, 0)), mode="edge")
    padded = np.pad(padded, ((0, 0), (1, 1), (0, 0)), mode="wrap")
    size = picture.shape[:2]
    blocks = np.lib.stride_tricks.sliding_window_view(padded, (3, 3), axis=(0, 1))
    return np.asarray(blocks.reshape(*size, 3, 9).mean(axis=3, dtype=np.float64), np.float32)


def _in_texels(
    texel: Indices, down: Floats32, along: Floats32, height: int, width: int
) -> Floats32:
    """Directions (3, n) that are uniform over the solid angles of texels (n,), by numbers (n,) in [0, 1]."""
    row, column = np.divmod(texel, width)
    heights = np.cos(np.linspace(0, np.pi, height + 1))
    up = heights[row] + down * np.diff(heights)[row]
    azimuth = np.pi * (2 * (column + along) / width - 1)
    radius = np.sqrt((1 - up) * (1 + up))
    direction = np.stack((radius * np.sin(azimuth), up, -radius * np.cos(azimuth)))
    return direction.astype(np.float32)
