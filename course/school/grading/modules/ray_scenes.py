"""Scenes that rays are sent through: triangles, a hierarchy of boxes around them, and rays to and past them."""

from collections.abc import Mapping
from typing import Any

import numpy as np

from course.engine.shapes import torus
from course.school.grading.checks.check import Array
from course.school.grading.checks.declare import Case
from course.school.grading.checks.drawing import Draw
from course.school.grading.checks.vectors import unit_vectors
from course.school.grading.modules.hierarchies import (
    Hierarchy,
    Vectors,
    balanced,
    boxes_around,
    chain,
    exact_hit,
    lopsided,
    one_leaf,
    spans,
)

WIDTH, HEIGHT = 56, 42
"""Of the picture whose rays are compared with Embree's."""

LAYERS = 64


def scene(p: Vectors, hierarchy: Hierarchy, o: Array, d: Array) -> dict[str, Any]:
    """Arguments of ``traverse``."""
    return {
        "hierarchy": hierarchy,
        **dict(zip(("p0", "p1", "p2"), p, strict=True)),
        "origins": o,
        "directions": d,
    }


def cloud(draw: Draw) -> Mapping[str, Any]:
    """Triangles anyhow in a cube in a hierarchy as bad as they come, and rays from a sphere around towards it."""
    triangles = int(draw.rng.choice((1, 2) if draw.simple else (1, 2, 7, 60)))
    middle = draw.uniform(-1, 1, 3, triangles)
    p0, p1, p2 = (draw.scale * (middle + draw.uniform(-1, 1, 3, triangles)) for _ in range(3))
    # Some without area.
    p2[:, 5::8] = p0[:, 5::8]
    o = 4 * draw.directions()
    d = draw.uniform(-1, 1, 3, draw.n) - o
    p = (p0, p1, p2)
    hierarchy = lopsided(draw.rng, *boxes_around(p))
    return scene(p, hierarchy, draw.scale * o, d / np.linalg.norm(d, axis=0))


def of_size(factor: float) -> Case:
    """The same, in scenes of another size."""
    return lambda draw: cloud(draw.but(scale=factor * draw.scale))


def one_triangle(draw: Draw) -> Mapping[str, Any]:
    """One triangle, and rays at and past it from either side, that begin near or far before or behind it."""
    a, b, normal = draw.frame()
    p0 = draw.uniform(-1, 1, 3)
    p: Vectors = tuple(draw.scale * v[:, None] for v in (p0, p0 + a, p0 + draw.number(0.5, 1) * b))  # type: ignore[assignment]
    weights = draw.rng.dirichlet((1, 1, 1), draw.n).T * 0.85 + 0.05
    # Past one edge, where of the other two coordinates both may be under 1.
    past = draw.rng.random(draw.n) < 0.3
    weights -= np.where(past, 2 * weights.min(axis=0), 0) * (weights == weights.min(axis=0)) * 1.5
    weights /= weights.sum(axis=0)
    cosine = draw.rng.uniform(0.3, 1, draw.n) * draw.rng.choice((-1, 1), draw.n)
    d = np.outer(normal, cosine) + np.outer(a, np.sqrt(1 - cosine**2))
    # In single precision origins are rounded more than the nearest are away.
    near = (1e-6, 1e-4, 1e-2) if draw.dtype is np.float64 else (1e-2,)
    t = draw.scale * draw.rng.choice((*near, 0.3, 3.0), draw.n)
    t *= np.where(draw.rng.random(draw.n) < 0.3, -1, 1)
    at = sum(w * c for w, c in zip(weights, p, strict=True))
    return scene(p, one_leaf(p), at - t * d, d * draw.rng.choice((0.5, 1.0, 2.0), draw.n))


def layers(draw: Draw, layers: int) -> tuple[Vectors, Array, Array]:
    """Large triangles one above the other, at z = 0, 1, 2, ..., in any order; rays through all, up and down."""
    z = draw.rng.permutation(layers).astype(float)
    p0, p1, p2 = (
        np.stack((np.full(layers, x), np.full(layers, y), z))
        for x, y in ((-50, -50), (50, -50), (0, 80))
    )
    d = np.concatenate((draw.uniform(-0.1, 0.1, 2, draw.n), np.ones((1, draw.n))))
    o = np.concatenate((draw.uniform(-5, 5, 2, draw.n), np.full((1, draw.n), -3.0)))
    o[2, ::2], d[2, ::2] = layers + 2, -1
    return (p0, p1, p2), o, d


def hidden(draw: Draw) -> Mapping[str, Any]:
    """Eight triangles before eight others; the boxes of the front ones have been carried away."""
    p, o, d = layers(draw, 16)
    o[2], d[2] = -3, 1
    lo, hi, *rest = balanced(*boxes_around(p), 4)
    front = hi[2] < 7.5
    lo[0, front] += 100
    hi[0, front] += 100
    hi[0, 0] += 100
    return scene(p, (lo, hi, *rest), o, d)  # type: ignore[arg-type]


