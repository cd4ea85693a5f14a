"""Record a pixel: its samples once more, with every segment of their paths."""

import warnings
from collections import defaultdict
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np

from course.base.errors import CourseError, CourseWarning
from course.engine.core.camera import Camera
from course.engine.core.counters import Counters
from course.engine.core.film import Film
from course.engine.core.samplers import Block
from course.engine.core.tiles import Area, Tile, Work, passes
from course.engine.core.tracer import Tracer
from course.engine.core.types import Floats32, Words
from course.engine.functions.contracts import contract
from course.engine.functions.effects import Bound
from course.engine.loops.embree_device import available
from course.engine.loops.fits import fits
from course.engine.recording.recorder import Recorder
from course.engine.recording.segments import Segment, segments_of
from course.engine.recording.stages import RecordedDraws, RecordedEffects, recorded
from course.engine.render.binding import bind
from course.engine.render.job import check_whole, chosen_settings
from course.engine.render.not_written import lines_named
from course.engine.scene.building.world import compile_scene
from course.engine.scene.scene import Scene, SceneSettings
from course.engine.terms.samplers.sobol import SobolSampler

MOST_SAMPLES = 16384
"""Largest number of samples that are recorded at once."""

ASIDE = 4
"""Pixels on each side, among which it is tried whether a pixel's samples depend on others."""


@dataclass(frozen=True)
class Recording:
    """What was recorded of a rectangle of pixels.

    Attributes
    ----------
    scene, settings : of the picture
    area : the rectangle
    linear : (3, height, width) float32, the picture there
    radiance : (3, pixels, samples) float32, of each sample
    offsets : (2, pixels, samples) float32 [pixels], where each lies in its pixel
    weights : (pixels, samples) float32, of the filter
    segments : in the order in which they were followed, each before those that leave its end
    asked : "module.function" -> how often it was asked; once for a whole pattern of samples, or for a batch whose
        columns aren't those of all rays
    camera : of the compiled scene
    counters : the receipt's numbers, of all pixels that had to be rendered
    alone : whether no other pixels had to be rendered
    """

    scene: Scene
    settings: SceneSettings
    area: Tile
    linear: Floats32
    radiance: Floats32
    offsets: Floats32
    weights: Floats32
    segments: list[Segment]
    asked: dict[str, int]
    camera: Camera
    counters: Counters
    alone: bool


def record(
    scene: Scene,
    x: int,
    y: int,
    width: int = 1,
    height: int = 1,
    *,
    spp: int | None = None,
    size: tuple[int, int] | None = None,
    seed: int | None = None,
    quick: bool = False,
) -> Recording:
    """Render some pixels once more, and record every segment of their samples' paths.

    The samples are those of `course.render` with the same settings, to the last bit. Sobol points are each pixel's own,
    and the course's own functions look at each column by itself; then the pixels are rendered alone. Otherwise the
    tiles that they are in are rendered as a whole.

    Parameters
    ----------
    x, y : column and row of the upper left pixel, from the upper left corner of the picture
    width, height : of the rectangle [pixels]
    spp, size, seed : see `course.render`
    quick : whether a student's functions are tried, too, with a few pixels around: where the pixels' first samples are
        the same alone, among others and once more, they are rendered alone

    Raises
    ------
    CourseError
        The rectangle isn't in the picture, has too many samples, or pixels of this scene have no samples of their own.
    EffectError
        A function is missing, not written yet, or returns what it must not.
    """
    settings = replace(_settings(scene, spp, size, seed), error=None)
    return _recorded(scene, settings, [Tile(0, x, y, width, height)], whole=False, quick=quick)[0]


def record_each(scene: Scene, pixels: Iterable[tuple[int, int]]) -> list[Recording]:
    """Render the whole picture once more, tile by tile in their order, and record these pixels, each by itself.

    So a function that counts its calls gets the same ones as in `course.render` with one thread.

    Raises
    ------
    CourseError, EffectError
        See ``record``.
    """
    settings = replace(_settings(scene, None, None, None), error=None)
    areas = [Tile(number, x, y, 1, 1) for number, (x, y) in enumerate(pixels)]
    return _recorded(scene, settings, areas, whole=True)


