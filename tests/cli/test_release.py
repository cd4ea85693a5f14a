"""`course release`: stubs written from solutions, and the check that the two haven't drifted."""

from pathlib import Path

import pytest

from course.cli import release
from tests.cli.conftest import Run
from tests.cli.test_process import imported_by

SOLUTION = "def f(a):\n    ### BEGIN SOLUTION\n    return a\n    ### END SOLUTION\n"
STUB = (
    "def f(a):\n"
    "    # TODO NAME.f: write your solution here\n"
    '    raise NotImplementedError("NAME.f: not written yet")\n'
)


@pytest.fixture
def project(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A project with two solutions and no assignments yet."""
    solutions = tmp_path / "solutions"
    solutions.mkdir()
    for name in ("lens", "blur"):
        (solutions / f"{name}.py").write_text(SOLUTION, encoding="utf-8")
    monkeypatch.setattr(release, "SOLUTIONS", solutions)
    monkeypatch.setattr(release, "ASSIGNMENTS", tmp_path / "assignments")
    return tmp_path


def snapshot(folder: Path) -> dict[str, bytes]:
    """Every file below a folder with what is in it."""
    return {
        str(path.relative_to(folder)): path.read_bytes()
        for path in folder.rglob("*")
        if path.is_file()
    }


def test_stubs_are_written_for_every_solution(run: Run, project: Path) -> None:
    result = run("release")
    assert (result.exit_code, result.stderr) == (0, "")
    assert result.stdout == "assignments/blur.py written\nassignments/lens.py written\n"
    assert snapshot(project / "assignments") == {
        "blur.py": STUB.replace("NAME", "blur").encode(),
        "lens.py": STUB.replace("NAME", "lens").encode(),
    }
    assert run("release", "--check").exit_code == 0


def test_stubs_that_are_up_to_date_are_not_written_again(run: Run, project: Path) -> None:
    run("release")
    path = project / "assignments" / "lens.py"
    number = path.stat().st_ino
    result = run("release")
    assert "assignments/lens.py is up to date" in result.stdout
    assert path.stat().st_ino == number


def test_the_check_names_each_stub_that_drifted_and_shows_how(run: Run, project: Path) -> None:
    run("release")
    solution = project / "solutions" / "lens.py"
    solution.write_text(SOLUTION.replace("(a)", "(a, b)"), encoding="utf-8")
    before = snapshot(project)
    result = run("release", "--check")
    assert result.exit_code == 1
    assert "-def f(a):\n+def f(a, b):" in result.stdout
    assert "blur" not in result.output
    assert result.stderr == (
        "error: not what the solutions make: assignments/lens.py; "
        "`course release` makes them anew\n"
    )
    assert snapshot(project) == before


def test_the_check_tells_what_is_missing_and_what_has_no_solution(run: Run, project: Path) -> None:
    run("release")
    (project / "assignments" / "blur.py").rename(project / "assignments" / "old.py")
    result = run("release", "--check")
    assert result.exit_code == 1
    assert "assignments/blur.py is missing" in result.stdout
    assert "assignments/old.py has no solution" in result.stdout
    assert "assignments/blur.py, assignments/old.py" in result.stderr
    result = run("release")
    assert result.exit_code == 0
    assert "assignments/old.py has no solution" in result.stderr
    assert (project / "assignments" / "old.py").exists()
    result = run("release", "--check")
    assert result.exit_code == 1
    assert result.stderr == "error: not what the solutions make: assignments/old.py\n"


def test_a_change_outside_the_regions_is_a_drift_and_one_inside_is_none(
    run: Run, project: Path
) -> None:
    run("release")
    solution = project / "solutions" / "lens.py"
    solution.write_text(SOLUTION.replace("return a", "return +a"), encoding="utf-8")
    assert run("release", "--check").exit_code == 0
    solution.write_text(SOLUTION + "\n\nX = 1\nf(X)\n", encoding="utf-8")
    assert run("release", "--check").exit_code == 1


def test_a_long_difference_is_cut_short(run: Run, project: Path) -> None:
    run("release")
    text = "".join(f"print({number})\n" for number in range(100))
    (project / "assignments" / "lens.py").write_text(text, encoding="utf-8")
    shown = run("release", "--check").stdout.splitlines()
    assert len(shown) == release.SHOWN + 1
    assert shown[-1].endswith("lines more")


def test_line_ends_of_another_system_are_no_drift(run: Run, project: Path) -> None:
    run("release")
    for path in (project / "assignments").iterdir():
        path.write_bytes(path.read_bytes().replace(b"\n", b"\r\n"))
    assert run("release", "--check").exit_code == 0


def test_functions_that_somebody_has_written_are_not_lost(run: Run, project: Path) -> None:
    run("release")
    (project / "assignments" / "blur.py").write_text("# drifted\n", encoding="utf-8")
    (project / "assignments" / "lens.py").write_text("def f(a):\n    return a\n", encoding="utf-8")
    before = snapshot(project)
    result = run("release")
    assert result.exit_code == 1
    assert "assignments/lens.py holds work that would be lost: lens.f" in result.stderr
    assert snapshot(project) == before
    assert run("release", "--force").exit_code == 0
    assert run("release", "--check").exit_code == 0


@pytest.mark.parametrize("options", [[], ["--check"]])
def test_a_solution_in_error_is_refused_and_nothing_is_written(
    run: Run, project: Path, options: list[str]
) -> None:
    (project / "solutions" / "lens.py").write_text("x = 1\n### END SOLUTION\n", encoding="utf-8")
    before = snapshot(project)
    result = run("release", *options)
    assert result.exit_code == 1
    assert result.stderr.startswith("error: solutions/lens.py:2: ")
    assert snapshot(project) == before


def test_without_solutions_there_is_nothing_to_release(run: Run, project: Path) -> None:
    for path in (project / "solutions").iterdir():
        path.unlink()
    result = run("release")
    assert result.exit_code == 1
    assert "there are no solutions" in result.stderr


def test_the_stubs_of_this_project_are_what_its_solutions_make(run: Run) -> None:
    result = run("release", "--check")
    assert result.exit_code == 0, result.output


def test_releasing_needs_no_arrays(project: Path) -> None:
    names = imported_by(project, "release --check")
    assert "click" in names
    assert not names & {"numpy", "yaml", "msgspec", "rich", "PIL", "embreex", "solutions"}
