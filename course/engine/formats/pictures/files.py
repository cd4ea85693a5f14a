"""Picture files: PNG for looking (sRGB, 8 bit), OpenEXR for measuring (linear, 32-bit float).

Pillow and OpenImageIO are imported where they are used: a render that writes a PNG never loads
OpenImageIO, one that fails loads neither.
"""

import io
from pathlib import Path
from typing import BinaryIO

import numpy as np
from numpy.typing import NDArray

from course.base.atomic import check_writable, replacing
from course.base.errors import OutputError
from course.engine.formats.pictures.display import SRGB, Display

SUFFIXES = (".png", ".exr")

COMPRESS_LEVEL = 4
"""zlib level of a PNG: half the time of level 6 on a noisy picture, at the same size."""


def save(path: Path, linear: NDArray[np.float32], display: Display = SRGB) -> None:
    """Write a picture in the format that the file's suffix names.

    Raises OutputError: the suffix is not known, or the file can't be written. Then nothing is.

    Parameters
    ----------
    path : ends in .png or .exr, in upper or lower case
    linear : (3, H, W) float32, linear RGB
    display : how a PNG shows it; other formats hold the values themselves
    """
    if _suffix(path) == ".png":
        write_png(path, linear, display)
    else:
        write_exr(path, linear)


def check_picture_path(path: Path) -> None:
    """Find out before rendering whether `save` can write to `path`.

    Raises OutputError as `save` would.
    """
    _suffix(path)
    check_writable(path)


def write_png(path: Path, linear: NDArray[np.float32], display: Display = SRGB) -> None:
    """Write linear RGB (3, H, W) as a PNG of 8 bits; values above the display's white show as white.

    Raises OutputError: the file can't be written.
    """
    with replacing(path) as temporary, temporary.open("wb") as file:
        _encode_png(file, linear, display)


def encode_png(linear: NDArray[np.float32], display: Display = SRGB) -> bytes:
    """Return the bytes of the file that `write_png` writes."""
    file = io.BytesIO()
    _encode_png(file, linear, display)
    return file.getvalue()


def _encode_png(file: BinaryIO, linear: NDArray[np.float32], display: Display) -> None:
    from PIL import Image, PngImagePlugin

    info = PngImagePlugin.PngInfo()
    if display.encoding == "srgb":
        # Its values are sRGB (PNG specification, 11.3.2.5; perceptual).
        info.add(b"sRGB", b"\0")
    image = Image.fromarray(display.codes(linear))
    image.save(file, "PNG", compress_level=COMPRESS_LEVEL, pnginfo=info)


def write_exr(path: Path, linear: NDArray[np.float32]) -> None:
    """Write linear RGB (3, H, W) as OpenEXR, float32, lossless: the values as they are.

    Raises OutputError: the file can't be written.
    """
    with replacing(path) as temporary:
        import OpenImageIO

        _, height, width = linear.shape
        spec = OpenImageIO.ImageSpec(width, height, 3, "float")
        spec.attribute("compression", "zip")
        spec.attribute("DateTime", "")  # none: the same picture is the same file
        pixels = np.ascontiguousarray(np.moveaxis(linear, 0, -1), np.float32)
        file = OpenImageIO.ImageOutput.create("openexr")
        if file is None:
            raise OSError(OpenImageIO.geterror())
        written = file.open(str(temporary), spec) and file.write_image(pixels)
        trouble = file.geterror()
        # Closed even then, for an open file can't be removed everywhere.
        if not file.close() or not written:
            raise OSError(trouble or file.geterror())


def _suffix(path: Path) -> str:
    suffix = path.suffix.lower()
    if suffix not in SUFFIXES:
        raise OutputError(f"{path}: the name of a picture must end in {' or '.join(SUFFIXES)}")
    return suffix
