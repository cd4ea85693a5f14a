"""What camera rays see of triangles from behind, and that no other rays mind.

Expected pictures are worked out in float64, for axis-parallel walls by hand and for the rest by a tracer of a few lines
that shares no code with the engine.
"""

import math
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from course import Scene, load_scene, render
from course.base.errors import SceneError
from course.engine.formats.meshes.files import save_ply
from course.engine.radiosity.accepting import check_accepted
from course.engine.shapes.mesh import Mesh
from tests.lengths import fewer

MakeScene = Callable[..., Scene]
PixelRays = Callable[[Scene], tuple[NDArray[np.float64], NDArray[np.float64]]]


def triangles(number: int) -> NDArray[np.float64]:
    """Corners (number, 3, 3) of triangles at random in a cube of edge 2, whose backs are as often seen."""
    rng = np.random.default_rng(11)
    middle = rng.uniform(-0.8, 0.8, (number, 1, 3))
    return np.asarray(middle + rng.uniform(-0.45, 0.45, (number, 3, 3)))


def flat(name: str, from_behind: str = "unseen", **keys: Any) -> dict[str, Any]:
    """An object of the mesh and of the material of that name."""
    own = {"material": name, "file": f"{name}.ply", "from_behind": from_behind}
    return {"shape": "mesh", "shading": "flat"} | own | keys


def of_triangles(
    make_scene: MakeScene, corners: NDArray[np.float64], from_behind: str, **parts: Any
) -> Scene:
    """Triangles in 5 greys, seen from +z without light from anywhere: each sends out its own grey."""
    folder = make_scene().path.parent
    objects = []
    for grey in range(5):
        mine = corners[grey::5].reshape(-1, 3)
        save_ply(Mesh(mine, np.arange(len(mine)).reshape(-1, 3)), folder / f"{grey}.ply")
        objects.append(flat(f"{grey}", from_behind=from_behind))
    return make_scene(
        **{
            "camera": {"eye": [0.3, 0.4, 5], "look_at": [0, 0, 0], "vertical_fov": 30},
            "film": {"width": 96, "height": 96},
            "sampler": {"type": "regular", "samples": 1},
            "materials": {f"{g}": {"color": 0, "emission": (g + 1) / 5} for g in range(5)},
            "objects": objects,
        }
        | parts
    )


def greys(
    eye: NDArray[np.float64], way: NDArray[np.float64], corners: NDArray[np.float64], culled: bool
) -> NDArray[np.float64]:
    """Of rays (3, H, W) from an eye the grey of the nearest triangle, fronts alone if the others are culled."""
    nearest, grey = np.full(way.shape[1:], np.inf), np.zeros(way.shape[1:])
    for number, (a, b, c) in enumerate(corners):
        normal = np.cross(b - a, c - a)
        facing = np.tensordot(normal, way, 1)
        t = normal @ (a - eye) / facing
        point = eye[:, None, None] + t * way - a[:, None, None]
        u = np.tensordot(np.cross(normal, c - a), point, 1) / (np.cross(normal, c - a) @ (b - a))
        v = np.tensordot(np.cross(normal, b - a), point, 1) / (np.cross(normal, b - a) @ (c - a))
        met = (u >= 0) & (v >= 0) & (u + v <= 1) & (t > 0) & (t < nearest)
        if culled:
            met &= facing < 0
        nearest[met], grey[met] = t[met], (number % 5 + 1) / 5
    return grey


@fewer
@pytest.mark.parametrize("kind", ["distribution", "path"])
@pytest.mark.parametrize("from_behind", ["turned", "unseen"])
def test_backs_that_are_unseen_are_looked_through_one_after_the_other(
    make_scene: MakeScene, pixel_rays: PixelRays, from_behind: str, kind: str, compiled: bool
) -> None:
    corners = triangles(300)
    scene = of_triangles(make_scene, corners, from_behind, integrator={"type": kind})
    expected = greys(*pixel_rays(scene), corners, from_behind == "unseen")
    got = render(scene, compiled=compiled).linear[..., 0]
    # Pixels whose rays pass within rounding of an edge.
    assert (np.abs(got - expected) > 1e-6).sum() <= 3


