"""Render a scene to a picture."""

from __future__ import annotations

import sys
from collections.abc import Callable
from contextlib import closing
from dataclasses import replace
from math import isfinite
from time import monotonic
from typing import TYPE_CHECKING

from course import __version__
from course.effects import Bound, Need
from course.errors import CourseError, EffectError, FunctionError, OutputError
from course.geometry.packets import available as packets_available
from course.imaging.adaptive_film import AdaptiveFilm
from course.imaging.film import Film
from course.rendering.adaptive import ADAPTABLE, Groups, render_adaptively
from course.rendering.allocation import FIRST
from course.rendering.binding import bind
from course.rendering.corners import Corners
from course.rendering.memory import keep_freed_memory
from course.rendering.passes import (
    Work,
    kept_samples,
    pass_size,
    passes,
    preview,
)
from course.rendering.picture import Picture
from course.rendering.pool import Pool, default_threads
from course.rendering.receipt import Receipt
from course.rendering.subdivision import Functions, Saving, render_subdivided
from course.scene.consistency import nearest_squares
from course.scene.scene import Scene
from course.scene.skipped_modules import skipped_modules
from course.scene.world import Settings
from course.transport.counters import Counters
from course.transport.plan import Plan
from course.transport.tracing import Tracer

if TYPE_CHECKING:
    from course.core.samplers import Sampler
    from course.rendering.cluster import Cluster

Progress = Callable[[float, bool], None]

HURRIED = 4
"""Batches of rays in a tile where a time limit has to be kept; what has begun is finished first."""

MOST_SAMPLES = 65536
WORTH_COMPILED = 8_000_000
"""Camera rays from which on compiled loops save more than the second that Numba takes to get ready."""

BYTES_A_PIXEL = 64
"""Sums, weights, the picture itself, and its copies on the way to a file."""

BYTES_A_DIVIDED_PIXEL = 400
"""Those of a render by subdivision: cells, their corners and what is known of them; measured, 350 or less."""

LEAST_FOR_RAYS = 0.1
"""The share of a time limit that is left for rays, however long reading and building took."""


def render(
    scene: Scene,
    *,
    spp: int | None = None,
    size: tuple[int, int] | None = None,
    sampler: str | None = None,
    seed: int | None = None,
    threads: int | None = None,
    time_limit: float | None = None,
    since: float | None = None,
    error: float | None = None,
    progress: Progress | None = None,
    start: Picture | None = None,
    compiled: bool | None = None,
    address: str | None = None,
) -> Picture:
    """Render a scene; what isn't given is as the scene file says.

    Parameters
    ----------
    spp : samples a pixel
    size : (width, height) [pixels]
    sampler : "sobol", "random", "jittered", "regular", "halton", "hammersley", "chained" or "xorshift"
    seed : chooses the random numbers
    threads : how many; the picture doesn't depend on it
    time_limit : seconds; the best picture in that time, with as many samples as fit (at most ``spp`` if that is given);
        building the scene's hierarchy counts, but a tenth of the limit is left for rays in any case. On a cluster it
        counts from when the workers have the scene
    since : ``time.monotonic()`` from which a time limit counts; None for now
    error : root-mean-square error of the whole picture [radiance] at which sampling ends: samples go where the
        estimated error is, with ``spp`` a pixel on average at most
    progress : called from this thread with the share done, and whether the whole picture has been covered once
    compiled : whether Numba's loops are used (``pip install .[fast]``), which give the same picture sooner; None means
        where that pays
    start : a picture of the same scene and settings with fewer samples, to be continued
    address : of the scheduler of a Dask cluster, such as tcp://127.0.0.1:8786, whose workers render (``pip install
        .[dask]``) and decide how many threads; None means this machine

    Returns
    -------
    Picture

    Raises
    ------
    SceneError, EffectError, OutputError
        For settings that don't fit together, functions that are not written yet, and pictures larger than memory.
    CourseError
        For a cluster that can't be reached or is lost.

    Notes
    -----
    Ctrl-C ends the render with a picture whose ``interrupted`` is true. A picture is a function of scene, settings
    and seed alone: the same bits for any number of threads or workers.
    """
    if address is not None and threads is not None:
        raise CourseError(
            "threads are for renders on this machine; the workers of a cluster have their own"
        )
    since = monotonic() if since is None else since
    keep_freed_memory()
    settings = _settings(scene, spp, size, sampler, seed, time_limit, error)
    _check_memory(settings)
    bound = Bound(scene.effects, scene.compiled.needs)
    packets = _use_compiled(settings, compiled)
    if address is None:
        scene.compiled.world.surface.accelerator.use_packets(packets)
    began = monotonic()
    try:
        tracer = bind(scene, settings, bound)
        film: Film | AdaptiveFilm
        done = 0
        saving = None
        if settings.error is None:
            film = Film(settings.width, settings.height)
        else:
            film = AdaptiveFilm(settings.width, settings.height)
        if start is not None:
            done = _check_start(start, settings, tracer.sampler)
            assert isinstance(film, Film)
            assert isinstance(start.film, Film)
            film = start.film.continued(done)
        corners = None
        if settings.subdivision is not None:
            corners = Corners(
                settings.width, settings.height, settings.subdivision.depth, settings.samples
            )
        sink = film if corners is None else corners
        pool: Pool | Cluster
        if address is None:
            pool = Pool(tracer, sink, threads or default_threads())
        else:
            from course.rendering.cluster import Cluster

            pool = Cluster(address, scene, settings, sink, packets)
        with closing(pool):
            deadline = None
            if time_limit is not None:
                deadline = pool.prepare(since) + time_limit
                deadline = max(deadline, monotonic() + LEAST_FOR_RAYS * time_limit)
            if corners is not None:
                complete, saving = _render_subdivided(
                    pool, bound, film, corners, settings, progress
                )
            elif isinstance(film, AdaptiveFilm):
                complete = _render_adaptively(pool, tracer, film, settings, deadline, progress)
            elif deadline is None or time_limit is None:
                complete = _render_all(pool, tracer, settings, done, progress)
            else:
                complete = _render_until(
                    pool, tracer, settings, done, deadline, time_limit, progress
                )
    except FunctionError as error:
        if (path := bound.asked_by(error.function)) is None:
            raise
        raise error.asked_by(scene.loaded.document.where(path), path) from error.__cause__
    except NotImplementedError as error:
        raise _not_written(scene, bound, error) from error
    wall = monotonic() - began
    receipt = _receipt(
        scene, settings, bound.needs, tracer.plan, pool.counters, film, pool.threads, wall
    )
    if saving is not None:
        receipt = replace(receipt, subdivision=saving.to_dict())
    return Picture(film, settings, receipt, complete, pool.interrupted)


