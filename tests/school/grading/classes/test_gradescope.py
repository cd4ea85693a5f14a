"""The archive for Gradescope, laid out and run as Gradescope does."""

import json
import os
import shutil
import stat
import subprocess
import sys
import zipfile
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from time import sleep
from typing import Any

import pytest
from click.testing import Result

from course.school.grading.catalog import module_checks
from course.school.grading.classes import container
from course.school.grading.classes.bundles import gradescope_contents
from course.school.grading.known import known
from course.school.grading.worker.sandbox import NotProtected, plain

PROJECT = Path(__file__).parents[4]
RIGHT = (PROJECT / "solutions" / "motion_blur.py").read_text("utf-8")
STUB = (PROJECT / "assignments" / "motion_blur.py").read_text("utf-8")
WRONG = next(one for one in known("motion_blur") if one.name == "accelerated")
# Each import takes so long that whoever looks sees the results before all are there.
SLOW = (
    RIGHT
    + "\n\n_right = displacement\ndef displacement(*a):\n    import time\n    time.sleep(0.2)\n    return _right(*a)\n"
)


@pytest.fixture(scope="module")
def bundle(tmp_path_factory: pytest.TempPathFactory, bundled: Callable[..., Result]) -> Path:
    path = tmp_path_factory.mktemp("bundle") / "autograder.zip"
    result = bundled("gradescope", "--out", str(path), "--modules", "motion_blur", "--seed=7")
    assert result.exit_code == 0, result.output
    return path


@pytest.fixture
def root(bundle: Path, tmp_path: Path) -> Path:
    for name in ("source", "submission", "results"):
        (tmp_path / name).mkdir()
    with zipfile.ZipFile(bundle) as archive:
        archive.extractall(tmp_path / "source")
    metadata = {"users": [{"name": "Ada Lovelace", "email": "ada@example.org"}]}
    (tmp_path / "submission_metadata.json").write_text(json.dumps(metadata))
    return tmp_path


def start(root: Path) -> subprocess.Popen[bytes]:
    """What run_autograder starts, with this Python in place of the image's."""
    script = (root / "source" / "run_autograder").read_text()
    command = script.split("exec ")[1].replace("\\\n", " ").split()
    assert command[0] == "/autograder/source/.venv/bin/python"
    command = [sys.executable, *command[1:]]
    command[command.index("--root") + 1] = str(root)
    project = root / "source" / "penumbra"
    return subprocess.Popen(
        command, cwd=project, env=os.environ | {"PYTHONPATH": str(project)}, stderr=subprocess.PIPE
    )


def grade(root: Path, source: str) -> dict[str, Any]:
    (root / "submission" / "motion_blur.py").write_text(source)
    process = start(root)
    _, errors = process.communicate(timeout=50)
    assert process.returncode == 0, errors.decode()
    found: dict[str, Any] = json.loads((root / "results" / "results.json").read_text())
    return found


def of(results: dict[str, Any]) -> float:
    return sum(test["max_score"] for test in results["tests"])


def test_the_archive_holds_what_grading_needs_and_no_more(bundle: Path) -> None:
    with zipfile.ZipFile(bundle) as archive:
        modes = {entry.filename: entry.external_attr >> 16 for entry in archive.infolist()}
        setup = archive.read("setup.sh").decode()
    for name in ("setup.sh", "run_autograder"):
        assert modes[name] & stat.S_IXUSR
        assert modes[name] & stat.S_IXOTH
    assert "penumbra/solutions/motion_blur.py" in modes
    assert "penumbra/course/school/grading/modules/motion_blur.py" in modes
    assert "penumbra/pyproject.toml" in modes
    assert "references.npz" in modes
    for folder in ("tests", "docs", "benchmarks", "assignments", "solutions/wrong", "out"):
        assert not any(name.startswith(f"penumbra/{folder}/") for name in modes)
    assert not any("__pycache__" in name for name in modes)
    assert "bubblewrap" in setup
    assert "-m venv .venv" in setup
    assert "install --editable ./penumbra" in setup


@pytest.mark.parametrize("script", ["setup.sh", "run_autograder"])
def test_the_scripts_are_bash(root: Path, script: str) -> None:
    subprocess.run(["bash", "-n", root / "source" / script], check=True)


def test_right_wrong_and_untouched(root: Path) -> None:
    right = grade(root, RIGHT)
    assert right["score"] == pytest.approx(of(right))
    assert of(right) > 0
    assert right["execution_time"] > 0
    # Students read this file.
    assert "seed" not in right["extra_data"]

    wrong = grade(root, WRONG.source)
    assert 0 < wrong["score"] < of(wrong) == of(right)
    failed = {test["extra_data"]["id"] for test in wrong["tests"] if test["status"] == "failed"}
    assert f"motion_blur.{WRONG.function}/{WRONG.caught_by}" in failed

    stub = grade(root, STUB)
    assert stub["score"] == 0
    assert of(stub) == of(right)


