"""Direct light with what only some scenes have: the environment's light, and other renderers' conventions."""

from dataclasses import dataclass, replace

import numpy as np

from course.core.direct import Candidates, DirectLight
from course.core.hits import Hits
from course.core.rays import Draws
from course.core.types import Floats32, Indices
from course.core.vectors import dot
from course.extras.light_choice import WHERE, WHICH, LightChoice, some_of
from course.extras.other_highlights import Highlights


@dataclass(frozen=True)
class FullDirectLight(DirectLight):
    """Direct light that hits reflect.

    Attributes
    ----------
    highlights : by other models than Blinn's with the cosine; None if there are none
    choice : chooses one light for each hit; None if all lights send light to all hits
    """

    highlights: Highlights | None = None
    choice: LightChoice | None = None

    def _from_lights(
        self, hits: Hits, path: Indices | None, depth: int, draws: Draws
    ) -> tuple[Floats32 | None, Floats32 | None]:
        choice = self.choice
        if choice is None:
            return super()._from_lights(hits, path, depth, draws)
        u = draws(WHICH, path, depth)[0]
        places = draws(WHERE, path, depth) if choice.width else None
        diffuse: Floats32 | None = None
        specular: Floats32 | None = None
        for light, which in choice.groups(hits, u, places):
            stage = replace(self, lights=(light,), choice=None)
            if which is None:
                return stage._from_lights(hits, path, depth, draws)
            of = which if path is None else path.take(which)
            more = stage._from_lights(some_of(hits, which), of, depth, draws)
            diffuse = _spread(diffuse, more[0], which, hits.size)
            specular = _spread(specular, more[1], which, hits.size)
        return diffuse, specular

    def _highlight(self, hits: Hits, candidates: Candidates, irradiance: Floats32) -> Floats32:
        highlight = super()._highlight(hits, candidates, irradiance)
        models = self.highlights
        if models is None:
            return highlight
        material = candidates.of(hits.material)
        if models.others is not None:
            which = np.flatnonzero(models.others.take(material))
            to_light, direction = self._ways(hits, candidates)
            highlight[which] = irradiance.take(which) * models.factor(
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

    def _reflected(self, hits: Hits, diffuse: Floats32, specular: Floats32 | None) -> Floats32:
        return super()._reflected(hits, diffuse, self._painted(hits, specular))

    def _painted(self, hits: Hits, specular: Floats32 | None) -> Floats32 | None:
        """The sum of the highlights, times what textures say of them."""
        shine = getattr(hits, "shine", None)
        return specular if specular is None or shine is None else specular * shine

    def _accumulated(
        self,
        total: Floats32 | None,
        hits: Hits,
        candidates: Candidates,
        values: Floats32,
        color: Floats32,
    ) -> Floats32:
        values = self._under_facets(hits, candidates, values)
        return super()._accumulated(total, hits, candidates, values, color)

    def _under_facets(self, hits: Hits, candidates: Candidates, values: Floats32) -> Floats32:
        """Values (k,) of a sum: irradiance, which is the diffuse term's, less what facets over that reflect."""
        models = self.highlights
        if models is None or models.covers is None or values is not candidates.irradiance:
            return values
        return values * models.left(*self._ways(hits, candidates), candidates.of(hits.material))

    def _ways(self, hits: Hits, candidates: Candidates) -> tuple[Floats32, Floats32]:
        """Unit vectors to the light, (3, k) or (3, 1), and from the viewer, (3, k)."""
        to_light: Floats32 = candidates.to_light * candidates.inverse_length
        return to_light, candidates.of(hits.direction)


def _spread(
    total: Floats32 | None, values: Floats32 | None, which: Indices, n: int
) -> Floats32 | None:
    """The total (3, n) with values (3, m) at the hits ``which`` (m,); None stands for 0."""
    if values is None:
        return total
    total = np.zeros((3, n), np.float32) if total is None else total
    total[:, which] = values
    return total