def _recorded(
    scene: Scene,
    settings: SceneSettings,
    areas: Sequence[Tile],
    *,
    whole: bool,
    quick: bool = False,
) -> list[Recording]:
    """A recording of each area; with ``whole`` all tiles of the picture are rendered, in their order."""
    _check(areas, settings)
    recorder = Recorder()
    scene = recordable(scene)
    assert isinstance(scene.effects, RecordedEffects)
    bound = Bound(scene.effects, scene.compiled.needs)
    film, counters = Film(settings.width, settings.height), Counters()
    numbers = [area.pixel_numbers(settings.width) for area in areas]
    wanted = np.concatenate(numbers)
    try:
        with lines_named(scene, bound):
            plain = bind(scene, settings, bound)
            own = isinstance(plain.sampler, SobolSampler) and not whole
            own = own and not any(_draws(need.function) for need in bound.needs)
            trusted = scene.effects.trusted
            alone = own and (trusted or (quick and _independent(scene, plain, areas[0])))
            tracer = recorded(plain, recorder, shafts=available() and fits(plain))
            scene.effects.recorder = recorder
            work = (
                passes(tracer.settings, tracer.sampler) if whole else _work(tracer, areas[0], alone)
            )
            samples = [_render(tracer, recorder, each, wanted, film, counters) for each in work]
    finally:
        scene.effects.recorder = None
    pixels = np.concatenate([found for found, _ in samples])
    columns = [
        np.concatenate(batches, axis=1) for batches in zip(*(c for _, c in samples), strict=True)
    ]
    segments: dict[int, list[Segment]] = defaultdict(list)
    for one in segments_of(recorder, scene, settings.width):
        segments[one.pixel[1] * settings.width + one.pixel[0]].append(one)
    recordings = []
    for area, own_pixels in zip(areas, numbers, strict=True):
        of = np.flatnonzero(np.isin(pixels, own_pixels))
        order = of.take(np.argsort(pixels.take(of), kind="stable"))
        radiance, offsets, weights = (
            column.take(order, axis=1).reshape(-1, area.size, settings.samples)
            for column in columns
        )
        recordings.append(
            Recording(
                scene,
                settings,
                area,
                film.linear[:, area.rows, area.columns],
                radiance,
                offsets,
                weights[0],
                sorted(
                    (one for pixel in own_pixels.tolist() for one in segments[pixel]),
                    key=lambda one: one.number,
                ),
                recorder.asked,
                tracer.integrator.camera,
                counters,
                alone,
            )
        )
    return recordings


def recordable(scene: Scene) -> Scene:
    """The scene with functions whose calls can be noted down; it is compiled again unless it has them already."""
    if isinstance(scene.effects, RecordedEffects):
        return scene
    effects = RecordedEffects(scene.effects)
    with warnings.catch_warnings():
        # Whoever loaded the scene has heard them.
        warnings.simplefilter("ignore", CourseWarning)
        with effects.building():
            return Scene(scene.loaded, compile_scene(scene.loaded, effects), effects)


def _settings(
    scene: Scene, spp: int | None, size: tuple[int, int] | None, seed: int | None
) -> SceneSettings:
    return chosen_settings(scene.settings, False, size, samples=spp, seed=seed)


def _check(areas: Sequence[Tile], settings: SceneSettings) -> None:
    if settings.subdivision is not None:
        raise CourseError(
            "this scene casts rays through the corners of pixels (film.subdivision), which share them: no pixel has"
            " samples of its own to record"
        )
    for area in areas:
        for number in (area.x, area.y, area.width, area.height):
            more = "; pixels are counted from 0, from the upper left corner"
            check_whole(f"pixel {area.x},{area.y}", number, more)
        if not (
            area.width > 0 <= area.x <= settings.width - area.width
            and area.height > 0 <= area.y <= settings.height - area.height
        ):
            raise CourseError(
                f"pixel {area.x},{area.y} is outside the picture: expected x from 0 to {settings.width - 1} and y from"
                f" 0 to {settings.height - 1}, counted from the upper left corner"
            )
    count = sum(area.size for area in areas) * settings.samples
    if count > MOST_SAMPLES:
        raise CourseError(
            f"{count:,} samples are too many to record: expected at most {MOST_SAMPLES:,};"
            " ask for fewer samples (--spp) or pixels"
        )


def _draws(function: str) -> bool:
    """Whether a function draws numbers of its own, which depend on the paths that are followed together."""
    return any(name == "rng" for name, _ in contract(function).arguments)


