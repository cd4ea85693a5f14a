"""A real Dask scheduler and its workers, each a process of its own on this machine."""

import json
import os
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path

ROOT = Path(__file__).parents[1]
START = 60
"""Seconds in which a busy machine has started what a test needs."""


class Cluster:
    """A scheduler and its workers."""

    def __init__(self, folder: Path) -> None:
        self._folder = folder
        self._file = folder / "scheduler.json"
        self.processes: list[subprocess.Popen[bytes]] = []
        self.scheduler = self._start("scheduler", "--port", "0", "--dashboard-address", ":0")
        try:
            # Its last character is there when the others are.
            wait_until(lambda: self._file.exists() and self._file.read_text().rstrip()[-1:] == "}")
        except BaseException:
            self.close()
            raise
        self.address: str = json.loads(self._file.read_text())["address"]

    def add_worker(self) -> subprocess.Popen[bytes]:
        return self._start(
            *("worker", "--nthreads", "1", "--no-nanny", "--no-dashboard"),
            *("--local-directory", str(self._folder), "--memory-limit", "0"),
        )

    def wait_for_workers(self, count: int) -> None:
        import distributed

        with distributed.Client(self.address, set_as_default=False) as client:
            client.wait_for_workers(count, timeout=START)

    def close_workers(self) -> None:
        """End them, and wait until the scheduler knows."""
        for process in self.processes[1:]:
            process.kill()
            process.wait()
        import distributed

        with distributed.Client(self.address, set_as_default=False) as client:
            wait_until(lambda: not client.scheduler_info()["workers"])

    def close(self) -> None:
        for process in self.processes:
            process.kill()
            process.wait()

    def _start(self, kind: str, *options: str) -> subprocess.Popen[bytes]:
        command = [sys.executable, "-m", f"distributed.cli.dask_{kind}", "--host", "127.0.0.1"]
        with (self._folder / f"{kind}-{len(self.processes)}.log").open("wb") as log:
            process = subprocess.Popen(
                [*command, "--scheduler-file", str(self._file), *options],
                cwd=self._folder,
                # A worker that is killed leaves the scenes that it keeps: there, where the tests clear up.
                env={**os.environ, "PYTHONPATH": str(ROOT), "TMPDIR": str(self._folder)},
                stdout=log,
                stderr=log,
            )
        self.processes.append(process)
        return process


def wait_until(true: Callable[[], bool]) -> None:
    end = time.monotonic() + START
    while not true():
        assert time.monotonic() < end, "it takes too long"
        time.sleep(0.02)
