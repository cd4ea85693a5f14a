"""The command as a process: what it imports, how it ends, what it leaves behind."""

import contextlib
import json
import os
import shutil
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from course.base.processes import environment_apart
from course.cli.main import COMMANDS
from course.engine.formats.pictures.reading import read_picture
from course.engine.functions.effects import PROJECT
from tests.cli.conftest import Run
from tests.cli.signalled import interrupted, started
from tests.cli.stand_in import RECEIPT
from tests.forms import needs_numba
from tests.processes import ROOT, python

HEAVY = {"scipy", "skimage", "trimesh", "psutil", "OpenImageIO", "rich", "networkx", "solutions"}
"""What rendering one small scene to a PNG has no use for."""

SCENE = """
camera: {eye: [0, 1, 4], look_at: [0, 0, 0]}
film: {width: 24, height: 16}
materials: {grey: {color: 0.5}}
lights: [{type: point, position: [2, 4, 3], intensity: 100}]
objects: [{shape: box, material: grey}]
"""


@pytest.fixture
def scene(tmp_path: Path) -> Path:
    """A box and a light."""
    path = tmp_path / "box.yaml"
    path.write_text(SCENE, encoding="utf-8")
    return path


def course(folder: Path, *arguments: str) -> subprocess.CompletedProcess[str]:
    """Run `python -m course` in a folder; warnings are errors there too."""
    command = [sys.executable, "-W", "error", "-m", "course", *arguments]
    return subprocess.run(
        command, cwd=folder, capture_output=True, text=True, encoding="utf-8", check=False
    )


def imported_by(folder: Path, *lines: str) -> set[str]:
    """Top-level names of the modules that a process has imported in which these commands were run."""
    code = (
        "import json, sys\n"
        "from course.cli.main import commands\n"
        "for line in sys.argv[1:]:\n"
        "    commands(line.split(), standalone_mode=False)\n"
        "json.dump(sorted(sys.modules), open('modules.json', 'w'))\n"
    )
    subprocess.run([sys.executable, "-c", code, *lines], cwd=folder, check=True)
    return {name.partition(".")[0] for name in json.loads((folder / "modules.json").read_text())}


def test_help_needs_no_arrays(tmp_path: Path) -> None:
    names = imported_by(tmp_path, "--help", "render --help", "info --help", "demo --help")
    assert "click" in names
    assert not names & (HEAVY | {"numpy", "yaml", "msgspec", "PIL", "embreex"})


def test_a_small_render_imports_only_what_it_uses(tmp_path: Path, scene: Path) -> None:
    names = imported_by(tmp_path, f"render {scene.name}")
    assert {"numpy", "embreex"} <= names
    assert not names & HEAVY


def test_a_module_run_is_the_command(tmp_path: Path) -> None:
    done = course(tmp_path, "--version")
    assert (done.returncode, done.stderr) == (0, "")
    assert done.stdout.startswith("course, version 0.")


def test_a_folder_that_is_gone_is_told(run: Run, tmp_path: Path) -> None:
    tmp_path.rmdir()
    result = run("status")
    assert result.exit_code == 1
    assert result.stderr.startswith("error: the current folder is gone")
    assert result.stderr.count("\n") == 1


@pytest.mark.skipif(os.name != "posix", reason="a shell of Unix closes streams")
def test_streams_that_are_closed_are_nobodys(tmp_path: Path) -> None:
    # As a service may be started. Pipes of workers had had the numbers of standard streams.
    shutil.copytree(PROJECT / "solutions", tmp_path / "assignments")
    check = f"exec '{sys.executable}' -m course check motion_blur --only displacement"
    subprocess.run(["sh", "-c", f"{check} <&- >&- 2>&-"], cwd=tmp_path, check=True)


def test_a_process_apart_imports_nothing_of_the_current_folder(tmp_path: Path) -> None:
    (tmp_path / "random.py").write_text("raise SystemExit(1)", encoding="utf-8")
    for program in (["-c", "import random, course"], ["-m", "random"]):
        subprocess.run(
            [sys.executable, *program],
            cwd=tmp_path,
            env=environment_apart(),
            check=True,
            stdout=subprocess.DEVNULL,
        )


