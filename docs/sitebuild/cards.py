"""The modules as cards in the order of the course: what one writes, how long it takes, and what comes before it."""

import re
from html import escape

from course.engine.functions.modules import TAUGHT
from sitebuild import pictures
from sitebuild.objectives import title
from sitebuild.place import Place
from sitebuild.shots import image
from sitebuild.teaching_file import DOCS, minutes, teaching

LEVELS = {100: "short", 149: "medium"}
"""Most minutes of writing, and how a module of so many is called; the others are long."""


def cards(place: Place, name: str = "", words: str = "") -> str:  # noqa: ARG001
    """Show all modules, the warm-up first."""
    shown = "\n".join(_card(place, number, module) for number, module in enumerate(TAUGHT, start=1))
    return f'<ol class="cards">\n{shown}\n</ol>\n'


def _card(place: Place, number: int, module: str) -> str:
    page = (DOCS / "modules" / f"{module}.md").read_text(encoding="utf-8")
    said = re.sub(r"[*`$]", "", page.split("\n\n")[1].replace("\n", " "))
    reading, writing, _ = minutes(module)
    needs = teaching().modules[module].needs
    after = f", after {' and '.join(map(title, needs))}" if needs else ""
    level = next((level for most, level in LEVELS.items() if writing <= most), "long")
    seen = ""
    if pictures.scene_path(module).is_file():
        seen, _ = image(place, pictures.shot(module), f"{title(module)}: the scene of the module")
    name = title(module)
    return (
        f'<li><a href="{place.up}modules/{module}.html">{seen}'
        f"<strong>{number}. {escape(name[0].upper() + name[1:])}</strong>"
        f"<span>{escape(said)}</span>"
        f"<small>{level}: {reading} + {writing} minutes{escape(after)}</small></a></li>"
    )
