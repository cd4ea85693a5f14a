"""Picture files written by hand, from what the formats' specifications say, apart from the libraries that read them."""

import struct
import zlib

import numpy as np
from numpy.typing import NDArray

Codes = NDArray[np.integer]
Values = NDArray[np.floating]

PNG_COLOR_TYPES = {1: 0, 2: 4, 3: 2, 4: 6}
"""By the number of channels: grey, grey and alpha, RGB, RGB and alpha."""


def png(
    codes: Codes,
    bits: int = 8,
    palette: Codes | None = None,
    stream: bytes | None = None,
    more: dict[str, bytes] | None = None,
) -> bytes:
    """A PNG of codes (H, W, channels), 8 or 16 bits each; with a palette (n, 3) the codes (H, W, 1) are its entries.

    With another stream than the compressed codes it only pretends to hold them. ``more``: chunks before them.
    """
    height, width, channels = codes.shape
    rows = codes.astype(">u2" if bits == 16 else "u1").tobytes()
    stride = len(rows) // height
    # Each row begins with the number of its filter: none.
    data = b"".join(b"\0" + rows[i : i + stride] for i in range(0, len(rows), stride))
    color_type = PNG_COLOR_TYPES[channels] if palette is None else 3
    chunks = [(b"IHDR", struct.pack(">IIBBBBB", width, height, bits, color_type, 0, 0, 0))]
    chunks += [(name.encode(), content) for name, content in (more or {}).items()]
    if palette is not None:
        chunks.append((b"PLTE", palette.astype("u1").tobytes()))
    chunks += [(b"IDAT", zlib.compress(data) if stream is None else stream), (b"IEND", b"")]
    return b"\x89PNG\r\n\x1a\n" + b"".join(
        struct.pack(">I", len(content))
        + name
        + content
        + struct.pack(">I", zlib.crc32(name + content))
        for name, content in chunks
    )


def netpbm(codes: Codes, white: int, plain: bool = False) -> bytes:
    """A PGM of codes (H, W, 1), or a PPM of three channels, whose largest code is ``white``; plain ones are in text."""
    height, width, channels = codes.shape
    kind = (2 if plain else 5) + (channels == 3)
    head = f"P{kind} # of {white}\n# by hand\n{width} {height}\n{white}\n".encode()
    if plain:
        return head + "\n".join(map(str, codes.ravel())).encode() + b"\n"
    return head + codes.astype(">u2" if white > 255 else "u1").tobytes()


def radiance(
    codes: Codes,
    *,
    run_lengths: bool = True,
    magic: str = "#?RADIANCE",
    header: str = "",
    kind: str = "32-bit_rle_rgbe",
    size: str | None = None,
) -> bytes:
    """A Radiance picture of codes (H, W, 4): three mantissas and an exponent."""
    height, width = codes.shape[:2]
    start = f"{magic}\n{header}FORMAT={kind}\n\n{size or f'-Y {height} +X {width}'}\n"
    if not run_lengths:
        return start.encode() + codes.astype("u1").tobytes()
    return start.encode() + b"".join(_scanline(row.astype("u1")) for row in codes)


def radiance_values(codes: Codes) -> NDArray[np.float64]:
    """Linear values (H, W, 3) of such codes: mantissa / 256 * 2^(exponent - 128)."""
    return np.ldexp(codes[..., :3].astype(float), codes[..., 3:].astype(int) - 136)


def _scanline(row: NDArray[np.uint8]) -> bytes:
    """Channel after channel, runs as (128 + length, value), the rest as (length, values...)."""
    width = len(row)
    assert 8 <= width < 32768, "others aren't encoded like this"
    out = bytes((2, 2, width >> 8, width & 255))
    for channel in row.T:
        ends = np.flatnonzero(np.diff(channel.astype(int))) + 1
        for run in np.split(channel, ends):
            for i in range(0, len(run), 127):
                part = run[i : i + 127]
                out += bytes((1, part[0])) if len(part) == 1 else bytes((128 + len(part), part[0]))
    return out


EXR_TYPES = {np.dtype(np.uint32): 0, np.dtype(np.float16): 1, np.dtype(np.float32): 2}


def exr(
    channels: dict[str, NDArray[np.generic]],
    shift: tuple[int, int] = (0, 0),
    shown: tuple[int, int] | None = None,
    chromaticities: tuple[float, ...] | None = None,
    envmap: int | None = None,
) -> bytes:
    """An OpenEXR file of planes (H, W), not compressed; its data window is moved by shift from its display window.

    ``shown``: width and height of the display window; those of the planes if not given
    ``envmap``: 0 for a sky over longitude and latitude, 1 for six faces of a cube
    """
    channels = dict(sorted(channels.items()))
    height, width = next(iter(channels.values())).shape
    x, y = shift
    listed = b"".join(
        name.encode() + b"\0" + struct.pack("<iB3xii", EXR_TYPES[plane.dtype], 0, 1, 1)
        for name, plane in channels.items()
    )
    wide, high = shown or (width, height)
    display = struct.pack("<4i", 0, 0, wide - 1, high - 1)
    data = struct.pack("<4i", x, y, x + width - 1, y + height - 1)
    one = struct.pack("<f", 1)
    attributes = [
        ("channels", "chlist", listed + b"\0"),
        ("compression", "compression", b"\0"),
        ("dataWindow", "box2i", data),
        ("displayWindow", "box2i", display),
        ("lineOrder", "lineOrder", b"\0"),
        ("pixelAspectRatio", "float", one),
        ("screenWindowCenter", "v2f", struct.pack("<2f", 0, 0)),
        ("screenWindowWidth", "float", one),
    ]
    if chromaticities is not None:
        listed = struct.pack("<8f", *chromaticities)
        attributes.append(("chromaticities", "chromaticities", listed))
    if envmap is not None:
        attributes.append(("envmap", "envmap", bytes((envmap,))))
    head = struct.pack("<II", 20000630, 2)
    for name, kind, content in attributes:
        head += f"{name}\0{kind}\0".encode() + struct.pack("<i", len(content)) + content
    head += b"\0"
    lines = []
    for row in range(height):
        values = b"".join(plane[row].tobytes() for plane in channels.values())
        lines.append(struct.pack("<ii", y + row, len(values)) + values)
    first = len(head) + 8 * height
    offsets = np.cumsum([first, *(len(line) for line in lines[:-1])])
    return head + offsets.astype("<u8").tobytes() + b"".join(lines)


def exr_rgb(picture: Values) -> bytes:
    """An OpenEXR file of linear RGB (H, W, 3)."""
    planes = np.moveaxis(picture, -1, 0)
    return exr(
        {name: np.ascontiguousarray(plane) for name, plane in zip("RGB", planes, strict=True)}
    )
