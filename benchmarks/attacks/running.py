"""All attacks behind one wall, in a process of its own that may be another user's."""

import json
import subprocess
import sys
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import asdict, dataclass
from functools import cache
from textwrap import dedent, indent

import numpy as np

from benchmarks.attacks.forging import FORGING, MODULE, submission
from benchmarks.attacks.reaching import ALONE, MANY_THREADS, PRELUDE, REACHING
from benchmarks.attacks.stage import Stage
from benchmarks.attacks.walls import OPEN, behind, python_for
from course.engine.functions.effects import PROJECT
from course.school.grading.checks.check import Check
from course.school.grading.checks.result import Status
from course.school.grading.errors import StudentError
from course.school.grading.grading import grade
from course.school.grading.references import references
from course.school.grading.report import Report
from course.school.grading.worker.client import Worker
from course.school.grading.worker.limits import Limits
from course.school.grading.worker.sandbox import Sandbox

LIMITS = Limits(call_seconds=2.0, memory=1 << 30, deaths=2)

ATTACKS = (*REACHING, *(f"score: {name}" for name in FORGING))
"""Names of all."""

ENDED = "refused by the grader"
"""What is said of an attack whose worker gave no value."""

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


def chosen(wall: str, every: int = 1, first: int = 0) -> list[list[str]]:
    """Names of attacks that reach for something outside, those of one worker together.

    Of those that have a worker of their own each so manieth, and of all where there is no wall.
    """
    shared = [name for name in REACHING if name not in ALONE]
    if wall == OPEN:
        shared = shared[first::every]
    return [shared, *([name] for name in ALONE[first::every])]


def outcomes(
    user: str, wall: str, *, reaching: bool = False, every: int = 1, first: int = 0
) -> list[Outcome]:
    """Of all attacks, or of those that reach for something outside alone.

    Raises LookupError: this machine can't.

    Parameters
    ----------
    user : who grades: "root" or "another"
    wall : of ``WALLS``, or ``OPEN``
    every, first : of ``chosen``
    """
    with python_for(user) as python:
        command = [
            *python,
            "-m",
            "benchmarks.attacks",
            "--behind",
            wall,
            *(["--reaching"] if reaching else []),
            *("--every", str(every), "--first", str(first)),
        ]
        ran = subprocess.run(command, check=False, capture_output=True, text=True, cwd=PROJECT)
    if ran.returncode == 3:
        raise LookupError(ran.stderr.strip())
    if ran.returncode:
        raise RuntimeError(ran.stderr)
    lines = (json.loads(line) for line in ran.stdout.splitlines())
    return [Outcome(**line | {"effects": tuple(line["effects"])}) for line in lines]


def run_all(wall: str, *, reaching: bool, every: int, first: int) -> int:
    """Run them here and print each outcome as JSON; what to exit with."""
    with Stage() as stage:
        try:
            shut_in = behind(wall, stage.mark)
        except LookupError as error:
            print(error, file=sys.stderr)
            return 3
        for outcome in _reach(wall, stage, shut_in, chosen(wall, every, first)):
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


def _reach(
    wall: str, stage: Stage, shut_in: Sandbox, groups: Iterable[Sequence[str]]
) -> Iterator[Outcome]:
    for group in groups:
        rest = [name for name in group if (wall, name) not in NOT_HELD]
        while rest:
            with Worker("attack", _source(rest, stage).encode(), LIMITS, shut_in) as worker:
                # What can't be imported attacks nothing: that is a fault of this program.
                worker.load()
                for number, name in enumerate(rest):
                    outcome = _reached(worker, name, number, number + 1 == len(rest), stage)
                    yield outcome
                    # Whatever a worker has done, or has died of, it does no more.
                    if not outcome.held or outcome.said.startswith(ENDED):
                        break
            del rest[: number + 1]


def _source(names: Iterable[str], stage: Stage) -> str:
    bodies = (indent(dedent(REACHING[name]).strip("\n"), "    ") for name in names)
    functions = (f"def attack():\n{body}\n\nATTACKS.append(attack)\n" for body in bodies)
    return "\n".join([PRELUDE.format(stage=stage.described()), *functions])


def _reached(worker: Worker, name: str, number: int, last: bool, stage: Stage) -> Outcome:
    working = stage.workers()
    try:
        value = worker.call("run", number)
        said = bytes(np.asarray(value).astype(np.uint8)).decode("utf-8", "replace")
    except StudentError as error:
        said, last = f"{ENDED}: {error.kind} {error}", True
    if last:
        worker.close()
        working = frozenset()
    gain = said if stage.token in said or said.startswith("DONE") else ""
    if name.endswith(MANY_THREADS) and not worker.sandbox.threads:
        gain = ""  # Where they can't be counted, nobody says that they are.
    return Outcome(name, gain[:200], tuple(stage.effects(working)), said[:200])


@cache
def _baseline(shut_in: Sandbox) -> Report:
    return _graded("", shut_in)


# Made once for all attacks.
_references = cache(references)


def _graded(name: str, shut_in: Sandbox) -> Report:
    return grade(
        {MODULE: submission(name).encode()},
        _references(),
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
