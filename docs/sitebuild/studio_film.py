"""The moving picture of the studio, as ``python -m benchmarks.studio_film`` has recorded it."""

from html import escape

from PIL import Image

from course.engine.functions.effects import PROJECT
from sitebuild.place import Place

FILM = PROJECT / "docs" / "_static" / "studio.webp"

ALT = (
    "The studio's page: with a wrong point_on_sphere the picture differs from the reference in the shadows, and the"
    " function is marked wrong; after the next save nothing differs but noise, and a click shows a pixel's rays."
)


def studio_film(place: Place, _name: str, _words: str) -> str:
    """Show the moving picture."""
    with Image.open(FILM) as film:
        width, height = film.size
    address = place.address("studio/studio.webp", FILM)
    size = f'width="{width}" height="{height}"'
    return f'<img src="{address}" alt="{escape(ALT)}" {size} loading="lazy">\n'
