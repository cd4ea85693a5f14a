"""A student's rays beside the right ones: of the same samples, with the farthest marked."""

import shutil
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from course import Story, pixel
from course.engine.functions.effects import PROJECT
from course.engine.recording.pair import departing, pair_data, told, unexplained
from course.engine.recording.segments import Call, Segment
from course.engine.recording.view import rays_data

FUNCTION = "soft_shadows.point_on_sphere"

OFF = 11
"""The sample whose point is moved."""


@pytest.fixture(scope="module")
def right() -> Story:
    return pixel(PROJECT / "scenes" / "soft_shadows.yaml", 30, 30, spp=16, size=(64, 48))


@pytest.fixture(scope="module")
def frosted() -> Story:
    return pixel(PROJECT / "scenes" / "blurred_transparency.yaml", 25, 30, spp=16, size=(64, 48))


def with_segments(story: Story, changed: Callable[[Segment], Segment]) -> Story:
    segments = [changed(one) for one in story.segments]
    return Story(replace(story.recording, segments=segments))


def moved(story: Story, sample: int, way: float) -> Story:
    """The same rays, but for a point on the lamp."""

    def changed(one: Any) -> Any:
        if one.sample != sample:
            return one
        calls = [
            replace(call, results={n: [v[0] + way, *v[1:]] for n, v in call.results.items()})
            if call.function == FUNCTION
            else call
            for call in one.calls
        ]
        return replace(one, calls=calls)

    return with_segments(story, changed)


def test_the_sample_that_is_farthest_off_is_marked_and_told(right: Story) -> None:
    yours = moved(moved(right, OFF, 0.2), OFF + 1, 0.1)
    data = pair_data(yours, rays_data(right), FUNCTION)
    assert data["marked"] == OFF
    assert set(data["asked"]) == {"center", "radius", "u"}
    said = [line for line in told(data) if line.startswith(f"For sample {OFF} {FUNCTION}(center")]
    assert len(said) == 1
    assert any(line.startswith(f"{FUNCTION} returned x ") for line in told(data))


def test_of_equal_rays_nothing_is_said_but_the_colour(right: Story) -> None:
    data = pair_data(right, rays_data(right), FUNCTION)
    (line,) = told(data)
    assert line.startswith("The pixel is ")


def test_where_no_function_was_asked_the_light_says_which_is_farthest(right: Story) -> None:
    radiance = right.recording.radiance.copy()
    radiance[:, 0, OFF] += 1
    yours = Story(replace(right.recording, radiance=radiance))
    assert pair_data(yours, rays_data(right), "supersampling.resolve")["marked"] == OFF


@pytest.mark.parametrize("name", ["directions", "total"])
def test_every_result_of_a_function_is_compared_and_told(frosted: Story, name: str) -> None:
    refract = "blurred_transparency.refract"
    assert any(call.function == refract for one in frosted.segments for call in one.calls)

    def other(call: Call) -> Call:
        value = call.results[name]
        wrong = [-x for x in value] if isinstance(value, list) else not value
        return replace(call, results=call.results | {name: wrong})

    yours = with_segments(
        frosted,
        lambda one: replace(
            one, calls=[other(call) if call.function == refract else call for call in one.calls]
        ),
    )
    right = rays_data(frosted)
    asked = ["blurred_transparency.jitter_refraction", refract]
    assert departing(yours, right, asked) == refract
    lines = told(pair_data(yours, right, refract))
    (spread,) = [line for line in lines if line.startswith(f"{refract} returned ")]
    assert spread.startswith(f"{refract} returned {name} ")
    (single,) = [line for line in lines if line.startswith("For sample ")]
    assert "returned directions (" in single
    assert ", total (" in single


@pytest.mark.parametrize(
    ("scene", "function", "body"),
    [
        ("environment_light", "environment_light.texel_weights", "np.ones_like(_own(*a))"),
        ("many_lights", "many_lights.light_tree", "[each[::-1] for each in _own(*a)]"),
    ],
)
def test_functions_that_are_asked_before_there_is_a_ray_are_compared_too(
    tmp_path: Path, scene: str, function: str, body: str
) -> None:
    module, name = function.split(".")
    for path in (PROJECT / "solutions").glob("*.py"):
        shutil.copy(path, tmp_path)
    with (tmp_path / f"{module}.py").open("a") as file:
        file.write(f"\n\n_own = {name}\n\n\ndef {name}(*a):\n    return {body}\n")
    asked = {"x": 20, "y": 20, "spp": 4, "size": (40, 30)}
    right, yours = (
        pixel(PROJECT / "scenes" / f"{scene}.yaml", **asked, effects=of) for of in (None, tmp_path)
    )
    data = pair_data(yours, rays_data(right), function)
    functions = [*yours.recording.asked, *data["built"]]
    assert departing(right, data["right"], functions) is None
    assert departing(yours, data["right"], functions) == function
    assert any(
        line.startswith(f"While the scene was built {function} returned ") for line in told(data)
    )
    # References that were kept before know nothing of it.
    assert departing(yours, data["right"] | {"built": {}}, functions) != function


