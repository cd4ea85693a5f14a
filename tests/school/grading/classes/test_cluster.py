"""Grading on a dask cluster: the same as on this machine, though a worker is lost."""

import json
import socket
import subprocess
import sys
from collections.abc import Iterator
from contextlib import closing
from importlib.util import find_spec
from pathlib import Path
from time import sleep
from typing import Any

import pytest
from click.testing import CliRunner

from course.base.errors import CourseError
from course.cli.main import commands
from course.engine.render.cluster import connection
from course.school.grading.classes.engines import on_cluster
from course.school.grading.known import known
from tests.dask_cluster import Cluster

PROJECT = Path(__file__).parents[4]
STUB = (PROJECT / "assignments" / "thin_lens.py").read_text("utf-8")

needs_distributed = pytest.mark.skipif(
    find_spec("distributed") is None, reason="distributed isn't installed (the extra dask)"
)


@pytest.fixture
def cluster(tmp_path: Path) -> Iterator[Cluster]:
    folder = tmp_path / "cluster"
    folder.mkdir()
    with closing(Cluster(folder)) as started:
        for _ in range(2):
            started.add_worker()
        yield started


def command(folder: Path, out: Path, *arguments: str) -> list[str]:
    module = ("--modules", "thin_lens", "--seed", "3")
    return ["grade", str(folder), "--out", str(out), *module, *arguments]


def results(out: Path) -> dict[str, Any]:
    """Of all students, without the times."""
    found = {}
    for path in out.glob("*/results.json"):
        result = json.loads(path.read_text())
        del result["seconds"]
        # How fast something was is never the same again.
        result["results"] = [check for check in result["results"] if check["kind"] != "speed"]
        for check in result["results"]:
            del check["seconds"]
        found[path.parent.name] = result
    return found


@needs_distributed
def test_a_worker_is_lost_and_no_result(cluster: Cluster, tmp_path: Path) -> None:
    folder, here, there = tmp_path / "class", tmp_path / "here", tmp_path / "there"
    collection = known("thin_lens")
    sources = {one.name: one.source for one in (collection[0], collection[-1])}
    for number in range(3):
        sources[f"slow{number}"] = f"import time\ntime.sleep(0.7)\n{STUB}\n# {number}"
    for name, source in sources.items():
        (folder / name).mkdir(parents=True)
        (folder / name / "thin_lens.py").write_text(source)
    (folder / "damaged.zip").write_bytes(b"PK")

    remote = ("--engine", "dask", "--address", cluster.address)
    process = subprocess.Popen(
        [sys.executable, "-m", "course", *command(folder, there, *remote)],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        cwd=PROJECT,
    )
    while process.poll() is None and len(results(there)) < 2:
        sleep(0.02)
    assert process.poll() is None, process.communicate()
    cluster.processes[1].kill()
    done = len(results(there))
    output, errors = process.communicate(timeout=60)
    assert process.returncode == 0, errors
    assert "6 graded now" in output
    assert done < 6

    local = CliRunner().invoke(commands, command(folder, here, "--jobs", "2"))
    assert local.exit_code == 0, local.output
    assert len(results(here)) == 6
    assert results(there) == results(here)
    assert (there / "grades.csv").read_bytes() == (here / "grades.csv").read_bytes()


@needs_distributed
@pytest.mark.parametrize("listens", [False, True], ids=["nobody listens", "silent"])
def test_a_scheduler_that_does_not_answer(monkeypatch: pytest.MonkeyPatch, listens: bool) -> None:
    monkeypatch.setattr(connection, "ANSWER_WITHIN", 1)
    with socket.socket() as deaf:
        deaf.bind(("127.0.0.1", 0))
        if listens:
            deaf.listen()
        address = f"tcp://127.0.0.1:{deaf.getsockname()[1]}"
        # Whoever waits for a silent one waits for ever.
        with pytest.raises(CourseError, match=f"^{address}: no dask scheduler answered within 1 s"):
            next(on_cluster(max, ["a"], "b", address))


@needs_distributed
@pytest.mark.parametrize(
    ("which", "message"),
    [(slice(1), "the scheduler has gone"), (slice(1, None), "all workers have gone")],
)
def test_a_cluster_that_goes_is_told(
    cluster: Cluster, monkeypatch: pytest.MonkeyPatch, which: slice, message: str
) -> None:
    monkeypatch.setattr(connection, "ALONE", 0.3)
    outcomes = on_cluster(max, [f"{number:03}" for number in range(100)], "b", cluster.address)
    assert next(outcomes).value == "b"
    for process in cluster.processes[which]:
        process.kill()
        process.wait()
    with pytest.raises(CourseError, match=message):
        list(outcomes)


def test_without_distributed(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "distributed", None)
    (tmp_path / "class" / "ada").mkdir(parents=True)
    arguments = ("--engine", "dask", "--address", "tcp://127.0.0.1:9")
    result = CliRunner().invoke(commands, command(tmp_path / "class", tmp_path / "out", *arguments))
    assert result.exit_code == 1
    assert 'pip install "penumbra-course[dask]"' in result.output
