"""Radiosities from form factors: gathering for few patches, progressive shooting for many.

The distance to convergence is bounded, not guessed. Light that has not been shot yet, with power U, can become at most
rho / (1 - rho) U before all of it is absorbed, where rho is the largest reflectance: for no hemicube lets out more
light than its patch has. Gathering changes no radiosity by more than rho times the largest change before it.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from course.base.errors import FunctionError
from course.engine.core.types import Floats32, Floats64, Indices, Mask
from course.engine.radiosity.hemicubes import Hemicube, Seen, Views, make_hemicube
from course.engine.radiosity.patches import Patches, RadiosityFunctions

GATHERED = 1000
"""Triangles up to which all form factors are kept at once: 2000 x 2000 of them take 16 MB."""

LAMP_RAYS = 24_000_000
"""All hemicubes of the lamps' patches together; what they see is not kept."""

COARSE = 48
"""Cells along the top of the hemicubes of all other patches that shoot."""

GATHER_RAYS = 40_000_000
"""All hemicubes together, when gathering."""

KEPT_BYTES = 256 << 20
"""What coarse hemicubes have seen is kept up to here, for patches shoot more than once."""

BATCH = 64
"""Patches with the most unshot power whose hemicubes are rendered together."""

APART, ROUNDING = 1.01, 1e-4
"""Changes of radiosity that grow by more than APART from one iteration to the next are a mistake, if they are more than
ROUNDING of the largest radiosity; so is more light than there can be by APART, or less than none by ROUNDING."""

Report = Callable[[float, bool], None]


@dataclass(frozen=True)
class Solved:
    """Radiosities, and how far they are from being final.

    Attributes
    ----------
    radiosity : (3, P) float32 [W/m^2]
    unshot : (3, P) float32 [W/m^2], what has not been sent out; None after gathering
    steps : iterations of gathering, or patches that have shot
    left : bound of the distance to the limit, as a share of all light
    rays : through cells of hemicubes
    """

    radiosity: Floats32
    unshot: Floats32 | None
    steps: int
    left: float
    rays: int


def gathered(
    patches: Patches,
    functions: RadiosityFunctions,
    tolerance: float,
    most: int | None,
    report: Report | None = None,
    rays: int = GATHER_RAYS,
) -> Solved:
    """Iterate over all patches at once, with all form factors in memory.

    Parameters
    ----------
    tolerance : end where the radiosities are this near to their limit
    most : end after so many iterations
    rays : through all hemicubes together
    """
    views = Views(patches)
    k = _even(math.sqrt(rays / (6 * patches.size)), 32, 256)
    factors = form_factors(views, make_hemicube(k, functions), 2 * patches.size)
    emission, reflectance, _ = _both_sides(patches)
    rho, share = float(reflectance.max()), max(1.0, float(factors.sum(axis=1).max()))
    radiosity = emission
    steps, left, change = 0, math.inf, math.inf
    while left > tolerance and steps < (most if most is not None else steps + 1):
        after = functions.gather(radiosity, emission, reflectance, factors)
        change, last = float(np.abs(after - radiosity).max()), change
        largest = float(after.max())
        least = np.unravel_index(int((after - emission).argmin()), after.shape)
        # Every patch has what it emits, and reflects at most rho of the brightest light around it.
        most_light = float(emission.max()) + APART * share * rho * float(radiosity.max())
        wrong = ""
        if after[least] - emission[least] < -ROUNDING * float(np.abs(after).max()):
            wrong = (
                f"returned a radiosity of {after[least]:g} W/m^2 in iteration {steps + 1} for a patch that emits "
                f"{emission[least]:g}: expected no less than that"
            )
        elif largest > most_light:
            wrong = (
                f"returned a radiosity of {largest:g} W/m^2 in iteration {steps + 1}: expected at most {most_light:g},"
                " for no patch reflects more light than comes to it"
            )
        # Where no patch lets out more than it gets, changes become smaller; rounding is left out.
        elif change > APART * last and change > ROUNDING * largest:
            wrong = (
                f"changed a radiosity by {change:g} W/m^2 in iteration {steps + 1}, after {last:g} in the one before: "
                f"expected at most {rho:g} times that, or it would never end"
            )
        if wrong:
            raise FunctionError(
                f"radiosity.gather {wrong}; `course check radiosity` says more", "radiosity.gather"
            )
        radiosity, steps = after, steps + 1
        lit = radiosity.max(axis=0)
        mean = float(lit[lit > 0].mean()) if lit.any() else 1.0
        left = _bound(change, rho) / mean
        _tell(report, left, tolerance)
    return Solved(radiosity, None, steps, left, views.rays)


