"""What bubblewrap is told, so that a worker sees Python, NumPy and its own files, and nothing else."""

from __future__ import annotations

import sys
from collections.abc import Mapping, Sequence
from pathlib import Path

_NOBODY = ("--unshare-user", "--uid", "65534", "--gid", "65534")
ISOLATED: tuple[Sequence[str], ...] = (
    (*_NOBODY, "--disable-userns", "--cap-drop", "ALL"),
    (*_NOBODY, "--cap-drop", "ALL"),
    ("--cap-drop", "ALL"),
)
"""Options from what the newest bubblewrap can do down: no capabilities ever, for root keeps them all otherwise."""


def bubblewrap_options(isolated: Sequence[str], shown: Mapping[str, str]) -> list[str]:
    """All options.

    Parameters
    ----------
    isolated : one of ``ISOLATED``
    shown : path inside -> file or folder that is seen there, if it is there
    """
    options = ["--unshare-all", *isolated, "--die-with-parent", "--new-session", "--clearenv"]
    options += ["--setenv", "OPENBLAS_NUM_THREADS", "1", "--setenv", "PYTHONHASHSEED", "0"]
    for name in ("/usr/lib", "/usr/lib64", "/usr/lib32", "/lib", "/lib64"):
        folder = Path(name)
        if folder.is_symlink():
            options += ["--symlink", str(folder.readlink()), name]
        elif folder.is_dir():
            options += ["--ro-bind", name, name]
    if Path("/etc/ld.so.cache").exists():
        options += ["--ro-bind", "/etc/ld.so.cache", "/etc/ld.so.cache"]
    # Of Python itself its program, its library and nothing else that may lie beside them.
    for path in Path(sys.base_prefix).resolve().glob("lib/libpython*"):
        options += ["--ro-bind", str(path), str(path)]
    for inside, outside in shown.items():
        if Path(outside).exists():
            options += ["--ro-bind", outside, inside]
    options += ["--proc", "/proc", "--dev", "/dev"]
    # Without the last, root outside could still write what root may in /proc/sys, capabilities or not.
    options += ["--remount-ro", "/dev", "--remount-ro", "/", "--remount-ro", "/proc"]
    return [*options, "--chdir", "/"]
