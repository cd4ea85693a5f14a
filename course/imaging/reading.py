"""Read pictures as linear light: PNG and JPEG are decoded from sRGB, EXR is linear already."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from course.core.types import Floats32
from course.errors import SceneError


def read_picture(path: Path) -> Floats32:
    """A picture as linear RGB.

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
        picture = _read_exr(path) if path.suffix.lower() == ".exr" else _read_coded(path)
    except Exception as error:
        raise SceneError(f"{path}: not a picture that can be read: {error}") from error
    wrong = np.argwhere(~(np.isfinite(picture) & (picture >= 0)))
    if len(wrong):
        y, x = wrong[0][:2]
        raise SceneError(f"{path}: the pixel in column {x}, row {y} is negative or not finite")
    return picture


def _read_coded(path: Path) -> Floats32:
    from PIL import Image

    with Image.open(path) as image:
        deep = image.mode.startswith("I;16") or image.mode == "I"
        codes = np.asarray(image if deep else image.convert("RGB"), np.float32)
    x = codes / np.float32(65535 if deep else 255)
    if x.ndim == 2:
        x = np.repeat(x[:, :, None], 3, axis=2)
    # IEC 61966-2-1, backwards.
    linear = np.where(x <= 0.04045, x / 12.92, ((x + 0.055) / 1.055) ** 2.4)
    return linear.astype(np.float32)


def _read_exr(path: Path) -> Floats32:
    import OpenEXR

    with OpenEXR.File(str(path)) as file:
        channels = file.channels()
        if "RGB" in channels:
            pixels = channels["RGB"].pixels
        elif "RGBA" in channels:
            pixels = channels["RGBA"].pixels[:, :, :3]
        elif "Y" in channels:
            pixels = np.repeat(channels["Y"].pixels[:, :, None], 3, axis=2)
        else:
            raise ValueError(f"it has the channels {', '.join(channels)}, not R, G and B")
        return np.ascontiguousarray(pixels, np.float32)
