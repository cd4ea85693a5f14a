"""Render a scene to a picture: choose a film, a schedule and an executor for what was asked for."""

from contextlib import ExitStack, closing
from dataclasses import replace
from time import monotonic
from typing import Any

from course.base.errors import CourseError
from course.base.progress import reported
from course.base.version import __version__
from course.engine.casters.choice import chosen
from course.engine.core.film import AnyFilm
from course.engine.core.schedule import Progress, Schedule
from course.engine.core.schedule import render as render_film
from course.engine.core.tracer import Tracer
from course.engine.functions.effects import Bound
from course.engine.render.binding import skipped_modules
from course.engine.render.developing import developing
from course.engine.render.job import Job, Mode, check_memory, chosen_settings
from course.engine.render.memory import keep_freed_memory
from course.engine.render.not_written import lines_named
from course.engine.render.picture import Picture
from course.engine.render.receipt import Receipt
from course.engine.render.threads import Pool, ThreadedExecutor, default_threads
from course.engine.render.uniform import TIMED, UNIFORM
from course.engine.render.which_loops import (
    choose_loops,
    loops_of_cluster,
    may_change_over,
    read_first,
    wants_compiled,
)
from course.engine.scene.scene import Denoising, Scene, SceneSettings, check_scene


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
    progress: Progress | bool | None = None,
    start: Picture | None = None,
    compiled: bool | None = None,
    address: str | None = None,
    denoise: bool | None = None,
    shafts: bool = False,
) -> Picture:
    """Render a scene; what isn't given is as the scene file says.

    Returns Picture.

    Ctrl-C ends the render with a picture whose ``interrupted`` is true. A picture is a function of scene, settings
    and seed alone: the same bits for any number of threads or workers.

    Parameters
    ----------
    spp : samples a pixel
    size : (width, height) [pixels]
    sampler : "sobol", "random", "jittered", "regular", "halton", "hammersley", "chained", "xorshift",
        "blue_noise" or "dithered"
    seed : chooses the random numbers
    threads : how many; the picture doesn't depend on it
    time_limit : seconds; the best picture in that time, with as many samples as fit (at most ``spp`` if that is given);
        building the scene's hierarchy counts, but a tenth of the limit is left for rays in any case. On a cluster it
        counts from when the workers have the scene
    since : ``time.monotonic()`` from which a time limit counts; None for now
    error : root-mean-square error of the whole picture [radiance] at which sampling ends: samples go where the
        estimated error is, with ``spp`` a pixel on average at most
    progress : called from this thread with the share done, and whether the whole picture has been covered once; or
        whether to show a bar, by None in a notebook alone
    compiled : whether Numba's loops are used (``pip install .[fast]``), which give the same picture sooner; None means
        where that pays
    start : a picture of the same scene and settings with fewer samples, to be continued
    address : of the scheduler of a Dask cluster, such as tcp://127.0.0.1:8786, whose workers render (``pip install
        .[dask]``) and decide how many threads; None means this machine
    denoise : whether a PNG shows means over neighbours, a preview whose means are biased; None means as the scene says
    shafts : whether compiled loops leave out shadow rays whose answer a shaft tells: the same picture, seldom sooner;
        the receipt counts them

    Raises
    ------
    SceneError, EffectError, OutputError
        For settings that don't fit together, functions that are not written yet, and pictures larger than memory.
    CourseError
        For what is no scene; and for a cluster that can't be reached or is lost.
    """
    check_scene(scene, "render")
    since = monotonic() if since is None else since
    keep_freed_memory()
    settings = _asked(
        scene.settings, spp, size, sampler, seed, error, denoise, ends_early=time_limit is not None
    )
    settings = replace(settings, shafts=shafts)
    job = Job(scene, settings, time_limit, start)
    mode = _mode(settings, time_limit)
    _check(job, mode, threads, address)
    bound = Bound(scene.effects, scene.compiled.needs)
    began = monotonic()
    with lines_named(scene, bound), ExitStack() as closed:
        executor: ThreadedExecutor
        if address is None:
            loops = choose_loops(scene, settings, bound, compiled, time_limit, closed)
            executor = pool = Pool(loops.tracer, threads or default_threads())
            if loops.take_over is not None:
                closed.enter_context(closing(loops.take_over(pool)))
        else:
            from course.engine.render.cluster.executor import Cluster

            loops = loops_of_cluster(scene, settings, bound, compiled)
            executor = Cluster(address, scene, settings, loops.film)
        closed.enter_context(closing(executor))
        display = developing(scene, settings, bound)
        film, schedule = mode.make(replace(job, compiled=loops.film), loops.tracer, bound)
        if time_limit is not None:
            executor.limit_time(time_limit, since)
        report = closed.enter_context(reported(progress, "rendering"))
        complete = render_film(film, schedule, executor, report)
    receipt = _receipt(job, bound, loops.tracer, film, schedule, executor, monotonic() - began)
    settings = replace(settings, display=display)
    return Picture(film, settings, receipt, complete, executor.interrupted)