def test_a_scene_becomes_a_png_and_an_exr_of_its_size(tmp_path: Path, scene: Path) -> None:
    done = course(tmp_path, "render", scene.name)
    assert (done.returncode, done.stderr) == (0, "")
    with Image.open(tmp_path / "box.png") as image:
        assert image.size == (24, 16)
        assert np.asarray(image).max() > 0
    done = course(tmp_path, "render", scene.name, "-o", "a.exr", "--size", "8x6", "--spp", "4")
    assert (done.returncode, done.stderr) == (0, "")
    pixels = read_picture(tmp_path / "a.exr")
    assert pixels.shape == (6, 8, 3)
    assert np.isfinite(pixels).all()


def test_a_scene_without_light_says_so_on_one_line_and_is_rendered(
    tmp_path: Path, scene: Path
) -> None:
    scene.write_text(SCENE.replace("lights:", "lights: [] #"), encoding="utf-8")
    done = course(tmp_path, "render", scene.name)
    assert done.returncode == 0
    assert done.stderr.startswith("warning: box.yaml: the picture will be black: the scene has no ")
    assert done.stderr.count("\n") == 1
    assert (tmp_path / "box.png").exists()


def test_a_receipt_has_its_keys(tmp_path: Path, scene: Path) -> None:
    done = course(tmp_path, "render", scene.name, "--receipt", "cost.json", "--seed", "5")
    assert done.returncode == 0
    receipt = json.loads((tmp_path / "cost.json").read_text())
    assert set(receipt) == set(RECEIPT)
    assert set(receipt["rays"]) == set(RECEIPT["rays"])
    assert receipt["rays"]["camera"] == 24 * 16 * 16
    assert (receipt["pixels"], receipt["samples"], receipt["seed"]) == (24 * 16, 16, 5)


@pytest.mark.parametrize(
    ("text", "told"),
    [
        (None, "box.yaml"),
        ("", "box.yaml"),
        ("{", "box.yaml"),
        (SCENE.replace("width: 24", "width: -1"), "film.width"),
        (SCENE.replace("look_at", "look_att"), "did you mean look_at"),
        (SCENE.replace("[0, 1, 4]", "[0, .nan, 4]"), "camera.eye"),
        (SCENE.replace("[0, 1, 4]", "[0, 0, 0]"), "camera"),
        (SCENE.replace("[0, 1, 4]", "!!python/object/apply:os.getcwd []"), "box.yaml"),
    ],
)
def test_a_bad_scene_is_refused_without_traceback_or_file(
    run: Run, tmp_path: Path, text: str | None, told: str
) -> None:
    path = tmp_path / "box.yaml"
    if text is not None:
        path.write_text(text, encoding="utf-8")
    before = set(tmp_path.iterdir())
    done = run("render", "box.yaml")
    assert done.exit_code == 1
    # Any other exception would print a traceback.
    assert isinstance(done.exception, SystemExit)
    assert done.stderr.startswith("error: ")
    assert told in done.stderr
    assert set(tmp_path.iterdir()) == before


def interrupted_after(seconds: float, folder: Path, *arguments: str) -> tuple[int, str]:
    """Exit code and stderr of a run that gets Ctrl-C so many seconds after its start."""
    with started(folder, *arguments, stderr=subprocess.PIPE) as process:
        try:
            with contextlib.suppress(subprocess.TimeoutExpired):
                process.wait(seconds)
            return interrupted(process)
        finally:
            process.kill()


@pytest.mark.parametrize("code", [0, 1, "told", None])
def test_the_program_ends_at_once_but_closes_what_is_open(tmp_path: Path, code: object) -> None:
    """Modules are not taken apart, output is complete, and functions for the end of the program are called."""
    program = (
        "import atexit, sys, threading\n"
        "from pathlib import Path\n"
        "from course.cli import main\n"
        "class Module:\n"
        "    def __del__(self): print('taken apart')\n"
        "module = Module()\n"
        "atexit.register(lambda: print('closed'))\n"
        f"main.commands = lambda **_: sys.exit({code!r})\n"
        "main.main()\n"
    )
    done = python("-c", program, folder=tmp_path, may_fail=True)
    assert done.returncode == (1 if code == "told" else code or 0)
    assert done.stdout == ("closed\ntaken apart\n" if code == "told" else "closed\n")


