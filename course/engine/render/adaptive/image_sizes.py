"""How likely a ray that has come over surfaces meets a place on a bright thing next."""

from dataclasses import dataclass

import numpy as np

from course.engine.core.types import Floats64, Mask
from course.engine.render.adaptive.bright import Bright
from course.engine.render.adaptive.cell_grid import CellGrid
from course.engine.render.adaptive.lobes_ahead import facets_density
from course.engine.render.adaptive.rays_ahead import Arrival, Front
from course.engine.render.adaptive.seen_ahead import CameraAxes

EACH = 4
"""Points on one thing at most."""

UNKNOWN = 2.0
"""Where no next block sends its ray the same way, the ways change by so many times the angle of a block."""


@dataclass(frozen=True)
class ImageSizes:
    """How large the cells' views of things are.

    Attributes
    ----------
    side : of the cells of the first rays [pixels]
    passes : places on the lens and times
    step : of the time from pass to pass; 0 where nothing moves
    """

    view: CameraAxes
    grid: CellGrid
    side: int
    passes: int
    step: float

    @property
    def angle(self) -> float:
        """Of a cell [rad]."""
        return float(self.grid.side * np.sqrt(self.view.pixel))

    def chance(
        self, arrival: Arrival, place: Floats64, facing: Floats64, thing: Bright
    ) -> tuple[Floats64, Mask]:
        """Chances of a unit of area around a place on a thing.

        Parameters
        ----------
        place, facing : (3, 1), and the normal there

        Returns
        -------
        (n,) of each ray that arrives, and where a cell blurs most
        """
        new, which, on = arrival.after, arrival.which, arrival.on
        way = place - new.origin
        far = np.maximum(np.sqrt((way * way).sum(axis=0)), 1e-12)
        way /= far
        cos = -(way * facing).sum(axis=0)
        cos = np.maximum(cos, 0) if thing.fronts else np.abs(cos)
        apart = new.way - way
        steps = self._steps(apart, new)
        length = new.length + far
        defocus = 0.0
        if self.view.camera.lens is not None:
            blur = self.view.aperture * np.abs(
                1 / self.view.camera.lens.focus_distance - 1 / length
            )
            defocus = (blur / self.angle) ** 2 * steps / (4 * self.passes)
        moved = float((thing.velocity**2).sum()) * self.step**2 / (12 * far**2)
        size = thing.area / (4 * np.pi * EACH * far**2)
        others = (defocus + moved + size + new.blur)[which]
        others[on.alpha > 0] += on.alpha[on.alpha > 0] ** 2
        block = steps[which] / 4
        # As it would be in the blocks of the first rays, so that both tell the same.
        sharp = block * (self.side / self.grid.side) ** 2 > others
        width = block + (defocus + moved + size + new.blur)[which]
        away = (apart[:, which] ** 2).sum(axis=0)
        dense = np.exp(-away / (2 * width)) / (2 * np.pi * width)
        rough = np.flatnonzero(on.alpha > 0)
        if len(rough):
            alpha = np.sqrt(on.alpha[rough] ** 2 + (width - new.blur[which])[rough] / 2)
            ways = (
                arrival.before.way[:, which[rough]],
                way[:, which[rough]],
                arrival.normal[:, rough],
            )
            dense[rough] = facets_density(*ways, np.minimum(alpha, 1))
        result: Floats64 = dense * (cos / far**2)[which]
        return result, sharp

    def _steps(self, apart: Floats64, new: Front) -> Floats64:
        """The larger of the squared changes (n,) of what is apart (3, n) from cell to cell, along either axis."""
        changes = self.grid.changes(apart, new.key)
        return np.where(changes >= 0, changes, (UNKNOWN * self.angle) ** 2)
