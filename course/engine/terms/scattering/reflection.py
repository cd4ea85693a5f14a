"""Reflection with what only some scenes have: highlights by other models, and textures of highlights."""

from dataclasses import dataclass

import numpy as np

from course.engine.core.direct import Candidates, Sums
from course.engine.core.hits import Hits
from course.engine.core.reflection import BlinnPhong
from course.engine.core.types import Floats32
from course.engine.core.vectors import dot
from course.engine.terms.scattering.other_highlights import Highlights


@dataclass(frozen=True)
class FullReflection(BlinnPhong):
    """See ``Reflection``.

    ``highlights`` : by other models than Blinn's with the cosine; None if there are none
    """

    highlights: Highlights | None = None

    def arriving(self, hits: Hits, candidates: Candidates) -> Floats32:
        """See ``BlinnPhong``; less what facets over the diffuse term reflect."""
        models, irradiance = self.highlights, candidates.irradiance
        if models is None or models.covers is None:
            return irradiance
        return irradiance * models.left(*_ways(hits, candidates), candidates.of(hits.material))

    def highlight(self, hits: Hits, candidates: Candidates) -> Floats32:
        """See ``BlinnPhong``."""
        highlight = super().highlight(hits, candidates)
        models = self.highlights
        if models is None:
            return highlight
        material = candidates.of(hits.material)
        if models.others is not None:
            which = np.flatnonzero(models.others.take(material))
            to_light, direction = _ways(hits, candidates)
            highlight[which] = candidates.irradiance.take(which) * models.factor(
                to_light if to_light.shape[1] == 1 else to_light.take(which, axis=1),
                direction.take(which, axis=1),
                candidates.of(hits.ns).take(which, axis=1),
                self.exponent(material.take(which)),
                material.take(which),
            )
        if models.plain.any():
            cosine = dot(candidates.of(hits.ns), candidates.to_light) * candidates.inverse_length
            plain = models.plain.take(material)
            highlight /= np.where(plain, np.maximum(cosine, np.float32(1e-20)), np.float32(1))
        return highlight

    def reflected(self, hits: Hits, sums: Sums) -> Floats32:
        """See ``Reflection``."""
        diffuse, specular = sums
        shine = getattr(hits, "shine", None)
        if specular is not None and shine is not None:
            specular = specular * shine
        return super().reflected(hits, (diffuse, specular))


def _ways(hits: Hits, candidates: Candidates) -> tuple[Floats32, Floats32]:
    """Unit vectors to the light, (3, k) or (3, 1), and from the viewer, (3, k)."""
    to_light: Floats32 = candidates.to_light * candidates.inverse_length
    return to_light, candidates.of(hits.direction)
