"""Hits on a coarse sphere, whose normals are far from those of its facets, for tests of compiled loops."""

from dataclasses import replace

import numpy as np

from course.engine import shapes
from course.engine.core.accelerator import Intersections
from course.engine.core.hits import Hits
from course.engine.terms.surfaces.surface import FullPart, build_surface


def hits_on_a_coarse_sphere(count: int, materials: int, seed: int) -> Hits:
    """From within and from outside, of so many materials; some arrive along the surface, and some normals are bent."""
    surface = build_surface([FullPart(shapes.sphere(0.9, 12), 3)])
    rng = np.random.default_rng(seed)
    triangle = rng.integers(len(surface.triangles.material), size=count).astype(np.int32)
    u, v = rng.random((2, count), np.float32) * np.float32(0.5)
    direction = rng.normal(size=(3, count))
    direction /= np.linalg.norm(direction, axis=0)
    found = Intersections(triangle, u, v, np.ones(count, np.float32))
    hits = surface.hits(found, direction.astype(np.float32))
    return replace(hits, material=rng.integers(materials, size=count).astype(np.uint16))
