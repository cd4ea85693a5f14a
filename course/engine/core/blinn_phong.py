"""What surfaces reflect of a light's samples: Lambert's diffuse term and Blinn-Phong's highlight."""

from dataclasses import dataclass

import numpy as np

from course.engine.core.direct import Candidates, Sums
from course.engine.core.hits import Hits
from course.engine.core.materials import Lookup
from course.engine.core.types import Floats32
from course.engine.core.vectors import dot


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


def blinn_phong_highlight(
    to_light: Floats32, direction: Floats32, normal: Floats32, exponent: Floats32
) -> Floats32:
    """(n . h)^exponent, (k,), with h the half vector of the directions to the light and to the viewer.

    The vectors are (3, k) float32 and of unit length: to the light, from the viewer, and the normal. ``exponent`` is
    (k,) or (1,) float32. (J. Blinn, "Models of light reflection for computer synthesized pictures", 1977.)
    """
    half = to_light - direction
    squared = dot(half, half)
    cosine = dot(half, normal)
    cosine /= np.sqrt(np.maximum(squared, np.float32(1e-12)))
    # NumPy's exp and log are ten times faster than `power`. With exponents of at least 1 the clamped power is
    # negligible. With 0 it is 1 everywhere. Between 0 and 1 a faint highlight stays where n . h <= 0.
    np.clip(cosine, np.float32(1e-6), 1, out=cosine)
    np.log(cosine, out=cosine)
    cosine *= exponent
    return np.exp(cosine, out=cosine)
