"""The command as a process: what it imports, how it ends, what it leaves behind."""

import contextlib
import json
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from course.cli.main import COMMANDS
from course.formats.pictures.reading import read_picture
from tests.cli.conftest import Run
from tests.cli.signalled import interrupted, started
from tests.cli.stand_in import RECEIPT

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
