"""The machine and the versions of a measurement."""

import os
import platform
from importlib.metadata import version
from pathlib import Path

from course.base.version import __version__
from course.engine.casters.choice import software
from course.engine.loops.embree_device import available
from course.engine.render.threads import default_threads


def machine() -> dict[str, str]:
    """Names of the parts that decide a run time."""
    names = ("numpy", *(["numba"] if available() else []))
    libraries = ", ".join(
        dict.fromkeys([software(), *(f"{name} {version(name)}" for name in names)])
    )
    return {
        "processor": _processor(),
        "threads": f"{default_threads()} of {os.cpu_count()} logical cores",
        "system": f"{platform.system()} {platform.release()}",
        "software": f"Python {platform.python_version()}, {libraries}, course {__version__}",
    }


def _processor() -> str:
    """The processor's name, as the system tells it."""
    try:
        lines = Path("/proc/cpuinfo").read_text(encoding="utf-8", errors="replace").splitlines()
    except OSError:
        lines = []
    names = [line.partition(":")[2].strip() for line in lines if line.startswith("model name")]
    return names[0] if names else platform.processor() or platform.machine()
