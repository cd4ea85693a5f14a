"""What a recorder notes down while rays are followed: tables with a row for each ray, and the functions' calls.

In the place of its path each ray of a batch has its own number, which the stages hand on as they would the path. So
whatever is drawn, cast or added says which ray it belongs to.
"""

from collections.abc import Iterator
from dataclasses import replace
from typing import Any

import numpy as np

from course.engine.core.counters import Counters
from course.engine.core.direct import Candidates, DirectLight
from course.engine.core.hits import Hits
from course.engine.core.lights.sample import Light, Sample
from course.engine.core.rays import Rays
from course.engine.core.types import Floats32, Indices, Mask, Materials
from course.engine.core.vectors import dot
from course.engine.functions.contracts import contract
from course.engine.recording.asking import Asking
from course.engine.terms.shafts.stage import UNKNOWN

WEIGHTS, RESOLVE = "supersampling.gaussian_weights", "supersampling.resolve"
"""The film asks these, for all samples of a tile."""

LARGEST_ARGUMENT = 16
"""Numbers of an argument that isn't one of each ray's; larger ones, such as pictures, are told by their shape."""


ENVIRONMENT_LIGHT = "environment light"
"""What light from the environment is called that hits ask for."""


class RecordTable:
    """Rows that are added in batches, column by column."""

    def __init__(self) -> None:
        self._batches: list[dict[str, Any]] = []

    def add(self, which: Indices, **columns: Any) -> None:
        """Add rows ``which`` (m,) of arrays (..., n); an array (..., 1) is the same for all, other values too."""
        if len(which) == 0:
            return
        self._batches.append(
            {
                name: (v.take(which, axis=-1) if v.shape[-1] > 1 else v.repeat(len(which), -1))
                if isinstance(v, np.ndarray)
                else [v] * len(which)
                for name, v in columns.items()
            }
        )

    def rows(self) -> Iterator[dict[str, Any]]:
        """All rows, in the order in which they came; a row of an array (3, n) is an array (3,)."""
        for batch in self._batches:
            names = batch.keys()
            columns = [c.T if isinstance(c, np.ndarray) else c for c in batch.values()]
            for row in zip(*columns, strict=True):
                yield dict(zip(names, row, strict=True))


