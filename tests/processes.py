"""Python in a process of its own, and what it has printed."""

import os
import subprocess
import sys
from collections.abc import Mapping
from pathlib import Path

ROOT = Path(__file__).parents[1]


def python(
    *words: object,
    folder: Path = ROOT,
    path: Path | str = ROOT,
    environment: Mapping[str, str] = os.environ,
    may_fail: bool = False,
) -> subprocess.CompletedProcess[str]:
    """The end of `python WORDS` in a folder, with the modules of ``path``; a good end unless it may fail."""
    done = subprocess.run(
        [sys.executable, *map(str, words)],
        cwd=folder,
        env={**environment, "PYTHONPATH": str(path)},
        check=False,
        capture_output=True,
        text=True,
        timeout=300,
    )
    assert may_fail or done.returncode == 0, done.stdout + done.stderr
    return done
