"""Materials with what only some scenes have: metals, and highlights by another convention."""

from dataclasses import dataclass

from course.core.materials import MaterialTable
from course.core.types import Mask
from course.extras.conductors import Conductors


@dataclass(frozen=True)
class FullMaterials(MaterialTable):
    """M materials.

    Attributes
    ----------
    conductors : the metals, None where there are none
    plain : (M,) which materials have highlights without the cosine in E, None where none has
    """

    conductors: Conductors | None = None
    plain: Mask | None = None
