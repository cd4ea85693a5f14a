"""Pictures as the site has them: WebP files, whole or not there."""

from functools import cache
from io import BytesIO
from pathlib import Path

from PIL import Image

from course import Picture
from course.base.atomic import replacing

GREY = (128, 128, 128)


def on_screen(rendered: Picture) -> Image.Image:
    """A render as screens show it.

    Raises
    ------
    KeyboardInterrupt
        It was interrupted, so it is not whole.
    """
    if rendered.interrupted:
        raise KeyboardInterrupt
    return Image.fromarray(rendered.settings.display.codes(rendered.shown))


def save(image: Image.Image, path: Path, quality: int, *, lossless: bool = False) -> None:
    """Write a picture; its folder is made where it is not there.

    ``lossless``: as it is, and ``quality`` counts for nothing: there WebP takes it for how hard it tries, and plots
    take a quarter of the time and no more bytes where it tries less.
    """
    path.parent.mkdir(parents=True, exist_ok=True)
    how = {"quality": 50, "method": 2} if lossless else {"quality": quality}
    with replacing(path) as temporary:
        image.save(temporary, "WEBP", lossless=lossless, **how)


def save_blank(path: Path, size: tuple[int, int]) -> Path:
    """Write a grey picture, for builds that must not wait."""
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(_blank(size))
    return path


@cache
def _blank(size: tuple[int, int]) -> bytes:
    """The file of a grey picture: a site has thousands of a few sizes."""
    file = BytesIO()
    Image.new("RGB", size, GREY).save(file, "WEBP")
    return file.getvalue()
