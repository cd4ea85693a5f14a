"""Messages between the studio and a process that renders: a map of JSON, and arrays."""

import json
import threading
from collections.abc import Iterator
from typing import IO, Any

import numpy as np

from course.school.grading.worker.framing import BrokenMessage, pack, unpack

Message = tuple[dict[str, Any], list[Any]]
"""What is told, and the arrays that belong to it."""


class Channel:
    """Sends messages to a pipe, from any number of threads."""

    def __init__(self, pipe: IO[bytes]) -> None:
        self._pipe = pipe
        self._lock = threading.Lock()

    def send(self, told: dict[str, Any], *arrays: Any) -> None:
        """Send one message; OSError if the other end is gone."""
        text = np.frombuffer(json.dumps(told).encode(), np.uint8)
        data = pack({}, [text, *arrays])
        with self._lock:
            self._pipe.write(data)
            self._pipe.flush()

    def close(self) -> None:
        """Close the pipe."""
        with self._lock:
            self._pipe.close()


def messages(pipe: IO[bytes]) -> Iterator[Message]:
    """All messages of a pipe, until it ends or what comes is none."""

    def read(count: int) -> bytearray:
        data = pipe.read(count)
        if len(data) != count:
            raise EOFError
        return bytearray(data)

    while True:
        try:
            _, (text, *arrays) = unpack(read, generators=False)
            yield json.loads(bytes(text)), arrays
        except (EOFError, OSError, BrokenMessage, ValueError):
            return
