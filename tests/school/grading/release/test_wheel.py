"""An installed wheel is the whole course: from an empty folder it lays out a folder to work in, renders and checks.

It is built by way of the source distribution and unpacked beside the libraries; the checkout isn't on the path.
"""

import json
import os
import re
import shutil
import subprocess
import sys
import tarfile
import zipfile
from collections.abc import Callable
from pathlib import Path

import pytest

from course.engine.functions.effects import PROJECT
from course.engine.functions.modules import COURSE
from course.school.grading.release.archive import LICENSES
from tests.once import Once
from tests.processes import python

Course = Callable[..., subprocess.CompletedProcess[str]]

OTHERS = "COURSE_TRY_PYTHONS"
"""Environment variable: if it is set, the wheel is installed for the machine's other Pythons, by pip from the index."""

pytest.importorskip("hatchling", reason="builds the wheel; it is one of the extras `dev`")


def _installed(folder: Path) -> None:
    """Build the source distribution from the checkout, the wheel from that, and unpack it."""
    folder.mkdir()
    _built("sdist", PROJECT, folder)
    (sources,) = folder.glob("*.tar.gz")
    with tarfile.open(sources) as file:
        file.extractall(folder, filter="data")
    _built("wheel", folder / sources.name.removesuffix(".tar.gz"), folder)
    (wheel,) = folder.glob("*.whl")
    with zipfile.ZipFile(wheel) as file:
        file.extractall(folder)


def _built(target: str, source: Path, folder: Path) -> None:
    line = [sys.executable, "-m", "hatchling", "build", "-t", target, "-d", str(folder)]
    subprocess.run(line, cwd=source, check=True, capture_output=True, timeout=120)


def _interpreter(version: str) -> Path | None:
    """A Python of that version on this machine, that of pyenv included."""
    versions = Path.home() / ".pyenv" / "versions"
    found = [*versions.glob(f"{version}.*/bin/python{version}"), shutil.which(f"python{version}")]
    for candidate in filter(None, found):
        line = [candidate, "-c", "import ensurepip, venv"]
        if not subprocess.run(line, check=False, capture_output=True).returncode:
            return Path(candidate)
    return None


@pytest.fixture(scope="module")
def site(once: Once) -> Path:
    """The folder into which the wheel is installed."""
    return once("installed wheel", _installed)


@pytest.fixture
def course(site: Path, tmp_path: Path) -> Course:
    """Run `course` as it is installed, in an empty folder or one of its folders."""

    def run(*arguments: str, folder: str = ".") -> subprocess.CompletedProcess[str]:
        line = ("-P", "-m", "course", *arguments)
        return python(*line, folder=tmp_path / folder, path=site, may_fail=True)

    return run


def test_a_folder_to_work_in_is_made_rendered_and_checked(
    course, site: Path, tmp_path: Path
) -> None:
    started = course("start", "mine")
    assert started.returncode == 0, started.stderr
    scene = "scenes/before/supersampling.yaml"
    rendered = course("render", scene, "--size", "60x40", "-o", "a.png", folder="mine")
    assert rendered.returncode == 0, rendered.stderr
    todo = course("check", "thin_lens", "--lines", folder="mine")
    assert todo.returncode == 3, todo.stderr
    tasks = json.loads((tmp_path / "mine" / ".vscode" / "tasks.json").read_text("utf-8"))
    matcher = tasks["tasks"][0]["problemMatcher"]["pattern"]["regexp"]
    found = [re.match(matcher, line) for line in todo.stdout.splitlines()]
    assert [m[4].partition(":")[0] for m in found if m] == list(COURSE["thin_lens"])
    # With the right functions all is right, and pictures are among what is checked.
    files = site / "penumbra_course_files"
    shutil.copy(files / "solutions" / "thin_lens.py", tmp_path / "mine" / "assignments")
    done = course("check", "thin_lens", folder="mine")
    assert done.returncode == 0, done.stdout + done.stderr
    assert re.search(r"40 of 40 points, (\d+) of \1 checks passed", done.stdout)


def test_a_picture_shows_what_is_written_so_far(course: Course, site: Path, tmp_path: Path) -> None:
    course("start", "mine")
    options = ("--size", "30x20", "--spp", "4", "--receipt", "a.json")
    shutil.copy(
        site / "penumbra_course_files/solutions/soft_shadows.py", tmp_path / "mine/assignments"
    )
    rendered = course("render", "scenes/soft_shadows.yaml", *options, folder="mine")
    assert rendered.returncode == 0, rendered.stderr
    receipt = json.loads((tmp_path / "mine" / "a.json").read_text("utf-8"))
    assert receipt["effects"]["yours"] == ["soft_shadows.point_on_sphere"]


