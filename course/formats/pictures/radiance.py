"""What the header of a Radiance picture says of its colours (Ward, "Radiance file formats")."""

from typing import BinaryIO, Final

LONGEST: Final = 1 << 16
"""Bytes of a header that are looked at."""


def radiance_primaries(stream: BinaryIO) -> tuple[float, ...] | None:
    """Return x and y of red, green, blue and white, where a Radiance file gives them; the stream is at its start again.

    Raises ValueError for colours in XYZ.
    """
    head = stream.read(LONGEST)
    stream.seek(0)
    if not head.startswith(b"#?"):
        return None
    primaries = None
    for line in head.partition(b"\n\n")[0].split(b"\n"):
        key, _, value = line.partition(b"=")
        if key.strip() == b"FORMAT" and value.strip() == b"32-bit_rle_xyze":
            raise ValueError(
                "its colours are XYZ (FORMAT=32-bit_rle_xyze); convert it to RGB, such as by Radiance's ra_xyze -r"
            )
        if key.strip() == b"PRIMARIES":
            try:
                numbers = tuple(float(word) for word in value.split())
            except ValueError:
                raise ValueError(
                    f"its PRIMARIES are {value[:60]!r}: expected eight numbers"
                ) from None
            primaries = numbers
    return primaries
