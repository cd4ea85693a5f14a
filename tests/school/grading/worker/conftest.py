"""Fixtures of the tests of a worker."""

import pytest

from course.school.grading.worker.client import Worker


@pytest.fixture
def starts(monkeypatch: pytest.MonkeyPatch) -> list[str]:
    """The modules of the processes that were started, of students' and the reference's."""
    found: list[str] = []
    usual = Worker._start

    def start(worker: Worker) -> None:
        found.append(worker.module)
        usual(worker)

    monkeypatch.setattr(Worker, "_start", start)
    return found
