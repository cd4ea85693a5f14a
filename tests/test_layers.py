"""Imports in course/ run downwards only; read from the source, so that no import can hide."""

import ast
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
COURSE = ROOT / "course"

FLOORS = {
    "course": [
        {"base"},
        {"engine"},
        {"benchmarking", "school"},
        {"__init__"},  # the front door: `from course import render`
        {"cli"},
        {"__main__"},
    ],
    "course.engine": [
        # The whole renderer for the six effects: it imports nothing else of the course.
        {"core"},
        {"casters", "shapes"},
        {"functions"},
        {"terms"},
        {"formats", "loops"},
        {"comparing", "scene"},
        {"render"},
        {"radiosity", "recording"},
    ],
    "course.engine.terms": [
        {"cameras", "samplers", "surfaces", "denoising", "work"},
        {"scattering"},
        {"environments", "lights"},
        {"paths", "shafts", "world"},
        # All others: terms around the integrator, of which plans know no more than that (``Wrap``).
        {"..."},
        {"plan"},
    ],
    "course.school": [{"grading"}, {"notebooks", "quizzes", "studio"}],
}
"""Rooms of the house and of its wings, from the lowest floor on; rooms of one floor know nothing of each other."""

DOOR = {
    "casters": {"choice"},
    "comparing": {"seen", "significance"},
    "core": {"accelerator", "film", "rays", "tiles", "types"},
    "formats": {
        *("pictures.display", "yaml.checking", "yaml.description", "yaml.document", "yaml.loading"),
        *("yaml.schema", "yaml.suggestions", "yaml.tree"),
    },
    "functions": {
        *("contracts", "effects", "modules", "own", "signatures", "sources"),
        *(
            f"notebook.{name}"
            for name in ("cells", "name_effects", "needed", "reachable", "reading")
        ),
    },
    "loops": {"fits", "embree_device"},
    "recording": {"pair", "recording", "stages", "story", "view"},
    "render": {
        *("adaptive.rounds", "background_compile", "binding", "cluster.connection", "developing"),
        *("not_written", "picture", "render", "threads", "which_loops"),
    },
    "scene": {"building.cameras", "building.world", "scene"},
    "shapes": {"__init__"},
    "terms": {"samplers.sobol"},
}
"""What the school takes of the engine, by room."""

CORE_NEEDS = {"numpy", "embreex"}


def modules() -> list[tuple[str, Path]]:
    """Every module of the package by its dotted name."""
    found = []
    for path in sorted(COURSE.rglob("*.py")):
        parts = path.relative_to(ROOT).with_suffix("").parts
        found.append((".".join(parts).removesuffix(".__init__"), path))
    return found


NAMES = {name for name, _ in modules()}


def room(module: str, wing: str) -> str | None:
    """Which room of a wing a module is in: "core" for course.engine.core.rays; None if it is in another wing."""
    if module == wing:
        return "__init__" if "__init__" in floors(wing) else None
    return (
        module.removeprefix(f"{wing}.").partition(".")[0] if module.startswith(f"{wing}.") else None
    )


def floors(wing: str) -> dict[str, int]:
    """The floor of each room; on the one with "..." are those of the wing that no floor names."""
    named = {name: floor for floor, rooms in enumerate(FLOORS[wing]) for name in rooms}
    if (rest := named.pop("...", None)) is None:
        return named
    found = {
        name.removeprefix(f"{wing}.").partition(".")[0]
        for name in NAMES
        if name.startswith(f"{wing}.")
    }
    return named | dict.fromkeys(found - named.keys(), rest)


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
    found = []
    for line, name in imports(source):
        where = f"{module}, line {line}: imports {name}"
        top = name.partition(".")[0]
        in_core = module.startswith("course.engine.core.")
        if top in {"assignments", "solutions"}:
            found.append(f"{where}; the folder of effects is chosen when a scene is loaded")
        elif in_core and top not in {"course", *CORE_NEEDS, *sys.stdlib_module_names}:
            found.append(f"{where}; the core needs NumPy and embreex only")
        elif in_core and top == "course" and not name.startswith("course.engine.core"):
            found.append(f"{where}; the core imports nothing else of the course")
        elif module.startswith("course.school.") and name.startswith("course.engine."):
            inner, _, rest = name.removeprefix("course.engine.").partition(".")
            if (rest or "__init__") not in DOOR.get(inner, ()):
                found.append(f"{where}, which is not of the engine's door")
        for wing in FLOORS:
            here, there = room(module, wing), room(name, wing)
            if here is None or there is None or here == there:
                continue
            low, high = floors(wing)[here], floors(wing)[there]
            if high > low:
                found.append(f"{where}, from {here} on floor {low} up to {there} on floor {high}")
            elif high == low:
                found.append(f"{where}; {here} and {there} stand side by side")
    return found


