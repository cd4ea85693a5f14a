"""The steps of the page on 1984: two of its kept pictures under a slider."""

from html import escape

from PIL import Image

from course.base.errors import CourseError
from course.engine.functions.effects import PROJECT
from sitebuild.place import Place
from sitebuild.shots import slider, tag

KEPT = PROJECT / "docs" / "_static" / "1984"
"""Made by scenes/billiards/make_pictures.py."""


def homage(place: Place, name: str, words: str) -> str:
    """Show the picture without a module and with it.

    Parameters
    ----------
    name : of the picture without it
    words : name of the picture with it, and then what stands below both
    """
    after, _, caption = words.partition(" ")
    left, right = (_image(place, each) for each in (name, after))
    return slider((left, "without"), (right, "with"), escape(caption), large=True)


def _image(place: Place, name: str) -> str:
    path = KEPT / f"{name}.webp"
    if not path.is_file():
        raise CourseError(f"no picture {path}; scenes/billiards/make_pictures.py makes it")
    words = "with nothing written" if name == "nothing" else name.replace("_", " ")
    with Image.open(path) as picture:
        return tag(f"{place.up}_static/1984/{name}.webp", f"The five balls: {words}", picture.size)
