"""The referee of changes that are to change no picture: it sees one that does."""

import json
from collections.abc import Iterator
from pathlib import Path

import pytest
from click.testing import CliRunner

from benchmarks import pictures

SCENE = "before/supersampling"


@pytest.fixture(scope="module", autouse=True)
def one_sampler() -> Iterator[None]:
    """All scenes are rendered by one sampler alone."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(pictures, "FUNCTIONS", {"sobol": ()})
        yield


@pytest.fixture(scope="module")
def record(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """One scene's pictures."""
    file = tmp_path_factory.mktemp("record") / "pictures.json"
    run = CliRunner().invoke(pictures.main, [SCENE, "--record", str(file)])
    assert run.exit_code == 0, run.output
    return file


def test_nothing_changed_is_told_so(record: Path) -> None:
    run = CliRunner().invoke(pictures.main, [SCENE, "--compare", str(record)])
    assert run.exit_code == 0
    assert "threads, 0 others" in run.output


def test_a_picture_that_changed_is_named(record: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(pictures, "SAMPLES", 5)
    run = CliRunner().invoke(pictures.main, [SCENE, "--compare", str(record)])
    assert run.exit_code == 1
    assert f"scenes/{SCENE}.yaml, sobol, NumPy: changed" in run.output


def test_another_machine_is_refused(record: Path, tmp_path: Path) -> None:
    found = json.loads(record.read_text())
    found["machine"]["processor"] = "another"
    other = tmp_path / "other.json"
    other.write_text(json.dumps(found))
    run = CliRunner().invoke(pictures.main, [SCENE, "--compare", str(other)])
    assert run.exit_code == 1
    assert "recorded on another machine" in run.output
