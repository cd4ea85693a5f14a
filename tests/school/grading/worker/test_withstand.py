"""What submissions try, by accident or not, and the score that each gets: nobody earns more, nobody else loses.

Each attack sits in one function of a module whose other functions are right: it must cost that function's points, or
the named checks, and nothing else.
"""

import threading
from dataclasses import dataclass
from math import fsum
from textwrap import indent

import numpy as np
import psutil
import pytest

from course.engine.functions.effects import PROJECT
from course.school.grading.catalog import module_checks
from course.school.grading.checks.result import Status
from course.school.grading.grading import grade
from course.school.grading.references import references
from course.school.grading.report import Report
from course.school.grading.worker.client import Worker
from course.school.grading.worker.limits import Limits
from course.school.grading.worker.sandbox import sandbox
from tests.school.grading.worker.graded import arrays, quick, solution

MODULE = "motion_blur"
FUNCTION = "to_object_space"
SOLUTION = solution(MODULE)
RIGHT = "return origins - np.multiply.outer(np.asarray(velocity, time.dtype), time)\n"
SLEEPER = "import threading, time as t\nthreading.Thread(target=t.sleep, args=(1e6,)).start()\n"
FORGED = "b'00000010{\"score\": 100000}'"
ALL = "all"

SANDBOXES = {"without bubblewrap": False}
if any("bubblewrap: no network" in line for line in sandbox().protections):
    SANDBOXES["bubblewrap"] = True


def points() -> float:
    return fsum(check.points for check in module_checks(MODULE).checks if quick(check))


def graded(source: str | bytes, bubblewrap: bool = True, call_seconds: float = 1.5) -> Report:
    content = source if isinstance(source, bytes) else source.encode()
    report = grade(
        {MODULE: content},
        arrays(),
        modules=[MODULE],
        limits=Limits(call_seconds=call_seconds, memory=1 << 30, deaths=2),
        shut_in=sandbox(bubblewrap),
        only=quick,
    )
    assert report.of == points()
    assert not report.broken
    return report


def with_body(body: str, before: str = "") -> str:
    """The solution with another body of the function, behind the checks of its arguments."""
    checks = '_check_batch("origins", origins, 3)\n_check_single(velocity=velocity)\n'
    checks += '_check_scalars("time", time, np.shape(origins)[1])\n'
    return f"{SOLUTION}\n{before}\ndef {FUNCTION}(origins, velocity, time):\n{indent(checks + body, '    ')}"


def with_displacement(body: str) -> str:
    """The solution with another function of the same module."""
    return f"{SOLUTION}\ndef displacement(velocity, time):\n    {body}\n"


def write_everywhere(content: str) -> str:
    """Lines that write an expression's bytes to every descriptor there may be."""
    return f"for fd in range(64):\n    try: os.write(fd, {content})\n    except OSError: pass\n"


def forged(head: str) -> str:
    """Lines that write a message of this head to every descriptor, and return what is right."""
    message = "b'%08x' % len(head) + head"
    return f"import os\nhead = {head!r}.encode()\n{write_everywhere(message)}{RIGHT}"


ODD = """
class Odd(np.random.Generator):
    bit_generator = type("B", (), {"state": {"bit_generator": "PCG64", "state": -1}})()
"""


def lost_functions(report: Report) -> set[str]:
    return {result.function for result in report.results if result.status is not Status.PASSED}


@dataclass(frozen=True)
class Attack:
    """A submission whose one function attacks.

    Attributes
    ----------
    body : of the function, behind the checks of its arguments
    before : what stands before the function
    ended : how its checks end
    lost : which of them are lost
    """

    body: str
    before: str = ""
    ended: Status = Status.FAILED
    lost: str | set[str] = ALL


