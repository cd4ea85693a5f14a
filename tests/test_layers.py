"""Imports in course/ run downwards only; read from the source, so that no import can hide."""

import ast
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
COURSE = ROOT / "course"

LAYERS = {
    # The whole renderer for the six effects: it imports nothing else of the course.
    "core": 0,
    "casters": 1,
    "errors": 1,
    "contracts": 1,
    "signatures": 1,
    "guard": 1,
    "effects": 1,
    "inputs": 1,
    "modules": 1,
    "processes": 1,
    "stand_ins": 1,
    "texts": 1,
    "atomic": 1,
    "extras": 2,
    "shapes": 2,
    "compiled": 3,
    "formats": 3,
    "building": 4,
    "comparing": 4,
    "scene": 5,
    "jobs": 6,
    "adaptive": 7,
    "rendering": 8,
    "cluster": 9,
    "radiosity": 9,
    "recording": 9,
    "render_scene": 10,
    "benchmarking": 11,
    "grading": 11,
    "quizzes": 12,
    "studio": 12,
    "cli": 13,
    # The front door: `from course import render`, and `python -m course`.
    "__init__": 13,
    "__main__": 13,
}
STRANGERS = {
    frozenset({"compiled", "formats"}),
    frozenset({"cluster", "radiosity"}),
    frozenset({"cluster", "recording"}),
    frozenset({"radiosity", "recording"}),
    frozenset({"benchmarking", "grading"}),
    frozenset({"quizzes", "studio"}),
}
"""Neighbours on one layer that know nothing of each other."""


CORE_NEEDS = {"numpy", "embreex"}


def modules() -> list[tuple[str, Path]]:
    """Every module of the package by its dotted name."""
    found = []
    for path in sorted(COURSE.rglob("*.py")):
        parts = path.relative_to(ROOT).with_suffix("").parts
        found.append((".".join(parts).removesuffix(".__init__"), path))
    return found


NAMES = {name for name, _ in modules()}


def part(module: str) -> str:
    """Where in the house a module is: "geometry" for course.core.triangles."""
    _, _, rest = module.partition(".")
    return rest.partition(".")[0] or "__init__"


def imports(source: str) -> Iterator[tuple[int, str]]:
    """Line and dotted name of each import, those in functions and under TYPE_CHECKING too."""
    for node in ast.walk(ast.parse(source)):
        if isinstance(node, ast.Import):
            for alias in node.names:
                yield node.lineno, alias.name
        elif isinstance(node, ast.ImportFrom):
            assert node.level == 0, f"line {node.lineno}: a relative import"
            for alias in node.names:
                inner = f"{node.module}.{alias.name}"
                if inner == "course.__version__":
                    continue  # a constant, there before anything else of the package
                yield node.lineno, inner if inner in NAMES else str(node.module)
        elif (
            isinstance(node, ast.Call)
            and isinstance(node.func, ast.Name | ast.Attribute)
            and (node.func.id if isinstance(node.func, ast.Name) else node.func.attr)
            in {"import_module", "__import__"}
            and node.args
            and isinstance(node.args[0], ast.Constant)
        ):
            yield node.lineno, str(node.args[0].value)


def breaches(module: str, source: str) -> list[str]:
    """What a module imports though it must not."""
    here = part(module)
    found = []
    for line, name in imports(source):
        where = f"{module}, line {line}: imports {name}"
        top = name.partition(".")[0]
        if top in {"assignments", "solutions"}:
            found.append(f"{where}; the folder of effects is chosen when a scene is loaded")
        elif top == "course":
            there = part(name)
            if LAYERS[there] > LAYERS[here]:
                found.append(f"{where}, from layer {LAYERS[here]} up to layer {LAYERS[there]}")
            elif frozenset({here, there}) in STRANGERS:
                found.append(f"{where}; {here} and {there} stand side by side")
        elif here == "core" and top not in CORE_NEEDS and top not in sys.stdlib_module_names:
            found.append(f"{where}; the core needs NumPy and embreex only")
    return found


def test_every_file_of_the_course_has_a_layer() -> None:
    assert {part(name) for name in NAMES} <= LAYERS.keys()


@pytest.mark.parametrize(("module", "path"), modules(), ids=[name for name, _ in modules()])
def test_imports_run_downwards_only(module: str, path: Path) -> None:
    assert not breaches(module, path.read_text(encoding="utf-8"))


def test_parts_never_import_each_other_in_a_circle() -> None:
    uses: dict[str, set[str]] = {name: set() for name in LAYERS}
    for module, path in modules():
        for _, name in imports(path.read_text(encoding="utf-8")):
            if name.partition(".")[0] == "course" and part(name) != part(module):
                uses[part(module)].add(part(name))
    for name, used in uses.items():
        assert not [other for other in used if name in uses[other]]


def test_one_file_knows_embree() -> None:
    users = {
        module
        for module, path in modules()
        for _, name in imports(path.read_text(encoding="utf-8"))
        if name.partition(".")[0] == "embreex"
    }
    assert users == {"course.core.embree"}


@pytest.mark.parametrize(
    ("module", "source", "told"),
    [
        (
            "course.formats.meshes.transforms",
            "import course.cli.main",
            "from layer 3 up to layer 13",
        ),
        (
            "course.formats.meshes.transforms",
            "def f():\n    from course.rendering import binding",
            "up to layer 8",
        ),
        (
            "course.core.vectors",
            "if TYPE_CHECKING:\n    from course.errors import CourseError",
            "line 2: imports course.errors, from layer 0 up to layer 1",
        ),
        ("course.formats.yaml.loading", "from course import render", "up to layer"),
        (
            "course.formats.yaml.loading",
            "import_module('course.rendering.binding')",
            "up to layer 8",
        ),
        ("course.compiled.fused", "import course.formats.meshes.ply", "stand side by side"),
        ("course.effects", "import solutions.supersampling", "chosen when a scene is loaded"),
        ("course.effects", "importlib.import_module('solutions')", "chosen when a scene is loaded"),
        ("course.core.vectors", "import scipy", "NumPy and embreex only"),
    ],
)
def test_a_breach_is_told(module: str, source: str, told: str) -> None:
    (message,) = breaches(module, source)
    assert told in message


def test_what_is_below_may_be_imported() -> None:
    source = (
        "import math\nimport numpy as np\nfrom course.errors import CourseError\nimport trimesh"
    )
    assert not breaches("course.formats.meshes.files", source)
    assert not breaches("course.cli.render", "from course.rendering.threads import Pool")
    assert not breaches("course.jobs.receipt", "from course import __version__")