def _settings(
    scene: Scene,
    spp: int | None,
    size: tuple[int, int] | None,
    sampler: str | None,
    seed: int | None,
    time_limit: float | None,
    error: float | None,
) -> Settings:
    settings = scene.settings
    if (
        (time_limit is not None or error is not None)
        and spp is None
        and (sampler or settings.sampler) in ("sobol", "random", "halton", "xorshift")
    ):
        spp = MOST_SAMPLES
    width, height = size or (settings.width, settings.height)
    settings = replace(
        settings,
        samples=settings.samples if spp is None else spp,
        width=width,
        height=height,
        sampler=sampler or settings.sampler,
        seed=settings.seed if seed is None else seed,
        error=error or settings.error,
    )
    if settings.width < 1 or settings.height < 1:
        raise OutputError(f"a picture of {settings.width} x {settings.height} pixels has no pixels")
    if settings.samples < 1:
        raise CourseError(f"{settings.samples} samples a pixel: expected at least 1")
    if settings.sampler in ("regular", "jittered"):
        squares = nearest_squares(settings.samples)
        if settings.samples not in squares:
            raise CourseError(
                f"the {settings.sampler} sampler needs a square number of samples, not "
                f"{settings.samples}; the nearest are {' and '.join(map(str, squares))}"
            )
    _check_adaptive(settings)
    if settings.subdivision is not None:
        _check_subdivision(scene, settings, time_limit)
    return settings


def _check_subdivision(scene: Scene, settings: Settings, time_limit: float | None) -> None:
    """What places samples in pixels, or leaves them off, doesn't go together with rays through corners."""
    where = f"{scene.loaded.document.where(('film', 'subdivision'))}: film.subdivision"
    if settings.error is not None:
        raise CourseError(
            f"{where} sends rays where corners differ, an error where estimates are large; give one of the two"
        )
    if time_limit is not None:
        raise CourseError(
            f"{where} ends when no cell needs dividing and not by a time limit; a lower depth takes less time"
        )
    if settings.sampler != "sobol":
        raise CourseError(
            f"{where} places its rays by itself; the {settings.sampler} sampler has nothing to place, use sobol"
        )
    if scene.loaded.description.film.filter != "box":
        raise CourseError(f"{where} weighs cells by their area; film.filter must be box")