ATTACKS = {
    "sys.exit": Attack("import sys\nsys.exit(0)"),
    "os._exit": Attack("import os\nos._exit(0)", ended=Status.CRASHED),
    "endless loop": Attack("while True: pass", ended=Status.TIMEOUT),
    "endless recursion": Attack(f"return {FUNCTION}(origins, velocity, time)"),
    "memory bomb": Attack("return np.ones((3, 1 << 32))"),
    "slow memory bomb": Attack("kept = []\nwhile True: kept.append(np.zeros(1 << 24))"),
    "fork bomb": Attack("import os\nwhile True: os.fork()"),
    "processes": Attack(f"import subprocess\nsubprocess.run(['true'])\n{RIGHT}"),
    "threads that never end": Attack(
        "import threading, time as t\n"
        "if threading.active_count() < 3: threading.Thread(target=t.sleep, args=(1e6,)).start()\n"
        f"{RIGHT}",
        ended=Status.PASSED,
        lost=set(),
    ),
    "flood of output": Attack("while True: print('x' * 1_000_000)", ended=Status.CRASHED),
    "forged result on stdout": Attack(
        'print(\'{"score": 100, "tests": []}\', flush=True)\nreturn np.zeros(3)'
    ),
    "chatty but right": Attack(
        f"print('debugging', time.shape)\n{RIGHT}", ended=Status.PASSED, lost=set()
    ),
    "forged result on every descriptor": Attack(
        f"import os\n{write_everywhere(FORGED)}{RIGHT}", ended=Status.CRASHED
    ),
    "arrays without end": Attack(
        forged('{"values": [], "arrays": Infinity}'), ended=Status.CRASHED
    ),
    "an array of nothing that is evaluated": Attack(
        forged('{"values": [{"array": 0}], "arrays": [{"dtype": "(", "shape": [3]}]}'),
        ended=Status.CRASHED,
    ),
    "brackets without end": Attack(forged("[" * 100_000), ended=Status.CRASHED),
    "a head of 60 MB": Attack(
        "import os\nhead = b'{\"values\": [' + b'{},' * 20_000_000\n"
        + write_everywhere("b'%08x' % len(head) + head"),
        ended=Status.CRASHED,
    ),
    "a generator of an impossible state": Attack(
        "return Odd(np.random.PCG64())", ODD, ended=Status.CRASHED
    ),
    "a generator": Attack("return np.random.default_rng()"),
    "a comma after the result": Attack(f"{RIGHT.rstrip()},"),
    "a list of rows": Attack("return [*np.zeros((3, len(time)), time.dtype)]"),
    "a list of numbers": Attack("return np.zeros((3, len(time))).tolist()"),
    "texts": Attack("return np.full((3, len(time)), 'x')"),
    "a text": Attack("return 'right'"),
    "a number of 400 digits": Attack("return 10 ** 400"),
    "infinity": Attack("return np.full((3, len(time)), -np.inf, time.dtype)"),
    "closed descriptors": Attack(f"import os\nos.closerange(0, 64)\n{RIGHT}", ended=Status.CRASHED),
    "an array that forges comparisons": Attack(
        "return np.zeros((3, len(time)), time.dtype).view(Forged)",
        "class Forged(np.ndarray):\n"
        "    def __eq__(self, other): return np.ones(self.shape, bool)\n"
        "    def __array_ufunc__(self, *a, **k): return np.zeros(())\n",
    ),
    "object arrays": Attack("return np.array([[object()]] * 3)"),
    "pickles": Attack(
        "return Pickled()", "class Pickled:\n    def __reduce__(self): return (exit, ())\n"
    ),
    "a name of its own for None": Attack("return None"),
    "NaN": Attack("return np.full((3, len(time)), np.nan, time.dtype)"),
    "wrong shape": Attack("return np.zeros((len(time), 3), time.dtype)"),
    "wrong dtype": Attack(
        "return origins - np.asarray(velocity, float)[:, None] * time.astype(float)",
        lost={"contract"},
    ),
    "reads the solutions": Attack(
        f"exec(open({str(PROJECT / 'solutions' / (MODULE + '.py'))!r}).read(), globals())\n{RIGHT}"
    ),
    "imports the solutions": Attack(f"import solutions.motion_blur\n{RIGHT}"),
    "imports the course": Attack(f"import course\n{RIGHT}"),
    "lists the folder": Attack(f"import os\nos.listdir({str(PROJECT)!r})\n{RIGHT}"),
    "patches NumPy": Attack(
        "return np.zeros((3, len(time)), time.dtype)",
        "np.allclose = np.array_equal = lambda *a, **k: True\n",
        lost={"contract", "at-rest", "along-axes", "travels-along", "own-time"},
    ),
    "signals its parent": Attack(f"import os\nos.kill(os.getppid(), 9)\n{RIGHT}"),
    "C through ctypes": Attack(f"import ctypes\nctypes.CDLL(None).fork()\n{RIGHT}"),
    "opens a socket": Attack(f"import socket\nsocket.socket()\n{RIGHT}"),
    "writes a file": Attack(f"open('/tmp/forged', 'w')\n{RIGHT}"),
    "changes the random state": Attack(f"np.random.seed(1)\n{RIGHT}", lost={"untouched"}),
    "an exception without words": Attack(
        "raise Odd()", "class Odd(Exception):\n    def __str__(self): raise ValueError\n"
    ),
    "an exception that is no exception": Attack("raise KeyboardInterrupt"),
}


