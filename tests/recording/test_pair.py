"""A student's rays beside the right ones: of the same samples, with the farthest marked."""

from dataclasses import replace
from typing import Any

import pytest

from course import Story, pixel
from course.effects import PROJECT
from course.recording.pair import pair_data, told
from course.recording.view import rays_data

FUNCTION = "soft_shadows.point_on_sphere"

OFF = 11
"""The sample whose point is moved."""


@pytest.fixture(scope="module")
def right() -> Story:
    return pixel(PROJECT / "scenes" / "soft_shadows.yaml", 30, 30, spp=16, size=(64, 48))


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

    segments = [changed(one) for one in story.segments]
    return Story(replace(story.recording, segments=segments))


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
