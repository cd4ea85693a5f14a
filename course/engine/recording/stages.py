"""Stages that tell a recorder what they do, in the place of a tracer's; the core knows nothing of them."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from course.engine.core.direct import DirectLight
from course.engine.core.hits import Hits
from course.engine.core.integrator import Integrator
from course.engine.core.rays import Draws
from course.engine.core.scatter import Boundary, Scatter
from course.engine.core.tracer import Tracer
from course.engine.core.types import Floats32, Indices, Numbers
from course.engine.functions.effects import Effects
from course.engine.functions.own import Watched
from course.engine.recording.asking import Asking
from course.engine.recording.recorder import ENVIRONMENT_LIGHT, Recorder
from course.engine.terms.environments.sky import Sky
from course.engine.terms.lights.light_tree import TreeChoice
from course.engine.terms.paths.path_tracing import PathIntegrator
from course.engine.terms.plan import same_fields
from course.engine.terms.shafts.stage import sparing
from course.engine.terms.surfaces.painting import ColorAt, Painting

SPREAD = 64
"""Numbers of a result that are kept, of a call while a scene is built."""

MOST_RESULTS = 8
"""Of a function that are kept then."""


class RecordedEffects(Effects):
    """The same functions; a scene that is loaded with them can be recorded without being compiled again.

    Attributes
    ----------
    recorder : notes down their calls; None where there is none
    built : "module.function" -> for its first results while the scene was built, the size of each and some of its
        numbers, evenly spread
    """

    def __init__(self, effects: Effects) -> None:
        vars(self).update(vars(effects))
        self._recorded = effects
        self.recorder: Recorder | None = None
        self.built: dict[str, list[list[Any]]] = {}
        self._building = False

    @contextmanager
    def building(self) -> Iterator[None]:
        """Note down what functions return meanwhile, and forget what was noted before."""
        self.built, self._building = {}, True
        try:
            yield
        finally:
            self._building = False

    def function(self, module: str, name: str) -> Callable[..., Any]:
        """See ``Effects``."""

        def note(arguments: tuple[Any, ...], result: Any) -> None:
            if self.recorder is not None:
                self.recorder.called(f"{module}.{name}", arguments, result)
            elif self._building:
                known = self.built.setdefault(f"{module}.{name}", [])
                known += _some_numbers(result)[: max(MOST_RESULTS - len(known), 0)]

        return Watched(self._recorded.function(module, name), note)

    def written(self, module: str, name: str) -> bool:
        """See ``Effects``."""
        return self._recorded.written(module, name)


def _some_numbers(result: Any) -> list[list[Any]]:
    """Of each result that is an array, its size and at most SPREAD of its numbers."""
    found = []
    for each in result if isinstance(result, tuple | list) else (result,):
        if isinstance(each, np.ndarray) and each.size and each.dtype.kind in "biuf":
            places = np.linspace(0, each.size - 1, min(each.size, SPREAD)).astype(int)
            found.append([each.size, each.ravel().take(places).astype(np.float64)])
    return found


@dataclass(frozen=True)
class RecordedDraws(Draws):
    """Draws numbers for rays that have numbers of their own in the place of their paths."""

    @property
    def recorder(self) -> Recorder:
        """The watcher, which numbers the rays."""
        assert isinstance(self.watcher, Recorder)
        return self.watcher

    def __call__(
        self,
        name: str,
        path: Indices | None = None,
        depth: int = 0,
        width: int | None = None,
        skip: int = 0,
    ) -> Floats32:
        """See ``Draws``."""
        recorder = self.recorder
        ids = recorder.ids if path is None else path
        u = super().__call__(
            name, None if path is None else recorder.path.take(path), depth, width, skip
        )
        recorder.draw(name, ids, u)
        return u

    def cast(
        self,
        kind: str,
        n: int,
        path: Indices | None,
        which: Indices | None = None,
        cost: float | None = None,
    ) -> None:
        """See ``Draws``."""
        super().cast(kind, n, path, which, cost)
        if path is not None:
            self.recorder.ids_cast = path if which is None else path.take(which)


def recorded(tracer: Tracer, recorder: Recorder, shafts: bool = False) -> Tracer:
    """The tracer with stages that tell the recorder what they do; with ``shafts``, what these would have told, too."""
    integrator = tracer.integrator
    changed: dict[str, Any] = {}
    if integrator.direct is not None:
        asking = Asking(integrator.surface.accelerator)
        recorder.asking = asking
        seen: dict[str, Any] = same_fields(integrator.surface) | {"accelerator": asking}
        # All rays are sent.
        direct = sparing(tracer).integrator.direct if shafts else None
        recorder.shafts = None if direct is None else direct.spare
        seen = {"surface": type(integrator.surface)(**seen), "spare": None}
        seen["sky"] = _sky(integrator.direct.sky, recorder, seen["surface"])
        choice = getattr(integrator.direct, "choice", None)
        if choice is not None:
            # Each light by itself, so that its rays have its name.
            seen["choice"] = replace(choice, together=False)
            if isinstance(choice, TreeChoice):
                seen["choice"] = _recorded_walk(seen["choice"], recorder)
        changed["direct"] = _as(RecordedDirect, integrator.direct, recorder, **seen)
    if integrator.scatter is not None:
        changed["scatter"] = _as(RecordedScatter, integrator.scatter, recorder)
    if isinstance(integrator, PathIntegrator):
        changed["bounce"] = replace(integrator.bounce, scatter=changed.get("scatter"))
    surface: Any = integrator.surface
    if (painting := getattr(surface, "painting", None)) is not None:
        noted = _as(RecordedPainting, painting, recorder)
        changed["surface"] = replace(surface, painting=noted)
    return replace(tracer, integrator=_as(RecordedIntegrator, integrator, recorder, **changed))


def _sky(sky: Any, recorder: Recorder, surface: Any) -> Any:
    """What tells of light from the environment, and in a term that adds to it, too."""
    if sky is None or isinstance(sky, Sky):
        return None if sky is None else _as(RecordedSky, sky, recorder, surface=surface)
    return replace(sky, sky=_sky(sky.sky, recorder, surface))


def _as(kind: type, stage: Any, recorder: Recorder, **changed: Any) -> Any:
    """A stage of the same class, with what a recorded one does before or after."""
    cls = type(kind.__name__, (kind, type(stage)), {"recorder": recorder})
    return cls(**same_fields(stage) | changed)


class RecordedIntegrator(Integrator):
    """Numbers rays, and tells what they meet and bring."""

    recorder: Recorder

    def add_radiance(
        self,
        path_radiance: Floats32,
        path: Indices | None,
        radiance: Floats32,
        throughput: Floats32 | None,
    ) -> None:
        """See ``Integrator``."""
        assert path is not None
        self.recorder.add(path, radiance, throughput)
        super().add_radiance(path_radiance, self.recorder.path.take(path), radiance, throughput)


class RecordedPainting(Painting):
    """Tells which hits a texture is asked about."""

    recorder: Recorder

    def painted(
        self, triangle: Numbers, u: Floats32, v: Floats32
    ) -> Iterator[tuple[Indices, ColorAt, Floats32, Floats32]]:
        """See ``Painting``."""
        ids = self.recorder.ids
        for which, color_at, weights, corners in super().painted(triangle, u, v):
            self.recorder.ids = ids.take(which)
            yield which, color_at, weights, corners
        self.recorder.ids = ids


class RecordedDirect(DirectLight):
    """Tells of the shadow rays to each light, and of the hits that need none."""

    recorder: Recorder

    def __call__(
        self, hits: Hits, path: Indices | None, depth: int, draws: Draws
    ) -> Floats32 | None:
        """See ``DirectLight``."""
        assert path is not None
        recorder = self.recorder
        recorder.ids, recorder.sky = path, None
        radiance = super().__call__(hits, path, depth, draws)
        recorder.ids, recorder.stage = path, "surface"
        if recorder.sky is not None:
            irradiance, which, places = recorder.sky
            shown = self.reflection.reflected(hits, (irradiance, None))
            recorder.tell_shadows(shown, ENVIRONMENT_LIGHT, which, places)
        return radiance


def _recorded_walk(choice: TreeChoice, recorder: Recorder) -> TreeChoice:
    """The choice, whose walk tells which hits walk down the tree."""
    walk = choice.walk

    def told(
        p: Floats32, n: Floats32, u: Floats32, which: Indices | None
    ) -> tuple[Indices, Floats32]:
        assert walk is not None
        recorder.knows(u, recorder.ids if which is None else recorder.ids.take(which))
        return walk(p, n, u, which)

    return replace(choice, walk=None if walk is None else told)


class RecordedSky(Sky):
    """Tells which hits ask for light from the environment, and what they get."""

    recorder: Recorder

    def __call__(
        self, hits: Hits, path: Indices | None, depth: int, draws: Draws
    ) -> Floats32 | None:
        """See ``Sky``."""
        recorder = self.recorder
        recorder.stage, recorder.ids_cast = ENVIRONMENT_LIGHT, np.zeros(0, np.intp)
        irradiance = super().__call__(hits, path, depth, draws)
        cast = recorder.ids_cast
        if len(cast):
            shown = np.zeros((3, hits.size), np.float32) if irradiance is None else irradiance
            # The rays are numbered in the order of the hits.
            which = np.searchsorted(recorder.ids, cast)
            recorder.sky = shown.copy(), which, np.arange(len(cast))
        return irradiance


class RecordedScatter(Scatter):
    """Tells the functions' calls for mirrored rays from those for refracted ones."""

    recorder: Recorder

    def boundary(
        self, hits: Hits, which: Indices | None, path: Indices | None, depth: int, draws: Draws
    ) -> Boundary:
        """See ``Scatter``."""
        recorder, ids = self.recorder, self.recorder.ids
        recorder.ids, recorder.stage = ids if which is None else ids.take(which), "refracted"
        recorder.begin_materials(
            hits.material if which is None else hits.material.take(which), self
        )
        boundary = super().boundary(hits, which, path, depth, draws)
        recorder.ids, recorder.material = ids, None
        return boundary

    def mirrored(
        self, hits: Hits, which: Indices, path: Indices, depth: int, draws: Draws
    ) -> Floats32:
        """See ``Scatter``."""
        self.recorder.ids, self.recorder.stage = path, "mirrored"
        return super().mirrored(hits, which, path, depth, draws)

    def refracted(
        self,
        hits: Hits,
        which: Indices,
        boundary: Boundary,
        path: Indices,
        depth: int,
        draws: Draws,
    ) -> Floats32:
        """See ``Scatter``."""
        self.recorder.ids, self.recorder.stage = path, "refracted"
        return super().refracted(hits, which, boundary, path, depth, draws)