def form_factors(views: Views, hemicube: Hemicube, count: int) -> Floats32:
    """(count, count) form factors of the first patches, a row after the other."""
    rows = np.empty((count, count), np.float32)
    for first in range(0, count, BATCH):
        which = np.arange(first, min(first + BATCH, count))
        for patch, seen in zip(which, views.look(which, hemicube), strict=True):
            rows[patch] = views.row(seen, hemicube)[:count]
    return rows


class Shooting:
    """Progressive refinement: the patch with the most unshot light shoots next.

    Parameters
    ----------
    patches, functions : what shoots, and how
    lamp_rays : through the hemicubes by which lamps shoot what they emit
    """

    def __init__(
        self, patches: Patches, functions: RadiosityFunctions, lamp_rays: int = LAMP_RAYS
    ) -> None:
        self._functions = functions
        self._views = Views(patches)
        self._emission, self._reflectance, areas = _both_sides(patches)
        self._areas = areas.astype(np.float32)
        self._fresh = np.asarray(self._emission.any(axis=0))
        lamps = max(int(self._fresh.sum()), 1)
        fine = _even(math.sqrt(lamp_rays / (3 * lamps)), COARSE, 512)
        self._fine = make_hemicube(fine, functions)
        self._coarse = make_hemicube(COARSE, functions)
        self._kept = _Kept(2 * patches.size)
        self.radiosity = self._emission.copy()
        self.unshot = self._emission.copy()
        self.steps = 0

    @property
    def solved(self) -> Solved:
        """The state of the iteration."""
        return Solved(self.radiosity, self.unshot, self.steps, self.left, self._views.rays)

    @property
    def left(self) -> float:
        """Bound of the distance to the limit, as a share of all light; of the worst channel."""
        rho = self._reflectance.max(axis=1)
        unshot, light = (
            values @ self._areas.astype(np.float64) for values in (self.unshot, self.radiosity)
        )
        return max(
            (
                _bound(float(u), float(r)) / float(all_of_it)
                for u, r, all_of_it in zip(unshot, rho, light, strict=True)
                if u > 0
            ),
            default=0.0,
        )

    def run(self, tolerance: float, most: int | None = None, report: Report | None = None) -> None:
        """Shoot until the radiosities are that near to their limit, or ``most`` patches have shot in all."""
        while (left := self.left) > tolerance and (most is None or self.steps < most):
            _tell(report, left, tolerance)
            which = self._brightest(BATCH if most is None else min(BATCH, most - self.steps))
            if len(which) == 0:
                return
            self._shoot_all(which)

    def _brightest(self, count: int) -> Indices:
        power = self.unshot.sum(axis=0) * self._areas
        count = min(count, power.size)
        which = np.argpartition(power, -count)[-count:]
        which = which[np.argsort(-power[which], kind="stable")]
        return np.asarray(which[power[which] > 0], np.intp)

    def _shoot_all(self, which: Indices) -> None:
        new = which[~self._fresh[which] & ~self._kept.has(which)]
        if len(new):
            self._kept.add(new, self._views.look(new, self._coarse))
        for patch in which:
            if self._fresh[patch]:
                # Lamps' first shots are the brightest, and most of them have no second.
                self._fresh[patch] = False
                self._shoot(
                    int(patch), self._views.look(np.array([patch]), self._fine)[0], self._fine
                )
            else:
                self._shoot(int(patch), self._kept.get(int(patch)), self._coarse)
        self._kept.trim()

    def _shoot(self, patch: int, seen: Seen, hemicube: Hemicube) -> None:
        row = self._views.row(seen, hemicube)
        # Only who sees the shooter gets something: the function is called with those alone, and the shooter.
        reached = np.flatnonzero(row != 0)
        place = int(np.searchsorted(reached, patch))
        if place == len(reached) or reached[place] != patch:
            reached = np.insert(reached, place, patch)
        radiosity, unshot = self._functions.shoot(
            self.radiosity.take(reached, axis=1),
            self.unshot.take(reached, axis=1),
            self._reflectance.take(reached, axis=1),
            self._areas.take(reached),
            row.take(reached),
            place,
        )
        before = self.unshot[:, patch]
        if (unshot[:, place] >= before).any(where=before > 0) or (unshot[:, place] > before).any():
            raise FunctionError(
                f"radiosity.shoot left the shooter's unshot light at {unshot[:, place].max():g} W/m^2, "
                f"{before.max():g} before: expected less, or shooting would never end",
                "radiosity.shoot",
            )
        self.radiosity[:, reached], self.unshot[:, reached] = radiosity, unshot
        self.steps += 1


