"""What is refused: parts of METU's format that change the picture, and that this course has nothing for.

Parts that nobody knows are left out with a warning; but without these a picture would be a wrong one: parts that are
known, and lights and objects of any name.
"""

import re
from collections.abc import Iterable

from course.base.errors import SceneError

REFUSED = {
    "Lights/*": "this course has no such light",
    "Objects/*": "this course has no such object",
    "Objects/*/Textures": "a Plane and a LightSphere have none here, only meshes, triangles and a Sphere",
    "Transparency": "no material of this course lets light straight through",
}
"""Elements by their names, or by the ends of their paths, in which * is any name; and why they are refused."""

MOST = 20
"""Further ones that are named, each once, however many there are of it."""


def refuse(left_over: Iterable[tuple[str, str]]) -> None:
    """SceneError for the first of the parts that are refused; it names all the others of them by their paths.

    ``left_over``: file and line, and path, of all parts that nobody has asked for.
    """
    found = [(where, path, why) for where, path in left_over if (why := _reason(path)) is not None]
    if not found:
        return
    (where, first, why), *others = found
    paths = list(dict.fromkeys(re.sub(r"\[\d+\]", "", path) for _, path, _ in others))
    more = f"; refused are also: {', '.join(paths[:MOST])}" if others else ""
    raise SceneError(f"{where}: {first} is refused: {why}; remove it to render without it{more}")


def _reason(path: str) -> str | None:
    names = re.sub(r"\[\d+\]", "", path)
    for end, why in REFUSED.items():
        # No comma: behind one is an attribute, or a text.
        if re.search(f"(^|/){re.escape(end).replace(re.escape('*'), '[^/,]+')}$", names):
            return why
    return None
