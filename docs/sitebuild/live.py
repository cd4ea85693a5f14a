"""Pictures that the page computes itself, by _static/live.js."""

import re
from pathlib import Path

from course.base.errors import CourseError
from sitebuild.place import Place

SCRIPT = Path(__file__).parents[1] / "_static" / "live.js"


def live(place: Place, name: str, words: str = "") -> str:  # noqa: ARG001
    """Have a view of the script shown where it can be; elsewhere nothing is.

    Raises
    ------
    CourseError
        The script has no such view.
    """
    text = SCRIPT.read_text(encoding="utf-8").partition("const VIEWS = {")[2].partition("\n  };")[0]
    known = re.findall(r"^    (\w+): \{", text, re.MULTILINE)
    if name not in known:
        raise CourseError(f"live.js has no view {name}; it has {', '.join(known)}")
    return f'<figure class="computed" data-view="{name}" hidden></figure>\n'
