"""Lobes by other renderers' conventions."""

from dataclasses import dataclass

from course.engine.core.gloss import Lobe
from course.engine.core.types import Floats32
from course.engine.terms.scattering.turned_square import jitter_on_turned_square


@dataclass(frozen=True)
class ForeignLobe(Lobe):
    """A lobe as another renderer has it.

    Attributes
    ----------
    turned : whether directions lie on the square of ``course.engine.terms.scattering.turned_square``
    keeps : whether directions into the surface are kept
    """

    turned: bool = False
    keeps: bool = False

    def jitter(self, direction: Floats32, u: Floats32) -> Floats32:
        """See ``Lobe``."""
        if self.turned:
            return jitter_on_turned_square(direction, self.parameter, u)
        return super().jitter(direction, u)

    def keep_above(self, direction: Floats32, ng: Floats32) -> Floats32:
        """See ``Lobe``."""
        return direction if self.keeps else super().keep_above(direction, ng)
