"""What two processes of a run need compiled is compiled by one of them."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

from tests.compiling import alone
from tests.forms import needs_numba
from tests.processes import ROOT

LOOP = """
from numba import njit
@njit(cache=True)
def twice(x):
    return x + x
@njit(cache=True)
def thrice(x):
    return twice(x) + x
"""

PROGRAM = """
import sys
from pathlib import Path
from numba.core import event
from tests.compiling import take_turns
take_turns(Path(sys.argv[1]))
import loop
print("ready", flush=True)
with event.install_recorder("numba:compile") as recorder:
    tripled = loop.thrice(4)
print(tripled, sum(one.is_start for _, one in recorder.buffer))
"""


@needs_numba
def test_of_two_processes_one_compiles_and_the_other_reads(tmp_path: Path) -> None:
    (tmp_path / "loop.py").write_text(LOOP, encoding="utf-8")
    path = os.pathsep.join([str(tmp_path), str(ROOT)])
    with alone(tmp_path):
        both = [
            subprocess.Popen(
                [sys.executable, "-c", PROGRAM, tmp_path],
                env={**os.environ, "PYTHONPATH": path},
                stdout=subprocess.PIPE,
                text=True,
            )
            for _ in range(2)
        ]
        for one in both:
            assert one.stdout is not None
            assert one.stdout.readline() == "ready\n"
    said = sorted(one.communicate(timeout=300)[0] for one in both)
    # The two functions of the loop; nothing.
    assert said == ["12 0\n", "12 2\n"]


def test_one_is_alone_until_it_ends(tmp_path: Path) -> None:
    with alone(tmp_path):
        pass
    with pytest.raises(ValueError, match="it goes wrong"), alone(tmp_path):
        raise ValueError("it goes wrong")
    with alone(tmp_path):
        pass
