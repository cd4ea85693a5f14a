"""Surfaces in patches: halved without gaps, as many as asked for, of scenes that have a radiosity."""

import math

import numpy as np
import pytest

from course.base.errors import SceneError
from course.engine.functions.effects import PROJECT
from course.engine.radiosity.patches import make_patches
from course.engine.scene.building.cutting import SharedTriangles, bisected, undivided
from tests.conftest import MakeScene
from tests.engine.radiosity.rooms import CAMERA, plates
from tests.tables import put, rows


def angles(triangles: SharedTriangles) -> np.ndarray:
    p = triangles.vertices[triangles.corners]
    a, b = np.roll(p, -1, axis=1) - p, np.roll(p, 1, axis=1) - p
    cosine = (a * b).sum(axis=2) / np.linalg.norm(a, axis=2) / np.linalg.norm(b, axis=2)
    return np.arccos(np.clip(cosine, -1, 1))


def square(n: int) -> SharedTriangles:
    """Rows of n by n unit squares of two triangles each."""
    x, y = np.meshgrid(np.arange(n + 1.0), np.arange(n + 1.0))
    vertices = np.stack((x.ravel(), y.ravel(), np.zeros(x.size)), axis=1)
    low = (np.arange(n)[:, None] * (n + 1) + np.arange(n)).ravel()
    right, up = low + 1, low + n + 1
    corners = np.concatenate(
        (np.stack((low, right, up + 1), axis=1), np.stack((low, up + 1, up), axis=1))
    )
    return undivided(vertices, corners)


def assert_whole_edges(triangles: SharedTriangles, outline: float) -> None:
    """Inside, every edge belongs to two triangles that go along it in opposite ways."""
    c = triangles.corners
    edges = np.concatenate((c[:, :2], c[:, 1:], c[:, [2, 0]]))
    there, count = np.unique(edges, axis=0, return_counts=True)
    assert (count == 1).all()
    both = {tuple(edge) for edge in there.tolist()}
    alone = np.array([edge for edge in both if edge[::-1] not in both])
    p = triangles.vertices
    length = np.linalg.norm(p[alone[:, 0]] - p[alone[:, 1]], axis=1).sum()
    assert length == pytest.approx(outline, rel=1e-12)


@pytest.mark.parametrize("seed", range(4))
def test_neighbours_share_whole_edges_after_any_choice(seed: int) -> None:
    rng = np.random.default_rng(seed)
    triangles = square(3)
    smallest = angles(triangles).min()
    for _ in range(6):
        chosen = rng.random(triangles.size) < 0.2
        before, triangles = triangles.size, bisected(triangles, chosen)
        assert triangles.size >= before + chosen.sum()
        assert_whole_edges(triangles, 12)
        p = triangles.vertices[triangles.corners]
        assert (np.cross(p[:, 1] - p[:, 0], p[:, 2] - p[:, 0])[:, 2] > 0).all()
        assert triangles.areas().sum() == pytest.approx(9, rel=1e-12)
    assert angles(triangles).min() >= smallest / 2 - 1e-9
    # Each part lies where it came from.
    areas = np.bincount(triangles.origin, triangles.areas(), 18)
    assert np.allclose(areas, 0.5, rtol=1e-12)


def test_nothing_chosen_changes_nothing() -> None:
    triangles = square(2)
    after = bisected(triangles, np.zeros(8, bool))
    assert (after.corners == triangles.corners).all()
    assert (after.vertices == triangles.vertices).all()


@pytest.mark.parametrize("count", [1, 100, 1500])
def test_there_are_as_many_patches_as_asked_for(make_scene: MakeScene, count: int) -> None:
    patches = make_patches(make_scene(**plates(0.5)), count)
    # The two plates have four triangles to begin with.
    assert max(count, 4) <= patches.size <= max(count, 4) + 4
    areas = patches.triangles.areas()
    plain = areas[~patches.lamps]
    assert plain.max() <= 4.01 * plain.min()
    if count > 100:
        assert areas[patches.lamps].mean() > 3 * plain.mean()


def test_what_patches_are_made_of(make_scene: MakeScene) -> None:
    scene = make_scene(
        camera=CAMERA,
        materials={"red": {"color": [0.6, 0.1, 0], "diffuse": 0.5}, "grey": {"mirror": 0}},
        lights=[{"type": "sphere", "center": [0, 3, 0], "radius": 0.5, "radiance": [1, 2, 3]}],
        objects=[
            {"shape": "quad", "material": "red"},
            {"shape": "box", "material": "grey", "transform": [{"translate": [0, 1, 0]}]},
        ],
    )
    patches = make_patches(scene, 1)
    assert patches.size == 2 + 12 + int(patches.lamps.sum())
    assert np.allclose(patches.reflectance[:, 0], [0.3, 0.05, 0])
    assert np.allclose(patches.reflectance[:, 2], 0.8)
    lamp = patches.emission[:, patches.lamps]
    assert np.allclose(lamp, math.pi * np.array([[1], [2], [3]]), rtol=1e-6)
    # As large as the true sphere, and so as bright.
    area = patches.triangles.areas()[patches.lamps].sum() * scene.compiled.frame.scale**2
    assert area == pytest.approx(4 * math.pi * 0.25, rel=1e-9)
    # A box has six plane faces, a sphere is one surface.
    assert len(np.unique(patches.surface[2:14])) == 6
    assert len(np.unique(patches.surface[patches.lamps])) == 1