def test_results_are_whole_after_every_check_and_stay_after_a_kill(root: Path) -> None:
    (root / "submission" / "motion_blur.py").write_text(SLOW)
    process = start(root)
    path = root / "results" / "results.json"
    points = pytest.approx(sum(check.points for check in module_checks("motion_blur").checks))
    scores: list[float] = []
    while process.poll() is None and len(set(scores)) < 6:
        if path.exists():
            found = json.loads(path.read_text())
            scores.append(found["score"])
            assert of(found) == points
        sleep(0.01)
    process.kill()
    process.communicate()
    assert sorted(scores) == scores
    assert len(set(scores)) == 6
    kept = json.loads(path.read_text())
    assert 0 < kept["score"] < of(kept)
    assert any("time was over" in test["output"] for test in kept["tests"])
    assert [one.name for one in path.parent.iterdir() if not one.name.startswith(".")] == [
        "results.json"
    ]


def test_a_submission_that_can_t_be_read_is_told(root: Path) -> None:
    for name in ("a", "b"):
        (root / "submission" / name).mkdir()
        (root / "submission" / name / "motion_blur.py").write_text(RIGHT)
    assert (
        container.main(["gradescope", "--root", str(root), "--modules", "motion_blur", "--seed=7"])
        == 0
    )
    found = json.loads((root / "results" / "results.json").read_text())
    assert "more than once" in found["output"]
    assert str(root) not in found["output"]


def test_a_fault_of_the_grader_gives_no_grade(root: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def fail(*_: object, **__: object) -> None:
        raise ZeroDivisionError

    (root / "submission" / "motion_blur.py").write_text(RIGHT)
    monkeypatch.setattr(container, "grade", fail)
    assert (
        container.main(["gradescope", "--root", str(root), "--modules", "motion_blur", "--seed=7"])
        == 1
    )
    assert not (root / "results" / "results.json").exists()


def test_names_come_from_the_metadata_if_it_is_there(tmp_path: Path) -> None:
    path = tmp_path / "submission_metadata.json"
    assert container._student(path) == ""
    for text in ("{", "[]", '{"users": 3}', '{"users": [null]}'):
        path.write_text(text)
        assert container._student(path) == ""
    path.write_text('{"users": [{"name": "Ada"}, {"email": "b@example.org"}]}')
    assert container._student(path) == "Ada, b@example.org"


@pytest.mark.skipif(
    os.name == "nt" or os.geteuid() != 0 or shutil.which("setpriv") is None,
    reason="only root can set an image up",
)
def test_the_image_keeps_the_course_from_every_user_but_root(root: Path) -> None:
    setup = (root / "source" / "setup.sh").read_text()
    # What follows the installation, without what runs the image's own Python.
    lines = [line for line in setup.splitlines() if line.startswith(("chown", "chmod"))]
    assert len(lines) == 2
    subprocess.run(["bash", "-ec", "\n".join(lines)], cwd=root / "source", check=True)
    # Whoever reaches the folder all the same, as every user does in a container.
    for folder in (root, *root.parents):
        if folder.stat().st_uid == os.geteuid() and folder != Path("/"):
            folder.chmod(folder.stat().st_mode | 0o111)
    nobody = ["setpriv", "--reuid=65534", "--regid=65534", "--clear-groups"]
    for name in ("penumbra/solutions/motion_blur.py", "penumbra/solutions", "references.npz"):
        look = [*nobody, "ls" if name.endswith("solutions") else "cat", str(root / "source" / name)]
        assert subprocess.run(look, capture_output=True, check=False).returncode, name
    assert not subprocess.run([*nobody, "ls", str(root / "source")], check=False).returncode
    assert grade(root, RIGHT)["score"] > 0


def test_the_image_says_when_it_is_built_what_will_hold(
    root: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    def refuse(*_: object) -> None:
        raise NotProtected("code could read solutions; --trust-submissions")

    assert container.main(["gradescope", "--root", str(root), "--walls"]) == 0
    monkeypatch.setattr(container, "protected", refuse)
    assert container.main(["gradescope", "--root", str(root), "--walls"]) == 0
    assert "will not be graded: code could read solutions" in capsys.readouterr().out


def test_without_protection_nothing_is_graded_unless_it_is_asked_for(
    root: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def refuse(*_: object) -> None:
        raise NotProtected("code could read solutions")

    unprotected = "NOT PROTECTED: student code could read solutions"
    (root / "submission" / "motion_blur.py").write_text(STUB)
    monkeypatch.setattr(container, "protected", refuse)
    monkeypatch.setattr(
        container, "sandbox", lambda **_: replace(plain(), protections=(unprotected,))
    )
    arguments = ["gradescope", "--root", str(root), "--modules", "motion_blur", "--seed=7"]
    assert container.main(arguments) == 1
    results = root / "results" / "results.json"
    assert not results.exists()
    assert container.main([*arguments, "--trust-submissions"]) == 0
    assert unprotected in json.loads(results.read_text())["output"]


def test_trust_is_bundled_only_when_it_is_asked_for(
    root: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    assert "--trust" not in (root / "source" / "run_autograder").read_text()
    monkeypatch.setattr("course.school.grading.classes.bundles.reference_file", lambda *_: b"")
    contents = gradescope_contents(PROJECT, 1, ("motion_blur",), trusted=True)
    run = contents["run_autograder"].decode()
    assert run.rstrip().endswith("--modules motion_blur --trust-submissions")
