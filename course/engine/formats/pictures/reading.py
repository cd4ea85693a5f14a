"""Read pictures as linear light: codes of PNG, JPEG and others are decoded, EXR and Radiance HDR are linear already.

Pillow reads what has 8 bits a channel, OpenImageIO what has more; each is imported where it is used.
"""

from __future__ import annotations

import re
import threading
import warnings
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, BinaryIO, Final

import numpy as np

from course.base.errors import CourseWarning, SceneError
from course.base.inputs import LARGEST_DATA, MOST_PIXELS, InputLimit, opened, shown
from course.engine.core.types import Floats32
from course.engine.formats.pictures.alpha import see_through
from course.engine.formats.pictures.icc import in_srgb, is_srgb
from course.engine.formats.pictures.layers import choose
from course.engine.formats.pictures.mending import ReadPicture, check_size, mend, parts_of, strips
from course.engine.formats.pictures.placing import (
    in_display_window,
    in_other_colours,
    orientation,
    upright,
)
from course.engine.formats.pictures.png_colours import Coding, Transfer, coding_of
from course.engine.formats.pictures.primaries import to_rec709
from course.engine.formats.pictures.radiance import radiance_header

if TYPE_CHECKING:
    from OpenImageIO import ImageInput, ImageSpec
    from PIL.Image import Image

MAGIC: Final = (b"\x76\x2f\x31\x01", b"#?RADIANCE", b"#?RGBE")
"""The first bytes of their files."""

CODED: Final = ("PNG", "JPEG", "TIFF", "BMP", "GIF", "WEBP", "PPM", "TGA")
"""What Pillow is asked for; of its other formats some start programs, and most are drawings or films."""

TIFF: Final = (b"II*\0", b"MM\0*", b"II+\0", b"MM\0+")
"""First bytes of its files (TIFF 6.0, section 2; BigTIFF)."""

FRAMES: Final = ("GIF", "WEBP", "TIFF", "PNG")
"""Formats that may have several pictures of which each is one to be looked at."""

USUAL_FILE: Final = InputLimit(LARGEST_DATA)
USUAL_PIXELS: Final = InputLimit(MOST_PIXELS)

_OPENING = threading.Lock()


def read_picture(
    path: Path,
    bound: InputLimit = USUAL_FILE,
    pixels: InputLimit = USUAL_PIXELS,
    codes: bool = False,
    layer: str | None = None,
) -> Floats32:
    """A picture as linear RGB of Rec. 709; grey becomes RGB. Alpha is dropped, and told in a
    picture of codes.

    It stands upright as its orientation says, and covers its display window, black where it has no pixels. Primaries,
    curves and profiles of colours that it names are heeded. Values that are infinite or negative become the largest
    that there is and 0, which one `CourseWarning` tells with their number. Values of a Radiance picture are divided by
    its EXPOSURE and COLORCORR.
    On the way it takes little more memory than the picture that is returned and the file's own codes together.
    Raises SceneError: the file is missing, is no picture or is too large, has no such layer, or holds a value that is
    not a number.
    Returns (H, W, 3) float32.

    Parameters
    ----------
    bound : the most bytes that the file may have
    pixels : the most pixels that the picture may have; it is refused before they are read
    codes : true for numbers as the file has them: without its curve and primaries, the largest code of its depth is 1
    layer : of an EXR file of several
    """
    with opened(path, "picture", bound, SceneError) as stream:
        try:
            if read := LINEAR.get(path.suffix.lower()):
                found = read(stream, path, pixels, codes, layer)
            elif layer is not None:
                raise ValueError(f"it has no layer {layer!r}; only an EXR file has layers")
            else:
                found = _read_coded(stream, path, pixels, codes)
        except UnicodeDecodeError as error:  # from a message that quotes the file's own bytes
            raise SceneError(f"{shown(path)}: its header is corrupt") from error
        except Exception as error:
            reason = (str(error) or type(error).__name__).splitlines()[0]
            raise SceneError(f"{shown(path)}: not a picture that can be read: {reason}") from error
    notes = found.notes + mend(found, path)
    if notes:
        warnings.warn(f"{shown(path)}: {'; '.join(notes)}", CourseWarning, stacklevel=2)
    return found.pixels


