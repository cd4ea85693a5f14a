from __future__ import annotations

import json
import math
from collections.abc import Callable

import pytest

from course import shapes
from course.formats.yaml.consistency import nearest_squares
from course.formats.yaml.loading import Loaded


def _camera(eye: object, look_at: object, up: object = "[0, 1, 0]") -> str:
    return f"camera:\n  eye: {eye}\n  look_at: {look_at}\n  up: {up}\n"


@pytest.mark.parametrize(
    ("eye", "look_at"),
    [
        ("[0, 0, 0]", "[0, 0, 0]"),
        ("[1, 2, 3]", "[1, 2, 3]"),
        ("[1, 2, 3]", "[1, 2, 3.000000000001]"),
        ("[1e150, 0, 0]", "[1e150, 0, 0]"),
        ("[1e-150, 0, 0]", "[1e-150, 0, 0]"),
    ],
)
def test_the_camera_looks_away_from_its_own_eye(
    refusal: Callable[[str], str], eye: str, look_at: str
) -> None:
    message = refusal(_camera(eye, look_at))
    assert message.startswith("scene.yaml:3: camera.look_at is [")
    assert "another point than camera.eye" in message


@pytest.mark.parametrize("size", [1e-150, 1e-30, 1.0, 1e30, 1e140])
@pytest.mark.parametrize("away", [0.0, 1e8])
def test_a_view_is_good_at_any_scale_and_place(
    load: Callable[[str], Loaded], size: float, away: float
) -> None:
    far = away * size
    load(_camera([far, far, far + size], [far, far, far], [0, size, 0]))


@pytest.mark.parametrize(
    ("up", "word"),
    [
        ("[0, 0, 0]", "not zero"),
        ("[0, 0, 1]", "not parallel to the view"),
        ("[0, 0, -1e150]", "not parallel to the view"),
        ("[0, 5e-7, 1]", "not parallel to the view"),
    ],
)
def test_up_is_a_direction_across_the_view(
    refusal: Callable[[str], str], up: str, word: str
) -> None:
    message = refusal(_camera("[0, 0, 5]", "[0, 0, 0]", up))
    assert message.startswith("scene.yaml:4: camera.up is [")
    assert word in message


def test_up_may_come_within_two_millionths_of_the_view(load: Callable[[str], Loaded]) -> None:
    load(_camera("[0, 0, 5]", "[0, 0, 0]", "[0, 2e-6, 1]"))


