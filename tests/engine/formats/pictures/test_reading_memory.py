"""What a picture takes while it is read: measured as the most memory of a process of its own."""

import struct
import sys
import zlib
from pathlib import Path

import pytest

from tests.processes import python

ROOT = Path(__file__).parents[4]
SIDE = 4000

PROGRAM = """
import sys
from pathlib import Path
from course.engine.formats.pictures.reading import read_picture

def peak():
    rows = Path("/proc/self/status").read_text().splitlines()
    return next(int(row.split()[1]) * 1024 for row in rows if row.startswith("VmHWM"))

# The libraries are loaded by a picture of one pixel.
read_picture(Path(sys.argv[1]))
before = peak()
picture = read_picture(Path(sys.argv[2]))
print((peak() - before) / picture.nbytes)
"""


def black_png(path: Path, side: int, channels: int, bits: int) -> Path:
    """A PNG of a side's pixels squared, all 0, of which no array is made here."""

    def chunk(kind: bytes, data: bytes) -> bytes:
        return (
            struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
        )

    squeeze = zlib.compressobj(1)
    row = bytes(1 + side * channels * bits // 8)
    data = b"".join([*(squeeze.compress(row) for _ in range(side)), squeeze.flush()])
    color = {1: 0, 3: 2, 4: 6}[channels]
    size = struct.pack(">IIBBBBB", side, side, bits, color, 0, 0, 0)
    path.write_bytes(
        b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", size) + chunk(b"IDAT", data) + chunk(b"IEND", b"")
    )
    return path


@pytest.mark.parametrize(("channels", "bits"), [(1, 8), (3, 8), (4, 8), (3, 16)])
def test_reading_takes_less_than_twice_the_picture(
    tmp_path: Path, channels: int, bits: int
) -> None:
    if sys.platform != "linux":
        pytest.skip("only Linux tells the most memory that a process has had")
    small = black_png(tmp_path / "small.png", 1, channels, bits)
    large = black_png(tmp_path / "large.png", SIDE, channels, bits)
    done = python("-c", PROGRAM, small, large)
    # At least the picture itself; its codes are 1/12 to 1/3 of it, and strips of them take as much here.
    assert 1 <= float(done.stdout) < 2