def _check_adaptive(settings: Settings) -> None:
    if settings.error is None:
        return
    if not (isfinite(settings.error) and settings.error > 0):
        raise CourseError(f"an error of {settings.error}: expected a finite radiance > 0")
    if settings.sampler == "halton":
        raise CourseError(
            "the halton sampler moves all points of a pixel together, so they don't tell their error; "
            "use sobol, random or xorshift"
        )
    if settings.sampler not in ADAPTABLE:
        raise CourseError(
            f"the {settings.sampler} sampler places all its samples at once, so it can't go on where the error is; "
            "use sobol, random or xorshift"
        )
    if settings.samples < FIRST:
        raise CourseError(
            f"{settings.samples} samples a pixel: an error can be aimed at with {FIRST} or more"
        )


def _use_compiled(settings: Settings, wanted: bool | None) -> bool:
    if wanted and not packets_available():
        raise CourseError("compiled loops need Numba: pip install .[fast]")
    if wanted is not None:
        return wanted
    rays = settings.width * settings.height * settings.samples
    return packets_available() and ("numba" in sys.modules or rays >= WORTH_COMPILED)


def _check_memory(settings: Settings) -> None:
    each = BYTES_A_PIXEL if settings.subdivision is None else BYTES_A_DIVIDED_PIXEL
    needed = settings.width * settings.height * each
    if needed < 256e6:
        return
    import psutil

    available = psutil.virtual_memory().available
    if needed > available:
        raise OutputError(
            f"a picture of {settings.width} x {settings.height} needs about {needed / 1e9:.1f} GB of memory, "
            f"{available / 1e9:.1f} GB are free; render a smaller one (--size)"
        )


def _check_start(start: Picture, settings: Settings, sampler: Sampler) -> int:
    """How many samples of the picture to continue can be kept."""
    if settings.error is not None or start.settings.error is not None:
        raise CourseError("a picture with an error to aim at can't be continued; start afresh")
    if settings.subdivision is not None:
        raise CourseError("a picture by subdivision can't be continued; start afresh")
    same = replace(start.settings, samples=settings.samples) == settings
    if not same or not start.complete or start.settings.samples > settings.samples:
        raise CourseError(
            "only a complete picture of the same settings and fewer samples can be continued"
        )
    if not sampler.extensible:
        raise CourseError(
            f"the {settings.sampler} sampler places all its samples at once; start afresh"
        )
    return kept_samples(start.settings.samples)


def _render_all(
    pool: Pool | Cluster, tracer: Tracer, settings: Settings, done: int, progress: Progress | None
) -> bool:
    work = list(passes(settings, tracer.sampler, done, tracer.batches, pool.threads))
    first_pass = sum(item.order == 0 for item in work)

    def tick(count: int, count_first: int) -> None:
        if progress is not None:
            progress(count / max(len(work), 1), count_first >= first_pass)

    return pool.run(work, None, tick)


def _render_until(
    pool: Pool | Cluster,
    tracer: Tracer,
    settings: Settings,
    done: int,
    deadline: float,
    time_limit: float,
    progress: Progress | None,
) -> bool:
    """As many samples as fit: a preview first, so that every pixel has something, then whole passes."""

    def tick(_count: int, _count_first: int) -> None:
        if progress is not None:
            progress(min(1 - (deadline - monotonic()) / time_limit, 1.0), covered)

    covered = False
    size = pass_size(settings, tracer.sampler)
    for quick in (1, 4):
        # Where a whole pass surely fits, a preview only costs.
        if size <= quick or done:
            break
        before = monotonic()
        covered = pool.run(preview(settings, quick), deadline, tick) or covered
        if pool.interrupted:
            return False
        seconds = monotonic() - before
        if seconds * size / quick < 0.5 * (deadline - monotonic()):
            break
    work = passes(settings, tracer.sampler, done, min(tracer.batches, HURRIED), pool.threads)
    return pool.run(work, deadline, tick)


class _Rounds:
    """Has the work of rounds done; from the end of the first on, the picture is covered."""

    def __init__(
        self, pool: Pool | Cluster, deadline: float | None, progress: Progress | None
    ) -> None:
        self._pool = pool
        self._deadline = deadline
        self._progress = progress
        self._covered = False

    def __call__(self, work: list[Work], done: float, after: float) -> bool:
        """See ``course.rendering.adaptive.Run``."""

        def tick(count: int, _count_first: int) -> None:
            if self._progress is not None:
                share = count / max(len(work), 1)
                self._progress(done + (after - done) * share, self._covered)

        whole = self._pool.run(work, self._deadline, tick)
        self._covered = self._covered or whole
        return whole


