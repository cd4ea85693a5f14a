"""Which caster answers rays: Embree where it is installed, else a hierarchy that Numba compiles, else one in NumPy.

The choice is made once a process. ``COURSE_CASTER`` makes it by name, to try a stand-in or to measure it.
"""

import os
from functools import cache
from importlib.util import find_spec
from typing import Literal, cast, get_args

from course.base.errors import CourseError
from course.engine.core.accelerator import Caster, StaticAccelerator
from course.engine.core.types import Floats32, Numbers

Name = Literal["embree", "numba", "numpy"]
"""In the order in which they are chosen."""

VARIABLE = "COURSE_CASTER"
"""Environment variable: the name of the caster."""

PACKAGES: dict[Name, str] = {"embree": "embreex", "numba": "numba", "numpy": "numpy"}
"""What each needs."""


@cache
def chosen() -> Name:
    """The caster of this process.

    Raises CourseError: COURSE_CASTER names no caster, or one whose library is not installed.
    """
    wanted = os.environ.get(VARIABLE)
    for name in get_args(Name):
        found = find_spec(PACKAGES[name]) is not None
        if name == wanted and not found:
            raise CourseError(
                f"{VARIABLE}={name}, and {PACKAGES[name]} is not installed: install it, or unset {VARIABLE}"
            )
        if name == wanted or (found and not wanted):
            return cast(Name, name)
    raise CourseError(f"{VARIABLE}={wanted}: expected one of {', '.join(get_args(Name))}")


def software() -> str:
    """The caster's library and its version, as "embreex 4.4.0"."""
    from importlib.metadata import version

    package = PACKAGES[chosen()]
    return f"{package} {version(package)}"


def static_accelerator(vertices: Floats32, triangles: Numbers) -> StaticAccelerator:
    """Vertices (V, 3) float32 and triangles (T, 3) int32 in the caster of this process."""
    return StaticAccelerator(vertices, triangles, _make)


def _make(vertices: Floats32, triangles: Numbers) -> Caster:
    name = chosen()
    if name == "embree":
        from course.engine.core.embree import EmbreeCaster

        return EmbreeCaster(vertices, triangles)
    if name == "numba":
        from course.engine.casters.compiled import CompiledCaster

        return CompiledCaster(vertices, triangles)
    from course.engine.casters.batches import BatchCaster

    return BatchCaster(vertices, triangles)
