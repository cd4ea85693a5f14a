"""Scenes in Mitsuba and here: closed forms that both must meet, and pictures that must agree within their noise.

Pictures are compared by Welch's t of blocks of 8 x 8 pixels, from 24 batches each with seeds of their own. With at
least 23 degrees of freedom some block or channel of a right pair exceeds a |t| of 9 less than once in 10^6 times; see
``test_blocks_beyond_the_limit_are_rare``. Seeds are fixed.
"""

import math
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from scipy.stats import t as students_t

from benchmarks.mitsuba_agreement import compare, converge
from benchmarks.mitsuba_export import (
    NotExportableError,
    _encloses,
    export,
    lat_long_directions,
    read,
    write,
)
from benchmarks.mitsuba_llvm import LlvmScene
from benchmarks.mitsuba_scalar import NativeScene, native_overrides
from benchmarks.mitsuba_variants import start_scalar
from course import Scene, render
from course.engine import shapes
from course.engine.functions.effects import PROJECT
from course.engine.shapes.mesh import Mesh
from tests.conftest import MakeScene
from tests.tables import put, rows

SIZE = (24, 24)
BATCHES = 24
LIMIT = 9.0

QUAD = {"shape": "quad", "material": "grey", "width": 4, "depth": 4}
FACING = [{"rotate": {"axis": [1, 0, 0], "degrees": 90}}]
BALL = {"shape": "sphere", "material": "grey", "radius": 0.5, "segments": 64}
FLOOR = {**QUAD, "width": 8, "depth": 8, "transform": [{"translate": [0, -0.5, 0]}]}
POINT = {"type": "point", "position": [2, 3, 3], "intensity": 40}
LAMP = {"type": "sphere", "center": [2, 3, 2], "radius": 0.6, "intensity": [30, 25, 20]}
SQUARE = {"type": "rectangle", "corner": [0, 3, 0], "edge_u": [1, 0, 0], "edge_v": [0, 0, 1]}
SKY = {"type": "constant", "radiance": [0.1, 0.2, 0.3]}


@pytest.fixture
def scalar() -> None:
    pytest.importorskip("mitsuba", reason="needs Mitsuba: pip install .[peers]")
    start_scalar(1)


