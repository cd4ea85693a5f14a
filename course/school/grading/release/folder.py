"""What is made for a folder to work in: README, stubs, the schema of scenes, settings of an editor."""

import json
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

from jinja2 import Environment, PackageLoader, StrictUndefined

from course.base.version import __version__
from course.engine.formats.yaml.schema import json_schema
from course.engine.functions.modules import TAUGHT
from course.engine.functions.sources import NOTEBOOK
from course.school.grading.release.stubs import make_stubs

TEMPLATES = {
    "README.md": "README.md",
    ".vscode/tasks.json": "tasks.json",
    ".vscode/settings.json": "settings.json",
    ".vscode/extensions.json": "extensions.json",
    ".devcontainer/devcontainer.json": "devcontainer.json",
}
"""File -> its template."""

OF_A_COPY = {"Makefile": "Makefile", "tests/test_copy.py": "test_copy.py"}
"""In a student's copy, which holds the course itself."""


def from_template(package: str, name: str, values: Mapping[str, Any]) -> bytes:
    """A file of that name from its template in a package; its lines are the template's, without those of blocks."""
    environment = Environment(
        loader=PackageLoader(package),
        undefined=StrictUndefined,
        keep_trailing_newline=True,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    return environment.get_template(f"{name}.jinja").render(values).encode()


def made_contents(
    solutions: Path,
    *,
    copy: bool,
    instructor: bool = False,
    site: bool = False,
    notebooks: Callable[[str, str], bytes] | None = None,
) -> dict[str, bytes]:
    """Path -> content of the files that are made anew for each folder.

    Parameters
    ----------
    copy : true for a student's copy, which holds the course; false for a folder beside an installed course
    instructor : true where the README tells how to grade
    site : true where the built site lies in ``site/``
    notebooks : makes a notebook of a module and its stub, which takes the stub's place; None for programs
    """
    values: dict[str, Any] = {"copy": copy, "instructor": instructor, "site": site}
    values |= {"version": __version__, "modules": TAUGHT, "notebooks": notebooks is not None}
    contents = {
        name: from_template("course.school.grading.release", template, values)
        for name, template in (TEMPLATES | (OF_A_COPY if copy else {})).items()
    }
    stubs = {
        f"assignments/{stub.module}.py": stub.text.encode()
        if notebooks is None
        else notebooks(stub.module, stub.text)
        for stub in make_stubs(solutions)
    }
    if notebooks is not None:
        stubs = {f"{name.removesuffix('.py')}{NOTEBOOK}": text for name, text in stubs.items()}
    schema = json.dumps(json_schema(), indent=2).encode() + b"\n"
    return contents | stubs | {"scenes/scene.schema.json": schema}
