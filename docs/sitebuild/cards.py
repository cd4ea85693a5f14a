"""The modules as cards in the order of the course: what one writes, how long it takes, and what comes before it."""

import re
from html import escape

from PIL import Image

from course.engine.functions.modules import FURTHER, MODULES, TAUGHT, WARM_UP
from sitebuild import pictures, webp
from sitebuild.objectives import title
from sitebuild.place import Place
from sitebuild.shots import tag
from sitebuild.teaching_file import DOCS, minutes, teaching

WIDTH = 480
"""Pixels across: two for each that a card shows."""

LEVELS = {100: "short", 149: "medium"}
"""Most minutes of writing, and how a module of so many is called; the others are long."""


def cards(place: Place, name: str = "", words: str = "") -> str:  # noqa: ARG001
    """Show all modules, the warm-up first."""
    shown = "\n".join(_card(place, number, module) for number, module in enumerate(TAUGHT, start=1))
    return f'<ol class="cards">\n{shown}\n</ol>\n'


def module_pages(place: Place, name: str = "", words: str = "") -> str:  # noqa: ARG001
    """The pages of all modules for the site's contents."""
    further = [module for module in FURTHER if module != WARM_UP]
    parts = {"The warm-up": [WARM_UP], "The six core modules": MODULES, "Further modules": further}
    return "\n\n".join(
        "\n".join(
            ["```{toctree}", ":hidden:", f":caption: {caption}", ""]
            + [f"modules/{module}" for module in modules]
            + ["```"]
        )
        for caption, modules in parts.items()
    )


def _card(place: Place, number: int, module: str) -> str:
    page = (DOCS / "modules" / f"{module}.md").read_text(encoding="utf-8")
    said = re.sub(r"[*`$]", "", page.split("\n\n")[1].replace("\n", " "))
    reading, writing, _ = minutes(module)
    needs = teaching().modules[module].needs
    after = f", after {' and '.join(map(title, needs))}" if needs else ""
    level = next((level for most, level in LEVELS.items() if writing <= most), "long")
    seen = ""
    if pictures.scene_path(module).is_file():
        seen = _small(place, pictures.shot(module), f"{title(module)}: the scene of the module")
    name = title(module)
    return (
        f'<li><a href="{place.up}modules/{module}.html">{seen}'
        f"<strong>{number}. {escape(name[0].upper() + name[1:])}</strong>"
        f"<span>{escape(said)}</span>"
        f"<small>{level}: {reading} + {writing} minutes{escape(after)}</small></a></li>"
    )


def _small(place: Place, planned: pictures.Shot, alternative: str) -> str:
    """A scene's picture in the size of a card: all of them are on one page."""
    width, height = planned.size
    size = WIDTH, round(WIDTH * height / width)
    file = place.made / "cards" / planned.file
    if place.blank:
        webp.save_blank(file, size)
    else:
        large, _ = pictures.picture(planned)
        # It may be on no other page, and is needed for the next build.
        place.kept.add(large)
        with Image.open(large) as whole:
            webp.save(whole.resize(size, Image.Resampling.LANCZOS), file, pictures.QUALITY)
    return tag(place.address(f"_cards/{planned.file}", file), alternative, size)
