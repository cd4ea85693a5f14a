"""What path tracing does with keys that few scenes have: metals, backdrops, lights that nobody sees.

Where every path brings the same there is no noise, and the tolerance is that of float32 sums. Else pixels of the random
sampler are independent estimates of one number, whose mean is within 5.33 of its standard errors (false-fail rate 1e-7
for each of the 9 such numbers).
"""

from typing import Any

import numpy as np
import pytest

from course import render
from tests.conftest import MakeScene
from tests.engine.terms.lights.over_a_floor import (
    PATHS,
    RECTANGLE,
    assert_mean,
    over_a_floor,
    share,
)
from tests.engine.terms.lights.over_a_floor import WALL as MIRROR

METAL = {"refraction_index": [0.37, 2.5, 0.0], "absorption_index": [2.82, 0.0, 1.0]}
N, K = (np.array(METAL[key]) for key in ("refraction_index", "absorption_index"))
HEAD_ON = ((N - 1) ** 2 + K * K) / ((N + 1) ** 2 + K * K)
"""What the metal mirrors of light along its normal."""

AHEAD = {"eye": [0, 0, 4], "look_at": [0, 0, 0], "vertical_fov": 0.01}
FACING = [{"rotate": {"axis": [1, 0, 0], "degrees": 90}}]
WALL = {"shape": "quad", "material": "m", "width": 9, "depth": 9, "transform": FACING}


# ---------------------------------------------------------------- metals


@pytest.mark.parametrize("mirror", [1.0, 0.5])
def test_a_metal_mirrors_its_fresnel_reflectance(make_scene: MakeScene, mirror: float) -> None:
    scene = make_scene(
        camera=AHEAD,
        materials={"m": {"color": 0, "mirror": mirror, "conductor": METAL}},
        objects=[WALL],
        environment={"type": "constant", "radiance": 1},
        integrator=PATHS,
    )
    assert np.allclose(render(scene).linear, mirror * HEAD_ON, rtol=1e-5)


def test_a_metal_that_also_scatters_takes_either_way_as_often_as_it_brings(
    make_scene: MakeScene,
) -> None:
    """0.2 of the white room by shadow rays, and of the mirrored way, which is chosen by chance, the metal's share."""
    scene = make_scene(
        camera=AHEAD,
        materials={"m": {"color": 0.2, "mirror": 0.6, "conductor": METAL}},
        objects=[WALL],
        environment={"type": "constant", "radiance": 1, "lights": True},
        sampler={"type": "random", "samples": 64},
        integrator=PATHS,
    )
    assert_mean(render(scene, size=(64, 64)), 0.2 + 0.6 * HEAD_ON)


def test_metals_are_as_the_distribution_ray_tracer_shows_them(make_scene: MakeScene) -> None:
    """A ball: every angle. With one way to go both follow the same rays."""
    ball = {"shape": "sphere", "material": "m", "radius": 1.2}
    parts: dict[str, Any] = {
        "materials": {"m": {"color": 0, "mirror": 0.9, "conductor": METAL}},
        "objects": [ball],
        "environment": {"type": "constant", "radiance": [1, 2, 3]},
    }
    pictures = [
        render(make_scene(**parts, integrator=integrator)).linear
        for integrator in (PATHS, {"max_depth": 20, "cutoff": 0})
    ]
    assert np.ptp(pictures[0][..., 1]) > 0.5
    assert np.allclose(pictures[0], pictures[1], rtol=1e-5)


# ---------------------------------------------------------------- backdrops


@pytest.mark.parametrize("kind", ["all", "camera"])
def test_only_the_camera_sees_a_backdrop(make_scene: MakeScene, kind: str) -> None:
    """Not the mirror, not through the glass."""
    for material in ({"mirror": 1, "color": 0}, {"dielectric": {}, "color": 0}):
        scene = make_scene(
            camera=AHEAD | {"vertical_fov": 40},
            environment={"type": "constant", "radiance": 0.5, "seen_by": kind},
            materials={"m": material},
            objects=[{"shape": "sphere", "material": "m", "radius": 0.5}],
            integrator=PATHS,
        )
        picture = render(scene, size=(9, 9)).linear
        assert picture[0, 0, 0] == 0.5
        assert picture[4, 4, 0] == pytest.approx(0.5 if kind == "all" else 0, rel=1e-5)


# ---------------------------------------------------------------- lights that nobody sees


@pytest.mark.parametrize("two_sided", [False, True])
def test_a_light_that_is_not_visible_lights_once_and_is_in_no_mirror(
    make_scene: MakeScene, two_sided: bool
) -> None:
    """Were it there for the paths over the mirror beside it, they would add its image's light."""
    lamp = RECTANGLE | {"radiance": 3, "visible": False, "two_sided": two_sided}
    scene = over_a_floor(make_scene, [MIRROR], [lamp], PATHS | {"max_depth": 3})
    # The camera looks through where it is: nothing stands there.
    assert_mean(render(scene, spp=64), 0.5 * 3 * share())


def test_a_light_that_is_not_visible_is_not_seen(make_scene: MakeScene) -> None:
    camera = {"eye": [0.7, 0.2, 0], "look_at": [0.7, 1, 0], "up": [0, 0, 1], "vertical_fov": 1}
    for visible in (True, False):
        scene = make_scene(
            camera=camera,
            materials={"m": {}},
            objects=[WALL | {"transform": [{"translate": [0, -5, 0]}]}],
            lights=[RECTANGLE | {"radiance": 3, "visible": visible}],
            integrator=PATHS,
        )
        assert (render(scene).linear == (3 if visible else 0)).all()


# ---------------------------------------------------------------- the receipt


@pytest.mark.parametrize(
    ("integrator", "reason"),
    [
        ({"type": "distribution"}, "the integrator is the distribution ray tracer"),
        ({"type": "path", "max_depth": 0}, "no path goes on from a diffuse surface"),
        ({"type": "path"}, None),
    ],
)
def test_the_receipt_says_why_paths_are_not_traced(
    make_scene: MakeScene, integrator: dict[str, Any], reason: str | None
) -> None:
    lights = [{"type": "point", "position": [0, 0, 2], "intensity": 1}]
    materials: dict[str, Any] = {"m": {}}
    scene = make_scene(objects=[WALL], lights=lights, materials=materials, integrator=integrator)
    receipt = render(scene).receipt
    assert receipt.effects["skipped"].get("path_tracing") == reason
    assert ("path" in receipt.rays) == (reason is None)
