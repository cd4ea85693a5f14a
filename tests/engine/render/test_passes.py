"""Passes: each has every pixel once; what is rendered at once is large while much is left, and small at the end."""

from dataclasses import replace

import numpy as np
import pytest

from course import load_scene
from course.engine.core.film import Film
from course.engine.core.rays import RAYS
from course.engine.core.tiles import PASS, Work
from course.engine.functions.effects import PROJECT
from course.engine.render.threads import InOrder
from course.engine.scene.scene import SceneSettings
from course.engine.terms.samplers.sobol import SobolSampler
from course.engine.terms.work import SHARES, divided_passes

WIDTH, HEIGHT, SAMPLES = 1000, 800, 64


def settings(samples: int = SAMPLES) -> SceneSettings:
    scene = load_scene(PROJECT / "scenes" / "path_tracing.yaml")
    return replace(scene.settings, width=WIDTH, height=HEIGHT, samples=samples)


def work_of(batches: int, threads: int, done: int = 0) -> list[Work]:
    return list(divided_passes(settings(), SobolSampler(seed=0), done, batches, threads))


@pytest.mark.parametrize("threads", [1, 2, 9])
@pytest.mark.parametrize("batches", [1, 2, 16])
def test_each_pass_has_every_pixel_once(batches: int, threads: int) -> None:
    work = work_of(batches, threads)
    assert [item.order for item in work] == sorted(item.order for item in work)
    for order in range(SAMPLES // PASS):
        count = np.zeros((HEIGHT, WIDTH), int)
        for item in work:
            if item.order == order:
                assert item.first == order * PASS
                assert item.samples == PASS
                count[item.tile.rows, item.tile.columns] += 1  # type: ignore[attr-defined]
        assert (count == 1).all()


@pytest.mark.parametrize("threads", [1, 2, 9])
@pytest.mark.parametrize("batches", [2, 3, 16])
def test_little_is_rendered_at_once_where_little_is_left(batches: int, threads: int) -> None:
    left = WIDTH * HEIGHT * SAMPLES // PASS
    one = RAYS // PASS
    sizes = []
    for item in work_of(batches, threads):
        assert item.tile.size <= max(min(left // (SHARES * threads), batches * one), one)
        left -= item.tile.size
        sizes.append(item.tile.size)
    assert left == 0
    # Tiles are powers of two wide, and halved.
    assert max(sizes) > min(batches * one, WIDTH * HEIGHT * 4 // (SHARES * threads)) / 2.2
    assert sizes[-1] <= one
    # Early passes are not divided, as long as no tile has a thread's share of all of it.
    assert len(sizes) < 4 * WIDTH * HEIGHT / one


@pytest.mark.parametrize("seed", range(4))
def test_a_film_gets_the_passes_of_each_pixel_in_order_whatever_comes_first(seed: int) -> None:
    """Parts of a tile may overtake each other, and its passes; no pixel sees that."""
    seen = np.zeros((HEIGHT, WIDTH), int)

    class Watcher(Film):
        def add(self, tile, mean, weight, samples, whole):  # type: ignore[no-untyped-def]
            assert (seen[tile.rows, tile.columns] == samples - PASS).all()
            seen[tile.rows, tile.columns] = samples

    work = work_of(16, 3)
    assert len({(item.tile.number, item.order) for item in work}) < len(work), "parts of tiles"
    np.random.default_rng(seed).shuffle(work)  # type: ignore[arg-type]
    film = InOrder(Watcher(1, 1))
    nothing = np.zeros((3, 0), np.float32)
    for item in work:
        film.add(item, nothing, 1.0)
    assert (seen == SAMPLES).all()
    assert film.done == len(work)
    assert film.done_first == sum(item.order == 0 for item in work)
