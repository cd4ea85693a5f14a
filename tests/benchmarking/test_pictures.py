"""The referee of changes that are to change no picture: it sees one that does."""

import json
from pathlib import Path

import pytest
from click.testing import CliRunner

from benchmarks import pictures

SCENE = "before/supersampling"


@pytest.fixture
def record(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """One scene's pictures by one sampler."""
    monkeypatch.setattr(pictures, "FUNCTIONS", {"sobol": ()})
    file = tmp_path / "pictures.json"
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


def test_another_machine_is_refused(record: Path) -> None:
    found = json.loads(record.read_text())
    found["machine"]["processor"] = "another"
    record.write_text(json.dumps(found))
    run = CliRunner().invoke(pictures.main, [SCENE, "--compare", str(record)])
    assert run.exit_code == 1
    assert "recorded on another machine" in run.output
