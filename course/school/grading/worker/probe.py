"""A probe of all that code in a worker could still do: it runs in one, behind its walls, and prints what it finds.

The grader hands this file's text to a worker's Python with ``-c``, so no sandbox needs to show it.
"""

import contextlib
import json
import os
import sys
from collections.abc import Callable
from typing import Any


def main() -> None:
    """Print the names of the guarantees that don't hold."""
    settings = json.loads(sys.argv[1])
    sys.path[:0] = settings["path"]
    import confine  # type: ignore[import-not-found]  # its folder has just been put there
    import numpy as np

    confine.confine(settings["wall"])
    # What students may import must still be there.
    import fractions  # noqa: F401
    import zipfile  # noqa: F401

    import numpy.polynomial

    np.ones(3) @ np.ones((3, 3))
    found = {
        "read": any(_works(_open, path, os.O_RDONLY) for path in settings["secrets"]),
        "write": any(_works(_create, path) for path in settings["folders"])
        or any(_works(_change_mode, path) for path in settings["secrets"])
        or any(_works(_open, path, os.O_WRONLY) for path in settings["files"]),
        # What has a network of its own may have sockets: they lead nowhere.
        "network": _works(_connect, settings["port"])
        or (not settings["own_world"] and _works(_socket)),
        "processes": _works(_signal, settings["grader"])
        or (not settings["own_world"] and _works(_fork)),
        "threads": not _bounded(settings["wall"]["threads"]),
    }
    sys.stdout.write(json.dumps([name for name, can in found.items() if can]))


def _works(act: Callable[..., Any], *arguments: Any) -> bool:
    try:
        act(*arguments)
    except OSError:
        return False
    return True


def _bounded(threads: int) -> bool:
    """True where so many threads are the limit, and none but the worker's own are counted."""
    import threading

    threading.stack_size(1 << 16)
    done = threading.Event()
    started = 0
    try:
        for _ in range(threads):
            threading.Thread(target=done.wait, daemon=True).start()
            started += 1
    except RuntimeError:
        pass
    finally:
        done.set()
    # The worker's own are its first one and bubblewrap's process; kernels before 5.14 count all of the user's.
    return threads - 4 <= started < threads


def _open(path: str, flags: int) -> None:
    os.close(os.open(path, flags))


def _create(folder: str) -> None:
    path = f"{folder}/.penumbra-{os.getpid()}"
    os.close(os.open(path, os.O_CREAT | os.O_EXCL | os.O_WRONLY))
    os.unlink(path)  # noqa: PTH108 - what runs here has no pathlib yet


def _change_mode(path: str) -> None:
    os.chmod(path, os.stat(path).st_mode & 0o7777)  # noqa: PTH101, PTH116


def _connect(port: int) -> None:
    import socket

    with contextlib.closing(socket.create_connection(("127.0.0.1", port), 2)):
        pass


def _socket() -> None:
    import socket

    socket.socket(socket.AF_INET, socket.SOCK_DGRAM).close()


def _signal(process: int) -> None:
    os.kill(process, 0)


def _fork() -> None:
    child = os.fork()
    if not child:
        os._exit(0)
    os.waitpid(child, 0)


if __name__ == "__main__":
    main()
