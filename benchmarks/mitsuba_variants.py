"""Mitsuba's variants: the LLVM one, where there is an LLVM that it can use, and the scalar one.

A process has one of them switched on at a time.
"""

from __future__ import annotations

import os
import re
from pathlib import Path

from benchmarks.mitsuba_export import NotExportableError

OLDEST_LLVM = 17
LIBRARY_FOLDERS = (
    "/usr/lib",
    "/usr/lib64",
    "/usr/local/lib",
    "/opt/homebrew/opt",
    "/usr/local/opt",
)


def find_llvm() -> Path | None:
    """The newest LLVM library that the variant can use; None where there is none.

    With an LLVM older than 17 the process aborts, so the version is told from the file's name.
    """
    named = os.environ.get("DRJIT_LIBLLVM_PATH")
    if named:
        return Path(named)
    found = []
    for folder in LIBRARY_FOLDERS:
        for pattern in ("libLLVM*", "*/libLLVM*", "llvm*/lib/libLLVM*", "*/llvm*/lib/libLLVM*"):
            for path in Path(folder).glob(pattern):
                version = re.search(r"libLLVM(?:-|\.so\.|\.)(\d+)", path.name)
                if version and path.exists() and int(version[1]) >= OLDEST_LLVM:
                    found.append((int(version[1]), str(path)))
    return Path(max(found)[1]) if found else None


def start_llvm(threads: int) -> None:
    """Switch Mitsuba to its LLVM variant.

    Raises NotExportableError: there is no LLVM on this machine that Mitsuba can use.
    """
    library = find_llvm()
    if library is None:
        raise NotExportableError(
            f"no LLVM {OLDEST_LLVM} or newer was found; install one (Debian: libllvm19) or name the library in"
            " DRJIT_LIBLLVM_PATH"
        )
    os.environ["DRJIT_LIBLLVM_PATH"] = str(library)
    _start("llvm_ad_rgb", threads)


def start_scalar(threads: int) -> None:
    """Switch Mitsuba to its scalar variant."""
    _start("scalar_rgb", threads)


def start_fastest(threads: int) -> None:
    """Switch Mitsuba to its LLVM variant, or to its scalar one on a machine without LLVM."""
    (start_scalar if find_llvm() is None else start_llvm)(threads)


def _start(variant: str, threads: int) -> None:
    import drjit
    import mitsuba

    mitsuba.set_variant(variant)
    # Samplers that round the number of samples up would say so each time; `Sensors.samples` tells it.
    mitsuba.set_log_level(mitsuba.LogLevel.Error)
    drjit.set_thread_count(threads)