@pytest.mark.parametrize("wing", FLOORS)
def test_every_file_of_a_wing_has_a_floor(wing: str) -> None:
    found = {room(name, wing) for name in NAMES if name != wing or wing == "course"} - {None}
    assert found == floors(wing).keys()


def test_the_school_takes_all_that_its_door_names() -> None:
    taken = {
        name.removeprefix("course.engine.")
        for module, path in modules()
        if module.startswith("course.school.")
        for _, name in imports(path.read_text(encoding="utf-8"))
    }
    for inner, names in DOOR.items():
        for name in names:
            assert (inner if name == "__init__" else f"{inner}.{name}") in taken


@pytest.mark.parametrize(("module", "path"), modules(), ids=[name for name, _ in modules()])
def test_imports_run_downwards_only(module: str, path: Path) -> None:
    assert not breaches(module, path.read_text(encoding="utf-8"))


def test_one_file_knows_embree() -> None:
    users = {
        module
        for module, path in modules()
        for _, name in imports(path.read_text(encoding="utf-8"))
        if name.partition(".")[0] == "embreex"
    }
    assert users == {"course.engine.core.embree"}


@pytest.mark.parametrize(
    ("module", "source", "told"),
    [
        (
            "course.base.errors",
            "import course.cli.main",
            "from base on floor 0 up to cli on floor 4",
        ),
        (
            "course.engine.terms.plan",
            "def f():\n    from course.engine.render import binding",
            "from terms on floor 3 up to render on floor 6",
        ),
        (
            "course.engine.core.vectors",
            "if TYPE_CHECKING:\n    from course.base.errors import CourseError",
            "line 2: imports course.base.errors; the core imports nothing else",
        ),
        ("course.engine.formats.yaml.loading", "from course import render", "up to __init__"),
        (
            "course.engine.formats.yaml.loading",
            "import_module('course.engine.render.binding')",
            "up to render",
        ),
        (
            "course.engine.loops.fused",
            "import course.engine.formats.meshes.ply",
            "formats stand side by side",
        ),
        ("course.benchmarking.tables", "import course.school.quizzes", "stand side by side"),
        (
            "course.engine.terms.lights.spot_light",
            "import course.engine.terms.paths.bounce",
            "from lights on floor 2 up to paths",
        ),
        (
            "course.school.grading.report",
            "import course.engine.loops.fused",
            "not of the engine's door",
        ),
        (
            "course.engine.functions.effects",
            "import solutions.supersampling",
            "chosen when a scene is loaded",
        ),
        (
            "course.engine.functions.effects",
            "importlib.import_module('solutions')",
            "chosen when a scene is loaded",
        ),
        ("course.engine.core.vectors", "import scipy", "NumPy and embreex only"),
    ],
)
def test_a_breach_is_told(module: str, source: str, told: str) -> None:
    (message,) = breaches(module, source)
    assert told in message


def test_what_is_below_may_be_imported() -> None:
    source = "import math\nimport numpy as np\nfrom course.base.errors import CourseError\nimport trimesh"
    assert not breaches("course.engine.formats.meshes.files", source)
    assert not breaches("course.cli.render", "from course.engine.render.threads import Pool")
    assert not breaches("course.engine.terms.plan", "import course.engine.terms.paths.bounce")