def test_the_default_up_is_blamed_at_the_camera(refusal: Callable[[str], str]) -> None:
    message = refusal("title: x\ncamera: {eye: [0, 5, 0], look_at: [0, 0, 0]}\n")
    assert message.startswith("scene.yaml:2: camera.up: expected a direction that is not parallel")


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        (
            "samples: 9",
            "samples: 10",
            (
                "9: sampler.samples is 10: expected a square number for the jittered sampler, "
                "such as 9 or 16"
            ),
        ),
        (
            "type: jittered, samples: 9",
            "type: regular, samples: 65535",
            (
                "9: sampler.samples is 65535: expected a square number for the regular "
                "sampler, such as 65025 or 65536"
            ),
        ),
        (
            ", radiance: 5",
            "",
            (
                "21: lights[3]: intensity or radiance is missing: expected one of them, in "
                "W/sr or W/(m^2 sr)"
            ),
        ),
        (
            ", radiance: 5",
            ", radiance: 5, intensity: 5",
            "21: lights[3]: both intensity and radiance are given: expected one of them",
        ),
        (
            "radius: 0, intensity: 3",
            "radius: 1",
            (
                "22: lights[4]: intensity or radiance is missing: expected one of them, in "
                "W/sr or W/(m^2 sr)"
            ),
        ),
        (
            "radius: 0, intensity: 3",
            "radius: 0, radiance: 3",
            (
                "22: lights[4].radius is 0: expected a number > 0 [world unit] for a light by "
                "radiance; a point has no area to emit from"
            ),
        ),
        (
            "radius: 0, intensity: 3",
            "radius: 1, radiance: 3, samples: facing disk",
            (
                '22: lights[4].samples is "facing disk": expected "sphere", "sphere by polar" or "visible" for '
                "a light by radiance, which shines from its surface; by intensity it may be a ball or a facing disk"
            ),
        ),
        (
            "radius: 0, intensity: 3",
            "radius: 1, intensity: 3, samples: visible",
            (
                '22: lights[4].samples is "visible": expected "sphere", "ball" or "facing disk" (or "sphere by '
                'polar", "ball by polar", "ball by rejection") for a light by intensity: all of it shines everywhere, '
                "and only a light by radiance has a side that can't be seen"
            ),
        ),
        (
            "direction: [0, -1, 0]",
            "direction: [0, 0, -0.0]",
            "20: lights[2].direction is [0, 0, -0.0]: expected a vector that is not zero",
        ),
        (
            "edge_u: [1, 0, 0]",
            "edge_u: [0, 0, 0]",
            "21: lights[3].edge_u is [0, 0, 0]: expected a vector that is not zero",
        ),
        (
            "edge_v: [0, 0, 1]",
            "edge_v: [0, 0, 0]",
            "21: lights[3].edge_v is [0, 0, 0]: expected a vector that is not zero",
        ),
        (
            "edge_v: [0, 0, 1]",
            "edge_v: [-3, 0, 0]",
            "21: lights[3].edge_v is [-3, 0, 0]: expected an edge that is not parallel to edge_u",
        ),
        (
            "material: glass",
            "material: glas",
            (
                '33: objects[2].material is "glas": expected the name of one of the materials; '
                "did you mean glass?"
            ),
        ),
        (
            "material: glass",
            "material: wood",
            (
                '33: objects[2].material is "wood": expected the name of one of the materials; '
                "known are red, mirror, glass"
            ),
        ),
        (
            "- scale: -2",
            "- scale: 0",
            "31: objects[1].transform[1].scale is 0: expected factors that are not 0",
        ),
        (
            "- scale: -2",
            "- scale: [1, 0.0, 1]",
            "31: objects[1].transform[1].scale is [1, 0.0, 1]: expected factors that are not 0",
        ),
        (
            "axis: [0, 1, 0]",
            "axis: [0, 0, 0]",
            (
                "32: objects[1].transform[2].rotate.axis is [0, 0, 0]: expected a vector that "
                "is not zero"
            ),
        ),
        (
            "p: 3, q: 4",
            "p: 6, q: 4",
            (
                "38: objects[7]: p is 6 and q is 4: expected numbers without a common divisor; "
                "these wind 2 times over the same curve"
            ),
        ),
        (
            "p: 3, q: 4",
            "p: 3, q: 4, segments: 55",
            (
                "38: objects[7].segments is 55: expected a whole number from 56, which is "
                "8 (p + q), to 16384"
            ),
        ),
        (
            "shape: torus,",
            "shape: torus, radius: 2, tube: 2.0,",
            "37: objects[6].tube is 2.0: expected a number < radius, 2 [world unit]",
        ),
        (
            "{shape: torus, material: red}",
            "\n    shape: torus\n    material: red\n    radius: 0.25",
            (
                "40: objects[6].radius is 0.25: expected a number > tube, 0.25 where it is not "
                "given [world unit]"
            ),
        ),
        (
            "shape: displaced_sphere,",
            "shape: displaced_sphere, amplitude: 1,",
            "39: objects[8].amplitude is 1: expected a number < radius, 1 [world unit]",
        ),
        (
            "shape: displaced_sphere,",
            "shape: displaced_sphere, radius: 0.1,",
            (
                "39: objects[8].radius is 0.1: expected a number > amplitude, 0.1 where it is "
                "not given [world unit]"
            ),
        ),
    ],
)
def test_a_contradiction_names_the_key_to_change(
    refusal_of: Callable[[str, str], str], old: str, new: str, message: str
) -> None:
    assert refusal_of(old, new) == f"scene.yaml:{message}"