def test_so_they_are_where_the_eye_moves_though_things_that_move_along_look_still(
    make_scene: MakeScene, pixel_rays: PixelRays, compiled: bool
) -> None:
    """The picture is that without motion; no triangle is known to be unseen before the rays are cast."""
    corners = triangles(300)
    motion = {"velocity": [0.7, -0.2, 0.4]}
    still = of_triangles(make_scene, corners, "unseen")
    expected = greys(*pixel_rays(still), corners, True)
    camera = {"eye": [0.3, 0.4, 5], "look_at": [0, 0, 0], "vertical_fov": 30, "motion": motion}
    description = still.loaded.description
    objects = [flat(f"{grey}", motion=motion) for grey in range(len(description.objects))]
    scene = of_triangles(make_scene, corners, "unseen", camera=camera, objects=objects)
    got = render(scene, compiled=compiled).linear[..., 0]
    assert (np.abs(got - expected) > 1e-6).sum() <= 12


def test_a_front_and_a_back_in_one_place_show_the_front(
    make_scene: MakeScene, compiled: bool
) -> None:
    """A sheet of two squares that look to either side, cut along different diagonals, at no round place."""
    square = np.array([[-1, -1, 0.1], [1, -1, -0.3], [1, 1, 0.2], [-1, 1, 0.6]]) * 0.9
    one, two = square[[0, 1, 2, 0, 2, 3]], square[[0, 3, 1, 1, 3, 2]]
    folder = make_scene().path.parent
    objects = []
    for name, corners in (("front", one), ("back", two)):
        save_ply(Mesh(corners, np.arange(6).reshape(-1, 3)), folder / f"{name}.ply")
        objects.append(flat(name))
    for z, grey in ((4, 0.5), (-4, 0.25)):
        scene = make_scene(
            camera={"eye": [0.2, 0.1, z], "look_at": [0, 0, 0.15], "vertical_fov": 12},
            film={"width": 32, "height": 32},
            materials={
                "front": {"color": 0, "emission": 0.5},
                "back": {"color": 0, "emission": 0.25},
            },
            objects=objects,
        )
        np.testing.assert_allclose(render(scene, compiled=compiled).linear, grey, rtol=1e-6)


@pytest.mark.parametrize("kind", ["distribution", "path"])
@pytest.mark.parametrize("lens", [None, {"aperture_radius": 0.2, "focus_distance": 4}])
def test_shadow_rays_and_mirrored_rays_meet_them(
    make_scene: MakeScene, lens: dict[str, Any] | None, kind: str, compiled: bool
) -> None:
    """A lid looks up, the camera below sees the mirror through nothing but air: in it the lid's back."""
    lid = {
        "shape": "quad",
        "material": "lid",
        "width": 40,
        "depth": 40,
        "transform": [{"translate": [0, 3, 0]}],
        "from_behind": "unseen",
    }

    def seen(
        material: dict[str, Any], eye: list[float], depth: int = 1, **parts: Any
    ) -> np.ndarray:
        scene = make_scene(
            camera={"eye": eye, "look_at": [0, 0, 0], "vertical_fov": 5, "lens": lens},
            film={"width": 8, "height": 8},
            materials={"floor": material, "lid": {"color": 0, "emission": 0.25}},
            objects=[{"shape": "quad", "material": "floor", "width": 40, "depth": 40}, lid],
            integrator={"type": kind, "max_depth": depth},
            **parts,
        )
        return np.asarray(render(scene, compiled=compiled).linear)

    mirror = {"color": 0, "mirror": 1}
    np.testing.assert_allclose(seen(mirror, [0, 2, 2]), 0.25, rtol=1e-6)
    white = {"color": 1}
    sun = {"type": "directional", "direction": [0, -1, 0], "irradiance": math.pi}
    np.testing.assert_array_equal(seen(white, [0, 2, 2], 0, lights=[sun]), 0)
    # From above its front is seen, and from below the sky through it.
    np.testing.assert_allclose(seen(white, [0, 6, 2]), 0.25, rtol=1e-6)
    sky = {"type": "constant", "radiance": 0.75}
    scene = make_scene(
        camera={"eye": [0, 1, 0], "look_at": [1, 2, 0], "vertical_fov": 5, "lens": lens},
        film={"width": 8, "height": 8},
        environment=sky,
        materials={"lid": {"color": 0}},
        objects=[lid],
    )
    np.testing.assert_allclose(render(scene, compiled=compiled).linear, 0.75, rtol=1e-6)