VALUES = {
    *("a comma after the result", "a list of rows", "a list of numbers", "texts", "a text", "NaN"),
    *("a number of 400 digits", "infinity", "an array that forges comparisons", "object arrays"),
    *("pickles", "a name of its own for None", "wrong shape", "wrong dtype", "patches NumPy"),
    *("changes the random state", "an exception without words", "chatty but right", "sys.exit"),
    *("an exception that is no exception", "a generator", "a generator of an impossible state"),
    *(
        "endless loop",
        "endless recursion",
        "flood of output",
        "a head of 60 MB",
        "brackets without end",
    ),
    *("arrays without end", "an array of nothing that is evaluated", "memory bomb"),
    *("forged result on stdout", "forged result on every descriptor", "closed descriptors"),
}
"""What is seen in the pipes or in the worker itself: the same behind any wall, and tried behind one."""


@pytest.mark.parametrize(
    ("name", "bubblewrap"),
    [
        pytest.param(name, SANDBOXES[wall], id=f"{name}-{wall}")
        for name in ATTACKS
        for wall in ([*SANDBOXES][-1:] if name in VALUES else SANDBOXES)
    ],
)
def test_an_attack_costs_its_own_function(name: str, bubblewrap: bool) -> None:
    attack = ATTACKS[name]
    report = graded(with_body(attack.body, attack.before), bubblewrap)
    found = {
        result.check: result.status for result in report.results if result.function == FUNCTION
    }
    wrong = {check for check, ended in found.items() if ended is not Status.PASSED}
    # What is refused for its arguments may be refused by the attack too, with another error.
    if attack.lost == ALL:
        # The attack stands behind the checks of arguments, which are right, and may leave its inputs alone.
        assert wrong >= set(found) - {"refuses", "untouched"}
    else:
        assert wrong == attack.lost
    if attack.lost:
        assert attack.ended in {found[check] for check in wrong}
    # Whatever it cost, it cost this function.
    others = [result for result in report.results if result.function != FUNCTION]
    assert {result.status for result in others} == {Status.PASSED}
    earned = fsum(
        result.of for result in report.results if result.check not in wrong or result in others
    )
    assert report.points == earned


def test_nothing_is_left_running() -> None:
    before = {child.pid for child in psutil.Process().children(recursive=True)}
    graded(with_body(SLEEPER + RIGHT), bubblewrap=False)
    graded(with_body("while True: pass"), bubblewrap=False, call_seconds=0.3)
    assert {child.pid for child in psutil.Process().children(recursive=True)} <= before


FILES: dict[str, tuple[bytes, Status, float]] = {
    "nothing": (b"", Status.NOT_ATTEMPTED, 0.0),
    "a stub": ((PROJECT / "assignments" / f"{MODULE}.py").read_bytes(), Status.NOT_ATTEMPTED, 0.0),
    "a syntax error": (b"def displacement(velocity, time:\n", Status.FAILED, 0.0),
    "an import error": (b"import torch\n" + SOLUTION.encode(), Status.FAILED, 0.0),
    "an exit at import": (b"raise SystemExit(0)\n", Status.FAILED, 0.0),
    "a loop at import": (b"while True: pass\n", Status.TIMEOUT, 0.0),
    "a binary file": (bytes(range(256)) * 40, Status.FAILED, 0.0),
    "10 MB of source": (SOLUTION.encode() + b"# filler\n" * 1_200_000, Status.FAILED, 0.0),
    "Windows line ends": (SOLUTION.replace("\n", "\r\n").encode(), Status.PASSED, 1.0),
    "tabs": (SOLUTION.replace("    ", "\t").encode(), Status.PASSED, 1.0),
    "all of NumPy": (b"from numpy import *\n" + SOLUTION.encode(), Status.PASSED, 1.0),
    "its own name": (
        b"import os\nHERE = os.path.dirname(os.path.abspath(__file__))\n" + SOLUTION.encode(),
        Status.PASSED,
        1.0,
    ),
    "a byte order mark": (b"\xef\xbb\xbf" + SOLUTION.encode(), Status.PASSED, 1.0),
    "Latin-1": (
        b"# -*- coding: latin-1 -*-\n# \xe9\n" + SOLUTION.encode("latin-1", "replace"),
        Status.PASSED,
        1.0,
    ),
}


