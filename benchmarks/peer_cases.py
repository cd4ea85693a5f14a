"""What ``python -m benchmarks.peers`` measures of one effect, and the file that keeps all of it.

All cases take an hour, and the figures of one were measured in turn, whenever that was. So docs/data/peers.json keeps
each case with the machine and the effort that it belongs to, and measuring one again leaves the others as they are.
Tables and plots are made of that file alone.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

import msgspec

from benchmarks.mitsuba_agreement import Agreement
from course.atomic import write_text
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
FORMS = ("llvm", "scalar")


@dataclass(frozen=True)
class Effort:
    """How much is spent: pictures for each error, rounds of times, batches of converged pictures and their samples."""

    pictures: int = 4
    rounds: int = 5
    batches: int = 16
    batch_samples: int = 256
    processes: int = 5


QUICK = Effort(pictures=2, rounds=5, batches=8, batch_samples=64, processes=3)


@dataclass(frozen=True)
class Reached:
    """How a way to render reaches the target.

    Attributes
    ----------
    seconds : interpolated between the two measured pictures around the target, both axes logarithmic
    knob : samples, or the error asked for, interpolated alike; None where an older run has not kept it
    """

    name: str
    seconds: float
    knob: float | None


@dataclass(frozen=True)
class Result:
    """One effect in one form.

    Attributes
    ----------
    without : what the scene has to do without in this form
    alike : whether even so the pictures are only alike, not the same
    error : root of the target's mean squared error
    seconds : Mitsuba's; ours : of each way to render, fastest first
    process, our_process : seconds of whole processes
    """

    effect: str
    form: str
    without: list[str]
    alike: bool
    sampler: str
    samples: int
    error: float
    seconds: float
    ours: list[Reached]
    process: float
    our_process: float
    agreement: Agreement


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

    Returns all that the file now keeps, in the order of FORMS and EFFECTS.
    """
    cases = {each.case: each for each in (*read_cases(path), *new)}
    ordered = [
        cases[form, effect] for form in FORMS for effect in EFFECTS if (form, effect) in cases
    ]
    text = msgspec.json.format(msgspec.json.encode([_rounded(asdict(case)) for case in ordered]))
    write_text(path, text.decode() + "\n")
    return read_cases(path)


def _rounded(value: Any) -> Any:
    """The same with as many digits as the other files of numbers have."""
    if isinstance(value, float):
        return rounded(value)
    if isinstance(value, dict):
        return {key: _rounded(each) for key, each in value.items()}
    if isinstance(value, list | tuple):
        return [_rounded(each) for each in value]
    return value
