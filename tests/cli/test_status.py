"""`course status`: what is done, what comes next, and what is remembered."""

from __future__ import annotations

import json
import shutil
from pathlib import Path

import pytest

from course.cli.main import commands
from course.engine.functions.effects import PROJECT
from course.engine.functions.modules import COURSE
from course.school.grading import progress as told
from course.school.grading.pictures.whole import ALL, NAME
from course.school.grading.progress import KEPT, FunctionProgress, next_one
from course.school.grading.submissions import find_modules, read_found

CliRunner = pytest.importorskip("click.testing").CliRunner


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    """One module done, and stubs of two others."""
    shutil.copy(PROJECT / "solutions" / "motion_blur.py", tmp_path)
    for name in ("thin_lens", "sampling"):
        shutil.copy(PROJECT / "assignments" / f"{name}.py", tmp_path)
    return tmp_path


MODULES = "motion_blur,thin_lens,sampling"


def status(folder: Path, *more: str) -> str:
    result = CliRunner().invoke(commands, ["status", MODULES, "--folder", str(folder), *more])
    assert result.exit_code == 0, result.output
    return str(result.stdout)


def test_points_states_and_what_is_next(folder: Path) -> None:
    document = json.loads(status(folder, "--json"))
    assert (document["points"], document["of"]) == (30, 130)
    states = {f"{f['module']}.{f['name']}": f["state"] for f in document["functions"]}
    assert states["motion_blur.displacement"] == "right"
    assert states["thin_lens.lens_rays"] == "to do"
    assert len(states) == 13
    coming = document["next"]
    assert (coming["module"], coming["name"]) == ("sampling", "disk_by_rejection")
    assert coming["page"] == "docs/modules/sampling.md#disk_by_rejection"
    row = Path(coming["file"]).read_text(encoding="utf-8").splitlines()[coming["line"] - 1]
    assert row.startswith("def disk_by_rejection(")
    text = status(folder)
    assert "motion_blur  done" in text
    assert "3 of 13 functions are right, 30 of 130 points" in text
    assert f"sampling.py:{coming['line']}" in text


def test_the_points_of_all_are_those_of_a_report(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(told, "_checked", lambda _where, module, *_: [_none(module)])
    found = list(told.progress(tmp_path, COURSE, together=True))
    assert [functions[0].module for functions in found] == [*COURSE, NAME]
    # Without the checks, which a fresh folder's status runs for seconds.
    assert NAME not in [f[0].module for f in told.progress(tmp_path, COURSE)]


def test_the_picture_of_all_together_is_checked_for_what_it_is_worth(tmp_path: Path) -> None:
    for module in ALL:
        shutil.copy(PROJECT / "assignments" / f"{module}.py", tmp_path)
    (one,) = told._checked(tmp_path, NAME, read_found(tmp_path, find_modules(tmp_path, ALL)), {})
    assert (one["state"], one["points"], one["of"]) == ("to do", 0, 3)


def _none(module: str) -> dict[str, object]:
    known = vars(one(module, "a", "to do")).copy()
    del known["file"], known["line"], known["cell"]
    return known


def test_only_what_has_changed_is_checked_again(
    folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    checked: list[str] = []

    def noting(_where: Path, module: str, *_of: object) -> list[dict[str, object]]:
        checked.append(module)
        return [_none(module)]

    monkeypatch.setattr(told, "_checked", noting)
    first = status(folder)
    assert checked == ["thin_lens", "motion_blur", "sampling"]
    assert status(folder) == first
    assert len(checked) == 3
    with (folder / "thin_lens.py").open("a", encoding="utf-8") as file:
        file.write("\n# a thought\n")
    assert status(folder) == first
    assert checked[3:] == ["thin_lens"]
    # Results of other checks count for nothing, nor does what is no result.
    kept = folder / KEPT
    document = json.loads(kept.read_text(encoding="utf-8"))
    kept.write_text(json.dumps(document | {"checks": "others"}), encoding="utf-8")
    status(folder)
    kept.write_text("{", encoding="utf-8")
    status(folder)
    assert len(checked) == 10


def one(module: str, name: str, state: str) -> FunctionProgress:
    return FunctionProgress(module, name, state, 0, 10, "", "", "", "", "", 1)


def test_what_is_wrong_comes_first_then_what_is_begun_then_the_warm_up() -> None:
    right, todo = one("glossy", "a", "right"), one("glossy", "b", "to do")
    other, warm = one("supersampling", "c", "to do"), one("sampling", "d", "to do")
    wrong = one("thin_lens", "e", "wrong")
    assert next_one([other, right, todo, warm, wrong]) == wrong
    assert next_one([other, right, todo, warm]) == todo
    assert next_one([other, right, warm]) == warm
    assert next_one([right]) is None


def test_a_wrong_function_is_told_with_its_law(folder: Path) -> None:
    file = folder / "motion_blur.py"
    text = file.read_text(encoding="utf-8")
    file.write_text(text + "\n\ndef displacement(*_):\n    return 1\n", encoding="utf-8")
    output = status(folder)
    assert "motion_blur  1 wrong" in output
    assert "next: motion_blur.displacement, wrong: " in output


def test_a_folder_that_is_not_there_is_told(tmp_path: Path) -> None:
    result = CliRunner().invoke(commands, ["status", "--folder", str(tmp_path / "no")])
    assert result.exit_code == 1
    assert "no such folder" in result.stderr


def test_what_cannot_be_kept_is_checked_each_time(folder: Path) -> None:
    # As where another user's status was the first.
    (folder / KEPT).mkdir(parents=True)
    assert "motion_blur  done" in status(folder)