def test_a_class_is_graded(course: Course, site: Path, tmp_path: Path) -> None:
    (tmp_path / "handed_in" / "ann").mkdir(parents=True)
    files = site / "penumbra_course_files"
    shutil.copy(files / "solutions" / "thin_lens.py", tmp_path / "handed_in" / "ann")
    graded = course(
        "grade", "handed_in", "--out", "graded", "--modules", "thin_lens", "--trust-submissions"
    )
    assert graded.returncode == 0, graded.stderr
    assert "ann,1,40,40" in (tmp_path / "graded" / "grades.csv").read_text("utf-8")


def test_where_nothing_is_yet_the_remedy_is_told(course: Course) -> None:
    missing = course("check", "sampling")
    assert missing.returncode == 1
    assert "`course start FOLDER` makes a folder to work in" in missing.stderr


def test_where_the_course_is_near_the_way_to_it_is_told(course: Course) -> None:
    course("start", "my course")
    for folder, way in ((".", '`cd "my course"`'), ("my course/docs", "`cd ..`")):
        for command in (("check", "sampling"), ("status",)):
            missing = course(*command, folder=folder)
            assert missing.returncode == 1
            assert f"{way} goes to your course" in missing.stderr
    line = ("render", "my course/scenes/soft_shadows.yaml", "--size", "30x20", "--spp", "1")
    rendered = course(*line, "-o", "a.png")
    assert rendered.returncode == 0, rendered.stderr
    assert 'all functions are the course\'s: `cd "my course"`' in rendered.stderr


def test_links_of_the_folder_lead_somewhere(course: Course, tmp_path: Path) -> None:
    started = course("start", "mine", "--instructor")
    # Who plans a course is told so, on the screen and by the folder's own page.
    assert "docs/guides/teaching.md" in started.stdout
    assert "(docs/guides/teaching.md)" in (tmp_path / "mine" / "README.md").read_text("utf-8")
    assert "teaching.md" not in course("start", "students").stdout
    for name in LICENSES:
        assert (tmp_path / "mine" / name).read_bytes() == (PROJECT / name).read_bytes()
    pages = sorted((tmp_path / "mine").rglob("*.md"))
    assert tmp_path / "mine" / "solutions" / "answers" / "glossy.md" in pages
    assert len(pages) > 20
    teaching = (tmp_path / "mine" / "docs" / "guides" / "teaching.md").read_text("utf-8")
    assert teaching.count("| week | modules |") == 2
    assert "| module | reading | writing |" in teaching
    assert teaching.count("| objective | shown by |") == len(COURSE)
    assert "<!-- site:" not in teaching
    for page in pages:
        for target in re.findall(r"\]\(([^)#\s]+)", page.read_text(encoding="utf-8")):
            if "://" not in target:
                assert (page.parent / target).exists(), (page, target)


def test_questions_are_written_from_the_wheel(course, tmp_path: Path) -> None:
    written = course("quiz", "out", "--modules", "quasi_monte_carlo", "--held-back")
    assert written.returncode == 0, written.stderr
    assert "1 question" in written.stdout
    assert (tmp_path / "out" / "canvas.zip").is_file()


@pytest.mark.skipif(not os.environ.get(OTHERS), reason=f"{OTHERS} is not set: needs the network")
@pytest.mark.parametrize("version", ["3.11", "3.12", "3.13", "3.14"])
def test_another_python_installs_the_wheel_and_works(
    version: str, site: Path, tmp_path: Path
) -> None:
    if version == f"{sys.version_info.major}.{sys.version_info.minor}":
        pytest.skip("the other tests here run with this Python")
    interpreter = _interpreter(version)
    if interpreter is None:
        pytest.skip(f"there is no Python {version} with venv here")
    environment = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"}

    def run(*line: object, folder: Path = tmp_path) -> str:
        done = subprocess.run(
            [*map(str, line)],
            cwd=folder,
            env=environment,
            check=False,
            capture_output=True,
            text=True,
            timeout=600,
        )
        assert done.returncode == 0, done.stdout + done.stderr
        return done.stdout

    run(interpreter, "-m", "venv", "env")
    binaries = tmp_path / "env" / ("Scripts" if sys.platform == "win32" else "bin")
    (wheel,) = site.glob("*.whl")
    run(binaries / "python", "-m", "pip", "install", "-q", "--no-compile", wheel)
    course, mine = binaries / "course", tmp_path / "mine"
    run(course, "start", "mine")
    run(course, "render", "scenes/soft_shadows.yaml", "--size", "60x40", folder=mine)
    shutil.copy(site / "penumbra_course_files" / "solutions" / "thin_lens.py", mine / "assignments")
    assert "40 of 40 points" in run(course, "check", "thin_lens", folder=mine)
