"""The autograder as other systems take it: Gradescope's archive, PrairieLearn's question, a container image's folder.

Gradescope runs ``setup.sh`` once to build an image, and ``run_autograder`` for each submission; ``penumbra/`` holds
the project as far as grading needs it. What goes in is listed, as it is for students.
"""

import json
import uuid
from collections.abc import Sequence
from math import fsum
from pathlib import Path
from typing import Any

from course.engine.functions.modules import COURSE
from course.school.grading.catalog import module_checks, with_whole
from course.school.grading.release.archive import project_files, reference_file
from course.school.grading.release.folder import from_template

FOLDERS = {"course": {".py", ".typed", ".json", ".jinja"}, "solutions": {".py"}}
"""Folders of the project that grading needs, and the kinds of file in them; its scenes are part of the course."""

FILES = ("README.md", "LICENSE", "pyproject.toml")

LEFT_OUT = ("course/benchmarking/", "solutions/right/", "solutions/wrong/")

REFERENCES = "references.npz"
"""Beside the project."""

HOME = "/opt/penumbra-grader"
"""Where the grader lies in the image."""

IMAGE = "penumbra-grader"

LONGEST = 600
"""Seconds that PrairieLearn lets an external grader take."""

_STARTING, _MODULE = 60, 40
"""Seconds for a container to start, and for a module whose functions all hang, on half a core."""

_SPACE = uuid.UUID("5b6ab9a6-3a65-4c9c-9d09-0fd0c2b5a6d1")


def gradescope_contents(
    project: Path, seed: int, modules: Sequence[str], *, trusted: bool = False
) -> dict[str, bytes]:
    """Path in Gradescope's archive -> content.

    Parameters
    ----------
    project : the course with its solutions
    seed, modules : what to check; the references for them are made now
    trusted : whether to grade where the code can't be kept from doing harm, too
    """
    rendered = _renderer(seed, modules, trusted=trusted)
    own = {name: rendered(name) for name in ("setup.sh", "run_autograder")}
    return own | _grader(project, seed, modules)


def image_contents(
    project: Path, seed: int, modules: Sequence[str], seconds: float, *, trusted: bool = False
) -> dict[str, bytes]:
    """Path in the folder that an image is built from -> content.

    Parameters
    ----------
    seconds : that PrairieLearn gives a submission
    project, seed, modules, trusted : as for `gradescope_contents`
    """
    rendered = _renderer(seed, modules, trusted=trusted, image=IMAGE, seconds=f"{seconds:g}")
    own = {"Dockerfile": rendered("Dockerfile"), "run": rendered("run")}
    return own | {"README.md": rendered("image.md")} | _grader(project, seed, modules)


def question_contents(
    project: Path,
    seed: int,
    modules: Sequence[str],
    title: str = "",
    image: str = IMAGE,
    *,
    trusted: bool = False,
) -> dict[str, bytes]:
    """Path in the folder of PrairieLearn's question -> content; the folder of its grader's image is in it.

    Parameters
    ----------
    title : of the question; from the modules if not given
    image : its name, with the registry
    project, seed, modules, trusted : as for `gradescope_contents`
    """
    seconds = min(LONGEST, _STARTING + _MODULE * len(modules))
    title = title or f"Penumbra: {', '.join(modules)}"
    info = {
        # The same question keeps its number, and another one has another.
        "uuid": str(uuid.uuid5(_SPACE, "\n".join([title, *modules]))),
        "title": title,
        "topic": "Ray tracing",
        "tags": ["code", "numpy"],
        "type": "v3",
        "singleVariant": True,
        "gradingMethod": "External",
        "externalGradingOptions": {
            "enabled": True,
            "image": image,
            "entrypoint": f"{HOME}/run",
            "timeout": seconds,
            "enableNetworking": False,
        },
    }
    points = totals(modules)
    rendered = _renderer(
        seed, modules, image=image, functions=COURSE, points=[(one, points[one]) for one in modules]
    )
    # The grader ends before PrairieLearn ends it: what was earned until then counts.
    inside = image_contents(project, seed, modules, seconds - _STARTING / 2, trusted=trusted)
    return {
        "info.json": json.dumps(info, indent=2).encode() + b"\n",
        "question.html": rendered("question.html"),
        "README.md": rendered("question.md"),
        **{f"image/{name}": content for name, content in inside.items()},
    }


def totals(modules: Sequence[str]) -> dict[str, float]:
    """Module -> the points of its checks, that of all modules together among them where it is made."""
    return {
        module: fsum(check.points for check in module_checks(module).checks)
        for module in with_whole(modules)
    }


def _grader(project: Path, seed: int, modules: Sequence[str]) -> dict[str, bytes]:
    """The project as far as grading needs it, and the references."""
    needed = {
        f"penumbra/{name}": content
        for name, content in project_files(project, FILES, FOLDERS).items()
        if not name.startswith(LEFT_OUT)
    }
    return needed | {REFERENCES: reference_file(with_whole(modules), seed)}


def _renderer(seed: int, modules: Sequence[str], *, trusted: bool = False, **values: Any) -> Any:
    """A function that makes a file of its template's name."""
    values |= {"seed": seed, "modules": ",".join(modules), "home": HOME, "references": REFERENCES}
    values["trusted"] = " --trust-submissions" if trusted else ""
    return lambda name: from_template("course.school.grading.classes", name, values)
