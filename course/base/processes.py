"""What the course's own processes import: nothing of the current folder, where a submission may be a `struct.py`."""

import os
import sys
from pathlib import Path

READ_THERE = {".numba_config.yaml": "Numba", "matplotlibrc": "Matplotlib"}
"""Files of the current folder that a library obeys, and which: Numba's may name a folder of programs that are run."""


def stay_apart() -> None:
    """Let this process and all that it starts, in whatever way, import nothing by a relative path."""
    sys.path[:] = filter(os.path.isabs, sys.path)
    # The processes of a pool, too, begin with `python -c`, which looks into the current folder first.
    os.environ["PYTHONSAFEPATH"] = "1"


def environment_apart() -> dict[str, str]:
    """The environment of a Python process that imports what this one does, and no `random.py` of the current folder."""
    path = os.pathsep.join([str(Path(__file__).resolve().parents[2]), *filter(None, sys.path)])
    return {**os.environ, "PYTHONPATH": path, "PYTHONSAFEPATH": "1"}
