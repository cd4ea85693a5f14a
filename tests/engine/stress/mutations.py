"""Files with something wrong in them: a few changes, of bytes, numbers, lines or parts, drawn by a number."""

import re
import struct
from collections.abc import Sequence

import numpy as np

from tests.engine.stress.file_kinds import Kind

NUMBERS = (
    *(b"0", b"-1", b"1", b"2", b"3", b"255", b"65536", b"2147483647", b"2147483648", b"4294967295"),
    *(b"18446744073709551616", b"-9223372036854775809", b"1" * 400, b"1e308", b"1e-320", b"-1e999"),
    *(b"nan", b"inf", b"0.5", b"1.5e", b"--1", b"0x10", b"1_000", b"", b"\xd9\xa3"),
)
"""What takes the place of a number in a text."""

WORDS = (
    *(0, 1, 2, 3, 0x7F, 0x80, 0xFF, 0x7FFF, 0x8000, 0xFFFF, 0x10000, 0x7FFFFFFF, 0x80000000),
    *(0xFFFFFFFF, 0x7F800000, 0x7FC00000),
)
"""What takes the place of four bytes: the largest counts, infinity, NaN."""

LONGEST = 1 << 18
"""Bytes of a mutated file."""


def mutated(kind: Kind, number: int, others: Sequence[bytes]) -> bytes:
    """The mutated file of a kind and a number, always the same; ``others`` are files of which parts may get into it."""
    rng = np.random.default_rng([number, *kind.name.encode()])

    def change(content: bytes) -> bytes:
        # The changes of one number are the same, however often they are asked for.
        own = np.random.default_rng([number, 1])
        for _ in range(1 + own.geometric(0.5)):
            content = _changed(content, own, others)[:LONGEST]
        return content

    if number == 0:
        return b""
    # Half of the changes go beneath what hides them from the reader's insides.
    return kind.inside(kind.content, change) if rng.random() < 0.5 else change(kind.content)


def _changed(content: bytes, rng: np.random.Generator, others: Sequence[bytes]) -> bytes:
    if not content:
        return bytes(rng.integers(0, 256, 8).tolist())
    a, b = sorted(rng.integers(0, len(content) + 1, 2).tolist())
    short = min(b, a + int(rng.integers(1, 17)))
    match rng.integers(0, 12):
        case 0:
            place = int(rng.integers(len(content)))
            flipped = content[place] ^ (1 << int(rng.integers(8)))
            return content[:place] + bytes((flipped,)) + content[place + 1 :]
        case 1:
            new = rng.choice([0, 255, 10, 32, 45, int(rng.integers(256))], short - a)
            return content[:a] + bytes(new.tolist()) + content[short:]
        case 2:
            return content[:a]
        case 3:
            return content[:a] + content[short:]
        case 4:
            return content[:a] + content[b:]
        case 5:
            return content[:b] + content[a:b] * int(rng.integers(1, 4)) + content[b:]
        case 6:
            return (
                content[:short] + content[a:short] * int(rng.integers(50, 3000)) + content[short:]
            )
        case 7:
            order = rng.choice(["<I", ">I", "<H", ">H"])
            word = struct.pack(
                order, int(rng.choice(WORDS)) & (0xFFFFFFFF if "I" in order else 0xFFFF)
            )
            return content[:a] + word + content[a + len(word) :]
        case 8 | 9:
            return _with_another_number(content, rng)
        case 10:
            return _with_another_line(content, rng)
        case _:
            other = others[int(rng.integers(len(others)))]
            c, d = sorted(rng.integers(0, len(other) + 1, 2).tolist())
            return content[:a] + other[c:d] + content[short:]


def _with_another_number(content: bytes, rng: np.random.Generator) -> bytes:
    found = list(re.finditer(rb"-?\d+(?:\.\d*)?(?:e-?\d+)?", content))
    if not found:
        return content[:-1]
    chosen = found[int(rng.integers(len(found)))]
    new = NUMBERS[int(rng.integers(len(NUMBERS)))]
    return content[: chosen.start()] + new + content[chosen.end() :]


def _with_another_line(content: bytes, rng: np.random.Generator) -> bytes:
    """One line left out, doubled, or moved to another place."""
    lines = content.split(b"\n")
    chosen = int(rng.integers(len(lines)))
    line = lines.pop(chosen) if rng.random() < 0.7 else lines[chosen]
    if rng.random() < 0.7:
        lines.insert(int(rng.integers(len(lines) + 1)), line)
    return b"\n".join(lines)
