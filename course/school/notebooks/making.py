"""A module's notebook: its task, its functions to write with their checks, its picture, the rays behind it, its noise.

All text about a function is that of the stub. Pictures have few samples, so that running all cells takes seconds.
"""

import ast
import json
import re
from collections.abc import Iterator
from hashlib import sha256
from pathlib import Path
from typing import Any, NamedTuple

from course.engine.formats.yaml.loading import load_description
from course.engine.functions.modules import COURSE
from course.engine.functions.notebook.reachable import first_line
from course.engine.render.adaptive.rounds import ADAPTABLE
from course.engine.scene.scene import SceneSettings, settings_of

WIDTH = 400
"""Columns of a picture at most [pixels]."""

SAMPLES = 16
"""Samples a pixel of a picture, where the scene leaves that open."""

FEWER = {"bounding_volumes": 1}
"""The same where rays are traced by the module's own functions, a hundred times slower."""

_RAYS = re.compile(r"^<!-- site: rays (\w+) (\d+),(\d+) -->", re.MULTILINE)
"""In a module's page: whose rays are shown there."""


class TextPart(NamedTuple):
    """A part of a module's text.

    ``name``: of the function that it is; empty for what stands between them
    """

    text: str
    name: str


def notebook_of(module: str, text: str, project: Path) -> bytes:
    """A notebook of a module.

    Parameters
    ----------
    text : of the stub, or of what was written in it
    project : with ``scenes`` and ``docs``
    """
    title, about = _about(text)
    setup, parts = _parts(module, text)
    page = f"../docs/modules/{module}.md"
    cells = [
        _markdown(
            f"# {module.replace('_', ' ').capitalize()}: {title}\n\n{about}\n\n"
            f"[The module's page]({page}) explains what to write. Run the cells from top to bottom; write in the place "
            "of `TODO` and of the line below it, and run that cell again: its results stand below it. `--hint 2` after "
            "the module's name shows the smallest input that is wrong, `--hint 3` which known mistake it looks like. "
            "`%course status` says what comes next.\n\n"
            "Where the course isn't installed yet, as on Colab, upload its wheel and run this in a cell of its own "
            "first: `%pip install penumbra_course-VERSION-py3-none-any.whl`."
        ),
        _code(f"%load_ext course\n{setup}"),
    ]
    for part in parts:
        if part.name:
            cells.append(_markdown(f"## {part.name}\n\n[What to write]({page}#{part.name})"))
            cells.append(_code(f"%%check {module}\n{part.text}"))
        else:
            cells.append(_code(part.text))
    cells += _pictures(module, project)
    for number, cell in enumerate(cells):
        cell["id"] = sha256(f"{module} {number}".encode()).hexdigest()[:8]
    document = {
        "cells": cells,
        "metadata": {
            "kernelspec": {"display_name": "Python 3", "language": "python", "name": "python3"},
            "language_info": {"name": "python"},
        },
        "nbformat": 4,
        "nbformat_minor": 5,
    }
    return json.dumps(document, indent=1, ensure_ascii=False).encode() + b"\n"


def _pictures(module: str, project: Path) -> Iterator[dict[str, Any]]:
    """Cells that show what the functions do."""
    if module == "radiosity":
        yield _markdown(
            "## The picture\n\nPatches exchange their light by your functions, as they were saved last."
        )
        yield _code(
            "from IPython.display import Image\n\n"
            "%course radiosity ../scenes/radiosity.yaml --patches 1000 --size 300x300 -o radiosity.png\n"
            'Image("radiosity.png")'
        )
        return
    settings = settings_of(load_description(project / "scenes" / f"{module}.yaml"))
    size = _size(settings)
    free = settings.sampler in ADAPTABLE and not (settings.subdivision or settings.denoise)
    samples = FEWER.get(module, SAMPLES)
    spp = f"spp={samples}, " if free else ""
    yield _markdown(
        "## The picture\n\nThe scene without the effect, and with it: `mine` are the functions of this notebook that "
        "are written, and the course's own stand where one isn't. Move the slider."
    )
    yield _code(
        "from course import load_scene, pixel, render\n\n"
        f'before = render(load_scene("before/{module}", effects=mine), {spp}size={size})\n'
        f'after = render(load_scene("{module}", effects=mine), {spp}size={size})\n'
        "before.compare(after)"
    )
    yield _markdown("What it has cost is folded below the picture.")
    yield _code("after")
    if settings.subdivision is None:
        x, y = _pixel(module, project, settings)
        yield _markdown(
            "## The rays\n\nWhy does a pixel have its colour? Turn the view with the mouse; choose a ray to read of it."
        )
        yield _code(f'pixel("{module}", {x}, {y}, spp={samples}, effects=mine)')
    if free:
        yield _markdown("## The noise\n\nHow the error falls with the time that is spent.")
        yield _code(
            "from course import error_over_time\n\n"
            f'error_over_time(load_scene("{module}", effects=mine))'
        )


def _size(settings: SceneSettings) -> tuple[int, int]:
    width = min(WIDTH, settings.width)
    return width, max(round(settings.height * width / settings.width), 1)


def _pixel(module: str, project: Path, settings: SceneSettings) -> tuple[int, int]:
    """The pixel whose rays the module's page shows; where it shows none, the one in the middle."""
    page = (project / "docs" / "modules" / f"{module}.md").read_text(encoding="utf-8")
    shown = next((found for found in _RAYS.finditer(page) if found[1] == module), None)
    return (int(shown[2]), int(shown[3])) if shown else (settings.width // 2, settings.height // 2)


def _about(text: str) -> tuple[str, str]:
    """What the module's docstring says after its name, and the rest of it."""
    first, _, rest = (ast.get_docstring(ast.parse(text)) or "").partition("\n")
    return first.partition(" - ")[2].rstrip("."), rest.strip()


def _parts(module: str, text: str) -> tuple[str, list[TextPart]]:
    """What the functions use, and the functions, each with the comments above it."""
    body = ast.parse(text).body
    lines = text.split("\n")
    uses: list[str] = []
    parts: list[TextPart] = []
    end = 0
    tasks = {*COURSE[module]}
    for number, node in enumerate(body):
        first, last = end, node.end_lineno or first_line(node)
        end = last
        if number == 0 and isinstance(node, ast.Expr):
            continue
        own = "\n".join(lines[first:last]).strip("\n")
        if isinstance(node, ast.FunctionDef) and node.name in tasks:
            parts.append(TextPart(own, node.name))
            continue
        # A constant may be made by a function above it; what is only defined can come first.
        made = not isinstance(node, ast.FunctionDef | ast.ClassDef) and any(
            isinstance(one, ast.Name) and one.id in tasks for one in ast.walk(node)
        )
        if made:
            parts.append(TextPart(own, ""))
        else:
            gap = "\n" if isinstance(node, ast.Import | ast.ImportFrom) else "\n\n\n"
            uses.append(gap + own)
    return "".join(uses).strip("\n"), parts


def _markdown(text: str) -> dict[str, Any]:
    return {"cell_type": "markdown", "id": "", "metadata": {}, "source": _rows(text)}


def _code(text: str) -> dict[str, Any]:
    source = _rows(text)
    return {
        "cell_type": "code",
        "execution_count": None,
        "id": "",
        "metadata": {},
        "outputs": [],
        "source": source,
    }


def _rows(text: str) -> list[str]:
    return text.splitlines(keepends=True)
