"""Materials with what only some scenes have: metals, and highlights by another convention."""

from dataclasses import dataclass

from course.core.materials import MaterialTable
from course.core.types import Floats32
from course.extras.conductors import Conductors
from course.extras.other_highlights import Highlights


@dataclass(frozen=True)
class FullMaterials(MaterialTable):
    """M materials.

    Attributes
    ----------
    conductors : the metals, None where there are none
    highlights : by other models than Blinn's with the cosine, None where there are none
    unlit : (3, M) float32 radiance that textures colour, whatever the light [W/(m^2 sr)]; None where there is none
    """

    conductors: Conductors | None = None
    highlights: Highlights | None = None
    unlit: Floats32 | None = None
