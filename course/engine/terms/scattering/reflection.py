"""Reflection with what only some scenes have: highlights by other models, and textures of highlights."""

from dataclasses import dataclass

import numpy as np

from course.engine.core.blinn_phong import BlinnPhong
from course.engine.core.direct import Candidates, Sums
from course.engine.core.hits import Hits
from course.engine.core.types import Floats32, Mask
from course.engine.core.vectors import dot
from course.engine.terms.scattering.highlight import Highlight


@dataclass(frozen=True)
class FullReflection(BlinnPhong):
    """See ``Reflection``.

    Attributes
    ----------
    highlights : by other models than Blinn's
    plain : (M,) bool, materials whose highlights lack the cosine in E; None if there are none
    """

    highlights: tuple[Highlight, ...] = ()
    plain: Mask | None = None

    def arriving(self, hits: Hits, candidates: Candidates) -> Floats32:
        """See ``BlinnPhong``; less what highlights over the diffuse term reflect."""
        irradiance = candidates.irradiance
        if not self.highlights:
            return irradiance
        ways, material = _ways(hits, candidates), candidates.of(hits.material)
        for model in self.highlights:
            left = model.left(*ways, material)
            if left is not None:
                irradiance = irradiance * left
        return irradiance

    def highlight(self, hits: Hits, candidates: Candidates) -> Floats32:
        """See ``BlinnPhong``."""
        highlight = super().highlight(hits, candidates)
        material = candidates.of(hits.material)
        if self.highlights:
            to_light, direction = _ways(hits, candidates)
        for model in self.highlights:
            which = np.flatnonzero(model.materials.take(material))
            highlight[which] = candidates.irradiance.take(which) * model.factor(
                to_light if to_light.shape[1] == 1 else to_light.take(which, axis=1),
                direction.take(which, axis=1),
                candidates.of(hits.ns).take(which, axis=1),
                self.exponent(material.take(which)),
                material.take(which),
            )
        if self.plain is not None:
            cosine = dot(candidates.of(hits.ns), candidates.to_light) * candidates.inverse_length
            plain = self.plain.take(material)
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
