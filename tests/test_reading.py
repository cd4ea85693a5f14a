"""Every test file is one process's to read first, and what is wrong with it is not told before its turn."""

import re
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

from tests.processes import ROOT
from tests.reading import read_a_share

COMPILED_WHEN_IMPORTED = re.compile(
    r"^(from|import) course\.engine\.casters.*\b(compiled|cast_kernels|build_kernels)\b",
    re.MULTILINE,
)
"""What has loops with declared types. Tests import it where they need it."""

FILES = {
    "wing/conftest.py": "",
    "wing/test_a.py": "import wing.conftest",
    "wing/test_b.py": "1 / 0",
    "wing/test_c.py": "import pytest\npytest.skip('no such thing', allow_module_level=True)",
    "wing/helper.py": "",
    "test_d.py": "",
}


@pytest.fixture
def written(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Path]:
    (tmp_path / "wing").mkdir()
    for name, text in FILES.items():
        (tmp_path / name).write_text(text, encoding="utf-8")
    monkeypatch.syspath_prepend(tmp_path)
    before = {*sys.modules}
    yield tmp_path
    for name in {*sys.modules} - before:
        if name.partition(".")[0] in ("wing", "test_d"):
            del sys.modules[name]


@pytest.mark.parametrize("asked", [["."], ["test_d.py::test_x", "wing/test_a.py::test_y", "wing"]])
def test_each_file_is_read_by_one_process(
    asked: list[str], written: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("PYTEST_XDIST_WORKER_COUNT", "3")
    read = []
    for number in range(3):
        monkeypatch.setenv("PYTEST_XDIST_WORKER", f"gw{number}")
        try:
            read += read_a_share(asked, written)
        except pytest.skip.Exception as skipped:
            raise AssertionError("what a file says of its own tests got through") from skipped
    assert sorted(read) == ["test_d", "wing.test_a", "wing.test_b", "wing.test_c"]
    assert {"test_d", "wing.test_a"} <= sys.modules.keys()
    assert not {"wing.test_b", "wing.test_c", "wing.helper"} & sys.modules.keys()


def test_one_process_alone_and_files_of_elsewhere_need_no_shares(
    written: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.delenv("PYTEST_XDIST_WORKER", raising=False)
    assert read_a_share(["."], written) == []
    monkeypatch.setenv("PYTEST_XDIST_WORKER", "gw0")
    monkeypatch.setenv("PYTEST_XDIST_WORKER_COUNT", "1")
    assert read_a_share([str(written / "test_d.py")], written / "wing") == []


@pytest.mark.parametrize("folder", ["tests", "benchmarks"])
def test_nothing_is_compiled_to_collect_tests(folder: str) -> None:
    """In a fresh copy it would be in every process of a run, for ten seconds."""
    files = sorted((ROOT / folder).rglob("*.py"))
    assert len(files) > 50
    assert [
        path.relative_to(ROOT).as_posix()
        for path in files
        if COMPILED_WHEN_IMPORTED.search(path.read_text(encoding="utf-8"))
    ] == []
