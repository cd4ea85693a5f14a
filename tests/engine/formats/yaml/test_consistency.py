import json
import math
from collections.abc import Callable

import pytest

from course.engine import shapes
from course.engine.formats.yaml.consistency import nearest_squares
from course.engine.formats.yaml.loading import Loaded


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
def test_shapes_are_made_up_to_the_limits_of_the_format(
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

    load(text(values))
    getattr(shapes, kind)(**values)
    (name,) = beyond
    assert refusal(text(values | beyond)).startswith(f"scene.yaml:3: objects[0].{name} is ")


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
