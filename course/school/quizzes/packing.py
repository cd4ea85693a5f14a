"""Questions in the files that learning platforms read.

- Canvas: a content package of QTI 1.2, with one quiz a module.
- Moodle: its own XML, with pictures inside, and one category a module.
- Others: a content package of QTI 2.1 items.
- PrairieLearn: one folder a question.

The formats are those of the specifications IMS Question and Test Interoperability 1.2 and 2.1, IMS Content Packaging
1.1, of Moodle's page "Moodle XML format" and PrairieLearn's "Question configuration".
"""

import json
import re
import uuid
from base64 import b64encode
from collections.abc import Iterable, Sequence
from functools import lru_cache
from itertools import groupby
from typing import Any

from jinja2 import Environment, PackageLoader, StrictUndefined
from markupsafe import Markup, escape

from course.school.quizzes.question import LETTERS, Question

_SPACE = uuid.UUID("0c1d5a0e-56ac-4a67-8a0c-6a3cf2c0f7f5")

CANVAS_FILES = "$IMS-CC-FILEBASE$"
"""Stands for the folder of a package's files in what Canvas imports."""

MOODLE_FILES = "@@PLUGINFILE@@"
"""Stands for the files of a question in what Moodle imports."""


def canvas(questions: Sequence[Question]) -> dict[str, bytes]:
    """Path in a QTI 1.2 package -> content; a quiz for each module."""
    quizzes = _by_module(questions)
    files = {
        f"{module}/{module}.xml": _made(
            "qti12.xml", module=module, questions=asked, folder=f"{CANVAS_FILES}/penumbra"
        )
        for module, asked in quizzes.items()
    }
    pictures = _pictures(questions, "penumbra")
    manifest = _made("qti12_manifest.xml", modules=list(quizzes), pictures=list(pictures))
    return {"imsmanifest.xml": manifest} | files | pictures


def qti21(questions: Sequence[Question]) -> dict[str, bytes]:
    """Path in a QTI 2.1 package of items -> content."""
    items = {
        f"items/{each.name}.xml": _made("qti21.xml", question=each, folder="../pictures")
        for each in questions
    }
    pictures = _pictures(questions, "pictures")
    manifest = _made("qti21_manifest.xml", questions=questions, folder="pictures")
    return {"imsmanifest.xml": manifest} | items | pictures


def moodle(questions: Sequence[Question]) -> bytes:
    """A file for Moodle's import of questions; a category for each module."""
    return _made("moodle.xml", modules=_by_module(questions), folder=MOODLE_FILES)


def prairielearn(questions: Iterable[Question]) -> dict[str, bytes]:
    """Path in the folder ``questions`` of a PrairieLearn course -> content."""
    files: dict[str, bytes] = {}
    for each in questions:
        home = f"penumbra/{each.module}/{each.name}"
        info = {
            # The same question keeps its number.
            "uuid": str(uuid.uuid5(_SPACE, each.name)),
            "title": each.title,
            "topic": each.module.replace("_", " "),
            "tags": ["penumbra", each.function],
            "type": "v3",
            "singleVariant": True,
        }
        files[f"{home}/info.json"] = json.dumps(info, indent=2).encode() + b"\n"
        files[f"{home}/question.html"] = _made("prairielearn.html", question=each)
        files |= _pictures([each], f"{home}/clientFilesQuestion")
    return files


def readme(questions: Sequence[Question]) -> bytes:
    """How to import the files, and the right answer of each question; it is for instructors."""
    return _made("README.md", questions=questions)


def file_name(question: Question, number: int) -> str:
    """Of a picture; it tells no answer."""
    return f"{question.name}-{number + 1}.png"


def _pictures(questions: Iterable[Question], folder: str) -> dict[str, bytes]:
    return {
        f"{folder}/{file_name(each, number)}": shown.png
        for each in questions
        for number, shown in enumerate(each.shown)
    }


def _by_module(questions: Sequence[Question]) -> dict[str, list[Question]]:
    ordered = groupby(questions, lambda each: each.module)
    return {module: list(asked) for module, asked in ordered}


def marked(text: str) -> Markup:
    """HTML of a text: escaped, and what stands between backticks as code."""
    return Markup(re.sub(r"`([^`\n]+)`", r"<code>\1</code>", str(escape(text))))


def _made(name: str, **values: Any) -> bytes:
    return (_environment().get_template(f"{name}.jinja").render(values) + "\n").encode()


@lru_cache(maxsize=1)
def _environment() -> Environment:
    environment = Environment(
        loader=PackageLoader("course.school.quizzes"),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    environment.filters["marked"] = marked
    environment.filters["base64"] = lambda content: b64encode(content).decode("ascii")
    # HTML as text inside XML.
    environment.filters["as_text"] = lambda html: escape(str(html).strip())
    environment.globals["file_name"] = file_name
    environment.globals["letters"] = LETTERS
    return environment
