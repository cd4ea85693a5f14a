"""The student archive: everything but the solutions."""

import re
import shutil
import zipfile
from collections.abc import Iterator
from pathlib import Path

import pytest

from course.base.errors import CourseError, OutputError
from course.engine.functions.modules import COURSE
from course.school.grading.references import make_references
from course.school.grading.release.archive import (
    LICENSES,
    LeakError,
    archive_contents,
    solution_lines,
    write_archive,
    write_folder,
)
from tests.lengths import share
from tests.processes import python
from tests.school.grading.lent import ReferencesFile

ROOT = Path(__file__).parents[4]

LONG = {"supersampling", "soft_shadows", "glossy", "motion_blur", "sampling", "environment_light"}
LONG |= {"blurred_transparency", "many_lights", "path_tracing"}
"""Modules whose references take more than a second."""


def _bodies() -> set[str]:
    """Lines between the markers, found without the code under test."""
    lines: set[str] = set()
    for path in (ROOT / "solutions").glob("*.py"):
        inside = False
        for row in path.read_text(encoding="utf-8").splitlines():
            if "### BEGIN SOLUTION" in row or "### END SOLUTION" in row:
                inside = "BEGIN" in row
            elif inside and len(row.strip()) >= 24 and "np.errstate(" not in row:
                lines.add(row.strip())
    return lines


def test_no_file_of_the_finished_archive_holds_a_line_of_a_solution(archive: Path) -> None:
    bodies = _bodies()
    assert len(bodies) > 100
    with zipfile.ZipFile(archive) as file:
        assert file.testzip() is None
        for name in file.namelist():
            text = file.read(name).decode("utf-8", "replace")
            assert not bodies & {row.strip() for row in text.splitlines()}, name


def test_the_archive_has_nothing_that_could_hide_a_solution(archive: Path) -> None:
    with zipfile.ZipFile(archive) as file:
        names = file.namelist()
    assert "penumbra/assignments/supersampling.py" in names
    assert "penumbra/course/cli/main.py" in names
    assert "penumbra/README.md" in names
    assert {f"penumbra/{name}" for name in LICENSES} <= set(names)
    hiding = ("solutions/", "tests/", "__pycache__", ".pyc", ".ipynb", ".whl", ".git", ".venv")
    found = [name for name in names if any(part in name for part in hiding)]
    # The notebook tries functions of its own, and has none of an assignment.
    assert found == ["penumbra/tests/test_copy.py", "penumbra/docs/notebooks/first_look.ipynb"]


def test_every_scene_that_is_listed_is_handed_out(archive: Path) -> None:
    listed = re.findall(r"^\| `([^`]+)` \|", (ROOT / "scenes/README.md").read_text(), re.MULTILINE)
    assert "metu/showroom.xml" in listed
    with zipfile.ZipFile(archive) as file:
        names = {name.removeprefix("penumbra/scenes/") for name in file.namelist()}
    found = {name for name in listed if name in names or f"gallery/{name}" in names}
    assert found == {name for name in listed if Path(name).suffix in {".yaml", ".xml", ".json"}}


