"""A hierarchy of boxes by the surface area heuristic, built by loops that Numba compiles.

A node is divided where a ray is expected to meet the fewest boxes and triangles: the chance to meet a box is in
proportion to its surface (Goldsmith and Salmon, "Automatic creation of object hierarchies for ray tracing", 1987; in
bins along an axis by Wald, "On fast construction of SAH-based bounding volume hierarchies", 2007).

One array of float32 holds everything, so that a loop needs one address only:

- a header of 16 numbers, of which the first two are integers: the place of the triangles, and what the root is;
- inner nodes, 16 numbers each: lowest and highest corner of the first child and of the second, then what the two are,
  as integers: the place of an inner node, or -1 - (8 k + n) for a leaf of the n triangles from the k-th on;
- the triangles in the order of the leaves, 10 numbers each: three corners, then the triangle's number as an integer.
"""

from pathlib import Path

import numpy as np
from numba import njit, types

from course.engine.casters.older_loops import forget_older_loops

forget_older_loops(Path(__file__).parent)

HEADER, NODE, TRIANGLE = 16, 16, 10
LEAF = 4
"""Most triangles of a leaf."""
BINS = 16
"""Along an axis."""
DEEPEST = 40
"""Levels from which on nodes are halved: none lies deeper than this and the logarithm of the number of triangles."""

_OPTIONS = {"nogil": True, "cache": True, "error_model": "numpy"}
_BOXES = np.float32(1.2)
"""What two boxes cost, in tests of triangles."""
_FAR = np.float32(3e38)


@njit(**_OPTIONS)
def _surface(box):
    """Half the surface of a box (6,), lowest and highest corner."""
    x, y, z = box[3] - box[0], box[4] - box[1], box[5] - box[2]
    return x * y + y * z + z * x


@njit(**_OPTIONS)
def _empty(box):
    for c in range(3):
        box[c], box[3 + c] = _FAR, -_FAR


@njit(**_OPTIONS)
def _grow(box, other):
    for c in range(3):
        box[c] = min(box[c], other[c])
        box[3 + c] = max(box[3 + c], other[3 + c])


@njit(**_OPTIONS)
def _around(boxes, first, last, box, middles):
    """The box around boxes, and around twice their middles."""
    _empty(box)
    _empty(middles)
    for i in range(first, last):
        for c in range(3):
            low, high = boxes[i, c], boxes[i, 3 + c]
            box[c], box[3 + c] = min(box[c], low), max(box[3 + c], high)
            middles[c], middles[3 + c] = (
                min(middles[c], low + high),
                max(middles[3 + c], low + high),
            )


@njit(**_OPTIONS)
def _bin(boxes, i, axis, lowest, scale):
    return min(int((boxes[i, axis] + boxes[i, 3 + axis] - lowest) * scale), BINS - 1)


@njit(**_OPTIONS)
def _scale(middles, axis):
    return np.float32(0.9999 * BINS) / (middles[3 + axis] - middles[axis])


@njit(**_OPTIONS)
def _best(boxes, first, last, middles, bins, counts, right):
    """Least expected number of triangle tests, times half the surface; with the axis, -1 for none, and the bin."""
    best, best_axis, best_bin = _FAR, -1, 0
    box = bins[BINS]
    for axis in range(3):
        scale = _scale(middles, axis)
        if not 0 < scale < _FAR:
            continue
        for k in range(BINS):
            _empty(bins[k])
            counts[k] = 0
        for i in range(first, last):
            k = _bin(boxes, i, axis, middles[axis], scale)
            counts[k] += 1
            _grow(bins[k], boxes[i])
        _empty(box)
        for k in range(BINS - 1, 0, -1):
            _grow(box, bins[k])
            right[k] = _surface(box)
        _empty(box)
        count = 0
        for k in range(BINS - 1):
            _grow(box, bins[k])
            count += counts[k]
            if 0 < count < last - first:
                cost = _surface(box) * count + right[k + 1] * (last - first - count)
                if cost < best:
                    best, best_axis, best_bin = cost, axis, k
    return best, best_axis, best_bin


@njit(**_OPTIONS)
def _part(boxes, first, last, middles, axis, most):
    """Bring the boxes of the first bins to the front; where the others begin."""
    scale = _scale(middles, axis)
    i, j = first, last - 1
    while i <= j:
        if _bin(boxes, i, axis, middles[axis], scale) <= most:
            i += 1
        else:
            for c in range(7):
                boxes[i, c], boxes[j, c] = boxes[j, c], boxes[i, c]
            j -= 1
    return i


@njit(**_OPTIONS)
def _boxes(vertices, triangles):
    """Box and number of each triangle, (T, 7)."""
    boxes = np.empty((len(triangles), 7), np.float32)
    numbers = boxes.view(np.int32)
    for k in range(len(triangles)):
        for c in range(3):
            p0, p1 = vertices[triangles[k, 0], c], vertices[triangles[k, 1], c]
            p2 = vertices[triangles[k, 2], c]
            boxes[k, c], boxes[k, 3 + c] = min(p0, p1, p2), max(p0, p1, p2)
        numbers[k, 6] = k
    return boxes


@njit(types.float32[::1](types.float32[:, ::1], types.int32[:, ::1]), **_OPTIONS)
def build(vertices, triangles):
    """The hierarchy of vertices (V, 3) and triangles (T, 3), T > 0."""
    boxes, size = _boxes(vertices, triangles), len(triangles)
    nodes = np.empty((size, NODE), np.float32)
    codes = nodes.view(np.int32)
    bins, middles = np.empty((BINS + 1, 6), np.float32), np.empty(6, np.float32)
    box, counts, right = (
        np.empty(6, np.float32),
        np.empty(BINS, np.int64),
        np.empty(BINS, np.float32),
    )
    # Runs that are still to be divided: first, last, and of which node they are which child, at which level.
    waiting = np.empty((DEEPEST + 40, 5), np.int64)
    waiting[0], height, made, root = (0, size, -1, 0, 0), 1, 0, 0
    while height:
        height -= 1
        first, last, parent, side, level = waiting[height]
        _around(boxes, first, last, box, middles)
        axis, cost, most = -1, _FAR, 0
        if level < DEEPEST and last - first > 1:
            cost, axis, most = _best(boxes, first, last, middles, bins, counts, right)
        whole = _surface(box)
        if last - first <= LEAF and not cost + _BOXES * whole < whole * (last - first):
            code = -1 - (8 * first + last - first)
        else:
            half = first + (last - first) // 2
            if axis >= 0:
                half = _part(boxes, first, last, middles, axis, most)
            code = HEADER + made * NODE
            waiting[height] = first, half, made, 0, level + 1
            waiting[height + 1] = half, last, made, 1, level + 1
            height += 2
            made += 1
        if parent < 0:
            root = code
        else:
            nodes[parent, 6 * side : 6 * side + 6] = box
            codes[parent, 12 + side] = code
    start = HEADER + made * NODE
    memory = np.empty(start + size * TRIANGLE, np.float32)
    numbers, order = memory.view(np.int32), boxes.view(np.int32)
    numbers[0], numbers[1] = start, root
    memory[HEADER:start] = nodes[:made].ravel()
    for i in range(size):
        k, place = order[i, 6], start + i * TRIANGLE
        for j in range(3):
            for c in range(3):
                memory[place + 3 * j + c] = vertices[triangles[k, j], c]
        numbers[place + 9] = k
    return memory
