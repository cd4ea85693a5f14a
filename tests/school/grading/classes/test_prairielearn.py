"""The question for PrairieLearn and the image that grades it, laid out and run as PrairieLearn does."""

import json
import re
import shlex
import subprocess
import uuid
from collections.abc import Callable
from math import fsum
from pathlib import Path
from typing import Any

import pytest
from click.testing import Result

from course.school.grading.classes import container
from course.school.grading.classes.bundles import HOME, totals
from course.school.grading.known import known

PROJECT = Path(__file__).parents[4]
RIGHT = (PROJECT / "solutions" / "motion_blur.py").read_text("utf-8")
WRONG = next(one for one in known("motion_blur") if one.name == "accelerated")


Bundle = Callable[..., Result]


@pytest.fixture(scope="module")
def bundle(bundled: Bundle) -> Bundle:
    def run(system: str, out: Path, *arguments: str) -> Result:
        options = ["--out", str(out), "--modules", "motion_blur", "--seed=7", *arguments]
        return bundled(system, *options)

    return run


@pytest.fixture(scope="module")
def question(tmp_path_factory: pytest.TempPathFactory, bundle: Bundle) -> Path:
    folder = tmp_path_factory.mktemp("bundle") / "question"
    made = bundle("prairielearn", folder, "--image", "registry.example.org/lens")
    assert made.exit_code == 0, made.output
    return folder


def grade(question: Path, root: Path, **files: str) -> dict[str, Any]:
    """What the image's own line does with a job in ``root``."""
    (root / "student").mkdir(parents=True, exist_ok=True)
    for name, content in files.items():
        (root / "student" / name).write_text(content)
    script = (question / "image" / "run").read_text()
    line = shlex.split(script.split("exec ")[1].replace("\\\n", " "))
    assert line[:4] == ["python", "-I", "-m", "course.school.grading.classes.container"]
    arguments = [part.replace(HOME, str(question / "image")) for part in line[4:]]
    assert container.main([*arguments, "--root", str(root), "--trust-submissions"]) == 0
    found: dict[str, Any] = json.loads((root / "results" / "results.json").read_text())
    return found


def test_the_question_is_what_prairielearn_reads(question: Path) -> None:
    info = json.loads((question / "info.json").read_text())
    uuid.UUID(info["uuid"])
    assert (info["type"], info["gradingMethod"]) == ("v3", "External")
    options = info["externalGradingOptions"]
    assert options["enabled"] is True
    assert options["image"] == "registry.example.org/lens"
    assert options["entrypoint"] == f"{HOME}/run"
    assert options["enableNetworking"] is False
    assert 30 < options["timeout"] <= 600
    page = (question / "question.html").read_text()
    assert '<pl-file-upload file-names="motion_blur.py">' in page
    assert "<pl-external-grader-results>" in page
    # The seed is in the image only.
    shown = [path for path in question.iterdir() if path.is_file()]
    assert not any("seed 7" in path.read_text() for path in shown)


def test_the_image_s_folder_has_all_that_its_dockerfile_takes(question: Path) -> None:
    image = question / "image"
    subprocess.run(["sh", "-n", image / "run"], check=True)
    text = (image / "Dockerfile").read_text()
    copied = [part for line in re.findall(r"^COPY (.*)$", text, re.M) for part in line.split()[:-1]]
    assert copied == ["penumbra", "references.npz", "run"]
    assert all((image / name).exists() for name in copied)
    assert (image / "penumbra" / "solutions" / "motion_blur.py").is_file()
    assert (image / "penumbra" / "pyproject.toml").is_file()
    assert not (image / "penumbra" / "solutions" / "wrong").exists()


def test_right_and_wrong_are_graded(question: Path, tmp_path: Path) -> None:
    right = grade(question, tmp_path / "right", **{"motion_blur.py": RIGHT})
    assert (right["gradable"], right["score"]) == (True, 1.0)
    assert (
        fsum(test["max_points"] for test in right["tests"])
        == totals(["motion_blur"])["motion_blur"]
    )
    wrong = grade(question, tmp_path / "wrong", **{"motion_blur.py": WRONG.source})
    assert 0 < wrong["score"] < 1
    assert "--seed" not in json.dumps(wrong)


def test_what_is_not_gradable_costs_no_attempt(question: Path, tmp_path: Path) -> None:
    nothing = grade(question, tmp_path / "nothing", **{"notes.txt": ""})
    assert nothing["gradable"] is False
    assert "there is no file for motion_blur.py" in nothing["format_errors"][0]


def test_a_fault_of_the_grader_leaves_no_results(
    question: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    grade(question, tmp_path, **{"notes.txt": ""})
    monkeypatch.setattr(container, "_grade", lambda *_: 1 // 0)
    references = str(question / "image" / "references.npz")
    arguments = ["prairielearn", "--root", str(tmp_path), "--references", references]
    assert container.main(arguments) == 1
    assert not (tmp_path / "results" / "results.json").exists()


def test_points_are_told(tmp_path: Path, bundle: Bundle) -> None:
    made = bundle("docker", tmp_path / "image")
    assert made.exit_code == 0, made.output
    of = f"{totals(['motion_blur'])['motion_blur']:g}"
    assert re.search(rf"motion_blur +{re.escape(of)}\n.*in all +{re.escape(of)}\n", made.output)
    assert (tmp_path / "image" / "Dockerfile").is_file()
    assert "course grade /submissions" in (tmp_path / "image" / "README.md").read_text()


@pytest.mark.parametrize(
    ("system", "out", "arguments", "told"),
    [
        ("gradescope", "x.tar", [], "doesn't end in .zip"),
        ("docker", "full", [], "not an empty folder"),
        ("docker", "new", ["--image", "x"], "are for prairielearn"),
    ],
)
def test_wrong_usage(
    bundle: Bundle, tmp_path: Path, system: str, out: str, arguments: list[str], told: str
) -> None:
    (tmp_path / "full").mkdir()
    (tmp_path / "full" / "mine").write_text("mine")
    made = bundle(system, tmp_path / out, *arguments)
    assert made.exit_code in (1, 2)
    assert told in made.output
