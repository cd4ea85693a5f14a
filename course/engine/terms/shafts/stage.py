"""Shadow rays that need not be sent: those of a cell from which a whole light is seen, or none of it.

What a shaft says holds for every way in it, so the picture keeps its bits. Answers are kept by cell and light, so that
each shaft is looked at once, however many samples lie in it.
"""

from collections.abc import Callable
from dataclasses import dataclass, field, replace
from functools import cached_property, partial
from threading import Lock
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from course.engine.core.accelerator import StaticAccelerator
from course.engine.core.camera import Camera
from course.engine.core.counters import Counters
from course.engine.core.direct import Candidates
from course.engine.core.hits import Hits, Surface
from course.engine.core.integrator import Integrator
from course.engine.core.lights.sample import Light
from course.engine.core.motion import MovingAccelerator
from course.engine.core.rays import Draws
from course.engine.core.tracer import Tracer
from course.engine.core.types import Indices, Mask
from course.engine.core.vectors import dot, repeated
from course.engine.terms.lights.own_lamp import LampAccelerator
from course.engine.terms.shafts.boxes import Boxes, boxes_of
from course.engine.terms.shafts.cells import OUTSIDE, Cells, Keys, cells_of, keys_of
from course.engine.terms.shafts.lamps import LampRegion, holds, lamp_of
from course.engine.terms.shafts.walk import CLEAR, CUT_OFF, MIXED, shaft_states
from course.engine.terms.surfaces.swept_movers import SweptMovers

REASONS = ("clear", "cut off")
"""Why shadow rays aren't sent: nothing is in their shaft; one triangle blocks all of it."""

UNKNOWN = 0
"""What is known of a ray without a shaft."""

PROBES = 8
"""Places of the table at which an answer may stand, from the one on that its key tells."""

MULTIPLIER = np.uint64(0x9E3779B97F4A7C15)
"""Spreads keys over the table: 2^64 over the golden ratio."""

MOST_LIGHTS, MOST_OBJECTS, MOST_TRIANGLES = 16, 2048, 1_000_000
"""Scenes with more of them have no shafts: these would take too long to make, or too much memory."""

WORTH = 1_000_000
"""Samples of a picture from which on it has shafts: fewer rays cost less than the boxes around triangles."""

SAMPLES_A_TRIANGLE = 16
"""The same, by the number of triangles."""

EXPECTED = 16
"""Samples of a pixel that are counted on where they go where the error is."""

RAYS_A_CELL = 2048
"""Samples that a cell is to have: so many rays cost a hundred times what its shaft does."""

NARROWEST, WIDEST = 2.0, 16.0
"""Widths of cells in pixels: narrower ones find little more, wider ones little at all."""

_ROOM_IN_TABLE, _SMALLEST, _LARGEST = 8, 1 << 12, 1 << 20
"""Places in a table, by the cells that a picture may show; at least; and at most of all lights together."""


class ShaftTables(NamedTuple):
    """What is known of a scene.

    Attributes
    ----------
    slots : ``id`` of a light -> its row; lights that stand for the cells of one lamp have one name
    lamps : of each row
    known : (rows, n) uint64, n a power of two: cells' keys times 4, plus what their shafts are; 0 for nothing yet.
        Threads write to it without a lock: each place is written at once, and whoever writes there has the same answer
    """

    cells: Cells
    boxes: Boxes
    slots: dict[int, int]
    lamps: list[LampRegion]
    known: NDArray[np.uint64]


