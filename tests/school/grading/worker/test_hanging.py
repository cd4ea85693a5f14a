"""Modules that hang, crash or aren't there: told once, waited for once, and nobody else's points.

How long something takes decides no test: what is counted is how often something was waited for or started.
"""

from pathlib import Path
from textwrap import indent

import pytest

from course.engine.functions.effects import PROJECT
from course.engine.functions.modules import COURSE
from course.school.grading import grading
from course.school.grading.checks.result import Result, Status
from course.school.grading.checks.running import OUT_OF_TIME
from course.school.grading.errors import StudentError
from course.school.grading.grading import grade
from course.school.grading.pictures.whole import Together
from course.school.grading.report import Report
from course.school.grading.worker.client import Worker
from course.school.grading.worker.limits import ALTOGETHER, NOT_RUN, Limits, TimeBudget
from tests.school.grading.worker.graded import arrays, quick, solution

MODULE = "motion_blur"
# No function of it calls another.
SOLUTION = solution(MODULE).replace(
    "gone = displacement(velocity, ", "gone = np.multiply.outer(np.asarray(velocity, time.dtype), "
)
LIMITS = Limits(call_seconds=2.0)
LOOP = "while True: pass"
EXIT = "import os\nos._exit(3)"


@pytest.fixture
def lost(monkeypatch: pytest.MonkeyPatch) -> list[float]:
    """The times that were waited in vain."""
    found: list[float] = []
    usual = TimeBudget.lose

    def lose(time_budget: TimeBudget, seconds: float) -> None:
        found.append(seconds)
        usual(time_budget, seconds)

    monkeypatch.setattr(TimeBudget, "lose", lose)
    return found


