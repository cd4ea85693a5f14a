"""A picture that gets better pass by pass, with what is known of its noise."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator
from contextlib import closing, contextmanager
from copy import deepcopy
from dataclasses import replace
from functools import partial
from time import monotonic

import numpy as np

from course.engine.core.film import Film
from course.engine.core.rays import RAYS
from course.engine.core.tiles import PASS, Tile, Work, spread_over_cache, tile_picture
from course.engine.core.types import Floats32
from course.engine.functions.effects import Bound
from course.engine.loops.embree_device import available
from course.engine.render.binding import bind
from course.engine.render.not_written import lines_named
from course.engine.render.render import render
from course.engine.render.threads import Pool, default_threads
from course.engine.render.which_loops import NO_COMPILER
from course.engine.scene.scene import Scene, SceneSettings

STAGES = (1, 16, 64, 256)
"""Samples of the pictures before the last, where a sampler places all samples at once."""


class NoisyFilm(Film):
    """A film that also knows how much its passes differ."""

    def __init__(self, width: int, height: int) -> None:
        super().__init__(width, height)
        self._squares = np.zeros((height, width))
        self._passes = np.zeros((height, width), np.int32)

    def add(
        self, tile: Tile, mean: Floats32, weight: Floats32 | float, samples: int, summed: bool
    ) -> None:
        """See ``Film``."""
        super().add(tile, mean, weight, samples, summed)
        shape = tile.height, tile.width
        light = mean.astype(np.float64).mean(axis=0).reshape(shape)
        w = np.broadcast_to(np.asarray(weight).reshape(-1), (tile.size,)).reshape(shape)
        self._squares[tile.rows, tile.columns] += light**2 * w
        self._passes[tile.rows, tile.columns] += 1

    @property
    def variance(self) -> Floats32:
        """(H, W) float32, of one sample's mean over the channels, from the differences of passes; 0 after one pass."""
        light = self.linear.astype(np.float64).mean(axis=0)
        spread = np.maximum(self._squares - self._weight * light**2, 0.0)
        variance: Floats32 = (spread / np.maximum(self._passes - 1, 1)).astype(np.float32)
        return variance


Tell = Callable[[Film, int, bool], None]
"""Called with the film, the samples that a pixel has, and whether a pass is complete; may raise to end the render."""