@fewer
@pytest.mark.parametrize("kind", ["distribution", "path"])
@pytest.mark.parametrize("from_behind", ["turned", "kept"])
def test_normals_that_are_kept_show_the_light_of_the_other_side(
    make_scene: MakeScene, from_behind: str, kind: str, compiled: bool
) -> None:
    """From inside a ball that has a lamp in its middle and one far above: the upper half shows what is outside."""
    radius, up = 2.0, 50.0
    scene = make_scene(
        camera={"eye": [0, 0, 0], "look_at": [0, 1, 0.001], "vertical_fov": 40},
        film={"width": 16, "height": 16},
        sampler={"type": "regular", "samples": 1},
        materials={"white": {"color": 1}},
        objects=[
            {
                "shape": "sphere",
                "radius": radius,
                "segments": 256,
                "material": "white",
                "from_behind": from_behind,
            }
        ],
        lights=[
            {"type": "point", "position": [0, 0, 0], "intensity": math.pi},
            {"type": "point", "position": [0, up, 0], "intensity": math.pi * 2000},
        ],
        integrator={"type": kind, "max_depth": 0, "shading_normals": "interpolated"},
    )
    got = render(scene, compiled=compiled).linear[..., 0]
    if from_behind == "turned":
        np.testing.assert_allclose(got, 1 / radius**2, rtol=1e-3)
        return
    half = math.tan(math.radians(20))
    across = half * (2 * (np.arange(16) + 0.5) / 16 - 1)
    polar = np.arctan(np.hypot(*np.meshgrid(across, across)))
    point = radius * np.stack((np.sin(polar), np.cos(polar)))
    to_light = np.array([0, up])[:, None, None] - point
    length = np.linalg.norm(to_light, axis=0)
    cosine = (to_light * point).sum(axis=0) / length / radius
    np.testing.assert_allclose(got, 2000 * cosine / length**2, rtol=1e-3)


def test_what_can_not_be_kept_is_refused_by_its_key(make_scene: MakeScene) -> None:
    ball = {"shape": "sphere", "material": "glass", "from_behind": "kept"}
    glass = {"glass": {"dielectric": {}}}
    with pytest.raises(SceneError, match=r'objects\[0\].from_behind is "kept": expected turned'):
        make_scene(materials=glass, objects=[ball])
    with pytest.raises(SceneError, match="shading_normals: expected interpolated"):
        make_scene(materials={"glass": {}}, objects=[ball])
    lamp = {"shape": "quad", "material": "lamp", "from_behind": "unseen"}
    lit = make_scene(materials={"lamp": {"emission": 1}}, objects=[lamp])
    with pytest.raises(SceneError, match=r'from_behind is "unseen": expected turned: patches'):
        check_accepted(lit.loaded)


def test_who_asks_for_nothing_pays_nothing(make_scene: MakeScene) -> None:
    surface = make_scene(objects=[{"shape": "box", "material": "grey"}]).compiled.world.surface
    assert surface.camera_accelerator is surface.accelerator
    assert (surface.kept, surface.through) == (None, None)
    # From outside a closed thing no back is seen before a front: all the same the hierarchy has no backs.
    box = {"shape": "box", "material": "grey", "shading": "flat", "from_behind": "unseen"}
    assert load_scene(make_scene(objects=[box]).path).compiled.world.surface.through is not None