@dataclass(frozen=True)
class Shafts:
    """Shadow rays that need not be sent.

    Attributes
    ----------
    surface, camera, lights : of the scene
    pixels : width of a cell
    places : of the table of each light
    """

    surface: Surface
    camera: Camera
    lights: tuple[Light, ...]
    pixels: float
    places: int

    lock: Any = field(default_factory=Lock, repr=False)

    @property
    def made(self) -> ShaftTables | None:
        """The tables, made by the first thread that asks."""
        with self.lock:
            return self.tables

    @cached_property
    def tables(self) -> ShaftTables | None:
        """Made when they are first asked for; None where no light or no triangle has shafts."""
        triangles, accelerator = self.surface.triangles, self.surface.accelerator
        found = {id(light): lamp_of(light) for light in self.lights}
        lamps = {light: lamp for light, lamp in found.items() if lamp is not None}
        boxes = boxes_of(accelerator, triangles) if lamps else None
        if boxes is None:
            return None
        static = accelerator.static if isinstance(accelerator, MovingAccelerator) else accelerator
        assert isinstance(static, StaticAccelerator)
        cells = cells_of(boxes, triangles, len(static.triangles), self.camera, self.pixels)
        slots = {light: number for number, light in enumerate(lamps)}
        known = np.zeros((len(lamps), self.places), np.uint64)
        return ShaftTables(cells, boxes, slots, list(lamps.values()), known)

    def __call__(
        self,
        ask: Callable[[Light, Hits, Candidates, Draws], Mask],
        light: Light,
        hits: Hits,
        candidates: Candidates,
        draws: Draws,
    ) -> Mask:
        """Visibility of a light, (k,), as ``ask`` tells it; what a shaft tells isn't asked."""
        states = self.states(light, hits, candidates, draws.counters)
        if states is None:
            return ask(light, hits, candidates, draws)
        free: Mask = np.asarray(states == CLEAR)
        told = free | (states == CUT_OFF)
        if candidates.mask is not None:
            told &= candidates.mask
        if not told.any():
            return ask(light, hits, candidates, draws)
        spared = draws.counters.spared
        known = int(np.count_nonzero(told & free)), int(np.count_nonzero(told & ~free))
        spared.update(dict(zip(REASONS, known, strict=True)))
        draws.counters.rays["shadow"] -= sum(known)
        asked = ~told if candidates.mask is None else candidates.mask & ~told
        which = np.flatnonzero(asked)
        if len(which):
            free[which] = ask(light, hits, _some(candidates, which), draws)
        return free

    def states(
        self, light: Light, hits: Hits, candidates: Candidates, counters: Counters
    ) -> NDArray[np.int8] | None:
        """UNKNOWN, CLEAR, MIXED or CUT_OFF, (k,), for the shafts of candidates' rays; None if the light has none."""
        tables = self.made
        if tables is None or id(light) not in tables.slots:
            return None
        row = tables.slots[id(light)]
        of, lamp = candidates.of, tables.lamps[row]
        p, to_light = of(hits.p), candidates.to_light
        # ---- a ray must leave its surface, towards where the light's points may lie, while the shutter is open
        certain = dot(of(hits.ng), to_light) > 2 * of(hits.offset)
        if light.width and not lamp.far:
            certain &= holds(lamp, p + to_light)
        if hits.time is not None:
            time = of(hits.time)
            certain &= (time >= 0) & (time <= 1)
        key = keys_of(tables.cells, p, of(hits.triangle), of(hits.side))
        key[~certain] = OUTSIDE
        if candidates.mask is not None:
            key[~candidates.mask] = OUTSIDE
        # Samples of a pixel come one after the other, and most lie in the same cell.
        begins = np.flatnonzero(np.concatenate(([True], key[1:] != key[:-1])))
        ends = np.append(begins[1:], len(key))
        probe = partial(self._probe, light, hits, candidates, counters)
        states = self._look_up(tables, row, key.take(begins), (begins, ends - 1), probe)
        return np.repeat(states, ends - begins)

    def _probe(
        self,
        light: Light,
        hits: Hits,
        candidates: Candidates,
        counters: Counters,
        which: Indices,
    ) -> Mask:
        """Which of some candidates' rays (m,) are free."""
        time = None if hits.time is None else candidates.of(hits.time).take(which)
        to_light = candidates.to_light
        to_light = to_light if to_light.shape[1] == 1 else to_light.take(which, axis=1)
        counters.spared["probes"] += len(which)
        return self.surface.accelerator.unoccluded(
            candidates.origin.take(which, axis=1),
            repeated(to_light, len(which)),
            light.limit,
            counters.embree,
            time,
        )

    def _look_up(
        self,
        tables: ShaftTables,
        row: int,
        key: Keys,
        rays: tuple[Indices, Indices],
        probe: Callable[[Indices], Mask],
    ) -> NDArray[np.int8]:
        """What is known of cells (n,), of which two ``rays`` (n,) each are known."""
        table, mask = tables.known[row], np.int64(self.places - 1)
        states = np.full(len(key), UNKNOWN, np.int8)
        left = np.flatnonzero(key != OUTSIDE)
        place = first_place(key.take(left), self.places)
        missing = []
        for _ in range(PROBES):
            found = table.take(place)
            same = (found >> np.uint64(2)).astype(np.int64) == key.take(left)
            states[left.compress(same)] = (found.compress(same) & np.uint64(3)).astype(np.int8)
            missing.append(left.compress(found == 0))
            on = ~same & (found != 0)
            left, place = left.compress(on), (place.compress(on) + 1) & mask
        new = np.concatenate(missing)
        if len(new):
            keys, first, which = np.unique(key.take(new), return_index=True, return_inverse=True)
            one, other = (probe(each.take(new.take(first))) for each in rays)
            # Where one ray is blocked and another isn't, there is nothing to look for.
            told = np.full(len(keys), MIXED, np.int8)
            alike = np.flatnonzero(one == other)
            known = tables.cells, tables.boxes, tables.lamps[row]
            told[alike] = shaft_states(*known, keys.take(alike))
            states[new] = told.take(which)
            self._keep(table, keys, told)
        return states

    def _keep(self, table: NDArray[np.uint64], keys: Keys, states: NDArray[np.int8]) -> None:
        entry = (keys << 2 | states).astype(np.uint64)
        place = first_place(keys, self.places)
        for _ in range(PROBES):
            empty = table.take(place) == 0
            table[place.compress(empty)] = entry.compress(empty)
            left = np.flatnonzero(table.take(place) != entry)
            entry, place = entry.take(left), (place.take(left) + 1) & np.int64(self.places - 1)


