"""Hits on the inside of glass, which shows no ambient light and scatters none; direct light leaves it out by itself."""

from __future__ import annotations

import numpy as np

from course.core.types import Indices
from course.geometry.hits import Hits
from course.transport.plan import Lookups, Plan


def insides(plan: Plan, lookups: Lookups, hits: Hits) -> Indices:
    """Which hits are on the inside of a dielectric; none where none of them would show anything."""
    if not plan.dark_insides:
        return np.empty(0, np.intp)
    dielectric = lookups.refraction_index.rows > 0
    return np.flatnonzero(~hits.entering & dielectric.take(hits.material))