def test_blocks_beyond_the_limit_are_rare() -> None:
    blocks = 3 * (SIZE[0] // 8) * (SIZE[1] // 8)
    assert 2 * students_t.sf(LIMIT, BATCHES - 1) * blocks < 1e-6


def test_a_written_scene_is_read_again(make_scene: MakeScene, tmp_path: Path) -> None:
    scene = make_scene(
        objects=[FLOOR, {**BALL, "motion": {"velocity": [1, 0, 0]}}], lights=[LAMP], environment=SKY
    )
    exported = export(scene, *SIZE)
    write(exported, tmp_path / "scene")
    _assert_equal(exported, read(tmp_path / "scene"))


def _assert_equal(a: Any, b: Any) -> None:
    if isinstance(a, np.ndarray):
        np.testing.assert_array_equal(a, b)
        assert a.dtype == b.dtype
    elif isinstance(a, tuple | list):
        assert len(a) == len(b)
        for left, right in zip(a, b, strict=True):
            _assert_equal(left, right)
    elif isinstance(a, dict):
        assert a.keys() == b.keys()
        for key in a:
            _assert_equal(a[key], b[key])
    elif hasattr(a, "__dataclass_fields__"):
        _assert_equal(vars(a), vars(b))
    else:
        assert a == b


def test_what_moves_stands_where_it_is_when_the_shutter_opens(make_scene: MakeScene) -> None:
    camera = {"eye": [0, 0, 4], "look_at": [0, 0, 0], "shutter": {"open": -0.5, "close": 1.5}}
    moving = {**BALL, "motion": {"velocity": [2, 0, 0]}}
    still, part = export(make_scene(camera=camera, objects=[FLOOR, moving]), *SIZE).parts
    assert still.velocity == (0, 0, 0)
    assert part.velocity == (2, 0, 0)
    center = (part.vertices.min(axis=0) + part.vertices.max(axis=0)) / 2
    np.testing.assert_allclose(center, [-1, 0, 0], atol=1e-6)


def test_flat_triangles_have_normals_of_their_own(make_scene: MakeScene) -> None:
    (part,) = export(make_scene(objects=[{**BALL, "shading": "flat"}]), *SIZE).parts
    corners = part.vertices[part.triangles].astype(np.float64)
    across = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    across /= np.linalg.norm(across, axis=1, keepdims=True)
    for corner in range(3):
        np.testing.assert_allclose(part.normals[part.triangles[:, corner]], across, atol=1e-4)


@pytest.mark.parametrize(
    "lamp",
    [
        {**LAMP, "motion": {"velocity": [1, 0, 0]}},
        {**LAMP, "samples": "ball"},
        {**SQUARE, "intensity": 1},
    ],
)
def test_what_is_not_exported_is_refused(make_scene: MakeScene, lamp: dict[str, Any]) -> None:
    with pytest.raises(NotExportableError, match="not exported"):
        export(make_scene(objects=[FLOOR], lights=[lamp]), *SIZE)


UNKNOWN = rows("""
materials/grey/emission -> [0, 1, 0] | materials.grey.emission
materials/grey/conductor -> {refraction_index: 1, absorption_index: 2, fresnel: approximate} |
    materials.grey.conductor.fresnel
materials/grey -> {dielectric: {roughness: 0.1}} | materials.grey.dielectric.roughness
materials/grey/highlight -> plain | materials.grey.highlight
materials/grey/ambient_color -> 0.2 | materials.grey.ambient_color
materials/grey/dielectric -> {shaded: true} | materials.grey.dielectric.shaded
materials/grey -> {dielectric: {}, gloss: {lobe: plane, roughness: 0.1}} | materials.grey.gloss
camera/near -> 1 | camera.near
camera/handedness -> left | camera.handedness
camera/image_plane -> {left: -1, right: 1, bottom: -1, top: 1} | camera.image_plane
lights/0 -> {type: rectangle, corner: [0, 3, 0], edge_u: [1, 0, 0], edge_v: [0, 0, 1], radiance: 1, two_sided: true,
    visible: false} | lights[0].two_sided
lights/0 -> {type: rectangle, corner: [0, 3, 0], edge_u: [1, 0, 0], edge_v: [0, 0, 1], radiance: 1, visible: false} |
    lights[0].visible
environment/seen_by -> camera | environment.seen_by
""")


@pytest.mark.parametrize(("place", "value", "key"), UNKNOWN)
def test_keys_that_mitsuba_is_not_told_are_refused_by_name(
    make_scene: MakeScene, place: str, value: str, key: str
) -> None:
    parts: dict[str, Any] = {
        "camera": {"eye": [0, 0, 4], "look_at": [0, 0, 0]},
        "environment": {"type": "constant"},
        "materials": {"grey": {}},
        "lights": [],
        "objects": [FLOOR],
    }
    put(parts, place, value)
    with pytest.raises(NotExportableError) as caught:
        export(make_scene(**parts), *SIZE)
    assert str(caught.value).startswith(key)


def test_directions_of_the_picture_of_all_directions() -> None:
    directions = lat_long_directions(5)
    assert directions.shape == (5, 8, 3)
    np.testing.assert_allclose(np.linalg.norm(directions, axis=-1), 1)
    np.testing.assert_allclose(directions[0], np.broadcast_to([0, 1, 0], (8, 3)), atol=1e-15)
    np.testing.assert_allclose(directions[-1], np.broadcast_to([0, -1, 0], (8, 3)), atol=1e-15)
    assert (directions[2, 3:5, 2] > 0.9).all()
    assert directions[2, 5, 0] < 0 < directions[2, 2, 0]


@pytest.mark.parametrize("effect", ["supersampling", "soft_shadows", "thin_lens", "motion_blur"])
def test_native_variants_ask_for_nothing_that_plugins_lack(effect: str) -> None:
    values, words = native_overrides(PROJECT / "scenes" / f"{effect}.yaml")
    assert "no highlights" in words
    from course.engine.scene.scene import load_variant

    exported = export(load_variant(PROJECT / "scenes" / f"{effect}.yaml", values), *SIZE)
    assert not exported.materials.specular.any()
    assert not exported.materials.mirror.any()
    assert all(light["type"] != "sphere" or "radiance" in light for light in exported.lights)


@pytest.mark.usefixtures("scalar")
@pytest.mark.parametrize("sampler", ["independent", "multijitter"])
def test_a_point_light_on_a_quad_scalar(make_scene: MakeScene, sampler: str) -> None:
    scene = _lit_quad(make_scene)
    picture = NativeScene(export(scene, *SIZE)).render(sampler, 16, 0)
    _assert_lit_quad(picture)
    _assert_lit_quad(render(scene, size=SIZE, spp=16, seed=0).linear)


@pytest.mark.usefixtures("llvm")
def test_a_point_light_on_a_quad_llvm(make_scene: MakeScene) -> None:
    exported = export(_lit_quad(make_scene), *SIZE)
    _assert_lit_quad(LlvmScene(exported).render("multijitter", 16, 0))


def _lit_quad(make_scene: MakeScene) -> Scene:
    """A grey quad that faces the camera, with a lamp straight before its middle and ambient light."""
    return make_scene(
        materials={"grey": {"color": [0.2, 0.5, 0.8]}},
        objects=[{**QUAD, "transform": FACING}],
        lights=[
            {"type": "point", "position": [0, 0, 2], "intensity": [1, 2, 3]},
            {"type": "ambient", "radiance": 0.1},
        ],
    )


def _assert_lit_quad(picture: np.ndarray) -> None:
    """Radiance is color (ambient + I cos / (pi d^2)); half the picture is 4 tan(20 degrees)."""
    half = 4 * math.tan(math.radians(20))
    for row, column in ((12, 12), (3, 20), (20, 5)):
        x = (column + 0.5 - 12) / 12 * half
        y = (12 - row - 0.5) / 12 * half
        squared = x * x + y * y + 4
        irradiance = np.array([1, 2, 3]) * 2 / squared**1.5
        expected = np.array([0.2, 0.5, 0.8]) * (0.1 + irradiance / math.pi)
        # Over a pixel of 0.12 the second derivative of the irradiance shifts the mean by less than 1e-3 of it; 16
        # stratified samples miss the mean by less than the whole variation over the pixel, under 5 %.
        np.testing.assert_allclose(picture[row, column], expected, rtol=0.02)


def _agrees(
    scene: Scene, peer: LlvmScene | NativeScene, folder: Path, ours: Path | None = None
) -> None:
    """``ours``: where this scene's own batches are kept, for those who ask again."""
    theirs = converge(lambda seed: peer.render("independent", 64, seed), BATCHES, folder / "a.npz")
    own = converge(
        lambda seed: render(scene, size=SIZE, spp=64, sampler="random", seed=seed).linear,
        BATCHES,
        ours or folder / "b.npz",
    )
    found = compare(theirs, own)
    assert found.largest < LIMIT, found
    # The means of whole pictures: the noise of 4 million paths is far below a percent.
    assert abs(found.mean) < 0.01, found


GLASS = {"color": 0, "dielectric": {"refraction_index": 1.5, "absorption": [0.5, 0.2, 0.1]}}
SCENES: dict[str, dict[str, Any]] = {
    "highlights": {
        "materials": {"grey": {"specular": 0.5, "exponent": 20}},
        "objects": [FLOOR, BALL],
        "lights": [POINT, {"type": "directional", "direction": [1, -2, -1], "irradiance": 1}],
    },
    "a lamp with a size": {"objects": [FLOOR, BALL], "lights": [LAMP]},
    "a lens": {
        "camera": {
            "eye": [0, 1, 4],
            "look_at": [0, 0, 0],
            "lens": {"aperture_radius": 0.2, "focus_distance": 3},
        },
        "objects": [FLOOR, BALL],
        "lights": [POINT],
    },
    "motion": {
        "objects": [FLOOR, {**BALL, "motion": {"velocity": [1, 0.5, 0]}}],
        "lights": [POINT],
    },
    **{
        lobe["lobe"]: {
            "materials": {"grey": {"color": 0.3, "mirror": 0.6, "gloss": lobe}, "red": {}},
            "objects": [FLOOR, {**BALL, "material": "red"}],
            "lights": [POINT],
            "integrator": {"max_depth": 3},
        }
        for lobe in (
            {"lobe": "plane", "roughness": 0.3},
            {"lobe": "ball", "glossiness": 0.3},
            {"lobe": "phong", "exponent": 30},
        )
    },
    "glass": {
        "materials": {"grey": {"color": 0.7}, "glass": GLASS},
        "objects": [FLOOR, {**BALL, "material": "glass", "segments": 256}],
        "lights": [POINT],
        "integrator": {"max_depth": 5, "cutoff": 0},
    },
}


@pytest.fixture(scope="module")
def kept(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The batches of ``SCENES``, as they are rendered here."""
    return tmp_path_factory.mktemp("kept")


@pytest.mark.usefixtures("llvm")
@pytest.mark.parametrize("name", SCENES)
def test_both_programs_show_the_same(
    make_scene: MakeScene, tmp_path: Path, kept: Path, name: str
) -> None:
    scene = make_scene(environment=SKY, **SCENES[name])
    _agrees(scene, LlvmScene(export(scene, *SIZE)), tmp_path, kept / f"{name}.npz")


WRONG: dict[str, dict[str, Any]] = {
    "a lamp with a size": {"lights": [{**LAMP, "radius": 1.6}]},
    "highlights": {"materials": {"grey": {"specular": 0.5, "exponent": 17}}},
    "a lens": {
        "camera": {
            **SCENES["a lens"]["camera"],
            "lens": {"aperture_radius": 0.2, "focus_distance": 3.4},
        }
    },
    "motion": {"objects": [FLOOR, {**BALL, "motion": {"velocity": [1.15, 0.5, 0]}}]},
    "glass": {
        "materials": {
            "grey": {"color": 0.7},
            "glass": {"color": 0, "dielectric": {"refraction_index": 1.45}},
        }
    },
}


@pytest.mark.usefixtures("llvm")
@pytest.mark.parametrize("name", WRONG)
def test_the_comparison_tells_a_wrong_picture(
    make_scene: MakeScene, tmp_path: Path, kept: Path, name: str
) -> None:
    scene = make_scene(environment=SKY, **SCENES[name])
    wrong = make_scene(environment=SKY, **{**SCENES[name], **WRONG[name]})
    with pytest.raises(AssertionError):
        _agrees(scene, LlvmScene(export(wrong, *SIZE)), tmp_path, kept / f"{name}.npz")


@pytest.mark.parametrize("variant", ["scalar", "llvm"])
def test_stills_average_to_motion(
    make_scene: MakeScene, tmp_path: Path, variant: str, request: pytest.FixtureRequest
) -> None:
    request.getfixturevalue(variant)
    scene = make_scene(objects=[FLOOR, {**BALL, "motion": {"velocity": [1, 0, 0]}}], lights=[POINT])
    _agrees(scene, NativeScene(export(scene, *SIZE)), tmp_path)


# ---------------------------------------------------------------- objects that are lights

LIT = {"type": "object", "object": "lamp"}
TUBE = {
    "shape": "torus_knot",
    "name": "lamp",
    "material": "neon",
    "radius": 0.5,
    "tube": 0.15,
    "segments": 64,
    "sides": 8,
    "transform": [{"translate": [0.5, 1, 0]}],
}
BLACK = {"color": 0, "emission": [3, 2, 1]}
PATHS = {"type": "path", "max_depth": 6}


def _lamp_scene(make_scene: MakeScene, **parts: Any) -> Scene:
    described: dict[str, Any] = {
        "camera": {"eye": [0, 1.5, 4], "look_at": [0, 0.3, 0]},
        "materials": {"grey": {"color": 0.6}, "neon": BLACK},
        "objects": [FLOOR, {**BALL, "transform": [{"translate": [-0.8, 0, 0]}]}, TUBE],
        "lights": [LIT],
    }
    return make_scene(**(described | parts))


@pytest.mark.usefixtures("scalar")
@pytest.mark.parametrize("integrator", [{}, PATHS], ids=["distribution", "path"])
def test_an_object_that_is_a_light_lights_the_same(
    make_scene: MakeScene, tmp_path: Path, integrator: dict[str, Any]
) -> None:
    """Also beside one of the same shape that is none, and beside a lamp of another kind."""
    dark = {**TUBE, "name": "dark", "material": "grey", "transform": [{"translate": [-1, 1.2, -1]}]}
    objects = [dark, {**BALL, "radius": 0.3}, TUBE, FLOOR]
    scene = _lamp_scene(make_scene, objects=objects, lights=[POINT, LIT], integrator=integrator)
    _agrees(scene, NativeScene(export(scene, *SIZE)), tmp_path)


@pytest.mark.usefixtures("scalar")
def test_the_comparison_tells_a_lamp_that_is_a_tenth_too_bright(
    make_scene: MakeScene, tmp_path: Path
) -> None:
    scene = _lamp_scene(make_scene)
    exported = export(scene, *SIZE)
    (light,) = exported.lights
    brighter = {**light, "radiance": [1.1 * x for x in light["radiance"]]}
    with pytest.raises(AssertionError):
        _agrees(scene, NativeScene(replace(exported, lights=(brighter,))), tmp_path)


def test_an_object_that_is_a_light_has_a_material_of_its_own(
    make_scene: MakeScene, tmp_path: Path
) -> None:
    exported = export(_lamp_scene(make_scene), *SIZE)
    assert exported.names == ("grey", "neon")
    assert exported.lights == ({"type": "object", "material": 1, "radiance": [3, 2, 1]},)
    (part,) = exported.parts
    assert (part.material == 1).sum() == 2 * 64 * 8
    # Flat, for Mitsuba takes fronts by the normals that it shades by.
    own = part.triangles[part.material == 1]
    assert len(np.unique(own)) == own.size
    write(exported, tmp_path / "scene")
    _assert_equal(exported, read(tmp_path / "scene"))


ABOVE = {"transform": [{"translate": [0, 1.7, 0]}]}
"""Off the other objects, whose planes a lamp's would lie in."""


@pytest.mark.parametrize(
    ("lamp", "material", "said"),
    [
        (QUAD, BLACK, "materials.neon.emission is not exported for objects[1]"),
        ({**BALL, "transform": [{"scale": [-1, 1, 1]}]}, BLACK, None),
        ({**BALL, "motion": {"velocity": [1, 0, 0]}}, BLACK, "lights that move"),
        (BALL, {"color": 0.1, "emission": 1}, "materials.neon of a light reflects"),
        (BALL, {"color": 0, "mirror": 0.1, "emission": 1}, "materials.neon of a light reflects"),
        (BALL, {"color": 0, "dielectric": {}, "emission": 1}, "materials.neon of a light reflects"),
        *[
            ({"shape": shape} | ABOVE, BLACK, None)
            for shape in ("box", "cylinder", "cone", "torus")
        ],
    ],
)
def test_lamps_that_mitsuba_has_and_has_not(
    make_scene: MakeScene, lamp: dict[str, Any], material: dict[str, Any], said: str | None
) -> None:
    lamp = {**lamp, "name": "lamp", "material": "neon"}
    camera = {"eye": [0, 1.5, 4], "look_at": [0, 0.3, 0], "shutter": {"open": 0, "close": 1}}
    materials = {"grey": {"color": 0.6}, "neon": material}
    scene = _lamp_scene(make_scene, objects=[FLOOR, lamp], materials=materials, camera=camera)
    if said is None:
        assert [light["type"] for light in export(scene, *SIZE).lights] == ["object"]
        return
    with pytest.raises(NotExportableError) as caught:
        export(scene, *SIZE)
    assert str(caught.value).startswith(said)


def test_a_body_encloses_something_if_it_is_closed_and_faces_outwards() -> None:
    knot = shapes.torus_knot(segments=64, sides=6)
    assert _encloses(knot)
    assert not _encloses(Mesh(knot.vertices, knot.triangles[:, ::-1]))
    assert not _encloses(Mesh(knot.vertices, knot.triangles[1:]))
    turned = np.array(knot.triangles)
    turned[0] = turned[0, ::-1]
    assert not _encloses(Mesh(knot.vertices, turned))


def test_an_object_that_only_glows_is_refused_beside_a_light(make_scene: MakeScene) -> None:
    objects = [FLOOR, TUBE, {**TUBE, "name": "other"} | ABOVE]
    with pytest.raises(NotExportableError, match=r"materials\.neon\.emission is not exported"):
        export(_lamp_scene(make_scene, objects=objects), *SIZE)


def test_the_llvm_form_names_the_one_that_has_such_lights(make_scene: MakeScene) -> None:
    exported = export(_lamp_scene(make_scene), *SIZE)
    with pytest.raises(NotExportableError, match=r"type object .* the scalar form \(NativeScene"):
        LlvmScene(exported)
