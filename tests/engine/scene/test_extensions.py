"""Keys that few scenes have: windows, matrices, backdrops, lights that nobody sees; and what contradicts itself."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from course import Scene, render
from course.base.errors import SceneError
from course.engine.scene.building.cameras import compile_camera
from course.engine.scene.building.objects import object_mesh
from course.engine.shapes.mesh import Mesh
from tests.tables import put, rows

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


CONTRADICTIONS = rows("""
camera/image_plane -> {left: -1, right: -1, bottom: -1, top: 1} | .right is -1: expected a number > left, -1
camera/image_plane -> {left: -1, right: 1, bottom: -1, top: -2} | .top is -2: expected a number > bottom, -1
camera/near -> -1 | camera.near is -1: expected a number >= 0
camera/handedness -> both | camera.handedness is "both": expected left or
film -> {encoding: gamma} | film.encoding is "gamma": expected linear or srgb
film -> {white: 0} | film.white is 0: expected a number from 1e-30 to 1e+30
lights/0/two_sided -> true | lights[0].visible: expected false for a two-sided light by radiance
materials/grey -> {dielectric: {}, conductor: {refraction_index: 1, absorption_index: 1}} |
    materials.grey: both dielectric and conductor are given
objects/0/transform -> [{scale: 2}, {matrix: 3}] |
    objects[0].transform[1].matrix is 3: expected 4 lists of 4 numbers
objects/0/transform -> [{matrix: [1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1]}] |
    objects[0].transform[0].matrix is [1, 1, 1, 1, ...]: expected 4 lists of 4 numbers
objects/0/transform -> [{matrix: [[1, 0, 0], [0, 1, 0], [0, 0, 1], [0, 0, 0]]}] |
    objects[0].transform[0].matrix[0] is [1, 0, 0]: expected 4 numbers
objects/0/transform -> [{matrix: [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 1, 1]]}] |
    matrix[3] is [0, 0, 1, 1]: expected [0, 0, 0, 1], the last row of any affine map
objects/0/transform -> [{matrix: [[1, 2, 3, 0], [4, 5, 6, 0], [7, 8, 9, 0], [0, 0, 0, 1]]}] |
    matrix is [[...], [...], [...], [...]]: expected rows that are independent
objects/0/transform -> [{matrix: [[0, 0, 0, 0], [0, 0, 0, 0], [0, 0, 0, 0], [0, 0, 0, 1]]}] |
    expected rows that are independent
