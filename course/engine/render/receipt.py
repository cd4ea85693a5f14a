"""The receipt: what a render has cost, and what it did without."""

from dataclasses import asdict, dataclass
from typing import Any

from course.engine.render.sections import plain_text, receipt_sections, receipt_table


@dataclass(frozen=True, repr=False)
class Receipt:
    """Counts and times of one render.

    Attributes
    ----------
    rays : kind (camera, shadow, reflection, refraction) -> rays cast; path tracing has a kind path for all that go
        on from a surface, whichever way
    numbers : dimension -> numbers drawn
    effects : "called" -> list of functions, "skipped" -> name -> reason; with "mine" for effects also "yours" -> the
        functions called that aren't the solutions', and where there are no solutions "stand-ins" -> name -> what the
        picture looks like without the function; with functions of one's own also "not called" -> those of them that
        the scene doesn't call, and modules of which it calls none
    seconds : stage -> seconds, summed over threads
    caster : what answered rays: "embree", or its stand-in, "numba" or "numpy"
    embree_seconds : inside Embree or its stand-in, summed over threads
    wall_seconds : from the call to the finished picture
    threads : that rendered
    samples : a pixel; the mean where pixels differ
    error : where one was aimed at: "target", "estimated" [radiance], the "fewest" and "most" samples of a pixel,
        "uniform" how many samples in every pixel would have brought the same, "saved" the part of them that was not
        needed, "audited" the samples and "foreseen" the rays that told of the error and aren't in the picture, and
        "not bounded" what the estimate doesn't bound, where there is any; else None
    pixels : of the picture
    seed, version : what to repeat it with
    subdivision : where pixels are divided by contrast: "corners" that got rays, corners of cells that were "shared",
        corners of the smallest cells ("lattice"), and the part of those that was "saved"; else None
    denoising : where the PNG is a biased preview: the "neighbours" a pixel is averaged with, and estimates of the
        root-mean-square "noise" before, of what is "left" of it, and of the "bias" [radiance]; else None
    tests : where a hierarchy takes the place of Embree: "boxes" and "triangles" that rays were tested with; else None
    spared : where shafts told of shadow rays, how many weren't sent: "clear" if nothing is in their shaft, "cut off" if
        one triangle blocks all of it; without compiled loops also "probes", rays that were sent to see which shafts are
        worth a look; else None
    """

    rays: dict[str, int]
    numbers: dict[str, int]
    effects: dict[str, Any]
    seconds: dict[str, float]
    caster: str
    embree_seconds: float
    wall_seconds: float
    threads: int
    samples: float
    pixels: int
    seed: int
    version: str
    error: dict[str, Any] | None = None
    subdivision: dict[str, float] | None = None
    tests: dict[str, int] | None = None
    denoising: dict[str, float] | None = None
    spared: dict[str, int] | None = None

    def to_dict(self) -> dict[str, Any]:
        """Plain data, as written by ``course render --receipt``; without what there was none of."""
        told = asdict(self)
        for part in ("subdivision", "tests", "denoising", "spared"):
            if told[part] is None:
                del told[part]
        return told

    def __repr__(self) -> str:
        return plain_text("receipt", receipt_sections(self.to_dict()))

    def _repr_html_(self) -> str:
        return receipt_table(self)
