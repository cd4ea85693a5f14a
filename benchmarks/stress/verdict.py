"""What is said of each cell: finite, no energy created, and equal to its well-conditioned twin within a stated bound.

The bound, for the room. Compared with its twin, whatever the renderer meets lies apart by the cell's ``shift`` at most
(rounding to float32, and what the levels of the axes add). So the pictures differ by

    GAIN * shift * (1 + bounces) * steepness  +  ROUNDING * U * (brightest pixel)

where the steepness of each pixel is measured on the twin (``probes``), up to four bounces count since each mirror that
errs turns what follows it, and the last term is the arithmetic on the way to the film. The power of a light that is an
object is that of its area, which errs as its corners do: GAIN times that (``Cell.power``) of the brightest pixel is
added. Pixels that see thin triangles, which are expected to be samples * bounces * (their share of the surfaces), may
differ by the larger shift of those.
There are no other exceptions but edges: where a sample of the twin sees something else when the scene moves by
H = 1e-3, or by GAIN * shift where that is more, it may do so in the cell too. Of those pixels a share of
GAIN * shift / H is expected to jump, all where that is more than 1. How many pixels may is the quantile of the Poisson
distribution with the expected number, at 1 : 10^6; and none may jump to what is not seen around it.

For patch, box and optics the radiance is a closed form, and the bound is rounding alone; that of optics is physics'
own, and shares nothing with the renderer.
"""

import math
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from benchmarks.stress import box, optics, parts, patch, room
from benchmarks.stress.axes import U
from benchmarks.stress.cells import Cell
from benchmarks.stress.files import SceneFiles
from benchmarks.stress.probes import H, Response, probe

Array = NDArray[np.float64]

GAIN = 4.0
ROUNDING = 64.0
FALSE_FAIL = 1e-6

SCENES = {"room": room.room, "patch": patch.patch, "box": box.box, "optics": optics.optics}
CLOSED_FORMS: dict[str, Any] = {"patch": patch, "box": box, "optics": optics}
"""Modules with ``radiance``, ``tolerance``, ``brightest`` and ``slips`` of a cell."""


@dataclass
class Verdict:
    """What was found in one cell.

    Attributes
    ----------
    cell : its name
    levels : axis -> name of the level
    finite : every pixel is finite and not negative
    energy : the brightest pixel over what the scene can bring at most
    error : the largest deviation from the twin, edges left out, over the twin's brightest pixel
    share : the largest deviation over the bound
    jumps, jumps_allowed : pixels at edges that deviate by more than the bound
    edges : share of the pixels that are at edges
    trouble : an error, or what is broken; empty where nothing is
    """

    cell: str
    levels: dict[str, str]
    finite: bool = False
    energy: float = 0.0
    error: float = 0.0
    share: float = 0.0
    jumps: int = 0
    jumps_allowed: int = 0
    edges: float = 0.0
    trouble: list[str] = field(default_factory=list)

    @property
    def passed(self) -> bool:
        """Nothing is broken."""
        return not self.trouble

    def to_dict(self) -> dict[str, Any]:
        """Plain data."""
        return asdict(self) | {"passed": self.passed}


class Judge:
    """Renders cells and judges them; the twin of the last family is kept.

    Parameters
    ----------
    folder : for their files
    compiled : whether pictures are made by Numba's loops; None for what the renderer takes itself
    """

    def __init__(self, folder: Path, compiled: bool | None = None) -> None:
        self._folder = folder
        self._compiled = compiled
        self._family: tuple[tuple[str, ...], float] | None = None
        self._twin: Response | None = None

    def __call__(self, cell: Cell) -> Verdict:
        """Judge one cell; whatever goes wrong in it is its verdict."""
        verdict = Verdict(cell.name, {axis: each.name for axis, each in cell.levels.items()})
        try:
            picture = self._picture(SCENES[cell.stage](cell))
            verdict.finite = finite(picture)
            if not verdict.finite:
                verdict.trouble.append("a pixel is negative or not finite")
            elif cell.stage == "room":
                self._judge_room(cell, picture, verdict)
            else:
                _judge_closed_form(cell, picture, verdict)
        except Exception as error:  # noqa: BLE001 - the suite goes on, and names the cell
            verdict.trouble.append(f"{type(error).__name__}: {error}")
        return verdict

    def _picture(self, files: SceneFiles) -> Array:
        return files.picture(self._folder / "cell", self._compiled)

    def twin(self, cell: Cell) -> Response:
        """The twin's picture and how it answers to changes."""
        family = cell.family, max(H, GAIN * cell.shift)
        if self._twin is None or self._family != family:
            twin = room.room(cell.twin())
            clearance = room.clearance(cell)
            self._twin = probe(twin, self._folder / "twin", self._compiled, family[1], clearance)
            self._family = family
        return self._twin

    def _judge_room(self, cell: Cell, picture: Array, verdict: Verdict) -> None:
        compare(picture, self.twin(cell), cell, verdict)
        slack = 1 + (cell["depth"] + 32) * U
        verdict.energy = float(picture.max()) / room.brightest(cell)
        inside = self._picture(room.furnace(cell))
        if not finite(inside):
            verdict.trouble.append("a pixel of the furnace is negative or not finite")
            return
        verdict.energy = max(verdict.energy, float(inside.max()))
        if verdict.energy > slack:
            verdict.trouble.append(f"energy is created: {verdict.energy:.7g} of what there is")
        least = room.least_in_furnace(cell)
        if inside.min() < least / slack:
            verdict.trouble.append(
                f"energy is lost: {inside.min():.7g} in the furnace, not {least:.7g}"
            )


