"""`course docs`: which page is opened, and what is said where there is none."""

from pathlib import Path

import pytest

from course.cli import docs as command
from tests.cli.conftest import Run


@pytest.fixture
def opened(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> list[str]:
    """Addresses that a browser was asked for, in a folder of `course start`."""
    (tmp_path / "scenes").mkdir()
    for name in ("index", "modules/soft_shadows", "guides/notebook"):
        file = tmp_path / "docs" / f"{name}.md"
        file.parent.mkdir(parents=True, exist_ok=True)
        file.touch()
    (tmp_path / "assignments").mkdir()
    monkeypatch.chdir(tmp_path / "assignments")
    monkeypatch.setattr(command, "PROJECT", tmp_path / "nothing")
    found: list[str] = []
    monkeypatch.setattr(command.webbrowser, "open", found.append)
    return found


def test_pages_without_a_site_are_told_with_the_way_to_it(run: Run, opened: list[str]) -> None:
    result = run("docs", "soft_shadows")
    assert result.stdout.strip().endswith(str(Path("docs", "modules", "soft_shadows.md")))
    assert "make docs" in result.stderr
    assert not opened


def test_the_built_site_is_opened(run: Run, opened: list[str], tmp_path: Path) -> None:
    for name in ("index", "guides/notebook"):
        file = tmp_path / "site" / f"{name}.html"
        file.parent.mkdir(parents=True, exist_ok=True)
        file.touch()
    assert run("docs").exit_code == 0
    assert run("docs", "guides/notebook.md").exit_code == 0
    assert [Path(one).name for one in opened] == ["index.html", "notebook.html"]
    assert run("docs", "notebook", "--no-browser").stdout.strip().endswith("notebook.html")
    assert len(opened) == 2


def test_a_page_that_may_be_meant_is_told(run: Run, opened: list[str], tmp_path: Path) -> None:
    assert "did you mean soft_shadows?" in run("docs", "soft_shadow").stderr
    (tmp_path / "docs" / "index.md").unlink()
    assert "no pages of the course" in run("docs").stderr
    assert not opened
