"""Materials with what only some scenes have: metals, and highlights by another convention."""

from dataclasses import dataclass

from course.engine.core.materials import MaterialTable
from course.engine.core.types import Floats32, Mask
from course.engine.terms.scattering.conductors import Conductors
from course.engine.terms.scattering.highlight import Highlight


@dataclass(frozen=True)
class FullMaterials(MaterialTable):
    """M materials.

    Attributes
    ----------
    conductors : the metals, None where there are none
    highlights : by other models than Blinn's
    plain : (M,) bool, materials whose highlights lack the cosine; None where there are none
    unlit : (3, M) float32 radiance that textures colour, whatever the light [W/(m^2 sr)]; None where there is none
    """

    conductors: Conductors | None = None
    highlights: tuple[Highlight, ...] = ()
    plain: Mask | None = None
    unlit: Floats32 | None = None
