"""Reads the files whose kinds and names come in by lines, and says what became of each; run as a process of its own.

Besides what the reader does, it tells what the libraries print by themselves, and how much memory a file took.
"""

import json
import os
import sys
import time
import traceback
import warnings
from pathlib import Path

from course.base.errors import CourseError, CourseWarning
from tests.engine.stress.file_kinds import file_kinds


def most_memory() -> float:
    """MB that the process has had at most since it was last asked to forget; 0 where nobody tells."""
    try:
        rows = Path("/proc/self/status").read_text(encoding="ascii").splitlines()
        Path("/proc/self/clear_refs").write_text("5", encoding="ascii")
    except OSError:
        return 0.0
    return next(int(row.split()[1]) / 1024 for row in rows if row.startswith("VmHWM"))


def main() -> None:
    """Answer until nothing comes in any more."""
    warnings.simplefilter("error")
    warnings.simplefilter("ignore", CourseWarning)
    printed = Path(sys.argv[1])
    answers = os.fdopen(os.dup(1), "w", encoding="utf-8")
    aside = os.open(printed, os.O_RDWR | os.O_CREAT | os.O_APPEND)
    os.dup2(aside, 1)
    os.dup2(aside, 2)
    readers = {kind.name: kind.read for kind in file_kinds()}
    for line in sys.stdin:
        name, path = json.loads(line)
        before, start = most_memory(), time.perf_counter()
        outcome, told = "read", ""
        try:
            result = readers[name](Path(path))
            # A submission tells its trouble itself, in lines of its own.
            told = str(getattr(result, "trouble", ""))
            outcome = "refused" if told else "read"
        except CourseError as error:
            outcome, told = "refused", str(error)
        except BaseException:  # noqa: BLE001 - whatever it is, it is told
            outcome, told = "raised", traceback.format_exc()[-2000:]
        seconds = time.perf_counter() - start
        sys.stderr.flush()
        said = printed.read_bytes().decode("utf-8", "replace")[:500]
        os.ftruncate(aside, 0)
        memory = most_memory() - before
        answers.write(json.dumps([outcome, told, said, seconds, memory]) + "\n")
        answers.flush()


if __name__ == "__main__":
    main()
