"""Whatever prints it: names in an archive and texts of a submission don't steer a terminal."""

import zipfile
from pathlib import Path

import pytest
from click.testing import CliRunner

from course.base.texts import clean, clean_line
from course.cli.main import Refusal, commands
from course.school.grading.checks.check import Check
from course.school.grading.checks.result import Result, Status, cleaned
from course.school.grading.classes.roster import match, read_roster
from course.school.grading.classes.submitted import find_submissions

BAD = "\x1b[2J\x1b]0;title\x07\x9b31m\u202e\udc80"
"""Clears the screen, names the window, colours by a C1 control, turns the direction, and is no text at all."""
STEERS = {*"\x1b\x07\x9b\u202e\udc80"}


def zipped(path: Path, *names: str) -> None:
    with zipfile.ZipFile(path, "w") as archive:
        for name in names:
            archive.writestr(
                name.encode("utf-8", "replace").decode(), "def displacement(v, t): ..."
            )


@pytest.mark.parametrize(
    "names",
    [
        (f"{BAD}/Motion_Blur.py",),
        (f"{BAD}.py", f"{BAD}2.py"),
        (f"../{BAD}",),
        (f"{BAD}.txt",),
        (f"{BAD}/a/motion_blur.py", f"{BAD}/b/motion_blur.py"),
        (f"{BAD}.zip", "motion_blur.py"),
        ("motion_blur.py", f"{BAD}/motion_blur (1).py"),
    ],
)
def test_names_in_an_archive(tmp_path: Path, names: tuple[str, ...]) -> None:
    zipped(tmp_path / "ada.zip", *names)
    (found,) = find_submissions(tmp_path, ["motion_blur"])
    told = "".join((found.student, found.trouble, *found.remarks))
    assert told != found.student
    assert not STEERS & {*told}
    assert "\n" not in told


@pytest.mark.parametrize("command", ["grade", "viva"])
def test_commands_print_nothing_that_steers(tmp_path: Path, command: str) -> None:
    folder = tmp_path / "class"
    folder.mkdir()
    zipped(folder / "ada.zip", f"{BAD}/a/motion_blur.py", f"{BAD}/b/motion_blur.py")
    more = ["--out", tmp_path / "out", "--trust-submissions"] if command == "grade" else []
    where = folder if command == "grade" else folder / "ada.zip"
    arguments = [command, where, "--modules", "motion_blur", *more]
    result = CliRunner().invoke(commands, [*map(str, arguments)])
    assert "more than once" in result.output
    assert not STEERS & {*result.output}
    for path in (tmp_path / "out").rglob("*"):
        if path.is_file() and path.suffix in (".csv", ".json", ".html", ".xml"):
            assert not STEERS & {*path.read_text("utf-8")}, path


def test_results_and_refusals(capsys: pytest.CaptureFixture[str]) -> None:
    check = Check("f", "contract", "title", "contract", 1.0, lambda *_: None)  # type: ignore[arg-type, return-value]
    texts = ("expected", "found", "where", "hint", "example", "says", "instructor")
    result = Result("m", check.function, "c", "t", "k", Status.FAILED, 0, 1)
    result = cleaned(Result(**vars(result) | dict.fromkeys(texts, f"{BAD}\nx")))
    for name in texts:
        assert not STEERS & {*getattr(result, name)}
        assert getattr(result, name).endswith("\nx")
    Refusal(f"a{BAD}b").show()
    assert not STEERS & {*capsys.readouterr().err}


def test_names_of_a_roster(tmp_path: Path) -> None:
    (tmp_path / "r.csv").write_text(f"Name,ID\nAnn {BAD[:-1]}Lee,11\n", "utf-8")
    matched = match(read_roster(tmp_path / "r.csv").students, {})
    assert len(matched.without) == 1
    assert not STEERS & {*matched.without[0]}


def test_clean_is_one_line_where_that_is_asked() -> None:
    assert clean_line("a\r\nb\n") == "a b "
    assert clean("\x1b[1mbold\x1b[0m") == "bold"
