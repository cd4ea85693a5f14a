"""What `from course import ...` gives, and what it costs."""

import ast
import subprocess
import sys
from importlib.metadata import version
from pathlib import Path

import pytest

import course

PUBLIC = {
    *("CourseError", "EffectError", "GeometryError", "OutputError", "Picture", "Scene"),
    *("SceneError", "Story", "__version__", "error_over_time", "load_scene", "pixel", "render"),
}


def in_a_new_process(code: str) -> None:
    subprocess.run([sys.executable, "-W", "error", "-c", code], check=True)


def test_the_public_names_are_these() -> None:
    assert set(course.__all__) == PUBLIC
    assert set(dir(course)) >= PUBLIC


@pytest.mark.parametrize("name", sorted(PUBLIC))
def test_each_public_name_is_there(name: str) -> None:
    assert getattr(course, name)


def test_another_name_is_not() -> None:
    with pytest.raises(AttributeError, match="no attribute 'raytrace'"):
        _ = course.raytrace


def test_the_version_is_that_of_the_package() -> None:
    assert course.__version__ == version("penumbra-course")


def test_the_package_costs_nothing_until_it_is_used() -> None:
    in_a_new_process("import sys, course; assert not {'numpy', 'click', 'yaml'} & {*sys.modules}")


@pytest.mark.parametrize(
    "first",
    [
        "",
        "import course.engine.render",
        "import course.engine.render.receipt",
        "import course.cli.main",
    ],
)
def test_render_is_a_function_whatever_was_imported_before(first: str) -> None:
    in_a_new_process(f"{first}\nfrom course import load_scene, render\nassert callable(render)")


DESCRIBED = "engine/formats/yaml/description.py"
"""Its classes are named for what they describe, and always written as ``d.PointLight``."""


def test_a_public_class_has_its_name_for_itself() -> None:
    root = Path(course.__file__).parent
    places: dict[str, list[str]] = {}
    for path in root.rglob("*.py"):
        place = path.relative_to(root).as_posix()
        for node in ast.parse(path.read_text(encoding="utf-8")).body:
            if isinstance(node, ast.ClassDef) and node.name[0] != "_" and place != DESCRIBED:
                places.setdefault(node.name, []).append(place)
    assert {name: where for name, where in places.items() if len(where) > 1} == {}
