"""The environment of Python processes that the course starts."""

import os
import sys
from pathlib import Path


def environment_apart() -> dict[str, str]:
    """The environment of a Python process that imports what this one does, and no `random.py` of the current folder."""
    path = os.pathsep.join([str(Path(__file__).resolve().parents[1]), *filter(None, sys.path)])
    return {**os.environ, "PYTHONPATH": path, "PYTHONSAFEPATH": "1"}
