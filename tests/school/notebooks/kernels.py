"""A notebook's kernel, to run cells in and to look at what they show."""

import re
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from queue import Empty
from typing import Any

import pytest


@dataclass
class Outputs:
    """What a cell has shown.

    Attributes
    ----------
    text : what it has printed, without colours
    shown : bundles by kind, as a notebook keeps them
    error : of Python, in a line
    trace : lines of the traceback that is shown
    number : that the notebook shows beside the cell
    """

    text: str = ""
    shown: list[dict[str, str]] = field(default_factory=list)
    error: str = ""
    trace: list[str] = field(default_factory=list)
    number: int = 0


LEND = """
from pathlib import PosixPath, WindowsPath
import course.school.notebooks.extension
from course.school.grading.references import read_references

def lent(seed, files={files}, read=read_references, usual=course.school.notebooks.extension.references):
    found = {{module: read(file, seed) for module, file in files.items()}}
    return lambda module, check: found.get(module, usual(seed))(module, check) if check.prepare else {{}}

course.school.notebooks.extension.references = lent
del PosixPath, WindowsPath, course, lent, read_references
"""
"""Has checks of some modules in a kernel compare with references that are made once for all processes of a run."""


class Kernel:
    """A kernel whose cells are run one after the other."""

    def __init__(self, folder: Path) -> None:
        manager = pytest.importorskip(
            "jupyter_client.manager", reason='kernels need: pip install -e ".[notebook]"'
        )
        self.manager, self.client = manager.start_new_kernel(cwd=str(folder))

    def lend(self, files: Mapping[str, Path]) -> None:
        """Let its checks compare with the references of these files; module -> file."""
        done = self.run(LEND.format(files=dict(files)))
        assert not done.error, done.error

    def run(self, code: str, key: str | None = None, interrupt: str = "") -> Outputs:
        """Run a cell.

        Parameters
        ----------
        key : which cell it is, as JupyterLab says it
        interrupt : what the cell prints before it is interrupted; empty to leave it alone
        """
        metadata = {} if key is None else {"cellId": key}
        content = {
            "code": code,
            "silent": False,
            "store_history": True,
            "user_expressions": {},
            "allow_stdin": False,
            "stop_on_error": True,
        }
        message = self.client.session.msg("execute_request", content, metadata=metadata)
        self.client.shell_channel.send(message)
        found = Outputs()
        ids: dict[str, int] = {}
        while True:
            try:
                said = self.client.get_iopub_msg(timeout=600)
            except Empty:
                raise AssertionError(f"the kernel doesn't answer: {code}") from None
            if said["parent_header"].get("msg_id") != message["header"]["msg_id"]:
                continue
            told = said["content"]
            if self._take(said["msg_type"], told, found, ids):
                return found
            if interrupt and interrupt in found.text:
                interrupt = ""
                self.manager.interrupt_kernel()

    @staticmethod
    def _take(kind: str, told: dict[str, Any], found: Outputs, ids: dict[str, int]) -> bool:
        """Add a message; whether it was the last one."""
        if kind == "execute_input":
            found.number = told["execution_count"]
        elif kind == "stream":
            found.text += re.sub(r"\x1b\[[0-9;]*m", "", told["text"])
        elif kind in ("display_data", "execute_result"):
            if name := told.get("transient", {}).get("display_id"):
                ids[name] = len(found.shown)
            found.shown.append(told["data"])
        elif kind == "update_display_data":
            found.shown[ids[told["transient"]["display_id"]]] = told["data"]
        elif kind == "error":
            found.error = f"{told['ename']}: {told['evalue']}"
            found.trace = told["traceback"]
        return kind == "status" and told["execution_state"] == "idle"

    def close(self) -> None:
        """End it."""
        self.client.stop_channels()
        self.manager.shutdown_kernel(now=True)


@contextmanager
def kernel(folder: Path) -> Iterator[Kernel]:
    """A kernel that ends with the context."""
    pytest.importorskip("ipykernel", reason='kernels need: pip install -e ".[notebook]"')
    found = Kernel(folder)
    try:
        yield found
    finally:
        found.close()
