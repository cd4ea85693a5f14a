"""The rays of a pixel in their scene, as `course pixel --html` writes them."""

from functools import cache
from html import escape

from course import pixel
from course.base.errors import CourseError
from course.engine.recording.view import page
from sitebuild.pictures import scene_path
from sitebuild.place import Place

FEW = 4
"""Samples of a pixel where pictures are left blank."""


def rays(place: Place, name: str, words: str) -> str:
    """Show the rays of a pixel; ``words`` are its column and row, such as "300,300".

    Raises
    ------
    CourseError
        There is no such scene or pixel.
    """
    x, _, y = words.partition(",")
    if not (x.isdigit() and y.isdigit()):
        raise CourseError(f"{words!r} is not a pixel: expected X,Y")
    text, title = _page(name, int(x), int(y), FEW if place.blank else None)
    file = place.made / f"rays-{name.replace('/', '-')}-{x}-{y}.html"
    file.parent.mkdir(parents=True, exist_ok=True)
    file.write_text(text, encoding="utf-8")
    address = place.address(f"rays/{file.name}", file)
    return (
        f'<iframe class="rays" src="{address}" title="The rays of {escape(title)}" loading="lazy">'
        f'</iframe>\n\n<a href="{address}">The view by itself</a>\n'
    )


@cache
def _page(name: str, x: int, y: int, spp: int | None) -> tuple[str, str]:
    story = pixel(scene_path(name), x, y, spp=spp)
    return page(story), story.tree.text