def _check(job: Job, mode: Mode, threads: int | None, address: str | None) -> None:
    """Raise an error for what doesn't go together; see ``render``."""
    mode.check(job)
    if job.start is not None:
        _check_start(job.settings, job.start.settings)
    check_memory(job.settings, mode.bytes_a_pixel)
    if address is not None and threads is not None:
        raise CourseError(
            "threads are for renders on this machine; the workers of a cluster have their own"
        )
    if address is not None and job.scene.effects.mixed:
        raise CourseError(
            'a cluster gets one folder of functions; "mine" is for renders on this machine'
        )


def _asked(
    settings: SceneSettings,
    spp: int | None,
    size: tuple[int, int] | None,
    sampler: str | None,
    seed: int | None,
    error: float | None,
    denoise: bool | None,
    *,
    ends_early: bool,
) -> SceneSettings:
    """The settings of a render; what isn't given is as the scene says. See ``render``."""
    settings = chosen_settings(
        settings,
        ends_early or error is not None,
        size,
        samples=spp,
        sampler=sampler,
        seed=seed,
        error=error,
    )
    if denoise is not None:
        rule = (settings.denoise or Denoising()) if denoise else None
        settings = replace(settings, denoise=rule)
    return settings


def reads_loops_first(
    settings: SceneSettings,
    *,
    spp: int | None = None,
    size: tuple[int, int] | None = None,
    sampler: str | None = None,
    seed: int | None = None,
    error: float | None = None,
    denoise: bool | None = None,
    time_limit: float | None = None,
    address: str | None = None,
    **_others: Any,
) -> bool:
    """True if a render begins with reading compiled loops: they can be read while the scene is built.

    ``settings``: of the scene; the others are as ``render`` takes them
    """
    if address is not None:
        return False
    settings = _asked(
        settings, spp, size, sampler, seed, error, denoise, ends_early=time_limit is not None
    )
    later = wants_compiled(settings, None) and may_change_over(settings)
    return later and read_first(settings, time_limit)


def _mode(settings: SceneSettings, time_limit: float | None) -> Mode:
    """The mode that settings ask for; its module is imported then."""
    if settings.denoise is not None:
        from course.engine.render.denoised import DENOISED

        return DENOISED
    if settings.subdivision is not None:
        from course.engine.render.adaptive.subdivision import SUBDIVISION

        return SUBDIVISION
    if settings.error is not None:
        from course.engine.render.adaptive.schedule import ADAPTIVE

        return ADAPTIVE
    return UNIFORM if time_limit is None else TIMED


def _check_start(*settings: SceneSettings) -> None:
    """Raise CourseError if one of two renders, the earlier or the one to continue it, is in a mode that can't go on."""
    for each in settings:
        if (picture := _mode(each, None).final) is not None:
            raise CourseError(f"{picture} can't be continued; start afresh")


def _receipt(
    job: Job,
    bound: Bound,
    tracer: Tracer,
    film: AnyFilm,
    schedule: Schedule,
    executor: ThreadedExecutor,
    wall: float,
) -> Receipt:
    """Collect the entries that world, film, schedule and executor have for the receipt."""
    rays, counters = tracer.integrator, executor.counters
    integrator = job.scene.loaded.description.integrator
    skipped = {
        **skipped_modules(bound.needs, integrator),
        **job.scene.compiled.world.skipped_lights,
    }
    if rays.scatter is None or rays.scatter.mirror.rows.max() <= rays.scatter.cutoff:
        skipped["reflection"] = "no material mirrors, or the depth is 0"
    if rays.scatter is None or rays.scatter.index is None:
        skipped["refraction"] = "no material refracts, or the depth is 0"
    if rays.environment_depth < 0:
        skipped["environment"] = "it is black"
    if not hasattr(rays, "recorder"):
        skipped["recorder"] = "a picture has none; course pixel renders a pixel once more"
    tests = {"boxes": counters.embree.box_tests, "triangles": counters.embree.triangle_tests}
    samples = float(film.samples.mean())
    called, effects = [need.function for need in bound.needs], job.scene.effects
    yours: dict[str, Any] = {}
    if effects.mixed:
        yours["yours"] = [name for name in called if effects.written(*name.split("."))]
    if standing := {name: said for name in called if (said := effects.stand_in(*name.split(".")))}:
        yours["stand-ins"] = standing
    if idle := effects.idle(called):
        yours["not called"] = idle
    return Receipt(
        rays=dict(counters.rays),
        spared=dict(counters.spared) or None,
        numbers=dict(counters.numbers),
        effects={"called": called, "skipped": skipped} | yours,
        seconds=dict(counters.seconds),
        caster=chosen(),
        embree_seconds=counters.embree.seconds,
        wall_seconds=wall,
        threads=executor.threads,
        samples=int(samples) if samples.is_integer() else samples,
        pixels=film.samples.size,
        seed=job.settings.seed,
        version=__version__,
        tests=None if "bounding_volumes" in skipped else tests,
        **schedule.receipt(),
    )
