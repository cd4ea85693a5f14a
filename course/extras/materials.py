"""Materials with what only some scenes have: metals, and highlights by another convention."""

from dataclasses import dataclass

from course.core.materials import MaterialTable
from course.extras.conductors import Conductors
from course.extras.highlights import Highlights


@dataclass(frozen=True)
class FullMaterials(MaterialTable):
    """M materials.

    Attributes
    ----------
    conductors : the metals, None where there are none
    highlights : by other models than Blinn's with the cosine, None where there are none
    """

    conductors: Conductors | None = None
    highlights: Highlights | None = None
