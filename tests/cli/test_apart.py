"""Commands in a folder of strangers' files: whatever they are called, none of them runs outside of the sandbox."""

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from course.base.processes import READ_THERE
from course.cli.main import COMMANDS
from tests.cli.signalled import interrupted
from tests.processes import ROOT

SCRIPT = """
import os
from course.cli.main import main
if __name__ == '__main__':
    exec(os.environ['FEWER'])
    main()
"""
"""What an installed `course` begins with: the folder of the script comes first, and not the current one."""

FEWER = {
    "release": "import course.school.grading.release.archive as place\nplace.COURSE = ['thin_lens']",
    "references": "import course.cli.references as place\nplace.COURSE = ['thin_lens']",
    "calibrate": (
        "import course.school.grading.calibration as place\n"
        "usual = place.known\n"
        "place.known = lambda module: usual(module)[:1]"
    ),
    "viva": "import course.cli.viva as place\nplace.QUESTIONS = 1",
}
"""What has a command do once what it does for all modules or many submissions, so that it comes to its end."""

MARK = "import os\nopen(os.environ['MARK'], 'a').write(__name__ + ' ')\n"
"""A file that tells that it was run; the sandbox has no such variable, and writes nothing."""

INSTALLED = (
    "click",
    "yaml",
    "numpy",
    "PIL",
    "numba",
    "embreex",
    "skimage",
    "msgspec",
    "rich",
    "scipy",
)

SCENE = """
camera: {eye: [0, 1, 4], look_at: [0, 0, 0]}
film: {width: 24, height: 16}
materials: {grey: {color: 0.5}}
lights: [{type: point, position: [2, 4, 3], intensity: 100}]
objects: [{shape: box, material: grey}]
"""

CHECK = ("check", "thin_lens", "--folder", "alice", "--only", "point_on_disk")
GRADE = ("grade", "some", "--modules", "thin_lens", "--jobs", "2", "--out", "../graded")

RUNS: dict[str, tuple[str, ...]] = {
    "start": ("start", "../new"),
    "check": CHECK,
    "status": ("status", "--folder", "alice"),
    "studio": ("studio", "a.yaml", "--effects", "alice", "--no-browser"),
    "portfolio": (
        "portfolio",
        "thin_lens",
        "--folder",
        "alice",
        "--scenes",
        "../scenes",
        "-o",
        "../p.html",
    ),
    "docs": ("docs", "soft_shadows", "--no-browser"),
    "render": ("render", "a.yaml", "--effects", "mine", "-o", "../a.png"),
    "pixel": ("pixel", "a.yaml", "12,8", "--html", "../a.html"),
    "view": ("view", "a.yaml", "--no-browser"),
    "radiosity": ("radiosity", "room.yaml", "-o", "../room.npz"),
    "info": ("info", "a.yaml"),
    "convert": ("convert", "a.yaml", "-o", "../b.yaml"),
    "compare": ("compare", "a.yaml", "a.yaml"),
    "schema": ("schema", "-o", "../schema.json"),
    "demo": ("demo", "a.yaml", "--out", "../demo"),
    "bench": ("bench", "sampling"),
    "release": ("release", "--out", "../student.zip"),
    "regrade": ("regrade", "some", "--out", "../graded", "--dry-run"),
    "viva": ("viva", "alice", "--modules", "thin_lens"),
    "quiz": ("quiz", "../quiz", "--modules", "film"),
    "bundle": ("bundle", "gradescope", "--modules", "thin_lens", "--out", "../autograder.zip"),
    "calibrate": ("calibrate", "thin_lens", "--seeds", "1", "--out", "../tolerances.json"),
    "references": ("references", "--seed", "1", "--out", "../references.npz"),
}
"""A run of each command. What it comes to is not the matter here: some end in a refusal."""

WATCHES = {
    "check --watch": (*CHECK, "--watch"),
    "render --watch": (*RUNS["render"], "--watch"),
}

STAYS = {"view", *WATCHES}
"""Commands that have begun all that they do without being asked when they say that Ctrl-C ends them."""

BEGUN = {"studio"}
"""Commands that don't end. All that they import, they have imported, and started what they start, after this."""

SECONDS = 6.0


