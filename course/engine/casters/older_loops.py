"""Loops that Numba has compiled are kept on disk; those that are older than a source beside them are compiled anew."""

import atexit
import logging
import os
import shutil
import tempfile
from contextlib import suppress
from pathlib import Path
from types import FunctionType

from numba import config
from numba.core.caching import FunctionCache


def forget_older_loops(folder: Path) -> None:
    """Delete what is older than any source of a folder; Numba looks at a loop's own file only, not at what it calls.

    Where Numba finds no folder to keep loops in, it gets one until this process ends, for it would refuse to compile.
    """
    sources = list(folder.glob("*.py"))
    try:
        kept = _place(sources[0])
    except RuntimeError:
        config.CACHE_DIR = tempfile.mkdtemp(prefix="penumbra-loops-")
        # For processes that compile, too.
        os.environ["NUMBA_CACHE_DIR"] = config.CACHE_DIR
        atexit.register(shutil.rmtree, config.CACHE_DIR, ignore_errors=True)
        logging.getLogger("course").warning(
            "compiled loops can't be kept for the next time: set NUMBA_CACHE_DIR to a folder that can be written"
        )
        kept = _place(sources[0])
    newest = max(file.stat().st_mtime for file in sources)
    for index in kept.glob("*.nbi"):
        # Another process may have deleted it, too.
        with suppress(FileNotFoundError):
            if index.stat().st_mtime < newest:
                index.unlink()


def _place(source: Path) -> Path:
    """The folder in which Numba keeps loops of a source; RuntimeError where it finds none."""
    somewhere = FunctionType(_place.__code__.replace(co_filename=str(source)), {})
    return Path(FunctionCache(somewhere).cache_path)
