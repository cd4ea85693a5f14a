"""Read pictures as linear light: PNG and JPEG are decoded from sRGB, EXR and Radiance HDR are linear already.

Pillow reads what has 8 bits a channel, OpenImageIO what has more; each is imported where it is used.
"""

from __future__ import annotations

import warnings
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from course.core.types import Floats32
from course.errors import SceneError

if TYPE_CHECKING:
    from OpenImageIO import ImageSpec

LINEAR = (".exr", ".hdr")
"""Suffixes of the formats that hold radiance, up to a scale. A Radiance file's EXPOSURE is left alone, too."""


def read_picture(path: Path) -> Floats32:
    """A picture as linear RGB; grey becomes RGB, and alpha is dropped.

    Returns
    -------
    (H, W, 3) float32

    Raises
    ------
    SceneError
        The file is missing, is no picture, or holds a value that is negative or not finite.
    """
    if not path.is_file():
        raise SceneError(f"{path}: no such file")
    try:
        picture = _read_linear(path) if path.suffix.lower() in LINEAR else _read_coded(path)
    except Exception as error:
        reason = (str(error) or type(error).__name__).splitlines()[0]
        raise SceneError(f"{path}: not a picture that can be read: {reason}") from error
    wrong = np.argwhere(~(np.isfinite(picture) & (picture >= 0)))
    if len(wrong):
        y, x = wrong[0][:2]
        raise SceneError(f"{path}: the pixel in column {x}, row {y} is negative or not finite")
    return picture


def _read_coded(path: Path) -> Floats32:
    from PIL import Image

    # Pillow warns of what it can read all the same, such as a damaged date or 90 million pixels.
    with warnings.catch_warnings(action="ignore"), Image.open(path) as image:
        if image.mode in ("I", "F"):
            raise ValueError("its values have 32 bits; save it with 8 or 16, or as EXR")
        if image.mode.startswith("I;16") or _is_deep_png(path):
            # Of a corrupt file Pillow only raises an error; OpenImageIO's PNG library would print one as well.
            image.load()
            with Image.open(path) as again:
                again.verify()
            return _linear_light(65535).take(_read_colors(path, "uint16"))
        return _linear_light(255).take(np.asarray(image.convert("RGB")))


def _is_deep_png(path: Path) -> bool:
    """Whether a file is a PNG of 16 bits a channel, of which Pillow shows 8 (PNG specification, 5.2 and 11.2.1)."""
    with path.open("rb") as file:
        start = file.read(25)
    return start[:8] == b"\x89PNG\r\n\x1a\n" and start[24] == 16


def _linear_light(white: int) -> Floats32:
    """Linear value of each sRGB code from 0 to white (IEC 61966-2-1, backwards), (white + 1,)."""
    x = np.arange(white + 1) / white
    linear = np.where(x <= 0.04045, x / 12.92, ((x + 0.055) / 1.055) ** 2.4)
    return linear.astype(np.float32)


def _read_linear(path: Path) -> Floats32:
    return np.ascontiguousarray(_read_colors(path, "float"), np.float32)


def _read_colors(path: Path, kind: str) -> NDArray[Any]:
    """Red, green and blue (H, W, 3) of a file that OpenImageIO reads, as values of that kind."""
    import OpenImageIO

    # Colours as they are, not multiplied by alpha.
    wish = OpenImageIO.ImageSpec()
    wish.attribute("oiio:UnassociatedAlpha", 1)
    try:
        file = OpenImageIO.ImageInput.open(str(path), wish)
        if file is None:
            raise ValueError(OpenImageIO.geterror())
        spec = file.spec()
        if kind == "float":
            _check_linear(spec)
        pixels = file.read_image(0, 0, *_color_channels(spec.channelnames), kind)
        if pixels is None:
            raise ValueError(file.geterror())
    except UnicodeDecodeError as error:  # from a message that quotes the file's own bytes
        raise ValueError("its header is corrupt") from error
    return np.broadcast_to(pixels, (*pixels.shape[:2], 3))


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
