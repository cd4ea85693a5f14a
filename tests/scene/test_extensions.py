"""Keys that few scenes have: windows, backdrops, lights that nobody sees, metals; and what contradicts itself."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from course import Scene, render
from course.errors import SceneError

MakeScene = Callable[..., Scene]

FLOOR = {"shape": "quad", "material": "grey", "width": 20, "depth": 20}
LAMP = {
    "type": "rectangle",
    "corner": [-0.01, 1, -0.01],
    "edge_u": [0.02, 0, 0],
    "edge_v": [0, 0, 0.02],
    "radiance": 1e4,
}
"""Its normal, cross(edge_u, edge_v), looks down at the floor."""

ABOVE = {"eye": [0, 3, 0], "look_at": [0, 0, 0], "up": [0, 0, 1], "vertical_fov": 0.01}


def floor(make_scene: MakeScene, **keys: Any) -> float:
    """What a camera above the lamp sees of the floor, beside the lamp."""
    camera = ABOVE | {"eye": [1, 3, 0], "look_at": [1, 0, 0]}
    scene = make_scene(
        camera=camera, lights=[LAMP | keys], objects=[FLOOR], film={"width": 1, "height": 1}
    )
    return float(render(scene).linear[0, 0, 0])


@pytest.mark.parametrize("samples", ["point", "grid 2"])
@pytest.mark.parametrize("visible", [True, False])
def test_a_light_lights_its_side_or_both(
    make_scene: MakeScene, samples: str, visible: bool
) -> None:
    """0.8 / pi times L A cos cos / d^2, 45 degrees from the lamp; the lamp spans 1/70 of its distance."""
    expected = 0.8 / np.pi * 1e4 * 4e-4 * 0.5 / 2
    keys: dict[str, Any] = {"samples": samples, "visible": visible}
    towards = {"edge_u": [0, 0, 0.02], "edge_v": [0.02, 0, 0]}
    values = [floor(make_scene, **keys), floor(make_scene, **keys, **towards)]
    assert sorted(value > 0 for value in values) == [False, True]
    np.testing.assert_allclose(max(values), expected, rtol=0.02)
    if not visible:
        for edges in ({}, towards):
            both = floor(make_scene, **keys, **edges, two_sided=True)
            np.testing.assert_allclose(both, expected, rtol=0.02)


def test_a_light_that_is_not_visible_is_not_in_the_picture(make_scene: MakeScene) -> None:
    parts: dict[str, Any] = {"camera": ABOVE, "objects": [FLOOR], "film": {"width": 1, "height": 1}}
    turned = LAMP | {"edge_u": [0, 0, 0.02], "edge_v": [0.02, 0, 0]}
    for visible in (True, False):
        values = [
            float(render(make_scene(**parts, lights=[lamp | {"visible": visible}])).linear.max())
            for lamp in (LAMP, turned)
        ]
        assert (max(values) == pytest.approx(1e4)) == visible


@pytest.mark.parametrize("kind", ["all", "camera"])
def test_a_backdrop_is_seen_by_camera_rays_only(make_scene: MakeScene, kind: str) -> None:
    scene = make_scene(
        environment={"type": "constant", "radiance": 0.5, "seen_by": kind},
        materials={"grey": {"mirror": 1, "color": 0}},
        objects=[{"shape": "sphere", "material": "grey", "radius": 0.5}],
    )
    picture = render(scene, size=(9, 9)).linear
    assert picture[0, 0, 0] == 0.5
    assert picture[4, 4, 0] == (0.5 if kind == "all" else 0)


PLANE = {"left": -1, "right": 1, "bottom": -1, "top": 1}


@pytest.mark.parametrize(
    ("parts", "told"),
    [
        (
            {"camera": ABOVE | {"image_plane": PLANE | {"right": -1}}},
            "camera.image_plane.right is -1: expected a number > left, -1",
        ),
        (
            {"camera": ABOVE | {"image_plane": PLANE | {"top": -2}}},
            "camera.image_plane.top is -2: expected a number > bottom, -1",
        ),
        ({"camera": ABOVE | {"near": -1}}, "camera.near is -1: expected a number >= 0"),
        (
            {"lights": [LAMP | {"two_sided": True}]},
            "lights[0].visible: expected false for a two-sided light by radiance",
        ),
        (
            {
                "materials": {
                    "grey": {
                        "dielectric": {},
                        "conductor": {"refraction_index": 1, "absorption_index": 1},
                    }
                }
            },
            "materials.grey: both dielectric and conductor are given",
        ),
        ({"film": {"encoding": "gamma"}}, 'film.encoding is "gamma": expected linear or srgb'),
        ({"film": {"white": 0}}, "film.white is 0: expected a number > 0"),
    ],
)
def test_contradictions_are_told(make_scene: MakeScene, parts: dict[str, Any], told: str) -> None:
    with pytest.raises(SceneError) as caught:
        make_scene(objects=[FLOOR], **parts)
    assert told in str(caught.value)


def test_a_window_with_the_edges_of_a_field_of_view_is_that_view(make_scene: MakeScene) -> None:
    half = float(np.tan(np.radians(20)))
    window = {
        "left": -2 * half,
        "right": 2 * half,
        "bottom": -2 * half,
        "top": 2 * half,
        "distance": 2,
    }
    eye = {"eye": [0, 1, 4], "look_at": [0, 0, 0]}
    lights = [{"type": "ambient", "radiance": 1}]
    objects = [{"shape": "box", "material": "grey"}]
    pictures = [
        render(make_scene(camera=eye | keys, lights=lights, objects=objects)).linear
        for keys in ({}, {"image_plane": window}, {"near": 1})
    ]
    assert (pictures[0] > 0).any()
    # A sample next to an edge may fall to its other side by rounding.
    for picture in pictures[1:]:
        assert np.mean(picture != pictures[0]) < 0.01


def test_plain_highlights_have_no_cosine(make_scene: MakeScene) -> None:
    """Two spots under one light, seen from above: the plain highlight is 1 / cos as strong."""
    values = []
    for highlight in ("cosine", "plain"):
        scene = make_scene(
            camera=ABOVE,
            materials={"grey": {"color": 0, "specular": 1, "exponent": 4, "highlight": highlight}},
            lights=[{"type": "point", "position": [3, 4, 0], "intensity": 10}],
            objects=[FLOOR],
            film={"width": 1, "height": 1},
        )
        values.append(float(render(scene).linear[0, 0, 0]))
    assert values[0] > 0
    assert values[1] == pytest.approx(values[0] / 0.8, rel=1e-4)