def _read_coded(stream: BinaryIO, path: Path, pixels: InputLimit, codes: bool) -> ReadPicture:
    notes: list[str] = []
    # Pillow warns of what it can read all the same, such as a damaged date or 90 million pixels.
    with warnings.catch_warnings(action="ignore"), _opened(stream) as image:
        check_size(image.width, image.height, pixels)
        deep = image.format == "PPM" and _is_deep_pnm(stream)
        if image.mode in ("I", "F") and not deep:
            raise ValueError("its values are no codes of 8 or 16 bits; save them so, or as EXR")
        if image.format in FRAMES and (frames := getattr(image, "n_frames", 1)) > 1:
            image.seek(0)
            notes.append(f"it has {frames:,} pictures, and the first is taken")
        # When Pillow reads the 8 bits of a TIFF file it turns them, and that of PNG may stand behind the pixels.
        turned = orientation(image) if image.format == "TIFF" else 1
        # Of a corrupt file Pillow only raises an error; OpenImageIO's PNG library would print one as well.
        image.load()
        deep = deep or image.mode.startswith("I;16") or _is_deep_png(stream)
        if image.format != "TIFF" or not deep:
            turned = orientation(image)
        if see_through(image):
            notes.append("its alpha is left out: all of it is opaque")
        # Colours of numbers are none.
        coding = Coding() if codes else coding_of(stream)
        profile = None if codes else image.info.get("icc_profile")
        if not codes and not profile and in_other_colours(image):
            notes.append(
                "its colours aren't sRGB's by its Exif data, such as Adobe RGB, but it has no profile: they are taken"
                " for sRGB's; convert it to sRGB"
            )
        if not deep:
            if profile:
                image, told = in_srgb(image, profile)
                notes += told
            picture = _from_codes(image, _table(256, codes, coding.transfer))
    if deep:
        stream.seek(0)
        with warnings.catch_warnings(action="ignore"), _opened(stream) as again:
            again.verify()
        if profile and not is_srgb(profile):
            notes.append(
                "its ICC profile isn't heeded with 16 bits: its colours are taken for sRGB's"
            )
        picture = _from_deep_codes(path, _table(65536, codes, coding.transfer))
    if coding.matrix is not None:
        for part in parts_of(picture):
            part[:] = part @ coding.matrix.T.astype(np.float32)
    return ReadPicture(upright(picture, turned), notes, white=1.0)


def _opened(stream: BinaryIO) -> Image:
    """A picture whose size is known and whose pixels haven't been read."""
    from PIL import Image, UnidentifiedImageError

    # Pillow's own bound can't be given with a call. The lock keeps one reader from putting back what is another's.
    with _OPENING:
        usual, Image.MAX_IMAGE_PIXELS = Image.MAX_IMAGE_PIXELS, None
        try:
            return Image.open(stream, formats=CODED)
        except UnidentifiedImageError as error:
            stream.seek(0)
            if stream.read(4) in TIFF:
                raise ValueError(
                    "it is a TIFF, but not of whole numbers of 8 or 16 bits, or cut short; save it as such, or as EXR"
                ) from error
            raise ValueError("it begins as none of " + ", ".join(CODED)) from error
        finally:
            Image.MAX_IMAGE_PIXELS = usual


def _table(count: int, codes: bool, transfer: Transfer) -> Floats32:
    """What each of so many codes means."""
    shares = np.arange(count) / (count - 1)
    return shares.astype(np.float32) if codes else transfer(shares)


def _from_codes(image: Image, table: Floats32) -> Floats32:
    """A picture of 8 bits (H, W, 3) by a table of what its codes mean."""
    picture = np.empty((image.height, image.width, 3), np.float32)
    for rows in strips(image.height, image.width):
        codes = image.crop((0, rows.start, image.width, rows.stop)).convert("RGB")
        # Every code is in the table; any other mode than "clip" would write to a copy first.
        table.take(np.asarray(codes), out=picture[rows], mode="clip")
    return picture


def _from_deep_codes(path: Path, table: Floats32) -> Floats32:
    """A picture of 16 bits (H, W, 3) by a table of what its codes mean."""
    file, spec = _open_linear(path)
    channels = (0, 3 if len(spec.channelnames) >= 3 else 1)
    picture = np.empty((spec.height, spec.width, 3), np.float32)
    for rows in strips(spec.height, spec.width):
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