def _independent(scene: Scene, tracer: Tracer, area: Tile) -> bool:
    """Whether pixels are the same alone, among others and once more, by the samples of one pass.

    Not only in their colours: where all is dark, functions that look at other columns make no other light.
    """
    assert isinstance(scene.effects, RecordedEffects)
    work = next(iter(passes(tracer.settings, tracer.sampler)))
    width, height = tracer.settings.width, tracer.settings.height
    x, y = max(area.x - ASIDE, 0), max(area.y - ASIDE, 0)
    if (x, y) == (area.x, area.y):
        # They would come first there, too.
        return False
    right, below = (
        min(area.x + area.width + ASIDE, width),
        min(area.y + area.height + ASIDE, height),
    )
    found = []
    for tile in (area, Tile(0, x, y, right - x, below - y), area):
        scene.effects.recorder = recorder = Recorder()
        part, which = replace(work, tile=tile), area.pixel_numbers(width)
        film = Film(width, height)
        _, columns = _render(recorded(tracer, recorder), recorder, part, which, film, Counters())
        rays = sorted(segments_of(recorder, scene, width), key=lambda one: (one.pixel, one.sample))
        found.append(([column.tobytes() for column in columns], [_returned(one) for one in rays]))
    first, *others = found
    return all(
        columns == first[0] and len(rays) == len(first[1]) and all(map(_agree, rays, first[1]))
        for columns, rays in others
    )


def _returned(one: Segment) -> dict[tuple[str, int], str]:
    """What functions returned for a ray, to the last digit, by their names and the number of the call."""
    return {(call.function, place): repr(call.results) for place, call in enumerate(one.calls)}


def _agree(one: dict[tuple[str, int], str], other: dict[tuple[str, int], str]) -> bool:
    """Whether calls that are known of both returned the same."""
    return all(one[call] == other[call] for call in one.keys() & other.keys())


def _work(tracer: Tracer, area: Tile, alone: bool) -> Iterator[Work]:
    """The passes of the rectangle, or of the picture's tiles that it is in."""
    for work in passes(tracer.settings, tracer.sampler):
        tile = work.tile
        assert isinstance(tile, Tile)
        across = range(max(tile.x, area.x), min(tile.x + tile.width, area.x + area.width))
        down = range(max(tile.y, area.y), min(tile.y + tile.height, area.y + area.height))
        if across and down:
            part = Tile(tile.number, across.start, down.start, len(across), len(down))
            yield replace(work, tile=part if alone else tile)


def _render(
    tracer: Tracer, recorder: Recorder, work: Work, which: Words, film: Film, counters: Counters
) -> tuple[Words, list[Floats32]]:
    """Render one pass as ``Tracer.render_tile`` does; pixel, radiance, offset and weight of the recorded samples."""
    tile: Area = work.tile
    assert isinstance(tile, Tile)
    pixels = tile.pixel_numbers(tracer.settings.width)
    block = Block(pixels, work.first, work.samples, tile.number)
    wanted = np.repeat(np.isin(pixels, which), work.samples)
    recorder.begin_block(block, wanted)
    draws = RecordedDraws(tracer.sampler, tracer.dimensions, block, counters, watcher=recorder)
    offsets = draws("pixel").reshape(2, tile.size, work.samples)
    x, y = tile.corners()
    x, y = (x[:, None] + offsets[0]).ravel(), (y[:, None] + offsets[1]).ravel()
    rays = tracer.integrator.camera_rays(x, y, draws)
    counters.rays["camera"] += rays.size
    radiance = tracer.integrator.radiance(rays, draws).reshape(-1, tile.size, work.samples)
    # From here on columns are pixels.
    recorder.ids, recorder.stage = np.zeros(0, np.intp), "film"
    mean, weight = tracer.reconstruction.pixels(radiance, offsets)
    film.add(tile, mean, weight, work.first + work.samples, work.summed)
    kept = np.flatnonzero(wanted)
    weights = np.ones(block.size, np.float32) if recorder.weights is None else recorder.weights
    columns = radiance.reshape(3, -1), offsets.reshape(2, -1), weights.reshape(1, -1)
    return np.repeat(pixels, work.samples)[kept], [each.take(kept, axis=1) for each in columns]