def ordered(draw: Draw) -> Mapping[str, Any]:
    """Layers, one a leaf."""
    p, o, d = layers(draw, LAYERS)
    return scene(p, balanced(*boxes_around(p), 6), o, d)


DEEP = 120
"""Layers of a hierarchy that is as deep as it has triangles."""


def deep(draw: Draw) -> Mapping[str, Any]:
    """Layers that are split off one by one: for rays of one of both ways all farther ones wait."""
    p, o, d = layers(draw, DEEP)
    order = np.argsort(p[0][2] * draw.rng.choice((-1, 1)))
    return scene(p, chain(*boxes_around(p), order), o, d)


def two_heaps(draw: Draw) -> Mapping[str, Any]:
    """Twenty triangles at x = -10 and twenty at 10, in one leaf or in two; rays to both, between, and past all."""
    middle = draw.rng.uniform(-1, 1, (3, 20))
    heap = [middle + draw.rng.uniform(-0.5, 0.5, (3, 20)) for _ in range(3)]
    aside = np.array((10.0, 0, 0))[:, None]
    p: Vectors = tuple(np.concatenate((c - aside, c + aside), axis=1) for c in heap)  # type: ignore[assignment]
    o = np.array([(-10.0, 10, 0, 300), (0, 0, 0, 0), (-9, -9, -9, -9)])[:, np.arange(draw.n) % 4]
    one = draw.rng.random() < 0.5
    hierarchy = one_leaf(p) if one else balanced(*boxes_around(p), 1)
    return scene(p, hierarchy, o, np.array((0, 0, 1.0))[:, None].repeat(draw.n, axis=1))


def swarm(draw: Draw) -> Mapping[str, Any]:
    """Small triangles anywhere, in a hierarchy as bad as they come, and rays that hit none and graze no box."""
    triangles = int(draw.rng.integers(20, 60))
    middle = draw.rng.uniform(-1, 1, (3, triangles))
    p: Vectors = tuple(middle + draw.rng.uniform(-0.05, 0.05, middle.shape) for _ in range(3))  # type: ignore[assignment]
    hierarchy = lopsided(draw.rng, *boxes_around(p))
    o, d = np.zeros((2, 3, 0))
    while o.shape[1] < draw.n:
        some = 4 * unit_vectors(draw.rng, 4 * draw.n)
        way = draw.rng.uniform(-1, 1, some.shape) - some
        t, least, _ = exact_hit([c[:, :, None] for c in p], some[:, None], way[:, None])
        near, far = crossed(hierarchy, some, way)
        clear = ((least < -0.01) | ~np.isfinite(t)).all(axis=0)
        clear &= (np.abs(near - far) > 1e-3).all(axis=0)
        o, d = np.append(o, some[:, clear], axis=1), np.append(d, way[:, clear], axis=1)
    d *= draw.rng.choice((0.1, 1.0, 10.0), d.shape[1])
    return scene(p, hierarchy, o[:, : draw.n], d[:, : draw.n])


def crossed(hierarchy: Hierarchy, o: Array, d: Array) -> tuple[Array, Array]:
    """Where each of N lines enters and leaves each of M boxes, (M, N) each."""
    lo, hi = (corner[:, :, None] for corner in hierarchy[:2])
    return spans(lo, hi, o[:, None], d[:, None])


def counted(draw: Draw) -> Mapping[str, Any]:
    """Two heaps, or a swarm."""
    return two_heaps(draw) if draw.rng.random() < 0.5 else swarm(draw)


def camera(rng: np.random.Generator) -> tuple[Array, Array]:
    """Rays of a pinhole camera that looks at the origin from anywhere."""
    right, up, forward = (row[:, None] for row in Draw(rng, 1).frame())
    x, y = np.meshgrid(np.linspace(-0.6, 0.6, WIDTH), np.linspace(0.45, -0.45, HEIGHT))
    d = forward + x.ravel() * right + y.ravel() * up
    d /= np.linalg.norm(d, axis=0)
    return np.repeat(-3.2 * forward, d.shape[1], axis=1).astype(np.float32), d.astype(np.float32)


def torus_of(segments: int, sides: int) -> tuple[Array, Array, Vectors]:
    """Vertices (V, 3), faces (T, 3), and the triangles' corners, in single precision."""
    mesh = torus(radius=1.0, tube=0.4, segments=segments, sides=sides)
    vertices, faces = mesh.vertices.astype(np.float32), mesh.triangles.astype(np.int32)
    p0, p1, p2 = (np.ascontiguousarray(vertices[faces[:, k]].T) for k in range(3))
    return vertices, faces, (p0, p1, p2)
