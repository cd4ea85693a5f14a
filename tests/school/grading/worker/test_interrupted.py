"""Ctrl-C while a worker is started ends it, and nothing else is told."""

from threading import Thread

import psutil
import pytest

from course.school.grading.grading import grade
from course.school.grading.worker.sandbox import plain
from tests.school.grading.worker.graded import arrays, quick, solution


def graded() -> float:
    content = {"motion_blur": solution("motion_blur").encode()}
    return grade(content, arrays(), modules=["motion_blur"], shut_in=plain(), only=quick).points


@pytest.mark.parametrize("begun", [False, True])
@pytest.mark.parametrize("of", ["_keep_printed", "_look_after"])
def test_ctrl_c_while_a_thread_of_a_worker_is_started(
    of: str, begun: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    before = {child.pid for child in psutil.Process().children(recursive=True)}
    start, reached = Thread.start, list[str]()

    def interrupted(thread: Thread) -> None:
        does = getattr(getattr(thread, "_target", None), "__name__", "")
        if does != of or begun:
            start(thread)
        if does == of:
            reached.append(does)
            raise KeyboardInterrupt

    with monkeypatch.context() as patch:
        patch.setattr(Thread, "start", interrupted)
        with pytest.raises(KeyboardInterrupt):
            graded()
    assert reached
    assert {child.pid for child in psutil.Process().children(recursive=True)} <= before
    assert graded() > 0