def test_what_glows_emits_from_both_sides_and_is_a_lamp_where_it_reflects_nothing(
    make_scene: MakeScene,
) -> None:
    room = plates(0.5, radiance=3)
    panel = {"shape": "quad", "transform": [{"translate": [0, 2, 0]}]}
    patches = make_patches(
        make_scene(
            camera=CAMERA,
            materials={
                "grey": {"color": 0.5},
                "black": {"color": 0, "emission": [1, 0, 2]},
                "white": {"color": 0.8, "emission": 1},
            },
            lights=room["lights"],
            objects=[
                *room["objects"],
                panel | {"material": "black"},
                panel | {"material": "white"},
            ],
        ),
        1,
    )
    assert np.allclose(patches.emission[:, ::2].T / math.pi, [[0] * 3, [1, 0, 2], [1] * 3, [3] * 3])
    assert np.allclose(
        patches.back_emission[:, ::2].T / math.pi, [[0] * 3, [1, 0, 2], [1] * 3, [0] * 3]
    )
    assert patches.lamps[::2].tolist() == [False, True, False, True]
    # All of it goes on to the halves of a triangle.
    halves = patches.split(np.arange(8) == 2)
    assert np.allclose(halves.back_emission[0, halves.triangles.origin == 2], math.pi)


TILES = PROJECT / "scenes" / "textures" / "tiles.png"


REFUSED = rows(f"""
materials/grey/mirror -> 0.5 | materials.grey.mirror is 0.5: expected 0 for radiosity, which knows diffuse
materials/grey/specular -> 0.2 | materials.grey.specular is 0.2: expected 0 for radiosity, which knows diffuse
materials/grey/dielectric -> {{}} | reflection only; or use course render
materials/grey/conductor -> {{refraction_index: 1, absorption_index: 2}} | materials.grey.conductor: expected null
materials/grey/texture -> {{image: {TILES}}} | materials.grey.texture: expected null
camera/handedness -> left | camera.handedness is "left": expected right
camera/lens -> {{aperture_radius: 0.1, focus_distance: 1}} | camera.lens.aperture_radius is 0.1: expected 0
camera/near -> 0.1 | camera.near is 0.1: expected 0
camera/image_plane -> {{left: -1, right: 1, bottom: -1, top: 1}} | camera.image_plane: expected vertical_fov
camera/motion -> {{velocity: [1, 0, 0]}} | camera.motion.velocity is [1, 0, 0]: expected 0
environment/radiance -> 0.2 | environment.radiance is 0.2: expected 0
lights -> [] | lights: nothing shines: expected a light that is a rectangle or a sphere
lights/0/visible -> false | lights[0].visible is false: expected true
lights/0/motion -> {{velocity: [1, 0, 0]}} | lights[0].motion.velocity is [1, 0, 0]: expected 0
lights/1 -> {{type: point, position: [0, 1, 0], intensity: 1}} | lights[1].type is "point": expected a rectangle
lights/1 -> {{type: directional, direction: [0, -1, 0], irradiance: 1}} | lights[1].type is "directional": expected
lights/1 -> {{type: ambient, radiance: 0.1}} | lights[1].radiance is 0.1: expected 0
lights/1 -> {{type: sphere, center: [0, 3, 0], radius: 0.1, intensity: 1}} |
    lights[1].intensity is 1: expected radiance instead
objects/0/motion -> {{velocity: [0, 1, 0]}} | objects[0].motion.velocity is [0, 1, 0]: expected 0
objects/0 -> {{shape: sphere, material: grey, segments: 512}} | objects[0]: the scene has
""")


@pytest.mark.parametrize(("place", "value", "told"), REFUSED)
def test_scenes_without_radiosity_are_refused(
    make_scene: MakeScene, place: str, value: str, told: str
) -> None:
    parts = plates(0.5) | {"camera": dict(CAMERA), "environment": {"type": "constant"}}
    put(parts, place, value)
    with pytest.raises(SceneError) as caught:
        make_patches(make_scene(**parts), 10)
    assert "scene.yaml:1: " in str(caught.value)
    assert told in str(caught.value)


def test_a_material_that_nothing_has_may_be_a_mirror(make_scene: MakeScene) -> None:
    room = plates(0.5)
    room["materials"]["mirror"] = {"mirror": 1}
    make_patches(make_scene(**room), 4)
