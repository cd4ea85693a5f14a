"""A student's copy, made from the archive: no solutions, and `course check` all the same."""

import os
import subprocess
import zipfile
from pathlib import Path

import pytest

from course.engine.functions.effects import PROJECT
from course.engine.functions.modules import COURSE
from course.school.grading.catalog import module_checks
from course.school.grading.checks.result import Status, result_of
from course.school.grading.pictures.whole import NAME
from course.school.grading.report import docs_page, reproduce
from tests.processes import python


@pytest.fixture(scope="module")
def copy(archive: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("student")
    with zipfile.ZipFile(archive) as file:
        file.extractall(folder)
    return folder / "penumbra"


def check(copy: Path, *arguments: str) -> subprocess.CompletedProcess[str]:
    return python("-m", "course", "check", *arguments, folder=copy, path=copy, may_fail=True)


def test_stubs_are_to_do(copy: Path) -> None:
    ended = check(copy, "motion_blur", "thin_lens")
    assert ended.returncode == 3, ended.stderr
    assert ended.stdout.count("to do") == 7
    assert "0 of" in ended.stdout


def test_what_a_student_writes_is_checked_with_pictures(copy: Path) -> None:
    assert not (copy / "solutions").exists()
    (copy / "assignments" / "motion_blur.py").write_bytes(
        (PROJECT / "solutions" / "motion_blur.py").read_bytes()
    )
    (copy / "assignments" / "thin_lens.py").write_bytes(
        (PROJECT / "solutions" / "thin_lens.py").read_bytes()
    )
    ended = check(copy, "motion_blur", "thin_lens")
    assert ended.returncode == 0, ended.stdout + ended.stderr
    again = check(copy, "thin_lens", "--only", "lens_rays/picture")
    assert "1 of 1 check passed" in again.stdout


def test_another_seed_makes_the_checks_that_need_no_references(copy: Path) -> None:
    (copy / "assignments" / "motion_blur.py").write_bytes(
        (PROJECT / "solutions" / "motion_blur.py").read_bytes()
    )
    ended = check(copy, "motion_blur", "--seed", "7")
    assert ended.returncode == 0, ended.stdout + ended.stderr
    assert "no references for the seed 7" in ended.stderr
    assert "right    displacement" in ended.stdout
    picture = check(copy, "motion_blur", "--seed", "7", "--only", "displacement/picture")
    assert picture.returncode == 1
    assert "leave --seed 7 out" in picture.stderr


def test_what_a_report_tells_to_run_and_to_read_is_in_the_copy(copy: Path) -> None:
    for module in (*COURSE, NAME):
        for one in module_checks(module).checks:
            result = result_of(module, one, Status.FAILED)
            page, _, anchor = docs_page(result).partition("#")
            text = (copy / page).read_text(encoding="utf-8")
            anchors = {
                line.lstrip("#").strip().lower().replace(" ", "-")
                for line in text.splitlines()
                if line.startswith("#")
            }
            assert anchor in anchors, (page, anchor)
    # The one check that is nobody's module's is found by its line, too.
    whole = module_checks(NAME).checks[0]
    line = reproduce(result_of(NAME, whole, Status.FAILED), None)
    assert line == "course check --only scene/picture"
    ended = check(copy, *line.split()[2:])
    assert "0 of 3 points" in ended.stdout


def test_its_own_tests_are_found_with_what_its_makefile_installs(copy: Path) -> None:
    makefile = (copy / "Makefile").read_text(encoding="utf-8")
    packages = makefile.partition("--editable . ")[2].splitlines()[0]
    assert f"pip install -e . {packages}\n" in (copy / "README.md").read_text(encoding="utf-8")
    first, *plugins = packages.split()
    assert first == "pytest"
    given = [word for name in plugins for word in ("-p", name.replace("-", "_"))]
    line = ("-m", "pytest", "-q", "--collect-only", "tests", *given)
    # The plugins and options of this environment are not those of the student's.
    alone = os.environ | {"PYTEST_DISABLE_PLUGIN_AUTOLOAD": "1", "PYTEST_ADDOPTS": ""}
    python(*line, folder=copy, path=copy, environment=alone)


def test_a_wrong_function_is_told_with_another_seed_too(copy: Path) -> None:
    """What known mistakes look like hangs on no seed."""
    right = (PROJECT / "solutions" / "motion_blur.py").read_text(encoding="utf-8")
    body = "    return -np.multiply.outer(velocity, time).astype(time.dtype)"
    wrong = f"{right}\n\ndef displacement(velocity, time):\n{body}\n"
    (copy / "assignments" / "motion_blur.py").write_text(wrong, encoding="utf-8")
    ended = check(copy, "motion_blur", "--seed", "7", "--hint", "3")
    assert ended.returncode == 3, ended.stderr
    assert "wrong    displacement" in ended.stdout, ended.stderr
    assert "looks like" in ended.stdout
    assert "right    shutter_times" in ended.stdout