""")


@pytest.mark.parametrize(("place", "value", "told"), CONTRADICTIONS)
def test_contradictions_are_told(make_scene: MakeScene, place: str, value: str, told: str) -> None:
    parts: dict[str, Any] = {"camera": {**ABOVE}, "lights": [{**LAMP}], "objects": [{**FLOOR}]}
    put(parts, place, value)
    with pytest.raises(SceneError) as caught:
        make_scene(**parts)
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


WINDOW = {"left": -0.5, "right": 1.5, "bottom": -0.25, "top": 1}


@pytest.mark.parametrize("keys", [{}, {"image_plane": WINDOW}], ids=["field of view", "window"])
def test_a_left_handed_camera_shows_the_right_on_the_left(
    make_scene: MakeScene, keys: dict[str, Any]
) -> None:
    """The direction through x is what the other camera has there, with its part to the right turned round."""
    eye = {"eye": [1, 2, 4], "look_at": [0, 0.5, 0], "up": [0.2, 1, 0]}
    right, left = (
        compile_camera(scene.loaded, scene.compiled.frame, 30, 20)
        for scene in (
            make_scene(camera=eye | keys | {"handedness": hand}, objects=[FLOOR])
            for hand in ("right", "left")
        )
    )
    x, y = np.array([[0, 7.5, 30, 12], [0, 3.25, 20, 20]], np.float32)
    seen, mirrored = right.directions(x, y), left.directions(x, y)
    across = right.right[:, None]
    expected = seen - 2 * across * (across * seen).sum(axis=0)
    np.testing.assert_allclose(mirrored, expected, atol=3e-7)
    np.testing.assert_array_equal(left.right, -right.right)
    np.testing.assert_array_equal(left.up, right.up)


def test_a_left_handed_picture_is_the_other_flipped(make_scene: MakeScene) -> None:
    parts: dict[str, Any] = {
        "lights": [{"type": "directional", "direction": [-1, -2, -1], "irradiance": 1}],
        "objects": [{"shape": "box", "material": "grey"}, FLOOR],
        "sampler": {"type": "regular", "samples": 1},
        "film": {"width": 24, "height": 16},
    }
    eye = {"eye": [1, 2, 4], "look_at": [0.4, 0, 0]}
    right, left = (
        render(make_scene(camera=eye | {"handedness": hand}, **parts)).linear
        for hand in ("right", "left")
    )
    assert not np.allclose(right, right[:, ::-1])
    # A sample next to an edge may fall to its other side by rounding.
    assert np.isclose(left, right[:, ::-1], atol=1e-5).mean() > 0.99


def moved(make_scene: MakeScene, transform: list[dict[str, Any]]) -> Mesh:
    ball = {"shape": "sphere", "material": "grey", "segments": 12, "transform": transform}
    loaded = make_scene(objects=[ball]).loaded
    return object_mesh(loaded.description.objects[0], 0, loaded.document, loaded.path.parent)


def test_a_matrix_is_the_steps_that_it_stands_for(make_scene: MakeScene) -> None:
    """Scaled by 2, 3, 1, turned from x to y, moved: rows worked out by hand; then another step."""
    steps = [
        {"scale": [2, 3, 1]},
        {"rotate": {"axis": [0, 0, 1], "degrees": 90}},
        {"translate": [10, 20, 30]},
    ]
    rows = [[0, -3, 0, 10], [2, 0, 0, 20], [0, 0, 1, 30], [0, 0, 0, 1]]
    after = {"rotate": {"axis": [1, 2, 3], "degrees": 40}}
    by_steps, by_matrix = (
        moved(make_scene, transform) for transform in ([*steps, after], [{"matrix": rows}, after])
    )
    np.testing.assert_allclose(by_matrix.vertices, by_steps.vertices, atol=1e-12)
    np.testing.assert_allclose(by_matrix.normals, by_steps.normals, atol=1e-12)


@pytest.mark.parametrize("sign", [1, -1])
def test_a_matrix_keeps_normals_and_triangles_outwards(make_scene: MakeScene, sign: int) -> None:
    """A ball sheared, and mirrored or not: normals are the gradient of |M^-1 p|^2."""
    rows = [[sign * 1.0, 0.5, 0, 0], [0, 1, 0.25, 0], [0, 0, 2, 0], [0, 0, 0, 1]]
    mesh = moved(make_scene, [{"matrix": rows}])
    inverse = np.linalg.inv(np.array(rows)[:3, :3])
    gradient = mesh.vertices @ inverse.T @ inverse
    # Of any length, but in proportion.
    longest = np.linalg.norm(inverse, 2)
    np.testing.assert_allclose(mesh.normals, gradient / longest, atol=1e-9)
    p = mesh.vertices[mesh.triangles]
    volume = np.einsum("ni,ni->n", p[:, 0], np.cross(p[:, 1], p[:, 2]))
    assert volume.min() > -1e-12
    assert volume.max() > 0


@pytest.mark.parametrize("size", [1e-140, 1e140])
def test_matrices_may_be_of_any_size(make_scene: MakeScene, size: float) -> None:
    rows = [[size, 0, 0, 0], [0, size, 0, 0], [0, 0, size, 0], [0, 0, 0, 1]]
    mesh = moved(make_scene, [{"matrix": rows}])
    assert np.abs(mesh.vertices).max() == pytest.approx(size, rel=1e-12)
