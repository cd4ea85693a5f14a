"""Scenes whose numbers `quasi_monte_carlo`, `sampling` and `blue_noise` draw: the right picture, another each seed.

The mean picture of S seeds is compared with Sobol's of as many: the mean of each channel over the whole picture, as a
difference over its own standard error, which the spread over the seeds tells. With 2 S - 2 = 30 degrees of freedom a
difference of 7 standard errors comes by chance once in 1e7 (Student's t); 36 are looked at, with fixed seeds.
"""

import re
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from course import Scene, render
from course.base.errors import CourseError, SceneError
from course.engine.terms.samplers import FUNCTIONS
from tests.conftest import MakeScene

NEW = ("halton", "hammersley", "chained", "xorshift", "blue_noise", "dithered")
SEEDS = 16

PLATE = {"shape": "quad", "width": 40, "depth": 40}
LENS = {"aperture_radius": 0.2, "focus_distance": 3}


def full(make_scene: MakeScene, integrator: str, **lens: Any) -> Scene:
    """A lens, a lamp, gloss, motion and, with paths, diffuse bounces: every kind of dimension."""
    return make_scene(
        camera={"eye": [0, 1.4, 3.5], "look_at": [0, 0.4, 0], "lens": LENS | lens},
        film={"width": 16, "height": 12},
        integrator={"type": integrator, "max_depth": 3},
        environment={"type": "constant", "radiance": [0.2, 0.3, 0.5]},
        materials={
            "floor": {"color": 0.5, "mirror": 0.3, "gloss": {"lobe": "phong", "exponent": 20}},
            "ball": {"color": [0.8, 0.4, 0.2]},
        },
        objects=[
            PLATE | {"material": "floor"},
            {
                "shape": "sphere",
                "material": "ball",
                "radius": 0.5,
                "motion": {"velocity": [1, 0, 0]},
            }
            | {"transform": [{"translate": [0, 0.6, 0]}]},
        ],
        lights=[{"type": "sphere", "center": [1, 3, 1], "radius": 0.7, "intensity": 8}],
    )


def means(scene: Scene, sampler: str, samples: int = 48) -> NDArray[np.float64]:
    """(SEEDS, 3) mean of each picture."""
    pictures = [render(scene, sampler=sampler, spp=samples, seed=seed) for seed in range(SEEDS)]
    return np.array([picture.linear.mean(axis=(0, 1)) for picture in pictures], np.float64)


_of_sobol: dict[str, NDArray[np.float64]] = {}


def sobols(make_scene: MakeScene, integrator: str) -> NDArray[np.float64]:
    """Sobol's means, which several tests hold others against."""
    if integrator not in _of_sobol:
        _of_sobol[integrator] = means(full(make_scene, integrator), "sobol")
    return _of_sobol[integrator]


def far(a: NDArray[np.float64], b: NDArray[np.float64]) -> float:
    """The largest difference between two means, in its standard errors."""
    error = np.sqrt((a.var(axis=0, ddof=1) + b.var(axis=0, ddof=1)) / SEEDS)
    return float((np.abs(a.mean(axis=0) - b.mean(axis=0)) / error).max())


@pytest.mark.parametrize("integrator", ["distribution", "path"])
def test_pictures_have_the_mean_that_sobol_has(make_scene: MakeScene, integrator: str) -> None:
    scene = full(make_scene, integrator)
    sobol = sobols(make_scene, integrator)
    found = {sampler: far(means(scene, sampler), sobol) for sampler in NEW}
    assert max(found.values()) < 7, found


@pytest.mark.parametrize("samples", ["polar", "rejection"])
def test_every_way_to_a_disk_gives_the_same_mean(make_scene: MakeScene, samples: str) -> None:
    sobol = sobols(make_scene, "distribution")
    other = full(make_scene, "distribution", samples=samples)
    assert far(means(other, "sobol"), sobol) < 7
    assert far(means(other, "xorshift"), sobol) < 7