@pytest.fixture
def no_solutions(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """As in a student's copy: nobody is asked again with the course's own functions."""
    monkeypatch.setattr(grading, "SOLUTIONS", tmp_path)


def graded(source: str, module: str = MODULE) -> Report:
    return grade({module: source.encode()}, arrays(), modules=[module], limits=LIMITS, only=quick)


def with_bodies(*functions: str, body: str) -> str:
    """The solution with another body for some functions."""
    own = [f"def {name}(*_, **__):\n{indent(body, '    ')}\n" for name in functions]
    return "\n\n".join([SOLUTION, *own])


def of(report: Report, function: str) -> list[Result]:
    return [result for result in report.results if result.function == function]


@pytest.mark.usefixtures("no_solutions")
@pytest.mark.parametrize("hanging", COURSE[MODULE])
def test_a_function_that_hangs_costs_no_other_its_points_wherever_it_stands(
    hanging: str, lost: list[float]
) -> None:
    report = graded(with_bodies(hanging, body=LOOP))
    for result in report.results:
        expected = Status.TIMEOUT if result.function == hanging else Status.PASSED
        assert result.status is expected, result
    # It was waited for once, whatever the number of its checks.
    assert len(lost) == 1
    first, *others = of(report, hanging)
    assert first.found.startswith("no answer within")
    assert {(other.found, other.same_as) for other in others} == {(OUT_OF_TIME, first.id)}


@pytest.mark.usefixtures("no_solutions")
def test_when_all_hang_the_time_has_an_end_and_it_is_told(lost: list[float]) -> None:
    module = "sampling"
    source = "".join(f"def {name}(*_):\n    {LOOP}\n" for name in COURSE[module])
    report = graded(source, module)
    assert {result.status for result in report.results} == {Status.TIMEOUT}
    assert sum(lost) <= ALTOGETHER * LIMITS.call_seconds
    assert any(result.found.startswith(NOT_RUN) for result in report.results)
    assert report.points == 0


@pytest.mark.usefixtures("no_solutions")
def test_slow_and_right_is_right(lost: list[float]) -> None:
    # Each call a fortieth of what one may take, and all of them together more than hanging ones may.
    slow = SOLUTION + "".join(
        f"\n\n_{name} = {name}\n\ndef {name}(*given):\n    import time\n    time.sleep(0.05)\n"
        f"    return _{name}(*given)\n"
        for name in COURSE[MODULE][:1]
    )
    report = graded(slow)
    assert report.score == 1
    assert report.seconds > ALTOGETHER * LIMITS.call_seconds
    assert not lost


def test_a_function_that_calls_one_that_hangs_is_not_waited_for(lost: list[float]) -> None:
    source = with_bodies("displacement", body=LOOP)
    source += "\n\ndef to_object_space(origins, velocity, time):\n"
    source += (
        "    _check_batch('origins', origins, 3)\n"
        "    _check_single(velocity=velocity)\n"
        "    _check_scalars('time', time, np.shape(origins)[1])\n"
        "    return origins - displacement(velocity, time)\n"
    )
    report = graded(source)
    assert {result.status for result in of(report, "to_object_space")} == {Status.PASSED}
    # Once by itself and once with the course's own above it.
    assert len(lost) == 2


def test_a_picture_of_all_does_not_wait_again() -> None:
    class Never:
        def call(self, *_: object, **__: object) -> object:
            raise AssertionError

        def call_and_look(self, *_: object) -> tuple[object, list[object], bool]:
            raise AssertionError

    with pytest.raises(StudentError) as error:
        Together({MODULE: Never()}, {f"{MODULE}.displacement"}).call(f"{MODULE}.displacement", 1)
    assert error.value.kind == "timeout"


@pytest.mark.parametrize(
    ("source", "status", "says"),
    [
        (LOOP, Status.TIMEOUT, "the import of motion_blur.py doesn't end within 2 s"),
        (EXIT, Status.CRASHED, "motion_blur.py can't be imported: the process has ended"),
        ("def f(:", Status.FAILED, "motion_blur.py can't be imported: SyntaxError: invalid syntax"),
        ("1 / 0", Status.FAILED, "motion_blur.py can't be imported: ZeroDivisionError: division"),
        ("", Status.NOT_ATTEMPTED, "motion_blur.py is empty"),
        ("\n \n", Status.NOT_ATTEMPTED, "motion_blur.py is empty"),
    ],
    ids=["loop", "exit", "syntax", "raises", "empty", "blank"],
)
def test_a_module_that_can_not_be_used_is_tried_once_and_told_once(
    source: str, status: Status, says: str, starts: list[str]
) -> None:
    report = grade({MODULE: source.encode()}, arrays(), modules=[MODULE], limits=LIMITS)
    # All kinds of checks, those of speed too: none passes.
    assert {result.status for result in report.results} == {status}
    assert report.points == 0
    # What ends its process is started once more: something else may have ended it.
    expected = {Status.NOT_ATTEMPTED: 0, Status.CRASHED: 2}
    assert len(starts) == expected.get(status, 1)
    first, *others = report.results
    assert first.found.startswith(says)
    assert {other.found for other in others} == {first.found}
    assert {(other.same_as, other.where) for other in others} == {(first.id, "")}
    assert all(result.module_wide for result in report.results)


@pytest.mark.parametrize("source", [LOOP, EXIT, "1 / 0"], ids=["loop", "exit", "raises"])
def test_nobody_imports_again_what_could_not_be_imported(source: str, starts: list[str]) -> None:
    with Worker("m", source.encode(), Limits(call_seconds=0.5)) as worker:
        for ask in (worker.load, worker.load, lambda: worker.call("f")):
            with pytest.raises(StudentError) as error:
                ask()
            assert error.value.module_wide
    assert starts == ["m"] * (2 if source is EXIT else 1)


def test_a_syntax_error_is_shown_with_its_line_and_a_caret() -> None:
    first = graded("import numpy as np\n\ndef f(:\n    pass\n").results[0]
    rows = first.where.splitlines()
    assert rows[0].strip() == 'File "motion_blur.py", line 3'
    assert rows[1].strip() == "def f(:"
    assert rows[1].index(":", 8) == rows[2].index("^")


def test_a_file_that_is_not_there_is_called_missing(tmp_path: Path) -> None:
    report = grade({}, arrays(), modules=[MODULE], only=quick)
    assert {result.found for result in report.results} == {"motion_blur.py is missing"}
    (tmp_path / "motionblur.py").write_text("")
    report = grade({}, arrays(), modules=[MODULE], only=quick, folder=tmp_path)
    assert (
        report.results[0].found
        == f"{tmp_path / 'motion_blur.py'} is missing (is it motionblur.py?)"
    )
    assert {result.status for result in report.results} == {Status.NOT_ATTEMPTED}


def test_a_function_that_is_not_there_is_called_missing_and_its_like_is_named() -> None:
    report = graded(SOLUTION.replace("def displacement", "def displacment"))
    results = of(report, "displacement")
    assert {result.status for result in results} == {Status.NOT_ATTEMPTED}
    says = "motion_blur.py has no displacement (did you mean displacment?)"
    assert {result.found for result in results} == {says}
    without = of(graded(SOLUTION.replace("def displacement", "def moved")), "displacement")
    assert without[0].found == "motion_blur.py has no displacement"


def test_an_exception_is_told_once_for_a_function_and_cut() -> None:
    report = graded(with_bodies("displacement", body="raise KeyError('long ' * 800)"))
    first, *others = of(report, "displacement")
    assert first.found.startswith("KeyError: 'long long")
    assert len(first.found) < 400
    assert "line" in first.where
    assert max(map(len, first.where.splitlines())) < 200
    assert {other.same_as for other in others} == {first.id}
    assert not any(other.where for other in others)
    # Another function's is another.
    both = graded(with_bodies("displacement", "shutter_times", body="raise KeyError('x')"))
    assert of(both, "displacement")[0].same_as == ""
    assert of(both, "shutter_times")[0].same_as == ""


def test_two_exceptions_of_one_function_are_both_told() -> None:
    body = "CALLS.append(1)\nraise (KeyError if len(CALLS) == 1 else IndexError)('x')"
    source = with_bodies("displacement", body=body) + "\nCALLS = []\n"
    found = {
        result.found.partition(":")[0]
        for result in of(graded(source), "displacement")
        if not result.same_as
    }
    assert found == {"KeyError", "IndexError"}


@pytest.mark.usefixtures("no_solutions")
def test_functions_that_end_their_process_cost_no_other_its_points() -> None:
    module = "sampling"
    solution = (PROJECT / "solutions" / f"{module}.py").read_text(encoding="utf-8")
    crashing = COURSE[module][:3]
    source = solution + "".join(
        f"\n\ndef {name}(*_):\n{indent(EXIT, '    ')}\n" for name in crashing
    )
    report = graded(source, module)
    for result in report.results:
        expected = Status.CRASHED if result.function in crashing else Status.PASSED
        assert result.status is expected, result


def test_a_stub_is_asked_once_and_who_calls_it_with_the_courses_own_in_its_place(
    starts: list[str],
) -> None:
    stubs = (PROJECT / "assignments" / f"{MODULE}.py").read_text(encoding="utf-8")
    assert {result.status for result in graded(stubs).results} == {Status.NOT_ATTEMPTED}
    assert starts == [MODULE]
    body = f'    raise NotImplementedError("{MODULE}.displacement: not written yet")'
    report = graded(f"{solution(MODULE)}\n\ndef displacement(*_):\n{body}\n")
    found = {(result.function == "displacement", result.status) for result in report.results}
    assert found == {(True, Status.NOT_ATTEMPTED), (False, Status.PASSED)}