class Recorder:
    """Notes down the rays of some paths of a block, and whatever is asked of the functions of the course.

    Attributes
    ----------
    path : of each ray so far, its path in the block
    ids : the rays, by number, that the columns of the present arrays belong to
    stage : what the functions are called for: "camera", a light's name, "mirrored", "refracted", "bounce", or what
        rays meet ("environment", "surface")
    material : of those rays' hits, where functions are asked for all hits on a material; else None
    shafts : of the tracer, whose rays are all sent; None if it has none
    weights : (pixels, samples) that the film's filter gave the last block; None without one
    asked : "module.function" -> how often it was asked for the recorded rays
    """

    def __init__(self) -> None:
        self.rays, self.hits, self.brought = RecordTable(), RecordTable(), RecordTable()
        self.shadows, self.unlit, self.left_diffuse = RecordTable(), RecordTable(), RecordTable()
        self.drawn, self.calls = RecordTable(), RecordTable()
        self.path: Indices = np.zeros(0, np.intp)
        self.ids: Indices = self.path
        self.stage = "building"
        self.asked: dict[str, int] = {}
        self.material: Materials | None = None
        # What stages tell each other: the hits whose rays were cast last, those rays, and the environment's light.
        self.ids_cast: Indices = self.path
        self.asking: Asking | None = None
        self.weights: Floats32 | None = None
        self.sky: Any = None
        self.shafts: Any = None
        self._wanted: Mask = np.zeros(0, np.bool_)
        self._known: list[tuple[Any, Indices]] = []
        self._block: Any = None
        self._told: set[tuple[str, int]] = set()
        self._asking: set[int] = set()

    def begin_block(self, block: Any, wanted: Mask) -> None:
        """A new block begins, of whose paths those ``wanted`` (block.size,) are recorded."""
        self._block, self._wanted = block, wanted
        self.ids, self.stage = self._number(np.arange(block.size)), "camera"
        self._known.clear()

    def _number(self, path: Indices) -> Indices:
        """New numbers (n,) for rays of paths (n,)."""
        ids = len(self.path) + np.arange(len(path))
        self.path = np.concatenate((self.path, path))
        return ids

    def begin_materials(self, material: Materials, scatter: Any) -> None:
        """Functions will be asked for all hits on a material, one after the other; ``material`` (n,) of the hits."""
        self.material = material
        ask = *getattr(scatter, "rough", ()), *getattr(scatter, "microfacets", ())
        self._asking = {one.material for one in ask}
        self._told.clear()

    def kept(self, ids: Indices) -> Indices:
        """Which of some rays (n,) are recorded, as indices (m,)."""
        return np.flatnonzero(self._wanted.take(self.path.take(ids)))

    def begins(self, rays: Rays, depth: int) -> Rays:
        """See ``Watcher``: number the rays of a batch at a depth."""
        # Camera rays have had their numbers since the block began.
        before = self.ids if rays.path is None else rays.path
        ids = before if depth == 0 else self._number(self.path.take(before))
        pixel, sample = np.divmod(self.path.take(ids), self._block.samples)
        self.rays.add(
            self.kept(ids),
            id=ids,
            parent=np.full(rays.size, -1) if depth == 0 else before,
            pixel=self._block.pixels.take(pixel),
            sample=sample + self._block.first,
            depth=depth,
            origin=rays.origin,
            direction=rays.direction,
            throughput=np.ones((3, 1), np.float32) if rays.throughput is None else rays.throughput,
        )
        if depth > 0:
            self._known.clear()
        self.ids, self.stage = ids, "surface"
        return replace(rays, path=ids)

    def missed(self, rays: Rays, which: Mask) -> None:
        """See ``Watcher``."""
        assert rays.path is not None
        self.ids, self.stage = rays.path.compress(which), "environment"

    def found(self, rays: Rays, met: Mask) -> None:
        """See ``Watcher``."""
        assert rays.path is not None
        self.ids, self.stage = rays.path.compress(met), "surface"

    def asks(self, direct: DirectLight, light: Light, path: Indices | None) -> None:
        """See ``Watcher``; of several lights one may be chosen by each hit, so only some hits ask it."""
        if self._listens(direct):
            assert path is not None
            self.ids, self.stage = path, light.name

    def faced(
        self, direct: DirectLight, hits: Hits, sample: Sample, candidates: Candidates | None
    ) -> None:
        """See ``Watcher``: why hits need no shadow ray."""
        if not self._listens(direct):
            return
        unlit = np.ones(hits.size, np.bool_)
        if candidates is not None:
            unlit[candidates.index] = False
        which = np.flatnonzero(unlit)
        back = np.broadcast_to(dot(hits.ns, sample.to_light) <= 0, hits.size).take(which)
        reason = np.where(back, "surface", "light")
        if direct.shaded is not None:
            front, inside = direct.shaded[0], direct.shaded[-1]
            shows = np.where(hits.entering, front.take(hits.material), inside.take(hits.material))
            reason = np.where(shows.take(which), reason, "material")
        ids = self.ids.take(which)
        self.unlit.add(self.kept(ids), id=ids, light=self.stage, reason=reason)

    def shadowed(
        self, direct: DirectLight, light: Light, hits: Hits, candidates: Candidates, free: Mask
    ) -> None:
        """See ``Watcher``: the shadow rays, what blocks them, and what they bring."""
        if not self._listens(direct):
            return
        sums = direct.reflection.add((None, None), hits, candidates, light.color)
        # A column of shadow rays is a hit or a candidate.
        columns = candidates.index
        if candidates.columns is not None:
            columns = np.arange(len(columns))
        shown = direct.reflection.reflected(hits, sums)
        # Probes of shafts are none of the picture's rays.
        told = self.shafts and self.shafts.states(light, hits, candidates, Counters())
        told = np.full(len(free), UNKNOWN) if told is None else told
        facts = free.take(columns), told.take(columns)
        self.tell_shadows(shown, light.name, candidates.index, columns, *facts)

    def tell_shadows(
        self,
        shown: Floats32,
        light: str,
        which: Indices,
        columns: Indices,
        free: Any = None,
        shaft: Any = UNKNOWN,
    ) -> None:
        """Tell of m shadow rays: hits, columns among those asked, radiance (3, n) of all hits, and what shafts told."""
        assert self.asking is not None
        origin, direction, far, triangle = self.asking.blockers(columns)
        ids = self.ids.take(which)
        self.shadows.add(
            self.kept(ids),
            id=ids,
            light=light,
            origin=origin,
            direction=direction,
            limit=self.asking.last[2],
            far=far,
            free=self.asking.last[3].take(columns) if free is None else free,
            triangle=triangle,
            shaft=shaft,
            value=shown.take(which, axis=1),
        )

    def _listens(self, direct: DirectLight) -> bool:
        """Whether a stage's light is told by its rays: not that of lobes, which have rays of their own."""
        asked: Any = direct.surface.accelerator
        return asked is self.asking

    def bounces(self, path: Indices | None) -> None:
        """See ``Watcher``."""
        self.stage = "bounce"
        if path is not None:
            self.left_diffuse.add(self.kept(path), id=path)

    def met(self, path: Indices, hits: Hits, throughput: Floats32 | None) -> None:
        """See ``Watcher``."""
        ids = self.ids = path
        arriving = np.ones((3, 1), np.float32) if throughput is None else throughput
        self.hits.add(
            self.kept(ids),
            id=ids,
            p=hits.p,
            near=hits.near_origin,
            triangle=hits.triangle,
            material=hits.material,
            throughput=arriving,
        )

    def stopped(self, path: Indices, points: Floats32, throughput: Floats32) -> None:
        """See ``FogWatcher``."""
        nothing = np.full(len(path), -1)
        self.hits.add(
            self.kept(path),
            id=path,
            p=points,
            near=points,
            triangle=nothing,
            material=nothing,
            throughput=throughput,
        )

    def sought(
        self, path: Indices, light: str, ways: tuple[Any, Any], ends: tuple[Any, Any], value: Any
    ) -> None:
        """See ``FogWatcher``."""
        self.shadows.add(
            self.kept(path),
            id=path,
            light=light or ENVIRONMENT_LIGHT,
            origin=ways[0],
            direction=ways[1],
            limit=np.maximum(ends[1], 1.0),
            far=ends[1],
            free=ends[0] < 0,
            triangle=ends[0],
            shaft=UNKNOWN,
            value=value,
        )

    def add(self, ids: Indices, radiance: Floats32, throughput: Floats32 | None) -> None:
        """Radiance (3, n) that rays bring to their hits, times throughput (3, n), None for 1."""
        value = radiance if throughput is None else radiance * throughput
        self.brought.add(self.kept(ids), id=ids, value=value)

    def draw(self, name: str, ids: Indices, u: Floats32) -> None:
        """Numbers (width, n) that rays ``ids`` (n,) have drawn."""
        self.knows(u, ids)
        self.drawn.add(self.kept(ids), id=ids, name=name, u=u)

    def knows(self, array: Any, ids: Indices) -> None:
        """The columns of an array belong to these rays, and so do those of a call that is given it or a slice of it."""
        self._known.append((array, ids))

    def called(self, name: str, arguments: tuple[Any, ...], result: Any) -> None:
        """The function "module.function" was called."""
        if self.asking is not None and self.asking.muted:
            return
        if name == WEIGHTS:
            self.weights = result
        # The film's arrays may share memory with what is known of other rays.
        ids = None if name in (WEIGHTS, RESOLVE) else self._columns(name, arguments)
        if ids is None:
            # A pattern of samples, or a part of what is known: it isn't said which.
            self.asked[name] = self.asked.get(name, 0) + 1
            return
        results = result if isinstance(result, tuple | list) else (result,)
        self._known += [(r, ids) for r in results if isinstance(r, np.ndarray)]
        kept = self.kept(ids)
        self.asked[name] = self.asked.get(name, 0) + len(kept)
        known = contract(name)
        named = zip([n for n, _ in known.arguments], arguments, strict=False)
        columns = {f"argument {n}": _column(value, len(ids)) for n, value in named}
        given = zip(known.results, results, strict=False)
        columns |= {f"result {r.name}": _column(value, len(ids)) for r, value in given}
        self.calls.add(kept, id=ids, function=name, stage=self.stage, **columns)

    def _columns(self, name: str, arguments: tuple[Any, ...]) -> Indices | None:
        """The rays that the columns of a call belong to: those of an array that was drawn or made before, or all."""
        size = contract(name).sizes(arguments).get("N")
        if size is None:
            return None
        arrays = [a for a in arguments if isinstance(a, np.ndarray)]
        columns: Indices
        for known, columns in reversed(self._known):
            for array in (a for a in arrays if np.may_share_memory(a, known)):
                # Hits may be looked at some at a time.
                first = 0 if len(columns) == size else _begins(array, known)
                if first is not None and first + size <= len(columns):
                    return columns[first : first + size]
        if len(self.ids) == size:
            return self.ids
        if self.material is None:
            return None
        materials, counts = np.unique(self.material, return_counts=True)
        some = [m for m in materials[counts == size].tolist() if m in self._asking]
        if len(some) > 1:
            # As many hits of each: functions are asked for one material after the other.
            some = [m for m in some if (name, m) not in self._told]
        if not some:
            return None
        self._told.add((name, some[0]))
        return self.ids.compress(self.material == some[0])


def _begins(part: Any, whole: Any) -> int | None:
    """The column of an array (..., n) at which a slice of it begins; None where it is none of some columns."""
    size = whole.itemsize
    if part.dtype != whole.dtype or {part.strides[-1], whole.strides[-1]} != {size}:
        return None
    begin = part.__array_interface__["data"][0] - whole.__array_interface__["data"][0]
    row = whole.strides[-2] if whole.ndim > 1 else whole.nbytes
    return int(begin % row // size) if 0 <= begin < whole.nbytes else None


def _column(value: Any, columns: int) -> Any:
    """A value with a column for each ray; else a number, a list of numbers, or how a large array looks."""
    if not isinstance(value, np.ndarray):
        return float(value) if isinstance(value, int | float | np.number) else type(value).__name__
    if value.ndim and value.shape[-1] == columns and value.ndim < 3:
        return value
    return value.tolist() if value.size <= LARGEST_ARGUMENT else f"{value.dtype} {value.shape}"