@pytest.fixture(scope="module")
def strangers(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder of submissions that are called like modules of the standard library, or of what is installed."""
    folder = tmp_path_factory.mktemp("class") / "submissions"
    for inner in ("alice", "some"):
        (folder / inner).mkdir(parents=True)
    for name in (*sys.stdlib_module_names, *INSTALLED):
        (folder / f"{name}.py").write_text(MARK, encoding="utf-8")
    solution = (ROOT / "solutions" / "thin_lens.py").read_text(encoding="utf-8")
    (folder / "alice" / "thin_lens.py").write_text(solution, encoding="utf-8")
    for name in ("struct.py", "socket.py"):
        (folder / "some" / name).write_text(solution, encoding="utf-8")
    (folder / "a.yaml").write_text(SCENE, encoding="utf-8")
    for name in ("thin_lens", "before/thin_lens", "gallery/1984"):
        scene = folder.parent / "scenes" / f"{name}.yaml"
        scene.parent.mkdir(parents=True, exist_ok=True)
        scene.write_text(SCENE, encoding="utf-8")
    (folder.parent / "course").write_text(SCRIPT, encoding="utf-8")
    return folder


def environment(folder: Path, fewer: str = "") -> dict[str, str]:
    """Nothing that would keep Python from looking into the current folder; where a file that runs says so."""
    plain = {key: value for key, value in os.environ.items() if not key.startswith("PYTHON")}
    return plain | {
        "PYTHONPATH": str(ROOT),
        "MARK": str(folder.parent / "mark"),
        "FEWER": fewer,
    }


def ran(folder: Path, command: list[str], name: str = "") -> str:
    """What was run of the folder's files by a command that began there; ``name``: of one that stays or takes long."""
    mark = folder.parent / "mark"
    mark.unlink(missing_ok=True)
    with subprocess.Popen(
        [sys.executable, *command],
        cwd=folder,
        env=environment(folder, FEWER.get(name, "")),
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
    ) as process:
        if name in STAYS:
            assert process.stdout is not None
            assert any("Ctrl-C ends it" in line for line in process.stdout)
            interrupted(process)
        else:
            try:
                process.communicate(timeout=SECONDS if name in BEGUN else 300)
            except subprocess.TimeoutExpired:
                assert name in BEGUN
                interrupted(process)
    if name in FEWER:
        assert process.returncode == 0
    return mark.read_text() if mark.exists() else ""


def test_each_command_has_a_run() -> None:
    assert {*RUNS, "grade"} == set(COMMANDS)


@pytest.mark.parametrize("name", [*RUNS, *WATCHES])
def test_a_command_runs_no_file_of_the_current_folder(name: str, strangers: Path) -> None:
    command = [str(strangers.parent / "course"), *(RUNS | WATCHES)[name]]
    assert ran(strangers, command, name) == ""


@pytest.mark.parametrize("arguments", [CHECK, GRADE], ids=["check", "grade"])
def test_a_module_run_imports_no_file_of_the_current_folder(
    arguments: tuple[str, ...], strangers: Path, tmp_path: Path
) -> None:
    # Python itself imports some before the course is there: -m needs them.
    needs = "import runpy, importlib.util, sys; print(*{name.partition('.')[0] for name in sys.modules})"
    early = subprocess.run(
        [sys.executable, "-Xfrozen_modules=off", "-c", needs],
        capture_output=True,
        text=True,
        check=True,
    )
    folder = tmp_path / "submissions"
    shutil.copytree(
        strangers,
        folder,
        ignore=lambda _, names: {n for n in names if Path(n).stem in early.stdout.split()},
    )
    assert (folder / "struct.py").exists()
    assert (folder / "multiprocessing.py").exists()
    assert ran(folder, ["-m", "course", *arguments]) == ""


def test_a_class_is_graded_there(strangers: Path) -> None:
    assert ran(strangers, [str(strangers.parent / "course"), *GRADE]) == ""
    grades = (strangers.parent / "graded" / "grades.csv").read_text(encoding="utf-8")
    assert grades.count("40") >= 2


@pytest.mark.parametrize("name", READ_THERE)
def test_a_file_that_a_library_would_obey_is_told(name: str, tmp_path: Path) -> None:
    (tmp_path / name).write_text("", encoding="utf-8")
    done = subprocess.run(
        [sys.executable, "-m", "course", "status"],
        cwd=tmp_path,
        env=environment(tmp_path),
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 1
    assert done.stderr.startswith(f"error: {name}: ")
    assert "rename" in done.stderr
