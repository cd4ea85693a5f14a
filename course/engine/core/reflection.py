"""What surfaces reflect of a light's samples: Lambert's diffuse term and Blinn-Phong's highlight."""

from dataclasses import dataclass

import numpy as np

from course.engine.core.direct import Candidates, Sums
from course.engine.core.hits import Hits
from course.engine.core.materials import Lookup, blinn_phong_highlight
from course.engine.core.types import Floats32


@dataclass(frozen=True)
class BlinnPhong:
    """See ``Reflection``: the sums are E / pi, and (n . h)^exponent E / pi.

    Attributes
    ----------
    diffuse : (3, M) reflectance
    specular, exponent : (3, M) and (M,) of the highlights; specular is None if no material has one
    """

    diffuse: Lookup
    specular: Lookup | None
    exponent: Lookup

    def add(self, sums: Sums, hits: Hits, candidates: Candidates, color: Floats32) -> Sums:
        """See ``Reflection``."""
        diffuse, specular = sums
        arriving = self.arriving(hits, candidates)
        diffuse = accumulated(diffuse, hits, candidates, arriving, color)
        if self.specular is not None:
            highlight = self.highlight(hits, candidates)
            specular = accumulated(specular, hits, candidates, highlight, color)
        return diffuse, specular

    def arriving(self, _hits: Hits, candidates: Candidates) -> Floats32:
        """Irradiance (k,) over pi of the diffuse term."""
        return candidates.irradiance

    def highlight(self, hits: Hits, candidates: Candidates) -> Floats32:
        """(n . h)^exponent times the irradiance, (k,)."""
        highlight = blinn_phong_highlight(
            candidates.to_light * candidates.inverse_length,
            candidates.of(hits.direction),
            candidates.of(hits.ns),
            self.exponent(candidates.of(hits.material)),
        )
        highlight *= candidates.irradiance
        return highlight

    def reflected(self, hits: Hits, sums: Sums) -> Floats32:
        """See ``Reflection``."""
        diffuse, specular = sums
        assert diffuse is not None
        diffuse *= self.diffuse(hits.material)
        if hits.tint is not None:
            diffuse *= hits.tint
        if specular is not None and self.specular is not None:
            specular *= self.specular(hits.material)
            diffuse += specular
        return diffuse


def accumulated(
    total: Floats32 | None, hits: Hits, candidates: Candidates, values: Floats32, color: Floats32
) -> Floats32:
    """Add values (k,) times a colour to the total (3, n) of all hits."""
    if candidates.columns is not None:
        spread = np.zeros(hits.size, np.float32)
        spread[candidates.columns] = values
        values = spread
    added: Floats32 = values * color[:, None]
    if total is None:
        return added
    total += added
    return total
