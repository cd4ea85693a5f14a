"""Rendering against the clock, with a clock that the test turns: no test depends on how fast a machine is."""

from typing import Any

import numpy as np
import pytest

from course import Scene, render
from course.engine.core.tiles import Area
from course.engine.core.tracer import Tracer
from course.engine.render import which_loops
from course.engine.render.binding import bind
from course.engine.terms.samplers import FUNCTIONS
from tests.conftest import MakeScene
from tests.engine.render.clock import Clock

LIMITS = (6.0, 12.0, 24.0, 48.0)
"""In looks at the clock, of which there is one before each tile."""


@pytest.fixture
def scene(make_scene: MakeScene) -> Scene:
    """A lit floor before a grey sky, in several tiles."""
    return make_scene(
        film={"width": 96, "height": 64},
        camera={"eye": [0, 1, 4], "look_at": [0, 0.5, 0]},
        environment={"type": "constant", "radiance": 0.2},
        objects=[{"shape": "quad", "material": "grey", "width": 9, "depth": 9}],
        lights=[
            {"type": "ambient", "radiance": 0.1},
            {"type": "sphere", "center": [1, 3, 1], "radius": 0.5, "intensity": 9},
        ],
    )


@pytest.mark.parametrize("sampler", FUNCTIONS)
def test_with_time_to_spare_the_picture_is_the_one_without_a_limit(
    scene: Scene, sampler: str
) -> None:
    limited = render(scene, sampler=sampler, spp=36, time_limit=1e9)
    assert limited.complete
    assert limited.linear.tobytes() == render(scene, sampler=sampler, spp=36).linear.tobytes()
    assert (limited.film.samples == 36).all()
    assert limited.receipt.samples == 36


def test_no_time_gives_a_picture_all_the_same(
    scene: Scene, monkeypatch: pytest.MonkeyPatch
) -> None:
    Clock(monkeypatch)
    picture = render(scene, time_limit=1e-3, threads=1)
    assert not picture.complete
    assert picture.linear.shape == (64, 96, 3)
    assert not picture.linear.any()
    assert picture.receipt.samples == 0


@pytest.mark.parametrize("limit", LIMITS)
def test_once_a_preview_fits_every_pixel_is_covered(
    scene: Scene, monkeypatch: pytest.MonkeyPatch, limit: float
) -> None:
    Clock(monkeypatch)
    told: list[bool] = []
    picture = render(
        scene, time_limit=limit, threads=1, progress=lambda _done, covered: told.append(covered)
    )
    assert not picture.complete
    assert picture.film.samples.min() >= 1
    assert np.isfinite(picture.linear).all()
    assert (picture.linear.max(axis=2) > 0).all(), "neither floor nor sky is black"
    assert told[-1]
    assert picture.receipt.samples == pytest.approx(picture.film.samples.mean())


def test_building_the_hierarchy_counts(scene: Scene, monkeypatch: pytest.MonkeyPatch) -> None:
    samples = []
    for building, limit in ((0.0, 24.0), (24.0, 48.0), (0.0, 2.4), (1e3, 24.0)):
        clock = Clock(monkeypatch)

        def build(*arguments: Any, clock: Clock = clock, building: float = building) -> Tracer:
            clock.now += building
            return bind(*arguments)

        monkeypatch.setattr(which_loops, "bind", build)
        picture = render(scene, time_limit=limit, threads=1, compiled=False)
        samples.append(picture.receipt.samples)
    assert samples[0] == samples[1], "as much as without building in what it leaves"
    assert samples[2] == samples[3], "a tenth of the limit, if it leaves nothing"
    assert 0 < samples[2] < samples[0]


def test_the_limit_may_count_from_earlier(scene: Scene, monkeypatch: pytest.MonkeyPatch) -> None:
    samples = []
    for before, limit in ((0.0, 24.0), (24.0, 48.0), (1e3, 24.0), (0.0, 2.4)):
        began = Clock(monkeypatch).now - before
        samples.append(render(scene, time_limit=limit, since=began, threads=1).receipt.samples)
    assert samples[0] == samples[1] > samples[2] == samples[3] > 0


def test_more_time_gives_more_samples(scene: Scene, monkeypatch: pytest.MonkeyPatch) -> None:
    samples = []
    for limit in LIMITS:
        Clock(monkeypatch)
        picture = render(scene, time_limit=limit, threads=1, compiled=False)
        samples.append(picture.receipt.samples)
    assert samples == sorted(samples)
    assert samples[-1] > 2 * samples[0]


def test_a_pixel_that_got_all_passes_in_time_is_as_good_as_without_a_limit(
    scene: Scene, monkeypatch: pytest.MonkeyPatch
) -> None:
    Clock(monkeypatch)
    picture = render(scene, spp=4096, time_limit=20.0, threads=1)
    for samples in np.unique(picture.film.samples[picture.film.samples >= 16]):
        whole = render(scene, spp=int(samples))
        these = picture.film.samples == samples
        # The sums are the same but for their order.
        np.testing.assert_allclose(picture.linear[these], whole.linear[these], rtol=1e-5)


@pytest.mark.parametrize("limit", [3.0, 7.0, 12.0, 25.0, 50.0])
def test_no_border_shows_where_time_ran_out(
    scene: Scene, monkeypatch: pytest.MonkeyPatch, limit: float
) -> None:
    """A sample of every pixel takes one unit of time. Noise differs by the root of samples: by 22% at 1.5."""
    clock, width, height = Clock(monkeypatch), 320, 240
    monkeypatch.setattr(clock, "tick", 0.0)
    trace = Tracer.render_tile

    def taking_time(tracer: Tracer, tile: Area, first: int, samples: int, *others: Any) -> Any:
        clock.now += tile.size * samples / (width * height)
        return trace(tracer, tile, first, samples, *others)

    monkeypatch.setattr(Tracer, "render_tile", taking_time)
    size = (width, height)
    picture = render(scene, size=size, spp=4096, time_limit=limit, threads=1, compiled=False)
    samples = picture.film.samples
    assert samples.max() <= 1.5 * samples.min() or samples.max() == 2
    # But for the first look, and what is left of the last.
    assert samples.mean() > 0.85 * (limit - 1)


def test_samples_asked_for_are_not_exceeded(scene: Scene) -> None:
    assert render(scene, spp=4, time_limit=1e9).receipt.samples == 4


def test_progress_goes_up_to_one(scene: Scene) -> None:
    done: list[float] = []
    covered: list[bool] = []

    def progress(share: float, whole: bool) -> None:
        done.append(share)
        covered.append(whole)

    render(scene, spp=64, progress=progress, threads=4)
    assert done == sorted(done)
    assert done[-1] == 1
    assert covered[-1]
    assert 0 <= done[0] <= 1
