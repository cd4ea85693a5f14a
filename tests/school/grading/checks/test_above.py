"""Where a function calls another public one that is wrong, that one is named first."""

from course.school.grading.catalog import module_checks
from course.school.grading.checks.closer import BEGIN
from course.school.grading.checks.result import Result, Status
from course.school.grading.checks.running import run_checks
from course.school.grading.references import prepared, reference
from course.school.grading.worker.client import Worker

SOURCE = """
import numpy as np

def shutter_times(open, close, u):
    return (open + (close - open) * u).astype(u.dtype)

def displacement(velocity, time):
    return 2 * np.outer(velocity, time).astype(time.dtype)

def _gone(velocity, time):
    ways = [displacement(v, time) for v in [velocity]]
    return ways[0]

def to_object_space(origins, velocity, time):
    moved = lambda: origins - {WAY}
    return moved().astype(np.result_type(origins, time))
"""


def failed(way: str) -> list[Result]:
    """What fails of to_object_space, in a copy without solutions."""
    source = SOURCE.replace("{WAY}", way).encode()
    checks = module_checks("motion_blur")
    with Worker("motion_blur", source) as worker:
        results = run_checks(
            checks,
            worker,
            prepared(reference("motion_blur"), 0),
            0,
            lambda check: check.kind not in ("picture", "bias", "speed"),
        )
        return [
            result
            for result in results
            if result.function == "to_object_space"
            and result.status is Status.FAILED
            and result.check not in ("contract", "refuses")
        ]


def test_the_function_that_it_calls_by_way_of_others_comes_first() -> None:
    found = failed("_gone(velocity, time)")
    assert found
    for result in found:
        assert result.hint.startswith(BEGIN.format("displacement"))
        assert not result.mistake


def test_a_function_that_calls_no_other_has_its_own_hints() -> None:
    found = failed("2 * np.outer(velocity, time)")
    assert found
    assert not any("Begin with" in result.hint for result in found)
