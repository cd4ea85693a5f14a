"""Cube maps looked up by a loop, in the place of the course's own functions and of no others."""

from dataclasses import dataclass

import numpy as np

from course.core.environment import CubeEnvironment, Environment
from course.core.types import Floats32
from course.extras.own import courses_own
from course.extras.plan import same_fields


@dataclass(frozen=True)
class CompiledCubeEnvironment(CubeEnvironment):
    """A cube map that the course's own functions look up."""

    def radiance(self, direction: Floats32) -> Floats32:
        """See ``Environment``."""
        from course.compiled import environment_kernels

        n = direction.shape[1]
        radiance, across = np.empty((3, n), np.float32), np.empty(n, np.int64)
        found = environment_kernels.lookup(
            self.faces, np.ascontiguousarray(direction), self.seamless, radiance, across
        )
        if found:
            beyond = across[:found]
            radiance[:, beyond] = super().radiance(direction.take(beyond, axis=1))
        return radiance


def compiled_environment(environment: Environment | None) -> Environment | None:
    """An environment in compiled form, where the course's own functions look it up; else as it is."""
    if not isinstance(environment, CubeEnvironment):
        return environment
    name = "lookup_seamless" if environment.seamless else "lookup"
    if not courses_own(getattr(environment.cube_map, name)):
        return environment
    return CompiledCubeEnvironment(**same_fields(environment))
