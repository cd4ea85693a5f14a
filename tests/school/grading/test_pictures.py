"""Pictures as checks: whatever a student returns is never the renderer's trouble; tapes play what they recorded."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from course.engine.functions.effects import PROJECT, Effects
from course.engine.functions.modules import COURSE
from course.engine.scene.scene import Scene, load_scene
from course.school.grading.checks.check import (
    Check,
    Failure,
    ModuleChecks,
    References,
    Trial,
    generator,
)
from course.school.grading.checks.result import Result, Status
from course.school.grading.checks.running import run_checks
from course.school.grading.checks.trusted import TrustedModule
from course.school.grading.pictures import rendered as rendered_module
from course.school.grading.pictures.catalog import PICTURES
from course.school.grading.pictures.judging import BLOCKS, check_bias, check_ssim, ssim
from course.school.grading.pictures.rendered import BIAS_REFERENCES, loaded, rendered
from course.school.grading.pictures.scenes import moving
from course.school.grading.pictures.whole import WHOLE, Together
from course.school.grading.references import prepared, reference

LOOKS = [
    (module, check)
    for module, checks in PICTURES.items()
    for check in checks
    if check.kind == "picture"
]
IDS = [f"{module}.{check.function}" for module, check in LOOKS]


def solution(module: str, **others: Any) -> TrustedModule:
    effects = Effects(PROJECT / "solutions")
    return TrustedModule({name: effects.function(module, name) for name in COURSE[module]} | others)


Judged = Callable[[str, Check, TrustedModule], Result]


@pytest.fixture
def judged(usual_references: References) -> Judged:
    """The result of one check alone."""

    def judge(module: str, check: Check, caller: TrustedModule) -> Result:
        (result,) = run_checks(ModuleChecks(module, (check,)), caller, usual_references, 0)
        return result

    return judge


@pytest.mark.parametrize(("module", "check"), LOOKS, ids=IDS)
def test_the_reference_looks_like_itself(module: str, check: Check, judged: Judged) -> None:
    result = judged(module, check, solution(module))
    assert result.status is Status.PASSED, result
    arrays = result.figures[0].arrays
    assert np.array_equal(arrays["yours"], arrays["expected"])
    # A scene that shows nothing of the effect would pass everything.
    assert arrays["expected"].std() > 0.05


@pytest.mark.parametrize("number", [np.nan, 3e38, 0.0])
@pytest.mark.parametrize(("module", "check"), LOOKS, ids=IDS)
def test_numbers_that_make_no_sense_fail_too(
    module: str, check: Check, number: float, judged: Judged
) -> None:
    right = solution(module)

    def wrong(*arguments: Any) -> Any:
        value = right.call(check.function, *arguments)
        if isinstance(value, tuple):
            return tuple(np.full_like(part, number) for part in value)
        return np.full_like(value, number)

    result = judged(module, check, solution(module, **{check.function: wrong}))
    if check.function == "gaussian_weights" and number == 0:
        return  # Weights that are all zero mean the plain mean.
    assert result.status is Status.FAILED, result


def test_a_bias_is_told_from_one_scene_with_many_seeds(monkeypatch: pytest.MonkeyPatch) -> None:
    scenes: list[Scene] = []

    def noted(*arguments: Any) -> Scene:
        scenes.append(load_scene(*arguments))
        return scenes[-1]

    monkeypatch.setattr(rendered_module, "load_scene", noted)
    (check,) = (check for check in PICTURES["motion_blur"] if check.kind == "bias")
    references = prepared(reference("motion_blur"), 0)("motion_blur", check)
    assert len(scenes) == 1
    blocks = references["blocks"].reshape(BIAS_REFERENCES, -1)
    assert len(np.unique(blocks, axis=0)) == BIAS_REFERENCES, "every seed gives another picture"
    trial = Trial(check.function, solution("motion_blur"), generator(0, "motion_blur", check))
    trial.references = references
    check.run(trial)
    assert len(scenes) == 2


def test_a_scene_that_was_rendered_before_gives_the_same_picture() -> None:
    find = Effects(PROJECT / "solutions").function
    description = moving(np.random.default_rng(0))
    scene, afresh = (loaded(description, find, np.random.default_rng(0)) for _ in range(2))
    before = rendered(scene, spp=16, seed=4)
    again = rendered(scene, spp=16, seed=5)
    assert not np.array_equal(before, again)
    assert again.tobytes() == rendered(afresh, spp=16, seed=5).tobytes()


def test_a_mistake_before_or_after_a_function_costs_nothing_there(judged: Judged) -> None:
    for module, check in LOOKS:
        others = {name: None for name in COURSE[module] if name != check.function}
        broken = dict.fromkeys(others, _raises)
        assert judged(module, check, solution(module, **broken)).status is Status.PASSED, (
            check.function
        )


def _raises(*_: Any) -> Any:
    raise RuntimeError("broken")


def test_the_whole_picture_needs_every_function_of_it(usual_references: References) -> None:
    (check,) = WHOLE.checks
    for module, name in (("thin_lens", "point_on_disk"), ("cube_map", "lookup_seamless")):
        callers = {other: solution(other) for other in COURSE}
        callers[module] = solution(module, **{name: _raises})
        (result,) = run_checks(WHOLE, Together(callers), usual_references, 0)
        assert result.status is Status.FAILED
        assert "broken" in result.found
    assert check.points > 0


def test_ssim_knows_equal_from_noise() -> None:
    rng = np.random.default_rng(0)
    picture = rng.random((3, 36, 48)).astype(np.float32)
    assert ssim(picture, picture) == 1
    assert ssim(picture, rng.random((3, 36, 48)).astype(np.float32)) < 0.2


def test_a_picture_that_is_moved_is_said_to_be() -> None:
    y, x = np.mgrid[:36, :48]
    picture = np.stack([0.3 + 0.2 * np.sin(x / k) * np.cos(y / 5) for k in (3, 4, 5)])
    with pytest.raises(Failure) as told:
        check_ssim(np.roll(picture, 2, axis=2), picture, "of/nothing")
    assert told.value.hint.endswith("A is moved by about 2 pixels to the right.")


def test_a_bias_of_one_percent_is_found_under_noise_of_ten() -> None:
    # Means of 36 pixels and of 4 pictures: noise of 0.1 becomes 0.008; a block 0.1 brighter is 12 of these.
    rng = np.random.default_rng(0)

    def picture(brighter: float) -> Any:
        noise = rng.normal(0.5, 0.1, (36, 48))
        noise[:6, :6] += brighter
        return np.stack([noise] * 3)

    blocks = (BLOCKS[0], 6, BLOCKS[1], 6)
    expected = np.stack(
        [picture(0).mean(axis=0).reshape(blocks).mean(axis=(1, 3)) for _ in range(32)]
    )
    check_bias([picture(0) for _ in range(4)], expected)
    with pytest.raises(Failure, match="block 0 across, 0 down"):
        check_bias([picture(0.12) for _ in range(4)], expected)


@pytest.mark.parametrize(
    ("module", "function"),
    [("blurred_transparency", "jitter_refraction"), ("path_tracing", "diffuse_bounce")],
)
def test_what_comes_before_is_replayed_for_every_picture_of_a_bias(
    module: str, function: str, judged: Judged, usual_references: References
) -> None:
    """Right whatever the functions before it do, and four different pictures."""
    (check,) = (c for c in PICTURES[module] if c.function == function and c.kind == "bias")
    others = {name: _raises for name in COURSE[module] if name != function}
    assert judged(module, check, solution(module, **others)).status is Status.PASSED
    tape = usual_references(module, check)
    before = {"blurred_transparency": "tape/refract/{}/0", "path_tracing": "tape/throughput/{}"}
    assert {before[module].format(number) for number in range(4)} <= set(tape)
