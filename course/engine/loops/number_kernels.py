"""Random numbers and camera rays of a packet's paths, compiled by Numba; parts of the fused loop."""

from typing import NamedTuple

import numpy as np
from llvmlite import ir
from numba import types
from numba.core import cgutils
from numba.extending import intrinsic
from numpy.typing import NDArray

from course.engine.core.types import Floats32, Words
from course.engine.loops import numpy_kernels
from course.engine.loops.lanes import JITTER, PATH, PIXEL, SAMPLE, TIME, A, B, C, U
from course.engine.loops.options import LEAN, njit
from course.engine.loops.packet_kernels import TO, WIDTH
from course.engine.terms.samplers.hashing import FIRST, GOLDEN, SECOND
from course.engine.terms.samplers.sobol import TO_UNIT

_GOLDEN, _FIRST, _SECOND = np.uint64(GOLDEN), np.uint64(FIRST), np.uint64(SECOND)
_BITS, _MORE_BITS, _HALF = np.uint64(30), np.uint64(27), np.uint64(32)
_BYTE = np.uint32(8)
_ONE, _NOTHING = np.float32(1), np.float32(0)
TURN = np.float32(2 * np.pi)


class Numbers(NamedTuple):
    """Numbers of a block's paths: Sobol's are computed, those of other samplers are drawn before, as arrays.

    Attributes
    ----------
    pixels : (n,) uint32 of the block
    x, y : (n,) float32 their corners
    samples : of each pixel
    points, first, salts : see ``SobolSampler.tables``; of no meaning where ``drawn`` has columns
    drawn : (d, n * samples) float32, by dimension; (0, 0) for Sobol's
    seen : (9, n * samples) float32, camera rays that functions of others have made: origin, direction, time, and
        position in the pixel; (9, 0) where the loop makes them
    placed : (r, n * samples) float32, points on lights that functions of others have placed, three rows for each such
        light and depth; (0, 0) for none
    """

    pixels: Words
    x: Floats32
    y: Floats32
    samples: int
    points: Words
    first: int
    salts: NDArray[np.uint64]
    drawn: Floats32
    seen: Floats32
    placed: Floats32


class Eye(NamedTuple):
    """The camera.

    Attributes
    ----------
    frame : (8, 3) float32, origin, right, up, forward, corner, step_x, step_y and velocity
    lens : (3,) float32, radius of the aperture, 0 for a pinhole, distance of the focus, and of the near plane
    lens_pair, time_pair : dimensions, by pairs; -1 for none
    moves : 1 if the velocity isn't 0
    """

    frame: Floats32
    lens: Floats32
    lens_pair: int
    time_pair: int
    moves: int


@njit(**LEAN)
def hashed(key, salt):
    """``course.engine.terms.samplers.hashing.hash_words`` of one key and one salt."""
    state = np.uint64(key) * _GOLDEN + salt
    state = (state ^ (state >> _BITS)) * _FIRST
    state = (state ^ (state >> _MORE_BITS)) * _SECOND
    return np.uint32(state >> _HALF)


@njit(**LEAN)
def find_pixels(whole, samples):
    """Fill pixel and sample of each path; true if all are of one pixel."""
    begin = end = pixel = np.int64(0)
    same = True
    for i in range(WIDTH):
        path = np.int64(whole[PATH + i])
        if not begin <= path < end:
            pixel = path // samples
            begin = pixel * samples
            end = begin + samples
        whole[PIXEL + i] = pixel
        whole[SAMPLE + i] = path - begin
        same &= pixel == np.int64(whole[PIXEL])
    return same


@intrinsic
def _ask_for(_context, _address):
    """Tell the processor that the memory at an address will be read soon (LLVM's ``llvm.prefetch``)."""

    def generate(_target, builder, _signature, arguments):
        pointer, number = ir.PointerType(ir.IntType(8)), ir.IntType(32)
        function_type = ir.FunctionType(ir.VoidType(), [pointer, number, number, number])
        ask = cgutils.get_or_insert_function(builder.module, function_type, "llvm.prefetch.p0")
        # To be read, into all caches, as data.
        place = builder.inttoptr(arguments[0], pointer)
        builder.call(ask, [place, number(0), number(3), number(1)])

    return types.void(types.uintp), generate