@pytest.mark.parametrize("sampler", NEW)
def test_neighbouring_pixels_have_points_of_their_own(make_scene: MakeScene, sampler: str) -> None:
    # All pixels see the same place in a lamp's penumbra: equal points would give equal pixels.
    scene = make_scene(
        camera={"eye": [0, 1, 0], "look_at": [0, 0, 0], "up": [0, 0, -1], "vertical_fov": 0.001},
        film={"width": 12, "height": 12},
        materials={"grey": {"specular": 0}},
        objects=[
            PLATE | {"material": "grey"},
            {"shape": "quad", "material": "grey", "width": 20, "depth": 20}
            | {"transform": [{"translate": [10.03, 2, 0]}]},
        ],
        lights=[{"type": "sphere", "center": [0.1, 4, 0], "radius": 0.9, "intensity": 9}],
    )
    values = render(scene, sampler=sampler, spp=5).linear[..., 0]
    assert values.std() > 0.01 * values.mean()
    # Of some hundred thousand values that can be told apart, 144 pixels have most for themselves.
    assert len(np.unique(values.round(5))) > 120


@pytest.mark.parametrize("sampler", ["halton", "xorshift"])
def test_a_picture_is_continued(make_scene: MakeScene, sampler: str) -> None:
    scene = full(make_scene, "distribution")
    start = render(scene, sampler=sampler, spp=24)
    more = render(scene, sampler=sampler, spp=40, start=start)
    whole = render(scene, sampler=sampler, spp=40)
    assert more.linear.tobytes() == whole.linear.tobytes()


@pytest.mark.parametrize("sampler", ["hammersley", "chained"])
def test_points_that_are_placed_all_at_once_are_not_continued(
    make_scene: MakeScene, sampler: str
) -> None:
    scene = full(make_scene, "distribution")
    start = render(scene, sampler=sampler, spp=16)
    with pytest.raises(CourseError, match=f"the {sampler} sampler places all its samples at once"):
        render(scene, sampler=sampler, spp=32, start=start)


def test_an_error_is_aimed_at_with_xorshift(make_scene: MakeScene) -> None:
    scene = full(make_scene, "distribution")
    picture = render(scene, sampler="xorshift", error=0.04)
    assert picture.complete
    truth = render(scene, spp=1024).linear
    assert np.sqrt(((picture.linear - truth) ** 2).mean()) < 0.06


def test_rejection_gives_the_same_bits_again_and_others_elsewhere(make_scene: MakeScene) -> None:
    scene = full(make_scene, "distribution", samples="rejection")
    one = render(scene, spp=24, threads=1).linear
    assert one.tobytes() == render(scene, spp=24, threads=2).linear.tobytes()
    assert one.tobytes() != render(scene, spp=24, seed=1).linear.tobytes()
    lens = scene.compiled.world.lens
    assert lens is not None
    u = np.random.default_rng(1).random((2, 2, 100), np.float32)
    first, again, other = (lens.points(numbers) for numbers in (u[0], u[0], u[1]))
    assert (first == again).all()
    assert not np.isin(other, first).any()


def test_a_lens_that_is_no_disk_has_one_way_to_its_points(make_scene: MakeScene) -> None:
    message = re.escape('camera.lens.samples is "polar": expected point for a square')
    with pytest.raises(SceneError, match=message):
        full(make_scene, "distribution", samples="polar", shape="square").compiled  # noqa: B018


@pytest.mark.parametrize("samples", ["point", "polar", "rejection"])
def test_a_receipt_names_the_function_that_places_points(
    make_scene: MakeScene, samples: str
) -> None:
    receipt = render(full(make_scene, "distribution", samples=samples)).receipt.to_dict()
    name = {"polar": "sampling.disk_by_polar", "rejection": "sampling.disk_by_rejection"}
    disks = ["thin_lens.point_on_disk", *name.values()]
    called = [function for function in disks if function in receipt["effects"]["called"]]
    assert called == [name.get(samples, "thin_lens.point_on_disk")]


def test_every_sampler_of_the_format_has_its_functions() -> None:
    from course.cli.render import SAMPLERS
    from course.engine.formats.yaml.schema import json_schema

    kinds = json_schema()["$defs"]["SamplerDescription"]["properties"]["type"]["enum"]
    assert set(kinds) == set(FUNCTIONS) == set(SAMPLERS)