@needs_numba
def test_a_large_render_reads_its_loops_while_the_scene_is_built(
    tmp_path: Path, scene: Path
) -> None:
    """And what only a compiler needs of Numba, SciPy's BLAS with it, when something is compiled."""
    program = (
        "import sys\n"
        "from threading import current_thread, main_thread\n"
        "from course.engine.render import which_loops\n"
        "from course.cli.main import commands\n"
        "from course.engine.render import reading_ahead\n"
        "read = []\n"
        "def noting(work=reading_ahead._read_loops):\n"
        "    read.append(current_thread() is main_thread())\n"
        "    work()\n"
        "reading_ahead._read_loops = noting\n"
        "which_loops.WORTH_COMPILED, which_loops.WORTH_READING = map(int, sys.argv[1:3])\n"
        "commands(sys.argv[3:], standalone_mode=False)\n"
        "print(read, 'numba' in sys.modules, 'numba.np.arraymath' in sys.modules)\n"
        "if read:\n"
        "    import numba, numpy\n"
        "    print(numba.njit(lambda a, b: a @ b)(numpy.eye(2), numpy.ones((2, 2))).sum())\n"
    )
    environment = {key: os.environ[key] for key in os.environ if key != "COURSE_NO_COMPILER"}
    everything = "[False] True False"
    for pixels, options, said in (
        (384, (), everything),
        (384, ("--error", "0.1"), everything),
        (385, ("--error", "0.1"), "[] "),
        (384, ("--error", "0.1", "--time-limit", "9"), "[] "),
    ):
        line = ("-c", program, 384, pixels, "render", scene.name, *options)
        done = python(*line, folder=tmp_path, environment=environment)
        lines = done.stdout.splitlines()
        if said == everything:
            assert lines.pop() == "4.0"
        assert lines[-1].startswith(said)


def test_a_numba_that_refuses_this_numpy_is_done_without(tmp_path: Path, scene: Path) -> None:
    refusing = tmp_path / "packages" / "numba"
    refusing.mkdir(parents=True)
    (refusing / "__init__.py").write_text("raise ImportError('Numba needs an older NumPy')\n")
    program = (
        "import sys\n"
        "from course.engine.render import which_loops\n"
        "from course.cli.main import commands\n"
        "which_loops.WORTH_COMPILED = which_loops.WORTH_READING = 1\n"
        "commands(sys.argv[1:], standalone_mode=False)\n"
    )
    environment = {key: os.environ[key] for key in os.environ if key != "COURSE_NO_COMPILER"}
    path = os.pathsep.join([str(refusing.parent), str(ROOT)])
    line = ("-c", program, "render", scene.name)
    done = python(*line, folder=tmp_path, environment=environment, path=path)
    assert not done.stderr
    assert (tmp_path / "box.png").exists()


@pytest.mark.skipif(sys.platform == "win32", reason="no SIGINT to send to another process")
def test_ctrl_c_writes_a_partial_picture_and_says_so(tmp_path: Path, scene: Path) -> None:
    hours = ["--spp", "65536", "--size", "640x480", "--threads", "2"]
    for seconds in (1.0, 4.0, 16.0):  # on a slow machine the first may come before the first ray
        status, said = interrupted_after(seconds, tmp_path, "render", scene.name, *hours)
        if (tmp_path / "box.partial.png").exists():
            break
    assert status == 130
    assert "box.partial.png" in said
    assert {path.name for path in tmp_path.iterdir()} == {"box.yaml", "box.partial.png"}
    with Image.open(tmp_path / "box.partial.png") as image:
        assert image.size == (640, 480)


def test_commands_are_listed_whole_and_by_what_they_are_for(run: Run) -> None:
    said = run("--help").stdout
    assert said.index("\nLearn:") < said.index("\n  start ") < said.index("\nRender:")
    assert said.index("\nTeach:") < said.index("\n  grade ")
    assert all(f"\n  {name} " in said for name in COMMANDS)
    assert "..." not in said.partition("\nLearn:")[2]


def test_a_command_that_is_misspelt_is_told_with_the_one_that_is_meant(run: Run) -> None:
    near, far = run("chek"), run("frobnicate")
    assert near.exit_code == far.exit_code == 2
    assert near.stderr.endswith("No such command 'chek'. Did you mean check?\n")
    assert far.stderr.endswith("No such command 'frobnicate'.\n")


def test_modules_without_their_option_are_told_which_it_is(run: Run) -> None:
    assert run("quiz", "out", "glossy").stderr.endswith(
        "(glossy). Modules are given by --modules.\n"
    )
    assert run("schema", "glossy").stderr.endswith("(glossy)\n")
