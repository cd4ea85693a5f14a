"""What ``python -m benchmarks.peers`` measures of one effect, and the file that keeps all of it.

All cases take an hour, and the figures of one were measured in turn, whenever that was. So docs/data/peers.json keeps
each case with the machine and the effort that it belongs to, and measuring one again leaves the others as they are.
Tables and plots are made of that file alone.
"""

from collections.abc import Iterable
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

import msgspec

from benchmarks.mitsuba_agreement import Agreement
from course.base.atomic import write_text
from course.benchmarking.plot_data import rounded

EFFECTS = (
    "supersampling",
    "soft_shadows",
    "glossy",
    "thin_lens",
    "motion_blur",
    "cube_map",
    "path_tracing",
)
"""Of the course, in ``scenes``."""

FURTHER = (
    "checkerboard",
    "sphere_light",
    "rectangle_light",
    "lens_and_sun",
    "moving_balls",
    "mirror_and_matt",
)
"""Of the same effects, with flat meshes and what Mitsuba's own integrators can do: ``benchmarks/scenes/peers``."""

FORMS = ("llvm", "llvm-robust", "scalar")
"""Mitsuba's variants; "llvm-robust" is the first one in Embree's robust mode."""

SAMPLES = (16, 64, 256)
"""A pixel, of Mitsuba's multijitter sampler; its errors are those to reach."""


@dataclass(frozen=True)
class Effort:
    """How much is spent: pictures for each error, rounds of times, batches of converged pictures and their samples."""

    pictures: int = 4
    rounds: int = 5
    batches: int = 16
    batch_samples: int = 256
    processes: int = 5


QUICK = Effort(pictures=2, rounds=3, batches=8, batch_samples=128, processes=3)


@dataclass(frozen=True)
class Reached:
    """How a way to render reaches an error.

    Attributes
    ----------
    seconds : interpolated between the measured pictures around the error, both axes logarithmic
    knob : samples, or the error asked for, interpolated alike; None where an older run has not kept it
    """

    name: str
    seconds: float
    knob: float | None


@dataclass(frozen=True)
class Target:
    """An error, and the seconds to it.

    Attributes
    ----------
    samples : of multijitter that have this error
    error : root of the mean squared error
    theirs : Mitsuba's fastest sampler to this error; ``knob`` is its samples
    ours : each of our ways to render, fastest first
    """

    samples: int
    error: float
    theirs: Reached
    ours: list[Reached]

    def ratio(self, name: str) -> float | None:
        """Our seconds over Mitsuba's, of a way to render; None where it was not measured."""
        return next((o.seconds / self.theirs.seconds for o in self.ours if o.name == name), None)


@dataclass(frozen=True)
class Result:
    """One effect in one form.

    Attributes
    ----------
    without : what the scene has to do without in this form
    alike : whether even so the pictures are only alike, not the same
    process, our_process : seconds of whole processes, to the error of the middle target
    """

    effect: str
    form: str
    without: list[str]
    alike: bool
    targets: list[Target]
    process: float
    our_process: float
    agreement: Agreement

    @property
    def middle(self) -> Target:
        """The target of whole processes."""
        return self.targets[len(self.targets) // 2]

    def ratios(self, name: str) -> list[float]:
        """Our seconds over Mitsuba's, of a way to render, from the best error to the worst."""
        return sorted(ratio for t in self.targets if (ratio := t.ratio(name)) is not None)


@dataclass(frozen=True)
class Measured:
    """A result, with what it was measured with.

    ``about``: machine and software, in words.
    """

    effort: Effort
    about: dict[str, str]
    result: Result

    @property
    def case(self) -> tuple[str, str]:
        """Form and effect, of which there is one result."""
        return self.result.form, self.result.effect


def read_cases(path: Path) -> list[Measured]:
    """All that a file keeps; nothing if there is no file."""
    if not path.is_file():
        return []
    return msgspec.json.decode(path.read_bytes(), type=list[Measured])


def keep_cases(new: Iterable[Measured], path: Path) -> list[Measured]:
    """Put cases into a file, each in the place of an older one of the same effect and form.

    Returns all that the file now keeps, in the order of FORMS, EFFECTS and FURTHER.
    """
    cases = {each.case: each for each in (*read_cases(path), *new)}
    names = [(form, effect) for form in FORMS for effect in (*EFFECTS, *FURTHER)]
    ordered = [cases[name] for name in names if name in cases]
    # A line for each case: a new measurement changes its own line, and the file stays small.
    lines = [msgspec.json.encode(rounded_deeply(asdict(case))).decode() for case in ordered]
    write_text(path, "[\n" + ",\n".join(lines) + "\n]\n")
    return read_cases(path)


def rounded_deeply(value: Any) -> Any:
    """The same with as many digits as the other files of numbers have."""
    if isinstance(value, float):
        return rounded(value)
    if isinstance(value, dict):
        return {key: rounded_deeply(each) for key, each in value.items()}
    if isinstance(value, list | tuple):
        return [rounded_deeply(each) for each in value]
    return value
