"""Fog around an integrator: what a plan becomes where a scene has media."""

from dataclasses import dataclass, fields, replace

from course.engine.core.integrator import Integrator
from course.engine.terms.media.fog import Fogs
from course.engine.terms.media.lamps import Lamps
from course.engine.terms.media.single import PLACE, FogIntegrator
from course.engine.terms.media.through import through_fog
from course.engine.terms.media.walk import FLIGHT, FogPathIntegrator
from course.engine.terms.paths.path_tracing import PathIntegrator


@dataclass(frozen=True)
class MediaStage:
    """See ``Wrap`` in ``course.engine.terms.world``."""

    fogs: Fogs
    lamps: Lamps

    def numbers(self, paths: bool) -> list[tuple[str, int]]:
        """See ``Wrap``."""
        own = (FLIGHT, 2 * len(self.fogs.all)) if paths else PLACE
        return [own, *self.lamps.numbers]

    def around(self, integrator: Integrator, max_depth: int) -> Integrator:
        """See ``Wrap``."""
        known = {each.name: getattr(integrator, each.name) for each in fields(integrator)}
        if integrator.direct is not None:
            known["direct"] = through_fog(integrator.direct, self.fogs)
        # What is seen by the camera alone is no light.
        environment = integrator.environment if self.lamps.environment is not None else None
        lamps = replace(self.lamps, environment=environment)
        if isinstance(integrator, PathIntegrator):
            known["max_depth"] = max_depth
            if environment is not None:
                known["environment_depth"] = max_depth
            return FogPathIntegrator(**known, fogs=self.fogs, fog_lamps=lamps)
        return FogIntegrator(**known, fogs=self.fogs, lamps=lamps)
