"""Whatever is wrong with a file, its reader refuses it in a line or reads it: no traceback, no crash, no hang.

The readers run in a process of their own, which may end by a fault of a library; 10,000 files are tried by
`pytest tests/engine/stress --hypothesis-profile=stress`, and a few hundred otherwise.
"""

import json
import os
import re
import select
import subprocess
import sys
from pathlib import Path
from types import TracebackType

import pytest

from tests.engine.stress.file_kinds import Kind, file_kinds
from tests.engine.stress.mutations import mutated
from tests.lengths import LONG

ROOT = Path(__file__).parents[3]
KINDS = {kind.name: kind for kind in file_kinds()}
FILES = 10_000 // (len(KINDS) - 1) if LONG else 16
"""Of each kind, but for those with a smaller share."""

ARCHIVES = 1 if LONG else 1 / 4
"""The share of work in archives, each of which a process of its own unpacks."""

SECONDS = 20.0
"""For a file that takes thousandths; a machine that does much else may be slow, too."""

MEGABYTES = 300.0
"""That a file of a few kilobytes may take, libraries that are loaded for it included."""


class Reading:
    """The process of the readers, which is begun anew where it has ended."""

    def __init__(self, folder: Path) -> None:
        self._folder = folder
        self._process: subprocess.Popen[str] | None = None

    def __enter__(self) -> "Reading":
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self._end()

    def _end(self) -> int:
        if self._process is None:
            return 0
        with self._process as process:
            process.kill()
        self._process = None
        return process.returncode

    def ask(self, name: str, path: Path) -> tuple[str, str, str, float, float]:
        """What became of a file: outcome, what is told, what is printed, seconds, megabytes."""
        if self._process is None:
            self._process = subprocess.Popen(
                [
                    sys.executable,
                    "-m",
                    "tests.engine.stress.reading_process",
                    self._folder / "printed",
                ],
                stdin=subprocess.PIPE,
                stdout=subprocess.PIPE,
                text=True,
                cwd=ROOT,
                env={**os.environ, "PYTHONPATH": str(ROOT)},
            )
        process = self._process
        assert process.stdin is not None
        assert process.stdout is not None
        process.stdin.write(json.dumps([name, str(path)]) + "\n")
        process.stdin.flush()
        # The first file waits for the libraries.
        if not select.select([process.stdout], [], [], SECONDS + 60)[0]:
            self._end()
            return "hangs", "", "", SECONDS, 0.0
        answer = process.stdout.readline()
        if not answer:
            process.wait()
            return f"ends the process ({self._end()})", "", "", 0.0, 0.0
        outcome, told, printed, seconds, memory = json.loads(answer)
        return outcome, told, printed, seconds, memory


def complaint(kind: Kind, path: Path, answer: tuple[str, str, str, float, float]) -> str:
    """What is wrong with an answer; "" where nothing is."""
    outcome, told, printed, seconds, memory = answer
    if outcome not in ("read", "refused"):
        return f"{outcome} {told}"
    if printed:
        return f"prints {printed}"
    if seconds > SECONDS:
        return f"takes {seconds:.0f} s"
    if memory > MEGABYTES:
        return f"takes {memory:.0f} MB"
    if "\n" in told and not kind.name.startswith(("work", "motion_blur")):
        return f"tells more than a line: {told}"
    if outcome == "refused" and path.stem not in told and not kind.name.startswith("work"):
        return f"doesn't name the file: {told}"
    return f"tells too much: {told}" if len(told) > len(str(path)) * 3 + 1500 else ""


@pytest.mark.skipif(sys.platform == "win32", reason="select is for sockets alone there")
def test_mutated_files_are_read_or_refused_in_a_line(tmp_path: Path) -> None:
    others = [kind.content for kind in KINDS.values()]
    wrong, few = [], []
    with Reading(tmp_path) as reading:
        for kind in KINDS.values():
            folder = tmp_path / kind.name
            folder.mkdir()
            (folder / "converted").mkdir()
            path = folder / kind.name
            path.write_bytes(kind.content)
            # Libraries are loaded here, so that a file's own memory is seen after it.
            right = reading.ask(kind.name, path)
            if right[:3] != ("read", "", ""):
                wrong.append(f"{kind.name} as it is: {right}")
            if kind.name == "text.stl":
                # Of normals that are no numbers the library notes a traceback in its log.
                path.write_bytes(re.sub(rb"normal \S+ \S+", b"normal 1 x", kind.content))
                if (quiet := reading.ask(kind.name, path)[:3]) != ("read", "", ""):
                    wrong.append(f"{kind.name} without normals: {quiet}")
            refused = 0
            archive = kind.name.startswith("work")
            files = max(2, int(FILES * kind.share * (ARCHIVES if archive else 1)))
            for number in range(files):
                path.write_bytes(mutated(kind, number, others))
                answer = reading.ask(kind.name, path)
                refused += answer[0] == "refused"
                if trouble := complaint(kind, path, answer):
                    wrong.append(f"{kind.name}, number {number}: {trouble}")
            if refused < files / 5:
                few.append(f"{kind.name}: {refused} of {files}")
    assert not wrong, f"{len(wrong)} in all:\n" + "\n".join(wrong[:20])
    assert not few, "mutations that hardly any reader minds say little"


def test_mutations_are_always_the_same_and_differ() -> None:
    kind = KINDS["text.ply"]
    files = [mutated(kind, number, [b"other"]) for number in range(50)]
    assert files == [mutated(kind, number, [b"other"]) for number in range(50)]
    assert len(set(files)) > 40
    assert kind.content not in files[:3]
