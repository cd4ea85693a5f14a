"""Where the fused loop keeps the numbers of a packet's paths: rows of WIDTH float32 in one array, and of as many int32.

Three packets of Embree's come first (``packet_kernels`` has their layout): the paths' rays, their shadow rays, and
those from a facet up to the round surface above it. All offsets are constants, so that the compiler sees which rows are
apart.
"""

from course.engine.loops.occlusion_kernels import ROWS
from course.engine.loops.packet_kernels import TFAR, TO, WIDTH
from course.engine.terms.lights.mesh_groups import GROUPS

PACKET = ROWS * WIDTH
RAY, SHADOW, ABOVE = 0, PACKET, 2 * PACKET

_FIRST = 3 * PACKET
_vectors = (_FIRST + 3 * WIDTH * number for number in range(12))
P, NG, NS, NEAR, POINT, THROUGHPUT, DIFFUSE, SPECULAR, START, AFTER, DIRECTION, U = _vectors
"""Point, normals, origin of leaving rays, and as a light sees it; throughput; sums of irradiance and highlights; where
the ray has left the last surface; throughput and direction of the next ray; random numbers."""

_scalars = (_FIRST + (36 + number) * WIDTH for number in range(16))
OFFSET, SIDE, TIME, INVERSE, FACTOR, COSINE, IRRADIANCE, JITTER, _, A, B, C, D, E, F, SHARE = (
    _scalars
)
"""Of hits and lights; the samples' positions in their pixels, two rows; rows of no lasting meaning; and of ``fresnel``
the reflectance, behind which BENT and ETA have the cosine and the ratio of indices."""
BENT, ETA = SHARE + WIDTH, SHARE + 2 * WIDTH
PLANE, EDGES, CORNERS = (_FIRST + (54 + number) * WIDTH for number in (0, 8, 15))
"""Columns of the hit triangles in ``Triangles``."""
CUBE, OWNER, KNOWN = (_FIRST + (78 + number) * WIDTH for number in range(3))
"""Integers: the halves of the key of each hit's cell, and a mask of shadow rays that a shaft may tell of."""
TINT, WEIGHTS, PLACE = (_FIRST + (81 + number) * WIDTH for number in (0, 3, 6))
"""Colours of textures, barycentrics, and three places in a picture, two rows each."""
STRENGTH = _FIRST + 93 * WIDTH
"""What each group of a light of triangles sends to a point."""
ALL_ROWS = 3 * ROWS + 54 + 39 + -(-GROUPS // WIDTH)

_integers = (number * WIDTH for number in range(15))
(
    HIT,
    ASKED,
    RAISED,
    OTHERS,
    MATERIAL,
    TRIANGLE,
    PATH,
    PIXEL,
    SAMPLE,
    MEDIUM,
    LEFT,
    KEPT,
    LIT,
    WAY,
    SENT,
) = _integers
"""Rows of integers: masks (-1 or 0), what is hit, and of each path its number, pixel, sample, medium, object left;
whether light from lamps and the environment counts; the way that a path takes; and shadow rays that are
sent."""
ALL_INTEGERS = 15

SHADOW_TO, SHADOW_TFAR = SHADOW + TO, SHADOW + TFAR

_counts = range(13)
NANOSECONDS, SHADOW_RAYS, SECOND_RAYS, REFLECTIONS, REFRACTIONS, HITS, GLOSSY, SKY, *_more = _counts
PATHS, BOUNCES, CHOICES, CLEAR, CUT_OFF = _more
"""What is counted: time inside Embree of packets that are timed, rays, hits, numbers of gloss, hits under the sky; rays
of paths, those that leave diffuse surfaces, and numbers by which ways are chosen; shadow rays that shafts spare."""
COUNTS = len(_counts)
