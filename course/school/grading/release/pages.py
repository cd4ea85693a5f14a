"""Pages of the site as plain Markdown: a word stands where the site has a figure."""

import re
from collections.abc import Mapping

KINDS = {
    "convergence": "a plot of error against samples",
    "diagram": "a diagram",
    "heat_map": "a heat map",
    "homage": "a picture without and with it, under a slider",
    "live": "a view with sliders",
    "mistakes": "pictures of these mistakes",
    "pattern_explorer": "a pattern to try",
    "rays": "the rays of one pixel, in 3D",
    "series": "a series of pictures, with a slider",
    "shot": "a picture",
    "walk": "a ray's way through the hierarchy",
}
"""Kind of a part of the site -> what a reader would see there; others are figures."""

_PART = re.compile(r"^<!-- site: (\w+).*?-->$", re.MULTILINE)


def plain_pages(contents: Mapping[str, bytes]) -> dict[str, bytes]:
    """The same files; in pages, which end in .md, what stands for a part of the site tells of it."""
    return {
        name: _PART.sub(_told, content.decode()).encode() if name.endswith(".md") else content
        for name, content in contents.items()
    }


def _told(part: re.Match[str]) -> str:
    return f"*[On the course's site: {KINDS.get(part[1], 'a figure')}.]*"