def with_ambient(
    patches: Patches, radiosity: Floats32, unshot: Floats32, among: Mask | None = None
) -> Floats32:
    """Radiosities with what the unshot light would bring if it came to all patches alike, for looking at early steps.

    Shot and reflected again and again, it adds up to 1 / (1 - rho) times itself for a mean rho (Cohen 1988).
    ``among``: (P,) which patches it comes to, for the insides of solids stay dark; those it has reached by default.
    Returns (3, P) float32.
    """
    _, reflectance, areas = _both_sides(patches)
    reached = radiosity.any(axis=0) if among is None else among
    weight = areas * reached / max(float((areas * reached).sum()), np.finfo(float).tiny)
    ambient = unshot @ weight / np.maximum(1 - reflectance @ weight, 1e-6)
    return (radiosity + reflectance * ambient[:, None] * reached).astype(np.float32)


class _Kept:
    """Views through hemicubes, in as few bytes as the number of patches allows."""

    def __init__(self, patches: int) -> None:
        self._type = np.uint16 if patches < 2**16 - 1 else np.int32
        self._seen: dict[int, NDArray[np.integer]] = {}
        self._bytes = 0

    def has(self, which: Indices) -> Mask:
        return np.array([int(patch) in self._seen for patch in which], bool)

    def add(self, which: Indices, seen: Seen) -> None:
        for patch, row in zip(which, seen, strict=True):
            # -1, nothing, becomes the type's largest number.
            self._seen[int(patch)] = row.astype(self._type)
            self._bytes += self._seen[int(patch)].nbytes

    def get(self, patch: int) -> Seen:
        row = self._seen[patch].astype(np.int32)
        if self._type is np.uint16:
            row[row == 2**16 - 1] = -1
        return row

    def trim(self) -> None:
        """Forget the oldest once there is too much."""
        while self._bytes > KEPT_BYTES:
            oldest = next(iter(self._seen))
            self._bytes -= self._seen.pop(oldest).nbytes


def _both_sides(patches: Patches) -> tuple[Floats32, Floats32, Floats64]:
    emission = patches.both(patches.emission, patches.back_emission)
    areas = patches.triangles.areas()
    return emission, patches.both(patches.reflectance), np.concatenate((areas, areas))


def _bound(light: float, rho: float) -> float:
    return light * rho / (1 - rho) if rho < 1 else (math.inf if light else 0.0)


def _even(k: float, low: int, high: int) -> int:
    return min(max(2 * round(k / 2), low), high)


def _tell(report: Report | None, left: float, tolerance: float) -> None:
    if report is not None and 0 < left < math.inf and tolerance > 0:
        # Convergence is geometric: a hundredth is as far from 1 as from a ten-thousandth.
        report(min(max(math.log(10 / left) / math.log(10 / tolerance), 0.0), 1.0), True)
