"""What the header of a Radiance picture says of its pixels (Ward, "Radiance file formats")."""

from dataclasses import dataclass
from typing import BinaryIO, Final

import numpy as np

from course.engine.core.types import Floats64

LONGEST: Final = 1 << 16
"""Bytes of a header that are looked at."""

NUMBERS: Final = {
    b"PRIMARIES": (8, "eight numbers"),
    b"EXPOSURE": (1, "a number above 0"),
    b"COLORCORR": (3, "three numbers above 0"),
}
"""Lines of numbers: how many, and what is expected."""

_AXES: Final = ("-Y+X", "-Y-X", "+Y-X", "+Y+X", "+X-Y", "-X-Y", "-X+Y", "+X+Y")
TURNED: Final = {axes: turned for turned, axes in enumerate(_AXES, start=1)}
"""By the axes along which pixels follow each other, the slower one first; Y runs upwards, as in its resolution line."""


@dataclass(frozen=True)
class Header:
    """What a Radiance picture says of its pixels; of another file the defaults.

    Attributes
    ----------
    primaries : x and y of red, green, blue and white; None where it gives none
    exposure : (3,) by what radiance was multiplied: all its EXPOSURE and COLORCORR lines together
    turned : its orientation, from 1, upright, to 8, as of a TIFF file
    """

    primaries: tuple[float, ...] | None
    exposure: Floats64
    turned: int


def radiance_header(stream: BinaryIO) -> Header:
    """Return what the header says; the stream is at its start again.

    Raises ValueError for colours in XYZ, and for a line without its numbers.
    """
    head = stream.read(LONGEST)
    stream.seek(0)
    primaries, exposure, turned = None, np.ones(3), 1
    lines = iter(head.split(b"\n") if head.startswith(b"#?") else [])
    for line in lines:
        if not line.strip():
            axes = b"".join(next(lines, b"").split()[::2]).decode("latin-1")
            turned = TURNED.get(axes, 1)
            break
        # Of a line that is indented another picture's header is told, from which this one was made.
        key, value = (part.rstrip() for part in line.partition(b"=")[::2])
        if key == b"FORMAT" and value == b"32-bit_rle_xyze":
            raise ValueError(
                "its colours are XYZ (FORMAT=32-bit_rle_xyze); convert it to RGB, such as by Radiance's ra_xyze -r"
            )
        if key == b"PRIMARIES":
            primaries = _numbers(key, value)
        elif key in NUMBERS:
            exposure *= _numbers(key, value)
    return Header(primaries, exposure, turned)


def _numbers(key: bytes, value: bytes) -> tuple[float, ...]:
    count, expected = NUMBERS[key]
    try:
        found = tuple(float(word) for word in value.split())
    except ValueError:
        found = ()
    if len(found) != count or (key != b"PRIMARIES" and not 0 < min(found) <= max(found) < np.inf):
        raise ValueError(f"its {key.decode()} is {value[:60]!r}: expected {expected}")
    return found
