"""What a PNG file says of its codes: by cICP, iCCP, sRGB, or gAMA and cHRM, the first of them that is there.

PNG specification, third edition, 4.3 and 11.3.2; code points of cICP: ITU-T H.273, 8.1 and 8.2.
"""

import struct
from collections.abc import Callable
from dataclasses import dataclass
from typing import BinaryIO, Final

import numpy as np

from course.engine.core.types import Floats, Floats32, Floats64
from course.engine.formats.pictures.display import srgb_to_linear
from course.engine.formats.pictures.primaries import REC709, to_rec709

SIGNATURE: Final = b"\x89PNG\r\n\x1a\n"

MOST_CHUNKS: Final = 10_000
"""That are passed before the picture's data."""

LIKE_SRGB: Final = range(44_500, 46_501)
"""Numbers of gAMA that programs write beside, or in the place of, sRGB; it is 45455 there."""

Transfer = Callable[[Floats], Floats32]
"""Linear values of encoded ones, both from 0 to 1."""


@dataclass(frozen=True)
class Coding:
    """What codes mean.

    Attributes
    ----------
    matrix : (3, 3), from linear colours to those of Rec. 709; None where they are these
    """

    transfer: Transfer = srgb_to_linear
    matrix: Floats64 | None = None


def _power(exponent: float) -> Transfer:
    return lambda encoded: np.power(encoded, exponent).astype(np.float32)


def _bt709(encoded: Floats) -> Floats32:
    x = np.asarray(encoded)
    return np.where(x < 0.081, x / 4.5, ((x + 0.099) / 1.099) ** (1 / 0.45)).astype(np.float32)


_TRANSFERS: Final[dict[int, Transfer]] = {
    **dict.fromkeys((1, 6, 14, 15), _bt709),
    4: _power(2.2),
    5: _power(2.8),
    8: _power(1.0),
    13: srgb_to_linear,
}
_NAMES: Final = {16: "PQ", 18: "HLG"}
_D65: Final = REC709[6:]
_PRIMARIES: Final[dict[int, tuple[float, ...]]] = {
    1: REC709,
    5: (0.64, 0.33, 0.29, 0.60, 0.15, 0.06, *_D65),
    6: (0.63, 0.34, 0.31, 0.595, 0.155, 0.07, *_D65),
    7: (0.63, 0.34, 0.31, 0.595, 0.155, 0.07, *_D65),
    9: (0.708, 0.292, 0.170, 0.797, 0.131, 0.046, *_D65),
    11: (0.68, 0.32, 0.265, 0.69, 0.15, 0.06, 0.314, 0.351),
    12: (0.68, 0.32, 0.265, 0.69, 0.15, 0.06, *_D65),
}


def coding_of(stream: BinaryIO) -> Coding:
    """What the codes of a PNG file mean; of another file, or one that doesn't say it, those of sRGB.

    A profile of iCCP is not looked at here. Raises ValueError for a coding that isn't known.
    """
    chunks = _chunks(stream)
    if "cICP" in chunks:
        return _of_code_points(chunks["cICP"])
    if "iCCP" in chunks or "sRGB" in chunks:
        return Coding()
    transfer: Transfer = srgb_to_linear
    if len(gamma := chunks.get("gAMA", b"")) == 4:
        (number,) = struct.unpack(">I", gamma)
        if number and number not in LIKE_SRGB:
            transfer = _power(100_000 / number)
    if len(listed := chunks.get("cHRM", b"")) != 32:
        return Coding(transfer)
    white_first = [x / 100_000 for x in struct.unpack(">8I", listed)]
    try:
        return Coding(transfer, to_rec709(white_first[2:] + white_first[:2]))
    except ValueError as error:
        raise ValueError(f"its primaries (cHRM) are no colours: {error}") from None


def _of_code_points(content: bytes) -> Coding:
    if len(content) != 4:
        raise ValueError("its cICP is corrupt")
    primaries, transfer, matrix, full = content
    if transfer not in _TRANSFERS:
        name = f"{_NAMES[transfer]}, " if transfer in _NAMES else ""
        raise ValueError(
            f"its codes are {name}transfer {transfer} of cICP; save it as sRGB, or EXR"
        )
    if primaries not in _PRIMARIES or matrix != 0 or full != 1:
        raise ValueError(
            f"its colours are {primaries} {transfer} {matrix} {full} of cICP; save it as sRGB, or EXR"
        )
    return Coding(_TRANSFERS[transfer], to_rec709(_PRIMARIES[primaries]))


def _chunks(stream: BinaryIO) -> dict[str, bytes]:
    """Small chunks before the picture's data, the first of each name; the stream is at its start again."""
    found: dict[str, bytes] = {}
    stream.seek(0)
    try:
        if stream.read(8) != SIGNATURE:
            return found
        for _ in range(MOST_CHUNKS):
            head = stream.read(8)
            if len(head) < 8 or head[4:] == b"IDAT":
                break
            length = int.from_bytes(head[:4], "big")
            content = stream.read(length) if length <= 64 else b""
            stream.seek(length - len(content) + 4, 1)
            found.setdefault(head[4:].decode("latin-1"), content)
        return found
    finally:
        stream.seek(0)
