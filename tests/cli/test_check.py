"""`course check`: which modules are checked, and what is said of those that can't be."""

import json
from functools import partial
from html import unescape
from pathlib import Path

import pytest
from click.testing import CliRunner, Result

from course.cli.main import commands
from course.cli.options import FAILED
from course.engine.functions.effects import PROJECT
from course.engine.functions.modules import COURSE
from course.school.grading.known import known as known_submissions
from course.school.grading.worker.limits import Limits
from tests.cli.conftest import Run

pytestmark = pytest.mark.usefixtures("lent_references")


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    """Modules in which nothing is written yet."""
    made = tmp_path / "mine"
    made.mkdir()
    for module, functions in COURSE.items():
        lines = [f"def {name}(*_, **__):\n    raise NotImplementedError\n" for name in functions]
        (made / f"{module}.py").write_text("\n".join(lines), encoding="utf-8")
    return made


@pytest.mark.parametrize("names", ["bokeh", "thin_lens,bokeh", "thin_lens,"])
def test_a_name_of_no_module_is_told_with_the_names_that_are(
    run: Run, folder: Path, names: str
) -> None:
    result = run("check", names, "--folder", folder)
    assert result.exit_code == 2
    wrong = names.rpartition(",")[2]
    assert f"{wrong!r}; the modules are {', '.join(COURSE)}" in result.stderr
    assert not result.stdout


@pytest.mark.parametrize(
    ("name", "says"),
    [
        ("THIN_LENS", "; did you mean thin_lens?"),
        ("thinlens", "; did you mean thin_lens?"),
        ("sofft", "; did you mean soft_shadows?"),
        ("lens", "; did you mean thin_lens?"),
        ("assignments/thin_lens.py", "; did you mean thin_lens?"),
        ("lens_rays", " is a function of thin_lens: course check thin_lens --only lens_rays"),
        ("thin_lens.lens_rays", " is a function of thin_lens: course check thin_lens --only"),
        ("thin_lens/lens_rays", " is a function of thin_lens: course check thin_lens --only"),
    ],
)
def test_what_is_meant_by_a_name_of_no_module_is_told(
    run: Run, folder: Path, name: str, says: str
) -> None:
    result = run("check", name, "--folder", folder)
    assert result.exit_code == 2
    assert f"{name!r}{says}" in " ".join(result.stderr.split())


@pytest.mark.parametrize(
    ("only", "near"),
    [
        ("lens_ray", "lens_rays"),
        ("lens_rays/contrakt", "lens_rays/contract"),
        ("lens_ray/contract", "lens_rays"),
    ],
)
def test_what_is_meant_by_a_name_of_no_check_is_told(
    run: Run, folder: Path, only: str, near: str
) -> None:
    result = run("check", "thin_lens", "--only", only, "--folder", folder)
    assert result.exit_code == 1
    assert result.stderr.endswith(f"has that name; did you mean {near}?\n")


@pytest.mark.parametrize(
    "names", [["motion_blur,thin_lens"], ["motion_blur", "thin_lens,motion_blur"]]
)
def test_modules_are_checked_once_and_in_the_order_of_the_course(
    run: Run, folder: Path, names: list[str]
) -> None:
    result = run("check", *names, "--folder", folder, "--json", "found.json")
    assert result.exit_code == FAILED, result.output
    shown = [line for line in result.stdout.splitlines() if line in COURSE]
    assert shown == ["thin_lens", "motion_blur"]
    found = json.loads(Path("found.json").read_text(encoding="utf-8"))
    checked = [(one["module"], one["function"]) for one in found["results"]]
    functions = [(module, name) for module in shown for name in COURSE[module]]
    assert list(dict.fromkeys(checked)) == functions


def test_without_names_all_modules_are_meant(run: Run, folder: Path) -> None:
    result = run("check", "--only", "bokeh", "--folder", folder)
    assert result.exit_code == 1
    assert f"no check of {', '.join(COURSE)} has that name" in result.stderr


SOLUTION = (PROJECT / "solutions" / "motion_blur.py").read_text(encoding="utf-8")


