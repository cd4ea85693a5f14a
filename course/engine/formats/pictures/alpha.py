"""Whether a picture of codes has pixels that aren't opaque, by a channel, its palette or one colour that is none."""

from typing import TYPE_CHECKING

from course.engine.formats.pictures.mending import strips

if TYPE_CHECKING:
    from PIL.Image import Image


def see_through(image: "Image") -> bool:
    """True if one pixel is not opaque."""
    keyed = "transparency" in image.info
    if not keyed and not {"A", "a"}.intersection(image.getbands()):
        return False
    for rows in strips(image.height, image.width):
        part = image.crop((0, rows.start, image.width, rows.stop))
        # Of a palette, and of one colour, this is what knows them.
        part = part.convert("RGBA") if keyed else part
        least = part.getchannel(len(part.getbands()) - 1).getextrema()[0]
        if isinstance(least, int | float) and least < 255:
            return True
    return False
