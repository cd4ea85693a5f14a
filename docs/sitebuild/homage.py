"""The steps of the page on 1984: two of its kept pictures under a slider."""

from html import escape

from PIL import Image

from course.base.errors import CourseError
from course.engine.functions.effects import PROJECT
from sitebuild.place import Place

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
    return f"""<figure class="before-after large">
<div class="pair">
<div class="before">{left}<span>without</span></div>
<div class="after">{right}<span>with</span></div>
</div>
<figcaption>{escape(caption)}</figcaption>
</figure>
"""


def _image(place: Place, name: str) -> str:
    path = KEPT / f"{name}.webp"
    if not path.is_file():
        raise CourseError(f"no picture {path}; scenes/billiards/make_pictures.py makes it")
    with Image.open(path) as picture:
        width, height = picture.size
    words = "with nothing written" if name == "nothing" else name.replace("_", " ")
    return (
        f'<img src="{place.up}_static/1984/{name}.webp" alt="The five balls: {words}" width="{width}"'
        f' height="{height}" loading="lazy">'
    )
