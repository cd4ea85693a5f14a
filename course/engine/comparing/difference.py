"""A picture of where two pictures differ: red where the first is brighter, blue where the second is."""

from collections.abc import Sequence
from textwrap import wrap

import numpy as np
from PIL import Image, ImageDraw, ImageFont

from course.engine.comparing.seen import Seen
from course.engine.core.types import Floats, Floats32
from course.engine.formats.pictures.display import srgb_to_linear

# sRGB, from the second being brighter to the first: ColorBrewer's RdBu (Brewer and Harrower), backwards.
_COLOURS = np.frombuffer(
    bytes.fromhex("053061 2166ac 4393c3 92c5de f7f7f7 f4a582 d6604d b2182b 67001f"), np.uint8
).reshape(-1, 3)
SHOWN = 99.5
"""Percentile of the differences' sizes that gets the darkest colour, so that a single bright pixel doesn't set it."""

NARROWEST = 180
"""Pixels that the legend needs."""

SIZE = 11
"""Of the letters [pixels]."""

FRAME = (0, 140, 0)
"""Colour of frames in sRGB: none that a difference has."""

_MARGIN, _BAR, _TEXT = 8, 8, 14


def difference_picture(a: Floats32, b: Floats32, seen: Sequence[Seen] = ()) -> Floats32:
    """The mean over the channels of a - b as colours, with a legend and what was seen below, and frames around that.

    ``a``, ``b``: (H, W, 3) float32, linear.
    Returns (3, H', W') float32, linear RGB, as `course.engine.formats.pictures.files.write_png` takes it.
    """
    difference = (a.astype(np.float64) - b).mean(axis=2)
    scale = float(np.percentile(np.abs(difference), SHOWN)) or float(np.abs(difference).max())
    height, width = difference.shape
    wide = max(width, NARROWEST)
    # A letter of this font is about as wide as half of its height.
    letters = 2 * (wide - 2 * _MARGIN) // SIZE
    lines = [line for one in seen for line in wrap(one.text, letters, subsequent_indent="  ")]
    below = 3 * _MARGIN + _BAR + _TEXT * (1 + len(lines))
    canvas = np.full((height + below, wide, 3), 255, np.uint8)
    left = (wide - width) // 2
    canvas[:height, left : left + width] = _coloured(difference / (scale or 1.0))
    top = height + _MARGIN
    bar = np.linspace(-1, 1, wide - 2 * _MARGIN)
    canvas[top : top + _BAR, _MARGIN:-_MARGIN] = _coloured(bar)
    image = Image.fromarray(canvas)
    draw = ImageDraw.Draw(image)
    font = ImageFont.load_default(size=SIZE)
    ends = (
        (_MARGIN, "la", f"-{scale:.3g}"),
        (wide / 2, "ma", "0  radiance"),
        (wide - _MARGIN, "ra", f"+{scale:.3g}"),
    )
    for x, anchor, text in ends:
        draw.text((x, top + _BAR + 2), text, fill=(0, 0, 0), font=font, anchor=anchor)
    for number, line in enumerate(lines, start=1):
        at = _MARGIN, top + _BAR + 2 + number * _TEXT
        draw.text(at, line, fill=(0, 0, 0), font=font)
    for place in (one.place for one in seen if one.place):
        # Around it, so that a spot of a few pixels isn't covered.
        corner = left + place.left - 1, place.top - 1
        draw.rectangle(
            (*corner, corner[0] + place.width + 1, corner[1] + place.height + 1), outline=FRAME
        )
    return np.moveaxis(srgb_to_linear(np.asarray(image) / 255), -1, 0)


def _coloured(place: Floats) -> Floats:
    """Codes of sRGB (..., 3) of numbers (...) from -1 to 1; beyond, as at the ends."""
    at = np.linspace(-1, 1, len(_COLOURS))
    return np.stack([np.interp(place, at, channel) for channel in _COLOURS.T], axis=-1).round()