@njit(**LEAN)
def ask_for_next(numbers, path, pairs):
    """Ask for the points that a packet's paths from here will draw of the first pairs, while others are being followed.

    The table is larger than the second-level cache, and each pixel has another row of it: without this each draw waits
    for memory.
    """
    points, salts = numbers.points, numbers.salts
    orders, samples = np.uint32(points.shape[1]), np.uint64(numbers.samples)
    end = np.uint64(min(path + WIDTH, len(numbers.pixels) * numbers.samples))
    begin = np.uint64(path)
    while begin < end:
        pixel = begin // samples
        sample = begin - pixel * samples
        key = numbers.pixels[pixel]
        for pair in range(pairs):
            order = np.uint64(hashed(key, salts[pair, 0]) % orders)
            line = 2 * pair if pair < 2 else 0
            for row in range(line, line + 2):
                _ask_for(points[row, order, np.uint64(numbers.first) + sample :].ctypes.data)
        begin = (pixel + np.uint64(1)) * samples


@njit(**LEAN)
def _unit(word):
    return np.float32(np.int32(word >> _BYTE)) * TO_UNIT


@njit(**LEAN)
def _draw_row(numbers, line, order, scramble, i, whole):
    # Unsigned, so that nobody looks whether an index counts from the end.
    place = np.uint64(numbers.first) + np.uint64(whole[SAMPLE + i])
    return _unit(numbers.points[np.uint64(line), order, place] ^ scramble)


@njit(**LEAN)
def _draw_next(points, first, scramble, s, row):
    """The numbers of a packet's samples that follow each other."""
    for i in range(WIDTH):
        s[row + i] = _unit(points[first + np.uint64(i)] ^ scramble)


@njit(**LEAN)
def alike(row, whole):
    """True if a row of integers has one value."""
    same = True
    for i in range(1, WIDTH):
        same &= whole[row + i] == whole[row]
    return same


@njit(**LEAN)
def consecutive(row, whole):
    """True if the integers of a row follow each other."""
    follow = True
    for i in range(1, WIDTH):
        follow &= whole[row + i] == whole[row] + i
    return follow


@njit(**LEAN)
def take(columns, first, count, s, whole, row):
    """Rows of some columns, of each path its own."""
    for k in range(count):
        for i in range(WIDTH):
            s[row + k * WIDTH + i] = columns[first + k, np.uint64(whole[PATH + i])]


@njit(**LEAN)
def draw(numbers, pair, width, same, s, whole, row):
    """The numbers of a pair of dimensions into one row, or two; see ``SobolSampler``."""
    if len(numbers.drawn):
        take(numbers.drawn, 2 * pair, width, s, whole, row)
        return
    salts, orders = numbers.salts, np.uint32(numbers.points.shape[1])
    line = 2 * pair if pair < 2 else 0
    pixel = np.int32(-1)
    order, one, two = np.uint64(0), np.uint32(0), np.uint32(0)
    if same and consecutive(SAMPLE, whole):
        key = numbers.pixels[whole[PIXEL]]
        order = np.uint64(hashed(key, salts[pair, 0]) % orders)
        first = np.uint64(numbers.first + whole[SAMPLE])
        one = hashed(key, salts[pair, 1])
        _draw_next(numbers.points[line, order], first, one, s, row)
        if width > 1:
            two = hashed(key, salts[pair, 2])
            _draw_next(numbers.points[line + 1, order], first, two, s, row + WIDTH)
        return
    for i in range(WIDTH):
        if whole[PIXEL + i] != pixel:
            pixel = whole[PIXEL + i]
            key = numbers.pixels[np.uint64(pixel)]
            order = np.uint64(hashed(key, salts[pair, 0]) % orders)
            one = hashed(key, salts[pair, 1])
            if width > 1:
                two = hashed(key, salts[pair, 2])
        s[row + i] = _draw_row(numbers, line, order, one, i, whole)
        if width > 1:
            s[row + WIDTH + i] = _draw_row(numbers, line + 1, order, two, i, whole)


