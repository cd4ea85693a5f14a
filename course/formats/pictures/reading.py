"""Read pictures as linear light: PNG and JPEG are decoded from sRGB, EXR and Radiance HDR are linear already.

Pillow reads what has 8 bits a channel, OpenImageIO what has more; each is imported where it is used.
"""

from __future__ import annotations

import threading
import warnings
from collections.abc import Iterator
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, BinaryIO, Final

import numpy as np

from course.core.types import Floats32
from course.errors import SceneError
from course.formats.pictures.display import srgb_to_linear
from course.inputs import LARGEST_DATA, MOST_PIXELS, Bound, opened, shown

if TYPE_CHECKING:
    from OpenImageIO import ImageInput, ImageSpec
    from PIL.Image import Image

LINEAR: Final = (".exr", ".hdr")
"""Suffixes of the formats that hold radiance, up to a scale. A Radiance file's EXPOSURE is left alone, too."""

MAGIC: Final = (b"\x76\x2f\x31\x01", b"#?RADIANCE", b"#?RGBE")
"""The first bytes of their files."""

CODED: Final = ("PNG", "JPEG", "TIFF", "BMP", "GIF", "WEBP", "PPM", "TGA")
"""What Pillow is asked for; of its other formats some start programs, and most are drawings or films."""

USUAL_FILE: Final = Bound(LARGEST_DATA)
USUAL_PIXELS: Final = Bound(MOST_PIXELS)

_STRIP: Final = 1 << 20
"""Pixels that are converted at a time: steps in between take memory for these only, and not for the picture."""

_OPENING = threading.Lock()


def read_picture(
    path: Path, bound: Bound = USUAL_FILE, pixels: Bound = USUAL_PIXELS, codes: bool = False
) -> Floats32:
    """A picture as linear RGB; grey becomes RGB, and alpha is dropped.

    On the way it takes little more memory than the picture that is returned and the file's own codes together.
    Raises SceneError: the file is missing, is no picture or is too large, or holds a value that is negative or not
    finite.
    Returns (H, W, 3) float32.

    Parameters
    ----------
    bound : the most bytes that the file may have
    pixels : the most pixels that the picture may have; it is refused before they are read
    codes : true for numbers as the file has them: without sRGB's curve, the largest code of its depth is 1
    """
    with opened(path, "picture", bound, SceneError) as stream:
        try:
            linear = path.suffix.lower() in LINEAR
            read = _read_linear if linear else partial(_read_coded, codes=codes)
            picture = read(stream, path, pixels)
        except UnicodeDecodeError as error:  # from a message that quotes the file's own bytes
            raise SceneError(f"{shown(path)}: its header is corrupt") from error
        except Exception as error:
            reason = (str(error) or type(error).__name__).splitlines()[0]
            raise SceneError(f"{shown(path)}: not a picture that can be read: {reason}") from error
    for rows in _strips(*picture.shape[:2]):
        part = picture[rows]
        wrong = np.argwhere(~(np.isfinite(part) & (part >= 0)))
        if len(wrong):
            y, x = wrong[0][:2]
            raise SceneError(
                f"{shown(path)}: the pixel in column {x}, row {rows.start + y} is negative or not finite"
            )
    return picture