def told(result: Result, folder: Path) -> str:
    """What the terminal says, checked to be no more and no less than the other reports do."""
    assert result.exit_code == FAILED, result.output
    found = json.loads((folder / "found.json").read_text(encoding="utf-8"))
    page = (folder / "page.html").read_text(encoding="utf-8")
    for one in found["results"]:
        if one["status"] != "passed" and not one["found"].endswith("not written yet"):
            assert one["found"][:40].partition("'")[0] in result.stdout
            assert one["found"][:40].partition("'")[0] in page
        if one["where"]:
            assert one["where"].splitlines()[0].strip() in result.stdout
    return result.stdout


def check(run: Run, folder: Path, *more: str) -> str:
    outputs = ("--json", folder / "found.json", "--html", folder / "page.html")
    return told(run("check", "motion_blur", "--folder", folder, *outputs, *more), folder)


def test_a_file_that_is_not_there_is_no_untouched_stub(run: Run, tmp_path: Path) -> None:
    mine = tmp_path / "mine"
    mine.mkdir()
    assert f"{mine / 'motion_blur.py'} is missing\n" in check(run, mine)
    (mine / "motion_blurr.py").touch()
    assert "motion_blur.py is missing (is it motion_blurr.py?)" in check(run, mine)
    (mine / "motion_blur.py").touch()
    text = check(run, mine)
    assert f"{mine / 'motion_blur.py'} is empty" in text
    assert text.count("is empty") == 1


def test_an_untouched_stub_needs_no_words(run: Run, folder: Path) -> None:
    stub = PROJECT / "assignments" / "motion_blur.py"
    (folder / stub.name).write_bytes(stub.read_bytes())
    lines = [line.split() for line in check(run, folder).splitlines()[1:10]]
    assert [line[0] for line in lines] == ["to", "write", "read"] * 3
    assert lines[::3] == [["to", "do", name] for name in COURSE["motion_blur"]]


@pytest.mark.parametrize("command", ["check", "status"])
def test_assignments_of_the_current_folder_come_before_the_checkouts(
    run: Run, folder: Path, command: str
) -> None:
    # As in a folder of `course start`, whichever way the course is installed.
    (folder / "motion_blur.py").write_text(SOLUTION, encoding="utf-8")
    folder.rename(folder.with_name("assignments"))
    assert "30 of 30 points" in run(command, "motion_blur").stdout


@pytest.mark.parametrize("command", ["check", "status", "render"])
def test_no_other_assignments_are_taken_below_or_above_ones_own(
    run: Run, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, command: str
) -> None:
    (tmp_path / "mine" / "assignments").mkdir(parents=True)
    given = [PROJECT / "scenes" / "motion_blur.yaml"] if command == "render" else ["motion_blur"]
    effects = ["--effects", "mine"] if command == "render" else []
    above = run(command, *given, *effects)
    monkeypatch.chdir(tmp_path / "mine" / "assignments")
    below = CliRunner().invoke(commands, [command, *map(str, given), *effects])
    assert (above.exit_code, below.exit_code) == (1, 1)
    assert "`cd mine` goes to your course" in above.stderr
    assert "`cd ..` goes to your course" in below.stderr


def test_a_name_that_is_spelt_wrongly_is_pointed_out(run: Run, folder: Path) -> None:
    renamed = SOLUTION.replace("def displacement", "def displacment")
    (folder / "motion_blur.py").write_text(renamed, encoding="utf-8")
    text = check(run, folder)
    assert text.count("motion_blur.py has no displacement (did you mean displacment?)") == 1


def test_a_syntax_error_is_told_once(run: Run, folder: Path) -> None:
    (folder / "motion_blur.py").write_text("import numpy\ndef f(:\n", encoding="utf-8")
    lines = check(run, folder).splitlines()
    assert lines[1].startswith("  motion_blur.py can't be imported: SyntaxError")
    assert lines[3].strip() == "def f(:"
    assert lines[4].strip() == "^"
    assert lines[4].index("^") == lines[3].index(":")
    assert sum("SyntaxError" in line for line in lines) == 2
    assert len(lines) < 14
    assert not any("right" in line for line in lines)


def test_an_editor_is_told_the_line_of_a_syntax_error_once(run: Run, folder: Path) -> None:
    (folder / "motion_blur.py").write_text("import numpy\ndef f(:\n", encoding="utf-8")
    told = run("check", "motion_blur", "--folder", folder, "--lines").stdout.splitlines()
    assert [line for line in told if ": error: " in line or ": warning: " in line] == told[-1:]
    assert told[-1].startswith(f"{folder / 'motion_blur.py'}:2: error: motion_blur.py can't be")