class Progressive:
    """A picture of a scene that is rendered in passes.

    Parameters
    ----------
    settings : of the picture; ``samples`` is the most that it can get
    compiled : whether compiled loops are used from the first pass on; else they are changed over to where functions
        are the course's own

    Attributes
    ----------
    film : of the passes that are complete
    samples : a pixel
    seconds : spent on rendering
    tracer : of the first pass
    """

    def __init__(self, scene: Scene, settings: SceneSettings, compiled: bool = False) -> None:
        self._scene, self._settings = scene, replace(settings, error=None)
        self._compiled = compiled
        self._bound = Bound(scene.effects, scene.compiled.needs)
        with lines_named(scene, self._bound):
            tracer = bind(scene, self._settings, self._bound, compiled)
        self.film: Film = NoisyFilm(settings.width, settings.height)
        self.samples, self.seconds = 0, 0.0
        self.variance: Floats32 | None = None
        self.tracer = tracer
        self._extensible = tracer.sampler.extensible
        self._pool = Pool(tracer, default_threads())

    def render(self, upto: int, tell: Tell) -> None:
        """Add passes until each pixel has so many samples, or all that the settings allow."""
        for first, samples in self._passes(min(upto, self._settings.samples)):
            began = monotonic()
            film: Film = deepcopy(self.film)
            if not self._extensible:
                film = Film(film.width, film.height)
                settings = replace(self._settings, samples=samples)
                with lines_named(self._scene, self._bound):
                    self._pool.tracer = bind(self._scene, settings, self._bound, self._compiled)

            def tick(_done: int, _first: int, film: Film = film) -> None:
                tell(film, self.samples, False)

            with self._changing_over():
                self._pool.run(self._work(first, samples), film, tick)
            self._keep(film, first + samples, samples)
            self.seconds += monotonic() - began
            tell(film, self.samples, True)

    def _keep(self, film: Film, samples: int, added: int) -> None:
        if isinstance(film, NoisyFilm):
            self.variance = film.variance if samples > 2 else None
        elif self.samples:
            # Of two pictures that have nothing in common.
            change = (film.linear - self.film.linear).astype(np.float64).mean(axis=0)
            per_sample = change**2 / (1 / self.samples + 1 / added)
            self.variance = per_sample.astype(np.float32)
        self.film, self.samples = film, samples

    def _passes(self, upto: int) -> Iterator[tuple[int, int]]:
        """First sample and number of samples of each pass."""
        if not self._extensible:
            for samples in (
                *(n for n in STAGES if n < self._settings.samples),
                self._settings.samples,
            ):
                if self.samples < samples <= max(upto, STAGES[0]):
                    yield 0, samples
            return
        while self.samples < upto:
            # 1, 1, 2, 4, 8, 16, 16, ...
            size = min(max(self.samples, 1), PASS, upto - self.samples)
            yield self.samples, size

    def _work(self, first: int, samples: int) -> list[Work]:
        width, height = self._settings.width, self._settings.height
        # Patterns hang on their tiles: those that have no passes are those of `course render`.
        tiles = tile_picture(width, height, samples)
        if self._extensible:
            tiles = even_tiles(width, height, samples, default_threads())
        return [Work(tile, 0, first, samples, True) for tile in tiles]

    @contextmanager
    def _changing_over(self) -> Iterator[None]:
        """Compiled loops, where they are ready and functions are the course's own."""
        if self._compiled or not self._scene.effects.trusted or not may_compile():
            yield
            return
        from course.engine.render.background_compile import BackgroundCompiler

        make = partial(bind, self._scene, self._settings, None, True)
        with closing(BackgroundCompiler(self._pool, make, self._scene, self._settings)):
            yield


def may_compile() -> bool:
    """Whether there is what compiled loops need, and nobody has forbidden them."""
    return available() and not os.environ.get(NO_COMPILER)


def even_tiles(width: int, height: int, samples: int, threads: int) -> list[Tile]:
    """Tiles of whole rows, of about the same size, and equally many for each thread: a pass may be short."""
    most = 2 * threads * -(-width * height * samples // (2 * threads * RAYS))
    rows = -(-height // min(most, height))
    fitting = (
        n for n in range(rows, max(rows - 4, 0), -1) if spread_over_cache(width * n * samples)
    )
    rows = next(fitting, rows)
    starts = range(0, height, rows)
    return [Tile(number, 0, y, width, min(rows, height - y)) for number, y in enumerate(starts)]


class Whole:
    """A picture that has no passes: rays go through the corners of pixels, where a scene divides them.

    It has the attributes and the method of ``Progressive``.
    """

    def __init__(self, scene: Scene, settings: SceneSettings) -> None:
        self._scene, self._settings = scene, settings
        self.film = Film(settings.width, settings.height)
        self.samples, self.seconds = 0, 0.0
        self.variance: Floats32 | None = None

    def render(self, upto: int, tell: Tell) -> None:
        """Render it, if it isn't there."""
        if self.samples >= upto:
            return
        began = monotonic()

        def progress(_share: float, _covered: bool) -> None:
            tell(self.film, 0, False)

        size = self._settings.width, self._settings.height
        picture = render(self._scene, size=size, progress=progress)
        self.film, self.samples = picture.film, upto  # type: ignore[assignment]
        self.seconds += monotonic() - began
        tell(self.film, self.samples, True)


def picture_of(
    scene: Scene, settings: SceneSettings, compiled: bool = False
) -> Progressive | Whole:
    """A picture without a sample yet."""
    if settings.subdivision is not None:
        return Whole(scene, settings)
    return Progressive(scene, settings, compiled)