def _strips(height: int, width: int) -> Iterator[slice]:
    """Rows of a picture, a strip after the other."""
    step = max(1, _STRIP // width)
    return (slice(y, min(y + step, height)) for y in range(0, height, step))


def _check_size(width: int, height: int, pixels: Bound) -> None:
    if width * height > pixels.most:
        raise ValueError(f"{width} x {height} are more than {pixels.most:,} pixels{pixels.remedy}")


def _read_coded(stream: BinaryIO, path: Path, pixels: Bound, codes: bool) -> Floats32:
    # Pillow warns of what it can read all the same, such as a damaged date or 90 million pixels.
    with warnings.catch_warnings(action="ignore"), _opened(stream) as image:
        _check_size(image.width, image.height, pixels)
        if image.mode in ("I", "F"):
            raise ValueError("its values have 32 bits; save it with 8 or 16, or as EXR")
        # Of a corrupt file Pillow only raises an error; OpenImageIO's PNG library would print one as well.
        image.load()
        if not (image.mode.startswith("I;16") or _is_deep_png(stream)):
            return _from_codes(image, _table(256, codes))
    stream.seek(0)
    with warnings.catch_warnings(action="ignore"), _opened(stream) as again:
        again.verify()
    return _from_deep_codes(path, _table(65536, codes))


def _opened(stream: BinaryIO) -> Image:
    """A picture whose size is known and whose pixels haven't been read."""
    from PIL import Image, UnidentifiedImageError

    # Pillow's own bound can't be given with a call. The lock keeps one reader from putting back what is another's.
    with _OPENING:
        usual, Image.MAX_IMAGE_PIXELS = Image.MAX_IMAGE_PIXELS, None
        try:
            return Image.open(stream, formats=CODED)
        except UnidentifiedImageError as error:
            raise ValueError("it begins as none of " + ", ".join(CODED)) from error
        finally:
            Image.MAX_IMAGE_PIXELS = usual


def _table(count: int, codes: bool) -> Floats32:
    """What each of so many codes means."""
    shares = np.arange(count) / (count - 1)
    return shares.astype(np.float32) if codes else srgb_to_linear(shares)


def _from_codes(image: Image, table: Floats32) -> Floats32:
    """A picture of 8 bits (H, W, 3) by a table of what its codes mean."""
    picture = np.empty((image.height, image.width, 3), np.float32)
    for rows in _strips(image.height, image.width):
        codes = image.crop((0, rows.start, image.width, rows.stop)).convert("RGB")
        # Every code is in the table; any other mode than "clip" would write to a copy first.
        table.take(np.asarray(codes), out=picture[rows], mode="clip")
    return picture


def _from_deep_codes(path: Path, table: Floats32) -> Floats32:
    """A picture of 16 bits (H, W, 3) by a table of what its codes mean."""
    file, spec = _open_linear(path)
    channels = _color_channels(spec.channelnames)
    picture = np.empty((spec.height, spec.width, 3), np.float32)
    for rows in _strips(spec.height, spec.width):
        # A tiled picture can't be read by rows.
        if spec.tile_width:
            rows = slice(0, spec.height)
            codes = file.read_image(0, 0, *channels, "uint16")
        else:
            codes = file.read_scanlines(
                spec.y + rows.start, spec.y + rows.stop, spec.z, *channels, "uint16"
            )
        if codes is None:
            raise ValueError(file.geterror())
        codes = np.broadcast_to(codes.reshape(-1, spec.width, codes.shape[-1]), picture[rows].shape)
        table.take(codes, out=picture[rows], mode="clip")
        if spec.tile_width:
            break
    return picture


def _is_deep_png(stream: BinaryIO) -> bool:
    """True for a PNG of 16 bits per channel, of which Pillow reads 8 (PNG specification, 5.2 and 11.2.1)."""
    stream.seek(0)
    start = stream.read(25)
    # Pillow minds no longer header; the library that reads 16 bits prints an error of its own.
    if start[:8] == b"\x89PNG\r\n\x1a\n" and start[8:12] != b"\0\0\0\x0d":
        raise ValueError("its header is corrupt")
    return start[:8] == b"\x89PNG\r\n\x1a\n" and start[24] == 16


def _read_linear(stream: BinaryIO, path: Path, most: Bound) -> Floats32:
    # OpenImageIO would try all its formats one after the other, which takes minutes with a large file.
    if not stream.read(max(map(len, MAGIC))).startswith(MAGIC):
        raise ValueError("it begins neither as EXR nor as HDR")
    file, spec = _open_linear(path)
    _check_size(spec.width, spec.height, most)
    _check_linear(spec)
    pixels = file.read_image(0, 0, *_color_channels(spec.channelnames), "float")
    if pixels is None:
        raise ValueError(file.geterror())
    pixels = np.broadcast_to(pixels, (*pixels.shape[:2], 3))
    return np.ascontiguousarray(pixels, np.float32)


def _open_linear(path: Path) -> tuple[ImageInput, ImageSpec]:
    """A file of more than 8 bits a channel, and what its header says."""
    import OpenImageIO

    # Colours as they are, not multiplied by alpha.
    wish = OpenImageIO.ImageSpec()
    wish.attribute("oiio:UnassociatedAlpha", 1)
    file = OpenImageIO.ImageInput.open(str(path), wish)
    if file is None:
        raise ValueError(OpenImageIO.geterror())
    return file, file.spec()


def _check_linear(spec: ImageSpec) -> None:
    """Refuse what would be read as another picture than the file shows."""
    if str(spec.format) not in ("half", "float"):
        raise ValueError(f"its values are {spec.format}, not half or float")
    if spec.get_int_attribute("Orientation", 1) != 1:
        raise ValueError("its pixels don't run in rows from the upper left corner")
    shown = (spec.full_x, spec.full_y, spec.full_width, spec.full_height)
    if (spec.x, spec.y, spec.width, spec.height) != shown:
        raise ValueError("its data window isn't its display window")


def _color_channels(names: tuple[str, ...]) -> tuple[int, int]:
    """First and last + 1 of the channels that hold red, green and blue, or grey; OpenImageIO has them in that order."""
    for wanted in ("RGB", "Y"):
        if set(wanted) <= set(names) and "RY" not in names:
            first = names.index(wanted[0])
            return first, first + len(wanted)
    raise ValueError(f"it has the channels {', '.join(names)}, not R, G and B, or Y")
