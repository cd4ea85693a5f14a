"""How one check gets its score is to be read in few files."""

import sys
from pathlib import Path
from types import FrameType
from typing import Any

import pytest

import course
from course.school.grading.catalog import module_checks
from course.school.grading.checks.result import Status
from course.school.grading.checks.running import run_checks
from course.school.grading.references import reference, references
from tests.code_lines import code_lines

COURSE = Path(course.__file__).parent

FILES, LINES = 10, 1275
"""At the most, of files of ``course`` whose functions run, and of their lines of code."""


@pytest.mark.parametrize("name", ["contract", "centres"])
def test_how_a_check_gets_its_score_is_read_in_few_files(name: str) -> None:
    checks, caller = module_checks("soft_shadows"), reference("soft_shadows")
    run: set[Path] = set()

    def profile(frame: FrameType, event: str, _: Any) -> None:
        if event == "call":
            run.add(Path(frame.f_code.co_filename))

    results = run_checks(
        checks,
        caller,
        references(),
        0,
        only=lambda check: (check.function, check.name) == ("light_grid", name),
    )
    before = sys.getprofile()
    sys.setprofile(profile)
    try:
        (result,) = results
    finally:
        sys.setprofile(before)
    assert result.status is Status.PASSED
    files = {path for path in run if path.is_relative_to(COURSE)}
    assert COURSE / "school/grading/checks/running.py" in files
    assert len(files) <= FILES, sorted(files)
    total = sum(code_lines(path.read_text(encoding="utf-8")) for path in files)
    assert total <= LINES, total