def first_place(key: Keys, places: int) -> Indices:
    """Where keys (n,) begin to look, in a table with a power of two of places."""
    spread = key.astype(np.uint64) * MULTIPLIER
    return (spread >> np.uint64(65 - places.bit_length())).astype(np.int64)


def _some(candidates: Candidates, which: Indices) -> Candidates:
    """Some columns (m,) of candidates."""
    columns = candidates.hit(which)
    arrays = (
        *(candidates.irradiance, candidates.cosine, candidates.origin),
        *(candidates.to_light, candidates.inverse_length),
    )
    some = [a if a.shape[-1] == 1 else a.take(which, axis=-1) for a in arrays]
    return Candidates(columns, columns, None, *some)


def sparing(tracer: Tracer) -> Tracer:
    """The tracer, with shafts where its picture is large enough."""
    settings = tracer.settings
    samples = settings.samples if tracer.costs is None else min(settings.samples, EXPECTED)
    pixels = settings.width * settings.height
    return replace(tracer, integrator=with_shafts(tracer.integrator, pixels, samples))


def with_shafts(integrator: Integrator, pixels: int, samples: int) -> Integrator:
    """The integrator, with shafts where they are worth their making.

    Parameters
    ----------
    pixels : of the picture
    samples : of each that are to be expected
    """
    direct, surface = integrator.direct, integrator.surface
    rays = pixels * samples
    triangles = len(surface.triangles.material)
    if direct is None or direct.spare is not None or rays < WORTH:
        return integrator
    if not 0 < len(direct.lights) <= MOST_LIGHTS:
        return integrator
    if len(surface.triangles.parts) > MOST_OBJECTS or triangles > MOST_TRIANGLES:
        return integrator
    if type(surface.accelerator) not in (StaticAccelerator, LampAccelerator, SweptMovers):
        return integrator
    if rays < SAMPLES_A_TRIANGLE * triangles:
        return integrator
    wide = min(max((RAYS_A_CELL / samples) ** 0.5, NARROWEST), WIDEST)
    wanted = _ROOM_IN_TABLE * pixels / wide**2 * (1 if integrator.max_depth == 0 else 2)
    largest = _LARGEST // len(direct.lights)
    places = 1 << min(max(int(wanted), _SMALLEST), largest).bit_length() - 1
    shafts = Shafts(surface, integrator.camera, direct.lights, wide, places)
    return replace(integrator, direct=replace(direct, spare=shafts))
