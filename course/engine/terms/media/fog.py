"""Fog in boxes and balls: where rays are in it, how much light gets through, where it is scattered and how much."""

from dataclasses import dataclass

import numpy as np

from course.engine.core.types import Floats32, Functions, Mask
from course.engine.terms.media.bounds import Ball, Box
from course.engine.terms.media.tracking import DensityGrid

EVEN = np.full(3, 1 / 3, np.float32)
"""How probable each channel is to choose a distance."""

NOTHING_LEFT = 100.0
"""Optical thickness after which float32 has no light left: an endless way through fog ends there."""


@dataclass(frozen=True)
class Fog:
    """A medium within bounds.

    Attributes
    ----------
    bounds : where it is
    extinction : (3,) float32 [1 / unit of the compiled scene]; with a grid, what it is times the grid's density
    albedo : (3,) float32, the share of what is stopped that is scattered
    g : mean cosine of the phase function
    media : functions of the module
    grid : densities, of a box; None where the medium is even
    """

    bounds: Box | Ball
    extinction: Floats32
    albedo: Floats32
    g: float
    media: Functions
    grid: DensityGrid | None = None

    @property
    def scattering(self) -> Floats32:
        """(3,) [1 / unit of the compiled scene]."""
        return self.extinction * self.albedo

    def span(
        self, origin: Floats32, direction: Floats32, limit: Floats32
    ) -> tuple[Floats32, Floats32]:
        """Where rays (3, n) with unit directions come into it, and how far they are in it, (n,); 0 if not at all."""
        first, last = self.bounds.between(origin, direction)
        length = np.minimum(last, limit) - first
        inside = length > 0
        start = np.where(inside, first, 0).astype(np.float32)
        return start, np.where(inside, np.minimum(length, self._end()), 0).astype(np.float32)

    def transmittance(self, origin: Floats32, direction: Floats32, limit: Floats32) -> Floats32:
        """Share (3, n) of the light that gets through, along unit directions up to limits (n,)."""
        start, length = self.span(origin, direction, limit)
        if self.grid is None:
            found: Floats32 = self.media.transmittance(self.extinction, length)
            return found
        return np.repeat(self._through_grid(origin, direction, start, length)[None], 3, axis=0)

    def _through_grid(
        self, origin: Floats32, direction: Floats32, start: Floats32, length: Floats32
    ) -> Floats32:
        assert self.grid is not None
        return self.grid.transmittance(*self._in_cube(origin, direction, start), length)

    def flights(
        self, origin: Floats32, direction: Floats32, start: Floats32, length: Floats32, u: Floats32
    ) -> tuple[Floats32, Mask, Floats32]:
        """Flights from where rays come into it, through at most ``length`` (n,) of it.

        Returns
        -------
        distance : (n,), from the ray's origin; where it isn't stopped it doesn't matter
        stopped : (n,)
        weight : (3, n), what the light is worth that was stopped and is scattered, or else that goes on
        """
        if self.grid is not None:
            flown, stopped = self.grid.flights(*self._in_cube(origin, direction, start), length)
            return start + flown, stopped, np.where(stopped, self.albedo[:, None], 1)
        media, sigma = self.media, self.extinction
        flown = media.free_flight(sigma, EVEN, u)
        stopped = flown < length
        flown = np.minimum(flown, length)
        left = media.transmittance(sigma, flown)
        density = media.free_flight_pdf(sigma, EVEN, flown)
        passes = EVEN @ left
        worth = np.where(stopped, self.scattering[:, None] * left, left)
        odds = np.where(stopped, density, passes)
        weight = np.divide(worth, odds, out=np.zeros_like(worth), where=odds > 0)
        return start + flown, stopped, weight

    def density_at(self, points: Floats32) -> Floats32 | None:
        """What the extinction is times, (n,), at points (3, n) within; None where the medium is even."""
        if self.grid is None:
            return None
        low, size = self._box()
        found: Floats32 = self.grid.at((points - low) / size)
        return np.asarray(found / self.extinction.max(), np.float32)

    def _in_cube(
        self, origin: Floats32, direction: Floats32, start: Floats32
    ) -> tuple[Floats32, Floats32]:
        """Origins at the box, and directions, in the cube that the box is to its grid."""
        low, size = self._box()
        return (origin + start * direction - low) / size, direction / size

    def _box(self) -> tuple[Floats32, Floats32]:
        """Lowest corner and size (3, 1) of what a grid fills."""
        assert isinstance(self.bounds, Box)
        return self.bounds.low[:, None], (self.bounds.high - self.bounds.low)[:, None]

    def _end(self) -> np.float32:
        thinnest = self.extinction[self.extinction > 0]
        return np.float32(NOTHING_LEFT / thinnest.min() if len(thinnest) else 1)


@dataclass(frozen=True)
class Fogs:
    """Boxes and balls of fog that don't overlap."""

    all: tuple[Fog, ...] = ()

    def transmittance(self, origin: Floats32, direction: Floats32, limit: Floats32) -> Floats32:
        """Share (3, n) of the light that gets through all of them; see ``Fog.transmittance``."""
        found = np.ones((3, direction.shape[1]), np.float32)
        for fog in self.all:
            found *= fog.transmittance(origin, direction, limit)
        return found


NO_FOG = Fogs()