def finite(picture: Array) -> bool:
    """Every pixel is finite and not negative."""
    return bool(np.isfinite(picture).all() and (picture >= 0).all())


def compare(picture: Array, twin: Response, cell: Cell, verdict: Verdict) -> None:
    """Hold a picture against its twin."""
    off = np.abs(picture - twin.picture).max(axis=2)
    triangles = cell.levels["triangles"]
    bounces = 1 + min(cell["depth"], 4)
    # Each sample meets surfaces up to so often; those that meet thin triangles may lie farther apart.
    samples = parts.samples(cell) * bounces
    thin = min(1.0, samples * triangles.thin_share)
    moved = GAIN * cell.shift
    moved_more = moved + GAIN * triangles.thin_shift
    rounding = (ROUNDING * U + GAIN * cell.power) * twin.brightest
    over = off / (moved * bounces * twin.steepness + rounding)
    over_most = off / (moved_more * bounces * twin.steepness + rounding)

    smooth = ~twin.edges
    verdict.error = float(off[smooth].max(initial=0)) / twin.brightest
    exempt = most_of(smooth.sum() * thin)
    ordered = np.sort(over[smooth])[::-1]
    verdict.share = float(max(ordered[exempt:].max(initial=0), over_most[smooth].max(initial=0)))
    if verdict.share > 1:
        wrong = int((over[smooth] > 1).sum())
        verdict.trouble.append(
            f"{wrong} of {off.size} pixels differ from the twin's, the worst by {verdict.share:.3g} times the bound"
        )
    verdict.edges = float(twin.edges.mean())
    jumped = twin.edges & (over > 1)
    verdict.jumps = int(jumped.sum())
    expected = min(1.0, moved / twin.step) + thin * min(1.0, moved_more / twin.step)
    verdict.jumps_allowed = most_of(twin.edges.sum() * min(1.0, expected))
    if verdict.jumps > verdict.jumps_allowed:
        verdict.trouble.append(
            f"{verdict.jumps} pixels at edges differ from the twin's: at most {verdict.jumps_allowed} may"
        )
    if (off > 2 * twin.contrast + rounding)[jumped & (over_most > 1)].any():
        verdict.trouble.append("a pixel at an edge shows what is not seen around it")


def _judge_closed_form(cell: Cell, picture: Array, verdict: Verdict) -> None:
    module = CLOSED_FORMS[cell.stage]
    expected, tolerance = module.radiance(cell), module.tolerance(cell)
    off = np.abs(picture - expected)
    over = off / tolerance
    verdict.energy = float((picture / (module.brightest(cell) + tolerance)).max())
    wrong = (over > 1).any(axis=2)
    # Nothing is expected of what takes a bounce that no ray may make.
    most = expected.max() or module.brightest(cell).max()
    verdict.error = float(off[~wrong].max(initial=0) / most)
    verdict.jumps = int(wrong.sum())
    verdict.jumps_allowed = most_of(module.slips(cell))
    verdict.share = float(over[~wrong].max(initial=0))
    if verdict.jumps > verdict.jumps_allowed:
        verdict.share, verdict.error = float(over.max()), float(off.max() / most)
        verdict.trouble.append(
            f"{verdict.jumps} of {wrong.size} pixels differ from the closed form, the worst by {verdict.share:.3g} "
            f"times the bound"
        )
    if verdict.energy > 1:
        verdict.trouble.append(f"energy is created: {verdict.energy:.7g} of what there is")


def most_of(expected: float) -> int:
    """The least n that a Poisson distribution with that mean exceeds with a probability of at most FALSE_FAIL."""
    if expected == 0:
        return 0
    probability = math.exp(-expected)
    if probability == 0:
        # Far from zero it is a normal distribution, to far less than this margin.
        return math.ceil(expected + 6 * math.sqrt(expected))
    total, n = probability, 0
    while 1 - total > FALSE_FAIL:
        n += 1
        probability *= expected / n
        total += probability
    return n
