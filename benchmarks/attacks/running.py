"""All attacks behind one wall, in a process of its own that may be another user's."""

import json
import subprocess
import sys
from collections.abc import Iterator
from dataclasses import asdict, dataclass
from functools import cache
from textwrap import dedent, indent

import numpy as np

from benchmarks.attacks.forging import FORGING, MODULE, submission
from benchmarks.attacks.reaching import MANY_THREADS, PRELUDE, REACHING
from benchmarks.attacks.stage import Stage
from benchmarks.attacks.walls import behind, python_for
from course.effects import PROJECT
from course.grading.checks.check import Check
from course.grading.checks.result import Status
from course.grading.errors import StudentError
from course.grading.grading import grade
from course.grading.references import references
from course.grading.report import Report
from course.grading.worker.client import Worker
from course.grading.worker.limits import Limits
from course.grading.worker.sandbox import Sandbox

LIMITS = Limits(call_seconds=2.0, memory=1 << 30)

ATTACKS = (*REACHING, *(f"score: {name}" for name in FORGING))
"""Names of all."""

NOT_HELD = {
    ("user without Landlock", "read: command lines of others"): "they hold no secret of the grader",
    ("user without Landlock", "read: imports the course and its solutions"): (
        "a checkout that everybody can read: there `course grade` takes no such wall for one"
    ),
}
"""(wall, attack) -> why it is not counted there."""


@dataclass(frozen=True)
class Outcome:
    """How an attack ended.

    Attributes
    ----------
    name : the attack
    gain : what it got that it must not have; empty for nothing
    effects : what it changed outside its worker
    said : what it says itself
    """

    name: str
    gain: str
    effects: tuple[str, ...]
    said: str

    @property
    def held(self) -> bool:
        """Whether it was in vain."""
        return not self.gain and not self.effects


def outcomes(user: str, wall: str, *, reaching: bool = False, every: int = 1) -> list[Outcome]:
    """Of all attacks, or of those that reach for something outside alone.

    Raises LookupError: this machine can't.

    Parameters
    ----------
    user : who grades: "root" or "another"
    wall : of ``WALLS``, or ``OPEN``
    every : of those that reach, each so manieth
    """
    with python_for(user) as python:
        command = [
            *python,
            "-m",
            "benchmarks.attacks",
            "--behind",
            wall,
            *(["--reaching"] if reaching else []),
            *("--every", str(every)),
        ]
        ran = subprocess.run(command, check=False, capture_output=True, text=True, cwd=PROJECT)
    if ran.returncode == 3:
        raise LookupError(ran.stderr.strip())
    if ran.returncode:
        raise RuntimeError(ran.stderr)
    lines = (json.loads(line) for line in ran.stdout.splitlines())
    return [Outcome(**line | {"effects": tuple(line["effects"])}) for line in lines]


def run_all(wall: str, *, reaching: bool, every: int) -> int:
    """Run them here and print each outcome as JSON; what to exit with."""
    with Stage() as stage:
        try:
            shut_in = behind(wall, stage.mark)
        except LookupError as error:
            print(error, file=sys.stderr)
            return 3
        for outcome in _reach(wall, stage, shut_in, every):
            print(json.dumps(asdict(outcome)), flush=True)
        for name in () if reaching else FORGING:
            print(json.dumps(asdict(forged(name, shut_in, stage))), flush=True)
    return 0


def forged(name: str, shut_in: Sandbox, stage: Stage) -> Outcome:
    """How one on the score ends."""
    without = _baseline(shut_in)
    try:
        report = _graded(name, shut_in)
        gain, said = _gained(report, without), f"{report.points:g} points"
    except Exception as error:  # noqa: BLE001 - what ends the grader is what is looked for
        gain, said = f"the grader ended: {type(error).__name__}: {error}", ""
    return Outcome(f"score: {name}", gain, tuple(stage.effects()), said)


def _reach(wall: str, stage: Stage, shut_in: Sandbox, every: int) -> Iterator[Outcome]:
    for name, body in [*REACHING.items()][::every]:
        if (wall, name) in NOT_HELD:
            continue
        source = PRELUDE.format(
            stage=stage.described(), body=indent(dedent(body).strip("\n"), "    ")
        )
        said = _reached(source, shut_in)
        gain = said if stage.token in said or said.startswith("DONE") else ""
        if name.endswith(MANY_THREADS) and not shut_in.threads:
            gain = ""  # Where they can't be counted, nobody says that they are.
        yield Outcome(name, gain[:200], tuple(stage.effects()), said[:200])


def _reached(source: str, shut_in: Sandbox) -> str:
    with Worker("attack", source.encode(), LIMITS, shut_in) as worker:
        # What can't be imported attacks nothing: that is a fault of this program.
        worker.load()
        try:
            value = worker.call("run")
        except StudentError as error:
            return f"refused: {error.kind} {error}"
    return bytes(np.asarray(value).astype(np.uint8)).decode("utf-8", "replace")


@cache
def _baseline(shut_in: Sandbox) -> Report:
    return _graded("", shut_in)


def _graded(name: str, shut_in: Sandbox) -> Report:
    return grade(
        {MODULE: submission(name).encode()},
        references(),
        modules=[MODULE],
        limits=LIMITS,
        shut_in=shut_in,
        only=_quick,
    )


def _gained(report: Report, without: Report) -> str:
    if report.count(Status.GRADER_ERROR):
        return "a check ended in an error of the grader"
    if report.of != without.of:
        return f"of {report.of:g} points in place of {without.of:g}"
    if report.points > without.points:
        return f"{report.points:g} points in place of {without.points:g}"
    return ""


def _quick(check: Check) -> bool:
    return check.kind not in ("picture", "bias", "order", "speed")