def test_an_editor_is_told_the_line_that_failed_and_not_where_its_function_begins(
    run: Run, folder: Path
) -> None:
    own = "\n\ndef displacement(velocity, time):\n    return _way(velocity, time)\n"
    own += "\n\ndef _way(velocity, time):\n    far = velocity\n    return np.outer(fast, time)\n"
    own += "\n\ndef shutter_times(open, close, u):\n    return u\n"
    text = SOLUTION.replace("def shutter_times(", "def _right(") + own
    (folder / "motion_blur.py").write_text(text, encoding="utf-8")
    rows = text.splitlines()
    failed = rows.index("    return np.outer(fast, time)") + 1
    begins = rows.index("def shutter_times(open, close, u):") + 1
    path = folder / "motion_blur.py"
    told = run("check", "motion_blur", "--folder", folder, "--lines").stdout.splitlines()
    (name,) = [line for line in told if ": error: displacement: " in line]
    assert name.startswith(f"{path}:{failed}: error: ")
    assert name.endswith("NameError: name 'fast' is not defined")
    # What raises nothing is told where the function begins.
    (value,) = [line for line in told if ": error: shutter_times: " in line]
    assert value.startswith(f"{path}:{begins}: error: ")


def test_a_long_exception_is_cut_and_told_once(run: Run, folder: Path) -> None:
    own = "\n\ndef displacement(*_):\n    raise KeyError('long ' * 800)\n"
    (folder / "motion_blur.py").write_text(SOLUTION + own, encoding="utf-8")
    text = check(run, folder, "--only", "displacement")
    assert text.count("\n      contract") == 1
    assert "checks more: KeyError: 'long long" in text
    assert len(text) < 2000


def test_one_cause_is_told_once_whatever_the_sizes(run: Run, folder: Path) -> None:
    own = "\n\ndef displacement(*given):\n    return _right(*given).T\n"
    right = SOLUTION.replace("def displacement(", "def _right(")
    (folder / "motion_blur.py").write_text(right + own, encoding="utf-8")
    text = run("check", "motion_blur", "--folder", folder, "--only", "displacement").stdout
    assert "It is turned over" in text
    assert text.count("more: displacement returned") == 1
    line = (right + own).splitlines().index("def displacement(*given):") + 1
    assert f"file        {folder / 'motion_blur.py'}:{line}\n" in text


def test_a_function_without_return_is_told_what_is_missing(run: Run, folder: Path) -> None:
    own = "\n\ndef displacement(*_):\n    pass\n"
    (folder / "motion_blur.py").write_text(SOLUTION + own, encoding="utf-8")
    said = run("check", "motion_blur", "--folder", folder, "--only", "displacement/contract")
    assert "has to end with `return`" in said.stdout


