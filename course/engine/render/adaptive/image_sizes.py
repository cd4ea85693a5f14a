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

MEAN_COSINE = 0.25
"""Of what is convex a quarter of the area is seen, on average over all directions (Cauchy)."""

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
        self, arrival: Arrival, place: Floats64, facing: Floats64 | None, thing: Bright, both: Mask
    ) -> tuple[Floats64, Floats64, Mask]:
        """Chances of a unit of area around a place on a thing, and the mean squares of the shares that samples find.

        A share is 1, but where points on the thing and the lobe are tried together: there each sample finds what part
        of the lobe the thing fills, and only its place within the pixel is left to chance.

        Parameters
        ----------
        place, facing : (3, 1), and the normal there; None for a thing that faces all that it lights
        both : (n,) which rays find the thing by its points, too

        Returns
        -------
        (n,) each, of the rays that arrive; at last where a cell blurs most
        """
        new, which, on = arrival.after, arrival.which, arrival.on
        way = place - new.origin
        far = np.maximum(np.sqrt((way * way).sum(axis=0)), 1e-12)
        way /= far
        cos = np.full_like(far, MEAN_COSINE if thing.closed else 1.0)
        if facing is not None and not thing.closed:
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
        apart, way, solid = apart[:, which], way[:, which], (cos / far**2)[which]
        met = _density(arrival, apart, way, width, on.alpha) * solid
        if not both.any():
            return met, met, sharp
        # What is blurred by more than a block differs within a pixel alone.
        within = np.where(sharp, block, block / max(self.grid.side, 1) ** 2)
        lobe = on.blur + 2 * on.alpha**2
        filled = solid * thing.area / (solid * thing.area + 4 * np.pi * lobe + 1e-300)
        squared = filled * solid
        squared *= _density(
            arrival, apart, way, width - block + within - on.blur / 2, on.alpha / np.sqrt(2)
        )
        return met, np.where(both, squared, met), sharp

    def _steps(self, apart: Floats64, new: Front) -> Floats64:
        """The larger of the squared changes (n,) of what is apart (3, n) from cell to cell, along either axis."""
        changes = self.grid.changes(apart, new.key)
        return np.where(changes >= 0, changes, (UNKNOWN * self.angle) ** 2)


def _density(
    arrival: Arrival, apart: Floats64, way: Floats64, width: Floats64, alpha: Floats64
) -> Floats64:
    """How dense the ways of rays are around ways (3, n), (n,) [1/sr].

    Parameters
    ----------
    apart : (3, n) by what the rays' own ways differ
    width : (n,) variance of the ways in each direction, but for microfacets
    alpha : (n,) roughness of these
    """
    dense = np.exp(-(apart**2).sum(axis=0) / (2 * width)) / (2 * np.pi * width)
    rough = np.flatnonzero(alpha > 0)
    if len(rough):
        blur = arrival.after.blur[arrival.which[rough]]
        wider = np.sqrt(alpha[rough] ** 2 + np.maximum(width[rough] - blur, 0) / 2)
        before = arrival.before.way[:, arrival.which[rough]]
        dense[rough] = facets_density(
            before, way[:, rough], arrival.normal[:, rough], np.minimum(wider, 1)
        )
    result: Floats64 = dense
    return result
