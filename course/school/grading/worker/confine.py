"""How a worker gives up what student code must not have, before any of that code is read.

Runs in the worker, and so needs nothing but the standard library. All of it is the kernel's: what has been given up
here can't be had back by anything that runs in the process later. Each step that is asked for is taken, or the
process ends.

Landlock has three system calls, and its binding on PyPI is a development release; so they are called here.
"""

import base64
import ctypes
import os
import signal
import sys
from collections.abc import Iterable
from typing import Any

_DEATH_SIGNAL, _SECCOMP, _NO_NEW_PRIVILEGES, _FILTER = 1, 22, 38, 2
_NEW_USERS = 0x10000000
_CREATE, _ADD, _RESTRICT = 444, 445, 446
_READ_FILE, _READ_FOLDER = 1 << 2, 1 << 3
_VERSION_ASKED, _BENEATH = 1, 1

# What each version of Landlock can forbid: rights on files, on TCP, on other processes.
_FILE_RIGHTS = {1: 13, 2: 14, 3: 15, 5: 16}
_NETWORK_SINCE, _SCOPES_SINCE = 4, 6


class _Beneath(ctypes.Structure):
    _pack_ = 1
    _layout_ = "ms"
    _fields_ = [("allowed", ctypes.c_uint64), ("folder", ctypes.c_int32)]


class _Program(ctypes.Structure):
    _fields_ = [("length", ctypes.c_ushort), ("instructions", ctypes.c_char_p)]


def confine(wall: dict[str, Any]) -> None:
    """Give up what the wall says; Linux only, if it says anything.

    Raises OSError: a step isn't possible here.
    ``wall``: ``uid`` to become, or None; ``users``: whether to make a namespace of users, in which threads are counted
    anew; ``threads``: how many there may be, 0 for no limit; ``landlock``: folders and files that may still be read, or
    None; ``filter``: of system calls, in base 64, empty for none
    """
    if not any(wall.values()):
        return
    library = ctypes.CDLL(None, use_errno=True)
    # Landlock and the filter hold for the thread that asks, and those that it starts.
    if len(os.listdir("/proc/self/task")) > 1:  # noqa: PTH208 - pathlib isn't loaded here
        raise OSError("the worker has threads already")
    if wall["uid"] is not None:
        os.setgroups([])
        os.setresgid(wall["uid"], wall["uid"], wall["uid"])
        os.setresuid(wall["uid"], wall["uid"], wall["uid"])
    if wall["users"]:
        _must(library.unshare(_NEW_USERS))
    if wall["threads"]:
        # Not before: a namespace takes over its maker's limit, for all threads that the user has anywhere.
        limit_threads(wall["threads"])
    _drop_capabilities(library)
    _must(library.prctl(_DEATH_SIGNAL, signal.SIGKILL, 0, 0, 0))
    _must(library.prctl(_NO_NEW_PRIVILEGES, 1, 0, 0, 0))
    if wall["landlock"] is not None:
        _close_files(library, wall["landlock"])
    if wall["filter"]:
        program = base64.b64decode(wall["filter"])
        _must(
            library.prctl(
                _SECCOMP, _FILTER, ctypes.byref(_Program(len(program) // 8, program)), 0, 0
            )
        )
    sys.dont_write_bytecode = True


def landlock_version() -> int:
    """Version of Landlock that the kernel has; 0 for none."""
    if sys.platform != "linux":
        return 0
    return max(int(ctypes.CDLL(None).syscall(_CREATE, None, 0, _VERSION_ASKED)), 0)


def limit_threads(count: int) -> None:
    """Limit the threads of the user that this process belongs to, in its namespace of users."""
    import resource  # no part of Python on Windows

    hard = resource.getrlimit(resource.RLIMIT_NPROC)[1]
    limit = count if hard == resource.RLIM_INFINITY else min(count, hard)
    resource.setrlimit(resource.RLIMIT_NPROC, (limit, limit))


def _drop_capabilities(library: Any) -> None:
    """Root without capabilities is a user like any other, but for what belongs to it."""
    # The version of the call and this process; no right effective, permitted or inheritable.
    header, none = (ctypes.c_uint32 * 2)(0x20080522, 0), (ctypes.c_uint32 * 6)()
    _must(library.capset(ctypes.byref(header), none))


def _close_files(library: Any, readable: Iterable[str]) -> None:
    version = landlock_version()
    rights = max((count for since, count in _FILE_RIGHTS.items() if version >= since), default=0)
    network, scopes = (3 if version >= since else 0 for since in (_NETWORK_SINCE, _SCOPES_SINCE))
    ruleset = (ctypes.c_uint64 * 3)((1 << rights) - 1, network, scopes)
    rules = _must(library.syscall(_CREATE, ctypes.byref(ruleset), ctypes.sizeof(ruleset), 0))
    for path in readable:
        try:
            folder = os.open(path, os.O_PATH | os.O_CLOEXEC)
        except OSError:
            continue  # What can't be reached can't be read either.
        allowed = _READ_FILE | (_READ_FOLDER if os.path.isdir(path) else 0)  # noqa: PTH112
        beneath = _Beneath(allowed, folder)
        _must(library.syscall(_ADD, rules, _BENEATH, ctypes.byref(beneath), 0))
        os.close(folder)
    _must(library.syscall(_RESTRICT, rules, 0))
    os.close(rules)


def _must(result: int) -> int:
    if result < 0:
        number = ctypes.get_errno()
        raise OSError(number, os.strerror(number))
    return result