@pytest.mark.parametrize(
    ("kind", "values", "beyond"),
    [
        ("torus", {"radius": 1.0, "tube": 0.999}, {"tube": 1.0}),
        ("torus", {"segments": 4096, "sides": 3}, {"segments": 4097}),
        ("torus", {"segments": 3, "sides": 4096}, {"sides": 4097}),
        ("torus", {"segments": 3, "sides": 3}, {"segments": 2}),
        ("torus_knot", {"p": 32, "q": 31, "tube": 0.01, "segments": 504}, {"segments": 503}),
        ("torus_knot", {"p": 32, "q": 31, "tube": 0.01, "segments": 504}, {"p": 33}),
        ("torus_knot", {"p": 31, "q": 32, "tube": 0.01, "segments": 504}, {"q": 33}),
        ("torus_knot", {"p": 1, "q": 1, "segments": 16, "sides": 1024}, {"segments": 15}),
        ("torus_knot", {"segments": 40, "sides": 1024}, {"sides": 1025}),
        ("displaced_sphere", {"radius": 1.0, "amplitude": 0.999}, {"amplitude": 1.0}),
        ("displaced_sphere", {"segments": 8, "frequency": 1e6}, {"frequency": 1.001e6}),
        ("height_field", {"segments": 1, "frequency": 1e6}, {"frequency": 1.001e6}),
        ("sphere", {"segments": 4096}, {"segments": 4097}),
    ],
)
def test_the_format_and_the_shapes_have_the_same_limits(
    load: Callable[[str], Loaded],
    refusal: Callable[[str], str],
    kind: str,
    values: dict[str, float],
    beyond: dict[str, float],
) -> None:
    def text(given: dict[str, float]) -> str:
        thing = json.dumps({"shape": kind, "material": "red", **given})
        return (
            "camera: {eye: [0, 0, 1], look_at: [0, 0, 0]}\n"
            f"materials: {{red: {{}}}}\nobjects: [{thing}]\n"
        )

    make = getattr(shapes, kind)
    load(text(values))
    make(**values)
    (name,) = beyond
    assert refusal(text(values | beyond)).startswith(f"scene.yaml:3: objects[0].{name} is ")
    with pytest.raises(ValueError, match=name):
        make(**(values | beyond))


def test_an_object_without_any_materials_says_so(refusal: Callable[[str], str]) -> None:
    message = refusal(
        "camera: {eye: [0, 0, 1], look_at: [0, 0, 0]}\nobjects: [{shape: box, material: red}]\n"
    )
    assert message == (
        'scene.yaml:2: objects[0].material is "red": expected the name of one of the materials; '
        "there are none"
    )


@pytest.mark.parametrize("sampler", ["sobol", "random"])
def test_samplers_without_a_grid_take_any_number(
    good: str, load: Callable[[str], Loaded], sampler: str
) -> None:
    text = good.replace("type: jittered, samples: 9", f"type: {sampler}, samples: 10")
    assert load(text).description.sampler.samples == 10


def test_the_nearest_squares_enclose_the_number() -> None:
    for samples in range(1, 2000):
        squares = nearest_squares(samples)
        assert all(math.isqrt(each) ** 2 == each for each in squares)
        if len(squares) == 1:
            assert squares[0] == samples
        else:
            assert squares[0] < samples < squares[1]
            assert math.isqrt(squares[1]) - math.isqrt(squares[0]) == 1


@pytest.mark.parametrize("index", [0.1, 10, 20])
def test_rough_glass_has_an_index_that_its_functions_take(
    refusal: Callable[[str], str], load: Callable[[str], Loaded], index: float
) -> None:
    text = (
        "camera: {eye: [0, 0, 5], look_at: [0, 0, 0]}\n"
        "materials:\n  glass: {dielectric: {refraction_index: INDEX, roughness: 0.2}}\n"
    )
    message = refusal(text.replace("INDEX", str(index)))
    assert message.startswith("scene.yaml:3: materials.glass.dielectric.refraction_index is ")
    assert "between 0.1 and 10" in message
    load(text.replace("INDEX", "1.5"))
    load(text.replace("INDEX", str(index)).replace("0.2", "0"))


def test_highlights_stay_within_float32(refusal: Callable[[str], str]) -> None:
    text = "camera: {eye: [0, 0, 5], look_at: [0, 0, 0]}\nmaterials:\n  one: {specular: [1, 2.0e+6, 1]}\n"
    message = refusal(text)
    assert message.startswith("scene.yaml:3: materials.one.specular is [1, 2000000.0, 1]")
    assert "at most 1e+06" in message