@njit(**LEAN)
def circle(call, s, turns):
    """Cosine and sine of a row of shares of a turn, into A and B."""
    for i in range(WIDTH):
        s[C + i] = TURN * s[turns + i]
    numpy_kernels.cos(call, s[C : C + WIDTH], s[A : A + WIDTH])
    numpy_kernels.sin(call, s[C : C + WIDTH], s[B : B + WIDTH])


@njit(**LEAN)
def look(numbers, eye, same, call, s, whole):
    """The rays of ``course.engine.core.camera``, with the functions of ``thin_lens``, and the paths' times."""
    if numbers.seen.shape[1]:
        take(numbers.seen, 0, 3, s, whole, 0)
        take(numbers.seen, 3, 3, s, whole, TO)
        take(numbers.seen, 6, 1, s, whole, TIME)
        take(numbers.seen, 7, 2, s, whole, JITTER)
        return
    frame = eye.frame
    draw(numbers, 0, 2, same, s, whole, JITTER)
    for i in range(WIDTH):
        pixel = whole[PIXEL + i]
        s[A + i] = numbers.x[pixel] + s[JITTER + i]
        s[B + i] = numbers.y[pixel] + s[JITTER + WIDTH + i]
    for i in range(WIDTH):
        x = frame[5, 0] * s[A + i] + frame[4, 0] + frame[6, 0] * s[B + i]
        y = frame[5, 1] * s[A + i] + frame[4, 1] + frame[6, 1] * s[B + i]
        z = frame[5, 2] * s[A + i] + frame[4, 2] + frame[6, 2] * s[B + i]
        scale = _ONE / np.sqrt(x * x + y * y + z * z)
        s[TO + i], s[TO + WIDTH + i], s[TO + 2 * WIDTH + i] = x * scale, y * scale, z * scale
        s[i], s[WIDTH + i], s[2 * WIDTH + i] = frame[0, 0], frame[0, 1], frame[0, 2]
    if eye.time_pair >= 0:
        draw(numbers, eye.time_pair, 1, same, s, whole, TIME)
    if eye.lens_pair >= 0:
        _through_lens(numbers, eye, same, call, s, whole)
    if eye.moves:
        for c in range(3):
            for i in range(WIDTH):
                s[c * WIDTH + i] += frame[7, c] * s[TIME + i]
    if eye.lens[2] != 0:
        for i in range(WIDTH):
            x, y, z = s[TO + i], s[TO + WIDTH + i], s[TO + 2 * WIDTH + i]
            forwards = _NOTHING + frame[3, 0] * x + frame[3, 1] * y + frame[3, 2] * z
            distance = eye.lens[2] / max(forwards, np.float32(1e-12))
            s[i] += x * distance
            s[WIDTH + i] += y * distance
            s[2 * WIDTH + i] += z * distance


@njit(**LEAN)
def _through_lens(numbers, eye, same, call, s, whole):
    frame, radius, focus = eye.frame, eye.lens[0], eye.lens[1]
    draw(numbers, eye.lens_pair, 2, same, s, whole, U)
    circle(call, s, U + WIDTH)
    for i in range(WIDTH):
        r = np.sqrt(s[U + i])
        a, b = r * s[A + i] * radius, r * s[B + i] * radius
        x, y, z = s[TO + i], s[TO + WIDTH + i], s[TO + 2 * WIDTH + i]
        far = focus / (frame[3, 0] * x + frame[3, 1] * y + frame[3, 2] * z)
        ox = frame[1, 0] * a + frame[2, 0] * b
        oy = frame[1, 1] * a + frame[2, 1] * b
        oz = frame[1, 2] * a + frame[2, 2] * b
        x, y, z = x * far - ox, y * far - oy, z * far - oz
        length = np.sqrt(x * x + y * y + z * z)
        s[TO + i], s[TO + WIDTH + i], s[TO + 2 * WIDTH + i] = x / length, y / length, z / length
        s[i] += ox
        s[WIDTH + i] += oy
        s[2 * WIDTH + i] += oz