def _render_adaptively(
    pool: Pool | Cluster,
    tracer: Tracer,
    film: AdaptiveFilm,
    settings: Settings,
    deadline: float | None,
    progress: Progress | None,
) -> bool:
    """In rounds; under a deadline with a preview first, so that every pixel has something."""
    run = _Rounds(pool, deadline, progress)
    if deadline is not None:
        run(preview(settings, 1), 0.0, 0.0)
        if pool.interrupted:
            return False
    assert settings.error is not None
    budget = settings.samples * settings.width * settings.height
    batches = tracer.batches if deadline is None else min(tracer.batches, HURRIED)
    groups = Groups(settings.width, batches, pool.threads)
    return render_adaptively(film, settings.error, budget, groups, run)


def _render_subdivided(
    pool: Pool | Cluster,
    bound: Bound,
    film: Film | AdaptiveFilm,
    corners: Corners,
    settings: Settings,
    progress: Progress | None,
) -> tuple[bool, Saving]:
    """Level by level; the picture is covered once the corners of all pixels have had their rays."""
    assert settings.subdivision is not None
    assert isinstance(film, Film)
    run = _Rounds(pool, None, progress)
    functions = Functions(bound, settings.subdivision)
    return render_subdivided(corners, film, functions, settings.subdivision.depth, run)


def _not_written(scene: Scene, bound: Bound, error: NotImplementedError) -> EffectError:
    """Which line of the scene asked for the function that says it isn't there yet."""
    function = str(error).partition(":")[0]
    path = bound.asked_by(function)
    if path is None:
        return EffectError(
            f"{str(error) or 'a function is not written yet'} (in {scene.effects.folder})"
        )
    file = scene.effects.folder / function.partition(".")[0]
    told = FunctionError(f"{error} ({file}.py)", function)
    return told.asked_by(scene.loaded.document.where(path), path)


def _error(film: Film | AdaptiveFilm, settings: Settings) -> dict[str, float] | None:
    if settings.error is None or not isinstance(film, AdaptiveFilm):
        return None
    uniform = film.uniform_samples
    return {
        "target": settings.error,
        "estimated": film.error,
        "fewest": int(film.samples.min()),
        "most": int(film.samples.max()),
        "audited": film.audited,
        "uniform": uniform,
        "saved": 1.0 - (float(film.samples.sum()) + film.audited) / film.samples.size / uniform
        if uniform
        else 0.0,
    }


def _numbers(settings: Settings, counters: Counters) -> dict[str, int]:
    numbers = dict(counters.numbers)
    if settings.subdivision is not None:
        # A ray through a corner draws no place in a pixel.
        numbers.pop("pixel", None)
    return numbers


def _tests(scene: Scene, counters: Counters) -> dict[str, int] | None:
    if scene.loaded.description.acceleration.type == "embree":
        return None
    return {"boxes": counters.embree.box_tests, "triangles": counters.embree.triangle_tests}


def _receipt(
    scene: Scene,
    settings: Settings,
    needs: tuple[Need, ...],
    plan: Plan,
    counters: Counters,
    film: Film | AdaptiveFilm,
    threads: int,
    wall: float,
) -> Receipt:
    samples = float(film.samples.mean())
    skipped = {
        **skipped_modules(needs, scene.loaded.description.integrator),
        **scene.compiled.world.skipped_lights,
    }
    if not plan.mirrors:
        skipped["reflection"] = "no material mirrors, or the depth is 0"
    if not plan.refracts:
        skipped["refraction"] = "no material refracts, or the depth is 0"
    if not plan.sees_environment:
        skipped["environment"] = "it is black"
    return Receipt(
        rays=dict(counters.rays),
        numbers=_numbers(settings, counters),
        effects={
            "called": [need.function for need in needs],
            "skipped": skipped,
        },
        seconds=dict(counters.seconds),
        embree_seconds=counters.embree.seconds,
        wall_seconds=wall,
        threads=threads,
        samples=int(samples) if samples.is_integer() else samples,
        error=_error(film, settings),
        pixels=settings.width * settings.height,
        seed=settings.seed,
        version=__version__,
        tests=_tests(scene, counters),
    )