def test_a_loop_that_never_ends_is_pointed_at(
    run: Run, folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    # Ten seconds tell no more of it.
    monkeypatch.setattr("course.school.grading.grading.Limits", partial(Limits, call_seconds=1.0))
    own = "\n\ndef displacement(*_):\n    while True:\n        pass\n"
    (folder / "motion_blur.py").write_text(SOLUTION + own, encoding="utf-8")
    last = len((SOLUTION + own).splitlines())
    said = run("check", "motion_blur", "--folder", folder, "--only", "displacement/contract")
    assert f"a loop by `while` in line {last - 1}\n" in said.stdout


def test_what_a_right_function_should_know_is_told(run: Run, folder: Path) -> None:
    own = "\n\ndef displacement(*given):\n    sum(range(20_000_000))\n    return _right(*given)\n"
    right = SOLUTION.replace("def displacement(", "def _right(")
    (folder / "motion_blur.py").write_text(right + own, encoding="utf-8")
    said = run("check", "motion_blur", "--folder", folder, "--only", "displacement/speed").stdout
    assert "right    displacement" in said
    assert "whole arrays instead of loops would help" in said


def test_a_module_that_may_not_be_imported_is_told_with_a_remedy(run: Run, folder: Path) -> None:
    (folder / "motion_blur.py").write_text(f"import matplotlib\n{SOLUTION}", encoding="utf-8")
    assert check(run, folder).count("NumPy and Python's own library") == 1
    page = unescape((folder / "page.html").read_text(encoding="utf-8"))
    assert page.count("NumPy and Python's own library") == 1


def test_nothing_that_a_submission_writes_steers_the_terminal(run: Run, folder: Path) -> None:
    own = "\n\ndef displacement(*_):\n    print('\\x1b]0;here\\x07')\n"
    own += "    raise ValueError('\\x1b]0;there\\x07 \\u202e')\n"
    (folder / "motion_blur.py").write_text(SOLUTION + own, encoding="utf-8")
    said = run("check", "motion_blur", "--folder", folder, "--only", "displacement").stdout
    assert "here" in said
    assert "there" in said
    assert not {"\x1b", "\x07", "\u202e"} & set(said)


def test_copies_of_other_modules_block_nothing(run: Run, tmp_path: Path) -> None:
    mine = tmp_path / "mine"
    for name in (".", "old", "older"):
        (mine / name).mkdir(parents=True, exist_ok=True)
        (mine / name / "motion_blur.py").write_text(SOLUTION, encoding="utf-8")
        if name != ".":
            (mine / name / "glossy.py").touch()
    only = ("--only", "displacement/contract")
    result = run("check", "motion_blur", "--folder", mine, *only)
    assert result.exit_code == 0, result.output
    assert not result.stderr
    (mine / "motion_blur.py").unlink()
    (mine / "older" / "motion_blur.py").unlink()
    result = run("check", "motion_blur", "--folder", mine, *only)
    assert result.exit_code == 0, result.output
    below = mine / "old" / "motion_blur.py"
    says = f"{mine / 'motion_blur.py'} is missing; {below} is checked in its place\n"
    assert result.stderr == says
    result = run("check", "glossy", "--folder", mine)
    assert "glossy.py is in it more than once" in result.stderr


def test_reports_are_looked_at_before_the_checks(run: Run, folder: Path, tmp_path: Path) -> None:
    """Two reports in one file, and one in a folder that isn't there."""
    asked = "check", "sampling", "--folder", folder
    twice = run(*asked, "--html", tmp_path / "a", "--json", tmp_path / "mine/../a")
    nowhere = run(*asked, "--json", tmp_path / "nowhere" / "a.json")
    for result, words in ((twice, "are one file"), (nowhere, "there is no folder")):
        assert result.exit_code == 1
        assert words in result.stderr
        assert not result.stdout
    assert list(tmp_path.iterdir()) == [folder]


@pytest.mark.parametrize("rungs", [1, 2, 3])
def test_a_failure_is_told_on_three_rungs_and_never_shows_the_code(
    run: Run, tmp_path: Path, rungs: int
) -> None:
    known = {one.name: one for one in known_submissions("thin_lens")}
    (tmp_path / "thin_lens.py").write_text(known["wrong_cosine"].source, encoding="utf-8")
    arguments = ("check", "thin_lens", "--folder", tmp_path, "--only", "lens_rays", "--hint", rungs)
    said = run(*arguments).stdout
    assert "rays: Rays go from their lens points to the points in focus" in said
    smallest, looks = "smallest    lens_rays(origin = [", known["wrong_cosine"].says
    assert (smallest in said) == (rungs >= 2)
    assert (looks in said) == (rungs >= 3)
    # The next rung is offered once, and other checks that fail by the same mistake in a line each.
    assert said.count(f"--hint {rungs + 1}") == (rungs < 3)
    assert said.count("    also  ") >= 3
    solution = (PROJECT / "solutions" / "thin_lens.py").read_text(encoding="utf-8")
    written = solution.partition("### BEGIN SOLUTION")[2].partition("### END SOLUTION")[0]
    assert not any(line.strip() in said for line in written.splitlines() if len(line.strip()) > 20)


def test_what_is_to_do_is_told_with_its_line_and_its_page(run: Run, folder: Path) -> None:
    result = run("check", "thin_lens", "--folder", folder)
    words = " ".join(result.stdout.split())
    lines = (folder / "thin_lens.py").read_text(encoding="utf-8").splitlines()
    for name in COURSE["thin_lens"]:
        (line,) = (n for n, row in enumerate(lines, 1) if row.startswith(f"def {name}("))
        place = f"{folder / 'thin_lens.py'}:{line}"
        assert f"to do {name} write {place} read docs/modules/thin_lens.md#{name}" in words