def _is_deep_pnm(stream: BinaryIO) -> bool:
    """True for a PGM or PPM whose largest code is above 255, of which Pillow reads 8 bits, or 32 (Netpbm's ppm(5))."""
    stream.seek(0)
    words = re.sub(rb"#[^\r\n]*", b"", stream.read(1 << 16)).split(None, 4)
    return words[0] in (b"P2", b"P3", b"P5", b"P6") and int(words[3]) > 255


def _read_linear(
    stream: BinaryIO, path: Path, most: InputLimit, codes: bool, layer: str | None
) -> ReadPicture:
    # OpenImageIO would try all its formats one after the other, which takes minutes with a large file.
    if not stream.read(max(map(len, MAGIC))).startswith(MAGIC):
        raise ValueError("it begins neither as EXR nor as HDR")
    stream.seek(0)
    header = radiance_header(stream)
    file, spec = _open_linear(path)
    check_size(spec.width, spec.height, most)
    chosen, spec, notes = choose(file, layer)
    check_size(spec.width, spec.height, most)
    check_size(spec.full_width, spec.full_height, most)
    _check_linear(spec, header.turned)
    first, last = min(chosen.channels), max(chosen.channels) + 1
    pixels = file.read_image(chosen.part, 0, first, last, "float")
    if pixels is None:
        old = (
            path.suffix.lower() == ".hdr"
            and "; it is cut short, or of the old run lengths: save it anew"
        )
        raise ValueError(f"{file.geterror()}{old or ''}")
    pixels = pixels.reshape(spec.height, spec.width, last - first)
    wanted = [channel - first for channel in chosen.channels]
    if wanted != list(range(last - first)):
        pixels = pixels[..., wanted]
    pixels = in_display_window(np.broadcast_to(pixels, (*pixels.shape[:2], 3)), spec)
    picture = np.require(upright(pixels, header.turned), np.float32, ["C", "W"])
    if (header.exposure != 1).any() and not codes:
        values = " ".join(f"{value:g}" for value in dict.fromkeys(header.exposure.tolist()))
        notes = [*notes, f"its values are divided by its EXPOSURE and COLORCORR, {values}"]
        with np.errstate(over="ignore"):
            np.divide(picture, header.exposure, out=picture, casting="same_kind")
    given = header.primaries or spec.getattribute("chromaticities")
    if given is not None and not codes:
        try:
            matrix = to_rec709(given)
        except (ValueError, TypeError) as error:
            matrix = None
            notes = [
                *notes,
                f"its chromaticities aren't heeded, and colours taken for sRGB's: {error}",
            ]
        if matrix is not None:
            for part in parts_of(picture):
                # An infinite red is one in all channels, and not a difference of two infinite ones.
                infinite = np.isinf(part).any(axis=2, keepdims=True)
                turned = np.where(infinite, 0, part) @ matrix.T.astype(np.float32)
                part[:] = np.where(infinite, np.inf, turned)
    return ReadPicture(picture, notes)


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


def _check_linear(spec: ImageSpec, turned: int) -> None:
    """Refuse what would be read as another picture than the file shows; ``turned``: how it is known to be."""
    if spec.deep:
        raise ValueError("it is deep, of several colours in a pixel; flatten it where it was made")
    if spec.get_string_attribute("textureformat").startswith("CubeFace"):
        raise ValueError("it is a cube map, of six pictures; save it by longitude and latitude")
    if str(spec.format) not in ("half", "float"):
        raise ValueError(f"its values are {spec.format}, not half or float")
    if turned == 1 and spec.get_int_attribute("Orientation", 1) != 1:
        raise ValueError(
            "its pixels don't run in rows from the upper left corner; open it in a picture editor, and save it anew"
        )


LINEAR: Final[dict[str, Callable[[BinaryIO, Path, InputLimit, bool, str | None], ReadPicture]]] = {
    ".exr": _read_linear,
    ".hdr": _read_linear,
}
"""What reads the formats that hold radiance, up to a scale, by suffix.

Arguments are the open file, its path, the most pixels, and ``codes`` and ``layer`` as ``read_picture`` has them.
"""
