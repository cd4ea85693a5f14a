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

_PART = re.compile(r"^<!-- site: (\w+) ?([\w./]*) ?(.*?) ?-->$", re.MULTILINE)


def plain_pages(contents: Mapping[str, bytes]) -> dict[str, bytes]:
    """The same files; in pages, which end in .md, what stands for a part of the site tells of it.

    Where a command makes the same of a scene that is among the files, that is told instead.
    """

    def told(part: re.Match[str]) -> str:
        kind, name, words = part.groups()
        scene = f"scenes/{name}.yaml"
        if kind in _MADE_BY and scene in contents:
            what, command = _MADE_BY[kind]
            return f"*[{what}: `{command.format(scene=scene, words=words)}`]*"
        return f"*[On the course's site: {KINDS.get(kind, 'a figure')}.]*"

    return {
        name: _PART.sub(told, content.decode()).encode() if name.endswith(".md") else content
        for name, content in contents.items()
    }


_MADE_BY = {
    "rays": ("The rays of one pixel, in 3D", "course pixel {scene} {words} --html rays.html"),
    "before_after": ("A picture of it", "course render {scene} -o after.png"),
    "picture": ("A picture", "course render {scene}"),
    "shot": ("A picture", "course render {scene}"),
}
"""Kind of a part -> what it shows, and the command that makes it."""