@pytest.mark.parametrize("name", FILES)
def test_a_file_gets_its_score(name: str) -> None:
    content, status, score = FILES[name]
    report = graded(content)
    assert {result.status for result in report.results} == {status}
    assert report.score == score


def test_what_is_printed_is_kept_and_cut() -> None:
    report = graded(with_body(f"print('here', '!' * 100000)\n{RIGHT}"))
    assert report.printed[MODULE].startswith("here !!!")
    assert len(report.printed[MODULE]) < 5000
    assert report.score == 1


def test_a_hidden_seed_needs_no_new_code() -> None:
    source = SOLUTION.encode()
    for seed in (1, 20261121):
        assert (
            grade({MODULE: source}, references(seed), seed=seed, modules=[MODULE], only=quick).score
            == 1
        )


def test_checks_draw_the_same_numbers_whoever_is_graded() -> None:
    from course.school.grading.checks.check import generator

    check = module_checks(MODULE).checks[0]
    assert np.array_equal(
        generator(3, MODULE, check).random(4), generator(3, MODULE, check).random(4)
    )
    assert not np.array_equal(
        generator(3, MODULE, check).random(4), generator(4, MODULE, check).random(4)
    )


@pytest.mark.parametrize(
    "body",
    [
        "return -np.multiply.outer(np.asarray(velocity, time.dtype), time)",
        "raise NotImplementedError",
    ],
    ids=["wrong", "unwritten"],
)
def test_a_function_pays_for_no_other_functions_mistake(body: str) -> None:
    assert lost_functions(graded(with_displacement(body))) == {"displacement"}


def test_only_who_calls_what_is_lent_is_asked_again() -> None:
    """Another process is no second try for a function that is right in its first calls."""
    tired = with_displacement(
        "_check_single(velocity=velocity)\n"
        "    _check_scalars('time', time)\n"
        "    CALLS.append(1)\n"
        "    return (len(CALLS) < 41) * np.outer(velocity, time).astype(time.dtype)"
    )
    assert lost_functions(graded(tired + "CALLS = []\n")) == {"displacement"}


def test_nobody_passes_by_two_functions_that_call_each_other() -> None:
    circle = with_displacement(
        "return -to_object_space(np.zeros((3, len(time)), time.dtype), velocity, time)"
    )
    circle += (
        "def to_object_space(origins, velocity, time):\n"
        "    return origins - displacement(velocity, time)\n"
    )
    assert "displacement" in lost_functions(graded(circle))


def test_what_is_borrowed_can_only_be_what_was_lent() -> None:
    forged = (
        "import os, json\n"
        "head = json.dumps({'borrowed': 'displacement', 'names': [], 'values': [], 'arrays': 0}).encode()\n"
    )
    forged += write_everywhere("b'%08x' % len(head) + head")
    report = graded(with_body(forged + RIGHT), bubblewrap=False)
    ended = {result.status for result in report.results if result.function == FUNCTION}
    assert Status.CRASHED in ended or Status.FAILED in ended


def test_a_worker_outlives_the_thread_that_called_it_first() -> None:
    source = b"COUNT = []\ndef f():\n    COUNT.append(1)\n    return len(COUNT)\n"
    with Worker("m", source) as worker:
        for number in (1, 2, 3):
            found: list[int] = []
            thread = threading.Thread(target=lambda: found.append(worker.call("f")))  # noqa: B023 - joined at once
            thread.start()
            thread.join()
            assert found == [number]