def test_scenes_of_metu_are_handed_out_in_either_form(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    for folder in ("solutions", "course"):
        shutil.copytree(ROOT / folder, tmp_path / folder)
    (tmp_path / "scenes").mkdir()
    for form in ("xml", "json"):
        (tmp_path / "scenes" / f"box.{form}").write_text(form)
    monkeypatch.setattr("course.school.grading.release.archive.reference_file", lambda *_: b"")
    contents = archive_contents(tmp_path)
    assert (contents["scenes/box.xml"], contents["scenes/box.json"]) == (b"xml", b"json")


@pytest.mark.usefixtures("references_at_hand")
def test_the_same_course_gives_the_same_archive(archive: Path, tmp_path: Path) -> None:
    again = tmp_path / "again.zip"
    write_archive(ROOT, again)
    assert again.read_bytes() == archive.read_bytes()


@pytest.mark.parametrize("module", share([one for one in COURSE if one not in LONG], 3))
def test_references_made_again_are_the_same(
    references_file: ReferencesFile, tmp_path: Path, module: str
) -> None:
    again = tmp_path / "again.npz"
    make_references((module,), 0, again)
    assert again.read_bytes() == references_file(module).read_bytes()


@pytest.mark.usefixtures("references_at_hand")
def test_a_folder_is_written_like_the_zip_file(archive: Path, tmp_path: Path) -> None:
    count = write_archive(ROOT, tmp_path / "folder")
    with zipfile.ZipFile(archive) as file:
        assert len(file.namelist()) == count
        for name in file.namelist():
            path = tmp_path / "folder" / name.removeprefix("penumbra/")
            assert path.read_bytes() == file.read(name)


def test_a_folder_with_something_in_it_is_refused(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    # Before anything is made, which takes a while.
    monkeypatch.delattr("course.school.grading.release.archive.archive_contents")
    (tmp_path / "mine.txt").write_text("mine")
    with pytest.raises(OutputError, match="not an empty folder"):
        write_archive(ROOT, tmp_path)
    assert [path.name for path in tmp_path.iterdir()] == ["mine.txt"]


def test_a_solution_that_stands_elsewhere_stops_the_release(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    monkeypatch.setattr("course.school.grading.release.archive.reference_file", lambda *_: b"")
    for folder in ("solutions", "course", "scenes"):
        shutil.copytree(ROOT / folder, tmp_path / folder)
    line = max(_bodies(), key=len)
    (tmp_path / "course" / "hint.py").write_text(f"x = 1\n    {line}\n", encoding="utf-8")
    with pytest.raises(LeakError, match=r"course/hint\.py:2 holds a line of a solution"):
        archive_contents(tmp_path)


def test_a_line_that_says_what_numpy_warns_of_is_nobodys_solution() -> None:
    # The engine's own guard silences an overflow, as the slab test does.
    lines = solution_lines(ROOT / "solutions")
    assert len(lines) > 100
    assert 'with np.errstate(over="ignore"):' not in lines


@pytest.fixture
def copy(archive: Path, tmp_path: Path) -> Path:
    """The archive, unpacked."""
    with zipfile.ZipFile(archive) as file:
        file.extractall(tmp_path)
    return tmp_path / "penumbra"


RENDER = ("-m", "course", "render", "scenes/cornell_box.yaml")


def test_a_students_copy_asks_for_the_function_that_is_not_written(
    copy: Path,
) -> None:
    options = ("--size", "16x16", "--effects", "assignments")
    alone = {"PATH": ""}
    done = python(*RENDER, *options, folder=copy, path=copy, environment=alone, may_fail=True)
    assert done.returncode == 1
    assert "not written yet" in done.stderr
    assert "asks for it" in done.stderr
    assert "Traceback" not in done.stderr
    assert not list(copy.glob("*.png"))


def test_a_students_copy_shows_pictures_before_the_first_function(copy: Path) -> None:
    options = ("--size", "16x16", "--spp", "4", "-o", "box.png")
    alone = {"PATH": "", "COURSE_NO_COMPILER": "1"}
    done = python(*RENDER, *options, folder=copy, path=copy, environment=alone)
    assert (copy / "box.png").is_file()
    assert "soft_shadows.point_on_rectangle: the lamp is a point" in done.stdout


def test_the_built_site_is_put_in_and_searched(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("course.school.grading.release.archive.reference_file", lambda *_: b"")
    site = tmp_path / "site"
    (site / "modules").mkdir(parents=True)
    (site / "_sources").mkdir()
    (site / "index.html").write_text("<title>Penumbra</title>")
    (site / "modules" / "glossy.html").write_text("<p>a page</p>")
    (site / "_sources" / "glossy.md.txt").write_text("its source")
    write_archive(ROOT, tmp_path / "copy", site)
    found = tmp_path / "copy"
    assert (found / "site" / "modules" / "glossy.html").read_text() == "<p>a page</p>"
    assert not (found / "site" / "_sources").exists()
    assert "Open `site/index.html`" in (found / "README.md").read_text()
    assert "open site/index.html" in (found / "Makefile").read_text()
    line = max(solution_lines(ROOT / "solutions"), key=len)
    (site / "modules" / "glossy.html").write_text(f"<pre>\n{line}\n</pre>")
    with pytest.raises(LeakError, match=r"site/modules/glossy\.html:2 holds a line"):
        write_archive(ROOT, tmp_path / "leaky", site)
    assert not (tmp_path / "leaky").exists()
    (site / "index.html").unlink()
    with pytest.raises(CourseError, match=r"no index\.html there"):
        write_archive(ROOT, tmp_path / "none", site)


def test_a_folder_that_cannot_be_filled_is_empty_again(tmp_path: Path) -> None:
    class Late(dict[str, bytes]):
        """Interrupted once the first files are written."""

        def items(self) -> Iterator[tuple[str, bytes]]:  # type: ignore[override]
            yield from super().items()
            raise KeyboardInterrupt

    contents = {"README.md": b"text", "docs/guides/start.md": b"text"}
    with pytest.raises(KeyboardInterrupt):
        write_folder(Late(contents), tmp_path)
    with pytest.raises(OutputError):
        write_folder(contents | {"README.md/under": b"a file"}, tmp_path)
    assert write_folder(contents, tmp_path) == 2
