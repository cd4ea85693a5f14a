"""Direct light with what only some scenes have: the environment's light, and other renderers' conventions."""

from dataclasses import dataclass

import numpy as np

from course.core.direct import Candidates, DirectLight
from course.core.hits import Hits
from course.core.lights.sample import TO_THE_LIGHT, Light
from course.core.types import Floats32, Mask
from course.core.vectors import dot


@dataclass(frozen=True)
class FullDirectLight(DirectLight):
    """Direct light that hits reflect.

    Attributes
    ----------
    plain : (M,) bool, materials whose highlights lack the cosine in E; None if there are none
    lifted : true if rays start so far above surfaces that lights are sampled for the surface itself
    """

    plain: Mask | None = None
    lifted: bool = False

    def _points(self, hits: Hits, light: Light) -> Floats32:
        return (
            self._as_if_still(hits.p, hits, light) if self.lifted else super()._points(hits, light)
        )

    def _to_light(self, light: Light, hits: Hits, candidates: Candidates) -> Floats32:
        to_light = super()._to_light(light, hits, candidates)
        if self.lifted and light.limit <= TO_THE_LIGHT:
            # The light was sampled for the surface; the shadow ray starts above it.
            to_light = to_light + candidates.of(hits.p) - candidates.origin
        return to_light

    def _highlight(self, hits: Hits, candidates: Candidates, irradiance: Floats32) -> Floats32:
        highlight = super()._highlight(hits, candidates, irradiance)
        if self.plain is not None:
            cosine = dot(candidates.of(hits.ns), candidates.to_light) * candidates.inverse_length
            plain = self.plain.take(candidates.of(hits.material))
            highlight /= np.where(plain, np.maximum(cosine, np.float32(1e-20)), np.float32(1))
        return highlight
