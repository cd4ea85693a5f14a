"""A question folder of PrairieLearn that works as it is, and in it the folder that its grader's image is built from."""

from __future__ import annotations

import json
import uuid
from collections.abc import Sequence
from pathlib import Path

from course.grading.classes.image import HOME, IMAGE, image_contents
from course.grading.classes.totals import totals
from course.modules import COURSE

LONGEST = 600
"""Seconds that PrairieLearn lets an external grader take."""

_STARTING, _MODULE = 60, 40
"""Seconds for a container to start, and for a module whose functions all hang, on half a core."""

_SPACE = uuid.UUID("5b6ab9a6-3a65-4c9c-9d09-0fd0c2b5a6d1")

READ_ME = """\
# Penumbra on PrairieLearn

This folder is a question. It and `image/` are not for students: the image holds the solutions and the seed.

1. `docker build -t {image} image`, and push it to where your PrairieLearn pulls images from. `info.json` names the
   image: put your registry before it (`"image": "registry.example.org/you/{image}"`).
2. Copy this folder, without `image/`, to `questions/NAME` of your course, and put NAME into an assessment.

PrairieLearn puts what a student hands in into `/grade/student`, runs `{home}/run` in the image, and reads
`/grade/results/results.json`. The question has no server.py and no tests/: nothing of it is computed on the server.
"""


def question_contents(
    project: Path,
    seed: int,
    modules: Sequence[str],
    title: str = "",
    image: str = IMAGE,
    *,
    trusted: bool = False,
) -> dict[str, bytes]:
    """Path in the question's folder -> content.

    Parameters
    ----------
    project : the course with its solutions
    seed, modules : what to check; the references for them are made now
    title : of the question; from the modules if not given
    image : its name, with the registry
    trusted : whether to grade where the code can't be kept from doing harm, too
    """
    seconds = min(LONGEST, _STARTING + _MODULE * len(modules))
    title = title or f"Penumbra: {', '.join(modules)}"
    info = _info(title, modules, image, seconds)
    contents = {
        "info.json": json.dumps(info, indent=2).encode() + b"\n",
        "question.html": _question(modules).encode(),
        "README.md": READ_ME.format(image=image, home=HOME).encode(),
    }
    # The grader ends before PrairieLearn ends it: what was earned until then counts.
    inside = image_contents(project, seed, modules, seconds - _STARTING / 2, trusted=trusted)
    return contents | {f"image/{name}": content for name, content in inside.items()}


def _info(title: str, modules: Sequence[str], image: str, seconds: int) -> dict[str, object]:
    return {
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


def _question(modules: Sequence[str]) -> str:
    points = totals(modules)
    # Of several files any may still be missing.
    names = "file-names" if len(modules) == 1 else "optional-file-names"
    rows = "\n".join(
        f"    <li><code>{module}.py</code> ({points[module]:g} points): "
        f"{', '.join(f'<code>{name}</code>' for name in COURSE[module])}</li>"
        for module in modules
    )
    files = ", ".join(f"{module}.py" for module in modules)
    return f"""\
<pl-question-panel>
  <p>Write these functions in <code>assignments/</code> of your copy of Penumbra, and hand in the files. What each
    function takes and gives is told in its docstring, the idea behind it in <code>docs/modules/</code>.</p>
  <ul>
{rows}
  </ul>
  <p>Before you hand in, <code>course check</code> makes the same checks with other numbers.</p>
  <pl-file-upload {names}="{files}"></pl-file-upload>
</pl-question-panel>

<pl-submission-panel>
  <pl-external-grader-results></pl-external-grader-results>
  <pl-file-preview></pl-file-preview>
</pl-submission-panel>
"""
