"""Where the fused loop keeps the numbers of sixteen paths: rows of 16 float32 in one array, and of 16 int32 in another.

Three packets of Embree's come first (``packet_kernels`` has their layout): the paths' rays, their shadow rays, and
those from a facet up to the round surface above it. All offsets are constants, so that the compiler sees which rows are
apart.
"""

from __future__ import annotations

from course.compiled.occlusion_kernels import ROWS
from course.compiled.packet_kernels import TFAR, TO, WIDTH

PACKET = ROWS * WIDTH
RAY, SHADOW, ABOVE = 0, PACKET, 2 * PACKET

_vectors = (3 * PACKET + 3 * WIDTH * number for number in range(9))
P, NG, NS, NEAR, POINT, THROUGHPUT, DIFFUSE, SPECULAR, START = _vectors
"""Point, normals, origin of leaving rays, and as a light sees it; throughput; sums of irradiance and highlights."""

_scalars = (3 * PACKET + (27 + number) * WIDTH for number in range(12))
OFFSET, SIDE, TIME, JITTER, _, U, _, _, INVERSE, FACTOR, COSINE, IRRADIANCE = _scalars
"""``JITTER`` has two rows, the samples' positions in their pixels, and ``U`` three of random numbers."""

ALL_ROWS = 3 * ROWS + 27 + 12 + 6
A, B, C, D, E, F = (3 * PACKET + (39 + number) * WIDTH for number in range(6))
"""Of no lasting meaning."""

HIT, ASKED, RAISED, OTHERS, MATERIAL, TRIANGLE, PATH, PIXEL, SAMPLE, MEDIUM, LEFT = (
    number * WIDTH for number in range(11)
)
"""Rows of integers: masks (-1 or 0), what is hit, and of each path its number, pixel, sample, medium, object left."""
ALL_INTEGERS = 11

SHADOW_TO, SHADOW_TFAR = SHADOW + TO, SHADOW + TFAR

NANOSECONDS, SHADOW_RAYS, SECOND_RAYS, REFLECTIONS, REFRACTIONS, HITS, GLOSSY = range(7)
"""What is counted: time inside Embree of the packets that are timed, rays, and hits that drew numbers."""
COUNTS = 7
