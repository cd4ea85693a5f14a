"""A student's copy, made from the archive: no solutions, and `course check` all the same."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

from course.effects import PROJECT
from course.grading.release.archive import write_archive


@pytest.fixture(scope="module")
def copy(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("student") / "penumbra"
    write_archive(PROJECT, folder)
    return folder


def check(copy: Path, *arguments: str) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        [sys.executable, "-m", "course", "check", *arguments],
        check=False,
        cwd=copy,
        env=os.environ | {"PYTHONPATH": str(copy)},
        capture_output=True,
        text=True,
        timeout=120,
    )


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


def test_another_seed_needs_the_solutions(copy: Path) -> None:
    ended = check(copy, "motion_blur", "--seed", "7")
    assert ended.returncode == 1
    assert "references for the seed 0, not 7" in ended.stderr
