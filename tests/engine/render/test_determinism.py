"""A picture is a function of scene, settings and seed: the same bits however it comes about."""

import random
import threading
from collections.abc import Callable, Iterator
from typing import Any

import numpy as np
import pytest

from course import Picture, render
from course.base.errors import CourseError
from course.engine.core import tiles
from course.engine.core.counters import Counters
from course.engine.core.film import Film
from course.engine.core.tiles import Tile, Work, passes
from course.engine.functions.effects import PROJECT
from course.engine.render.binding import bind
from course.engine.render.threads import Pool
from course.engine.scene.scene import load_variant
from course.engine.terms import work as extra_work
from course.engine.terms.samplers import FUNCTIONS
from course.engine.terms.work import divided_passes
from tests.coarser import coarser
from tests.engine.conftest import EveryStage
from tests.lengths import fewer

SAMPLERS = tuple(FUNCTIONS)
FILTERS = ("box", "gaussian")


@pytest.fixture(autouse=True)
def small_tiles(monkeypatch: pytest.MonkeyPatch) -> None:
    """Small pictures have as many tiles as larger ones do otherwise."""
    monkeypatch.setattr(tiles, "RAYS", tiles.RAYS // 4)


def film_of(kind: str) -> dict[str, Any]:
    # 40 x 35 pixels make several tiles at 16 samples, the last of a row and of a column narrower.
    return {"width": 40, "height": 35, "filter": kind}


def same(a: Picture, b: Picture) -> bool:
    return a.linear.tobytes() == b.linear.tobytes()


@fewer
@pytest.mark.parametrize("filter_", FILTERS)
@pytest.mark.parametrize("sampler", SAMPLERS)
def test_any_number_of_threads_gives_the_same_bits(
    every_stage: EveryStage, sampler: str, filter_: str
) -> None:
    scene = every_stage(film=film_of(filter_))
    samples = 16 if sampler in ("jittered", "regular") else 24
    one = render(scene, sampler=sampler, spp=samples, threads=1)
    assert np.isfinite(one.linear).all()
    assert one.linear.std() > 0
    assert same(one, render(scene, sampler=sampler, spp=samples, threads=3))


@fewer
@pytest.mark.parametrize("sampler", ["sobol", "random"])
@pytest.mark.parametrize("name", ["path_tracing", "mesh_light", "gallery/everything"])
def test_so_it_does_for_paths_for_lights_of_triangles_and_for_everything(
    name: str, sampler: str
) -> None:
    path = PROJECT / "scenes" / f"{name}.yaml"
    scene = load_variant(path, coarser(path))
    one, three = (
        render(scene, sampler=sampler, spp=16, size=(45, 40), threads=threads) for threads in (1, 3)
    )
    assert np.isfinite(one.linear).all()
    assert same(one, three)


@pytest.mark.parametrize("sampler", SAMPLERS)
def test_a_repeated_render_gives_the_same_bits_and_another_seed_does_not(
    every_stage: EveryStage, sampler: str
) -> None:
    scene = every_stage()
    one = render(scene, sampler=sampler)
    assert same(one, render(scene, sampler=sampler))
    assert same(one, render(every_stage(), sampler=sampler)), "compiled anew"
    assert sampler == "regular" or not same(one, render(scene, sampler=sampler, seed=1))


class Reordered:
    """The work of a render in another order: tiles shuffled in each pass, each tile's passes in a row, ..."""

    def __init__(self, monkeypatch: pytest.MonkeyPatch, order: Callable[[list[Work]], None]):
        def reordered(*arguments: Any) -> Iterator[Work]:
            work = list(divided_passes(*arguments))
            before = list(work)
            order(work)
            self.changed = work != before
            return iter(work)

        self.changed = False
        monkeypatch.setattr(extra_work, "divided_passes", reordered)


def shuffled(work: list[Work]) -> None:
    random.Random(3).shuffle(work)
    work.sort(key=lambda item: item.order)


def backwards(work: list[Work]) -> None:
    work.sort(key=lambda item: (item.order, -item.tile.number))


def tile_by_tile(work: list[Work]) -> None:
    work.sort(key=lambda item: (item.tile.number, item.order))


def anyhow(work: list[Work]) -> None:
    """Even a later pass before an earlier one, as threads may finish them."""
    random.Random(4).shuffle(work)


@pytest.mark.parametrize("sampler", ["sobol", "random"])
def test_any_order_of_tiles_gives_the_same_bits(
    every_stage: EveryStage, monkeypatch: pytest.MonkeyPatch, sampler: str
) -> None:
    scene = every_stage(film=film_of("gaussian"))
    expected = render(scene, sampler=sampler, spp=40, threads=1)
    for order in (shuffled, backwards, tile_by_tile, anyhow):
        reordered = Reordered(monkeypatch, order)
        assert same(expected, render(scene, sampler=sampler, spp=40, threads=1)), order
        assert reordered.changed, order


def test_a_tile_does_not_know_which_tiles_came_before(every_stage: EveryStage) -> None:
    scene = every_stage(film=film_of("box"))
    tracer = bind(scene, scene.settings)
    work = list(passes(scene.settings, tracer.sampler))
    film = Film(scene.settings.width, scene.settings.height)
    for item in work[::-1]:
        pixels, weight = tracer.render_tile(item.tile, item.first, item.samples, Counters())
        film.add(item.tile, pixels, weight, item.samples, item.summed)
    assert np.moveaxis(film.linear, 0, 2).tobytes() == render(scene).linear.tobytes()


class Obstinate:
    """A tracer whose first pass is finished last."""

    def __init__(self) -> None:
        self.later_passes_done = threading.Event()

    def render_tile(
        self, tile: Tile, first: int, samples: int, counters: Counters, *_: Any
    ) -> tuple[np.ndarray, float]:
        if first == 0:
            # No timing decides: the wait ends when the other thread has done all the rest.
            assert self.later_passes_done.wait(60)
        elif first == 32:
            self.later_passes_done.set()
        return np.full((3, tile.size), np.float32(1.0 + first)), 16.0


def test_passes_enter_the_film_in_order_even_if_the_first_is_finished_last() -> None:
    tile = Tile(0, 0, 0, 2, 2)
    work = [Work(tile, order, 16 * order, 16, True) for order in range(3)]
    film = Film(2, 2)
    pool = Pool(Obstinate(), 2)  # type: ignore[arg-type]
    assert pool.run(work, film)
    assert np.array_equal(film.linear, np.full((3, 2, 2), np.float32((1 + 17 + 33) / 3)))
    assert (film.samples == 48).all()


@fewer
@pytest.mark.parametrize("filter_", FILTERS)
@pytest.mark.parametrize("sampler", ["sobol", "random"])
@pytest.mark.parametrize("n", [4, 16, 24, 32])
def test_a_render_continued_from_n_to_2n_samples_is_the_render_of_2n(
    every_stage: EveryStage, n: int, sampler: str, filter_: str
) -> None:
    scene = every_stage(film={"width": 40, "height": 30, "filter": filter_})
    start = render(scene, sampler=sampler, spp=n)
    shown = start.linear.copy()
    more = render(scene, sampler=sampler, spp=2 * n, start=start)
    whole = render(scene, sampler=sampler, spp=2 * n)
    assert same(more, whole)
    assert np.array_equal(more.film.samples, whole.film.samples)
    assert more.complete
    assert np.array_equal(start.linear, shown), "the picture that was continued is untouched"
    if n >= 16:
        assert more.receipt.rays["camera"] < whole.receipt.rays["camera"], (
            "the first passes were kept"
        )


def test_continuing_twice_and_to_any_number_gives_the_same_bits(every_stage: EveryStage) -> None:
    scene = every_stage()
    start = render(scene, spp=10)
    for samples in (17, 16 + 24, 100):
        start = render(scene, spp=samples, start=start)
        assert same(start, render(scene, spp=samples))
    assert same(start, render(scene, spp=100, start=start)), "nothing left to do"


def test_only_what_fits_can_be_continued(every_stage: EveryStage) -> None:
    scene = every_stage()
    start = render(scene, spp=16)
    for change in ({"seed": 1}, {"size": (20, 10)}, {"sampler": "random"}, {"spp": 8}):
        with pytest.raises(CourseError, match="can be continued"):
            render(scene, **({"spp": 32, "start": start} | change))  # type: ignore[arg-type]
    jittered = render(scene, spp=16, sampler="jittered")
    with pytest.raises(CourseError, match="start afresh"):
        render(scene, spp=64, sampler="jittered", start=jittered)


def test_the_first_samples_of_a_longer_sobol_render_are_those_of_a_shorter_one(
    every_stage: EveryStage,
) -> None:
    scene = every_stage()
    short, long = render(scene, spp=16), render(scene, spp=32)
    second = 2 * long.linear.astype(float) - short.linear
    # What the second 16 samples brought is a picture of its own: as dark as the first in places, never negative.
    assert second.min() > -1e-5
    assert abs(second.mean() / short.linear.mean() - 1) < 0.05
