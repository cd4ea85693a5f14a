"""The core can be read: its size, whom it imports, and where it calls the functions of the course."""

import ast
import json
import re
from pathlib import Path

import pytest

from course.engine.functions.modules import MODULES
from tests.code_lines import code_lines
from tests.processes import python

ROOT = Path(__file__).parents[1]
COURSE = ROOT / "course"
CORE = COURSE / "engine" / "core"

FILES = sorted(CORE.rglob("*.py"))
MOST_FILES, MOST_LINES, LONGEST_FUNCTION = 32, 1829, 60
"""Lines are those that carry code. To raise this, say in the commit what a user gets for it."""

FROM_RAY_TO_COLOUR = (
    *("tracer", "integrator", "camera", "hits", "direct"),
    *("lights/sample", "lights/sphere", "blinn_phong", "materials", "scatter"),
)
MOST_LINES_TO_COLOUR = 900
"""What is to be read to understand how one camera ray becomes a colour."""

UNUSED = {
    "glossy.orthonormal_basis",
    "thin_lens.image_distance",
    "thin_lens.circle_of_confusion",
    "cube_map.face_and_uv",
}
"""What the other functions of a module call, or nobody but the checks."""

RUN = """
import json, sys, threading
files = set()
def note(frame, event, argument):
    if event == "call" and frame.f_code.co_name != "<module>":
        files.add(frame.f_code.co_filename)
from course import load_scene, render
from course.engine.render import threads
# Of a render that takes longer it asks whether a function never comes back.
threads.LOOK = 600
scene = load_scene("scenes/soft_shadows.yaml")
sys.setprofile(note)
threading.setprofile(note)
render(scene, spp=4, size=(60, 40), threads=1, compiled=False)
sys.setprofile(None)
print(json.dumps(sorted(files)))
"""


def _lines(path: Path) -> list[str]:
    return path.read_text(encoding="utf-8").splitlines()


def test_the_core_is_small_enough_to_be_read() -> None:
    assert len(FILES) <= MOST_FILES
    assert sum(code_lines(path.read_text(encoding="utf-8")) for path in FILES) <= MOST_LINES


def test_from_a_camera_ray_to_a_colour_little_is_to_be_read() -> None:
    """Every other file of the core is a tool or has one effect: a name says enough to read on."""
    paths = [CORE / f"{name}.py" for name in FROM_RAY_TO_COLOUR]
    assert (
        sum(code_lines(path.read_text(encoding="utf-8")) for path in paths) <= MOST_LINES_TO_COLOUR
    )
    assert len(paths) <= 10
    assert (
        tuple(re.findall(r"`([a-z_/]+)\.py`", _paragraph("From a camera ray to its colour")))
        == FROM_RAY_TO_COLOUR
    )


def _paragraph(begins: str) -> str:
    (found,) = (
        text
        for text in (ROOT / "docs" / "architecture.md").read_text("utf-8").split("\n\n")
        if text.startswith(begins)
    )
    return found


def test_the_readme_says_how_long_the_core_is() -> None:
    lines = sum(len(_lines(path)) for path in FILES)
    told = re.search(
        r"`course/engine/core`, ([\d,]+) lines", (ROOT / "README.md").read_text("utf-8")
    )
    assert told is not None
    assert abs(int(told[1].replace(",", "")) - lines) <= 50


@pytest.mark.parametrize("path", FILES, ids=lambda path: path.relative_to(CORE).as_posix())
def test_functions_of_the_core_are_short(path: Path) -> None:
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.FunctionDef):
            assert node.end_lineno is not None
            assert node.end_lineno - node.lineno < LONGEST_FUNCTION, node.name


@pytest.mark.parametrize(
    "function",
    sorted({f"{module}.{name}" for module in MODULES for name in MODULES[module]} - UNUSED),
)
def test_a_function_of_the_course_is_called_by_its_own_name_on_one_line(function: str) -> None:
    called = [
        path
        for path in COURSE.rglob("*.py")
        if "grading" not in path.relative_to(COURSE).parts
        for line in _lines(path)
        if re.search(rf"(?<![a-z]){re.escape(function)}\(", line)
    ]
    assert len(called) == 1


def test_one_picture_runs_few_files() -> None:
    done = python("-c", RUN)
    files = [file for file in json.loads(done.stdout) if Path(file).is_relative_to(COURSE)]
    assert CORE / "lights" / "sphere.py" in map(Path, files)
    assert len(files) <= 43