def test_of_functions_that_make_something_else_the_first_one_along_a_ray_is_named(
    tmp_path: Path,
) -> None:
    """The tile asks for the floor's colours first, and for the ball's places later."""
    for path in (PROJECT / "solutions").glob("*.py"):
        shutil.copy(path, tmp_path)
    with (tmp_path / "textures.py").open("a") as file:
        file.write("\n\n_own = sphere_uv\n\n\ndef sphere_uv(*a):\n    return _own(*a)[::-1]\n")
    scene, asked = PROJECT / "scenes" / "textures.yaml", {"spp": 4, "size": (100, 75)}
    right, yours = (pixel(scene, 62, 35, **asked, effects=of) for of in (None, tmp_path))
    # In this order the tile has asked for them.
    functions = ["textures.rectangle_uv", "textures.texture_lookup", "textures.sphere_uv"]
    assert set(functions[1:]) <= set(right.recording.asked)
    assert departing(yours, rays_data(right), functions) == "textures.sphere_uv"


def test_a_right_function_is_not_blamed_where_only_some_of_its_calls_are_known(
    tmp_path: Path,
) -> None:
    """Of shadow rays that not all hits send, the calls are recorded in one batch and not in another."""
    for path in (PROJECT / "solutions").glob("*.py"):
        shutil.copy(path, tmp_path)
    scene, asked = PROJECT / "scenes" / "motion_blur.yaml", {"spp": 16, "size": (480, 270)}
    right, yours = (pixel(scene, 240, 135, **asked, effects=of) for of in (None, tmp_path))
    functions = [*right.recording.asked]
    assert "motion_blur.to_object_space" in functions
    assert departing(yours, rays_data(right), functions) is None


def test_a_difference_of_rounding_is_not_told(right: Story) -> None:
    yours = moved(right, OFF, 5e-5)
    data = pair_data(yours, rays_data(right), FUNCTION)
    assert data["segments"] != data["right"]["segments"]
    (line,) = told(data)
    assert line.startswith("The pixel is ")
    assert departing(yours, data["right"], [FUNCTION]) is None
    # Of numbers about 0 three digits differ, too.
    zero, little = (
        with_segments(
            right,
            lambda one, x=x: replace(
                one, calls=[replace(call, results={"the points": [x] * 3}) for call in one.calls]
            ),
        )
        for x in (0.0, 5e-5)
    )
    (line,) = told(pair_data(little, rays_data(zero), FUNCTION))
    assert line.startswith("The pixel is ")


def test_where_right_rays_ask_no_light_it_is_said_in_words(right: Story) -> None:
    lit = rays_data(right)
    unlit = lit | {"segments": [row for row in lit["segments"] if not row[3]]}
    shadows = len(lit["segments"]) - len(unlit["segments"])
    assert shadows > 0
    lines = told(pair_data(right, unlit, FUNCTION), "the course's is", "the course's functions")
    (line,) = [line for line in lines if "shadow ray" in line]
    assert line.endswith(
        f" of {shadows} shadow rays are blocked;"
        " with the course's functions no shadow ray is sent there."
    )
    none = with_segments(right, lambda one: one)
    none.recording.segments[:] = [one for one in right.segments if one.light is None]
    (line,) = [line for line in told(pair_data(none, lit, "")) if "shadow ray" in line]
    assert line.startswith("No shadow ray is sent; right is ")


def test_nobody_is_named_without_evidence_but_other_rays_are_told(right: Story) -> None:
    """As with `light_grid`, which is asked before there is a ray: its points differ, and no recorded result does."""
    yours = with_segments(
        right,
        lambda one: one if one.light is None else replace(one, end=tuple(x + 0.3 for x in one.end)),
    )
    grid, rays = "soft_shadows.light_grid", rays_data(right)
    assert departing(yours, rays, [FUNCTION, grid]) is None
    said = unexplained(pair_data(yours, rays, ""), [grid])
    assert said is not None
    assert said.startswith("The course's functions send other rays, but no recorded result")
    assert said.endswith(f"Of yours this picture needs {grid}.")
    assert unexplained(pair_data(right, rays, ""), [grid]) is None


def test_a_function_that_was_asked_for_other_rays_is_not_named_for_that(right: Story) -> None:
    """Where a ray isn't sent on, whoever is asked for it later has returned nothing wrong."""
    segments = [one for one in right.segments if one.light is None or one.sample != OFF]
    numbers = {one.number for one in segments}
    assert len(numbers) < len(right.segments)
    yours = Story(replace(right.recording, segments=segments))
    assert departing(yours, rays_data(right), [FUNCTION]) is None


@pytest.mark.parametrize(
    ("changed", "named"),
    [
        ("offsets", "supersampling.regular"),
        ("weights", "supersampling.gaussian_weights"),
        ("linear", "supersampling.resolve"),
        ("radiance", None),
    ],
)
def test_what_the_film_got_says_which_of_its_functions_departs(
    right: Story, changed: str, named: str | None
) -> None:
    functions = [f"supersampling.{name}" for name in ("regular", "gaussian_weights", "resolve")]
    # Other samples' light is another colour, too.
    both = {changed, "linear"} if changed == "radiance" else {changed}
    other = {name: getattr(right.recording, name) * np.float32(1.1) for name in both}
    yours = Story(replace(right.recording, **other))
    rays = rays_data(right)
    assert departing(yours, rays, [FUNCTION, *functions]) == named
    said = unexplained(pair_data(yours, rays, ""), functions)
    if changed == "linear":
        assert said is not None
        assert "send the same rays, which bring other colours" in said
        assert said.endswith(f"needs for colours {', '.join(functions[1:])}.")
    if named == functions[0]:
        # Of two patterns it isn't known which one has moved them.
        assert departing(yours, rays, ["quasi_monte_carlo.chain", *functions]) is None
