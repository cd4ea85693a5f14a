"""`course info` and `course schema`."""

import json
from pathlib import Path

import jsonschema

from tests.cli.conftest import Run
from tests.cli.stand_in import Engine

ROOT = Path(__file__).parents[2]


def test_info_prints_the_summary_and_renders_nothing(run: Run, engine: Engine) -> None:
    result = run("info", "box.yaml", "--effects", "assignments")
    assert result.exit_code == 0
    assert engine.loaded == [(Path("box.yaml"), {"effects": "assignments"})]
    assert not engine.rendered
    lines = [line.split() for line in result.stdout.splitlines()]
    assert ["scene", "triangles", "82,000"] in lines
    assert ["effects", "supersampling", "called"] in lines
    assert "nothing" not in result.stdout


def test_schema_is_printed_or_written_alike(run: Run, tmp_path: Path) -> None:
    printed = run("schema")
    assert printed.exit_code == 0
    jsonschema.Draft202012Validator.check_schema(json.loads(printed.stdout))
    assert run("schema", "-o", "scene.json").exit_code == 0
    assert (tmp_path / "scene.json").read_text(encoding="utf-8") == printed.stdout


def test_a_scene_of_the_course_is_described(run: Run) -> None:
    """tests/test_scenes.py has what is said of each of them."""
    result = run("info", ROOT / "scenes" / "soft_shadows.yaml")
    assert result.exit_code == 0, result.output
    assert "triangles" in result.stdout
    assert "supersampling" in result.stdout
