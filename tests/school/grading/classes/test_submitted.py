"""What students hand in: names, and files that are not what they say."""

import errno
import os
import struct
import tarfile
import zipfile
from pathlib import Path

import pytest

from course.base.errors import CourseError
from course.school.grading.classes import submitted
from course.school.grading.classes.names import safe_name
from course.school.grading.classes.submitted import find_submissions

STUB = (Path(__file__).parents[4] / "assignments" / "motion_blur.py").read_bytes()


def zipped(path: Path, **entries: bytes) -> None:
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, content in entries.items():
            archive.writestr(name, content)


def trouble(folder: Path) -> str:
    (found,) = find_submissions(folder)
    assert not found.sources
    return found.trouble


def test_folders_and_zip_files_are_submissions(tmp_path: Path) -> None:
    (tmp_path / "Ada Lovelace").mkdir()
    (tmp_path / "Ada Lovelace" / "motion_blur.py").write_bytes(STUB)
    zipped(tmp_path / "bob.ZIP", **{"work/motion_blur.py": b"pass"})
    (tmp_path / ".git").mkdir()
    (tmp_path / "__MACOSX").mkdir()
    (tmp_path / "list.csv").write_text("ada")
    found = {one.student: one for one in find_submissions(tmp_path)}
    assert found["Ada Lovelace"].sources == {"motion_blur": STUB}
    assert found["bob"].sources == {"motion_blur": b"pass"}
    # What nobody can have handed in is told all the same.
    assert found["list.csv"].trouble == "is no folder, archive, .py file or notebook"
    assert len(found) == 3


def test_a_declared_bomb(tmp_path: Path) -> None:
    with zipfile.ZipFile(tmp_path / "bomb.zip", "w", zipfile.ZIP_DEFLATED) as archive:
        for number in range(3):
            archive.writestr(f"{number}/motion_blur.py", bytes(70_000_000))
    assert "too large" in trouble(tmp_path)


def test_a_bomb_that_lies_about_its_size(tmp_path: Path) -> None:
    path = tmp_path / "bomb.zip"
    zipped(path, **{"motion_blur.py": bytes(70_000_000)})
    data = path.read_bytes()
    assert data.count(struct.pack("<I", 70_000_000)) == 2
    path.write_bytes(data.replace(struct.pack("<I", 70_000_000), struct.pack("<I", 100)))
    (found,) = find_submissions(tmp_path)
    assert found.trouble
    assert not found.sources


@pytest.mark.parametrize(
    "name", ["../motion_blur.py", "a/../../motion_blur.py", "/motion_blur.py", "c:/motion_blur.py"]
)
def test_paths_that_lead_out(tmp_path: Path, name: str) -> None:
    zipped(tmp_path / "out.zip", **{name: STUB})
    assert "leads out" in trouble(tmp_path)


@pytest.mark.parametrize("name", ["_" * 1_000_000 + ".py", "a/" * 3000 + "x.py"])
def test_names_no_file_can_have(tmp_path: Path, name: str) -> None:
    """An archive may hold names of any length; a million signs took hours to read."""
    with tarfile.open(tmp_path / "x.tar.gz", "w:gz", format=tarfile.PAX_FORMAT) as archive:
        archive.addfile(tarfile.TarInfo(name))
    assert trouble(tmp_path).endswith("letters: too long for a file")


def test_an_archive_that_takes_hours_stops_nobody(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Some versions of Python read three million digits of a header in a time that grows with their square."""
    monkeypatch.setattr(submitted, "READING", 2.0)
    with tarfile.open(tmp_path / "x.tar", "w", format=tarfile.PAX_FORMAT) as archive:
        inner = tarfile.TarInfo("motion_blur.py")
        inner.pax_headers = {"9" * 3_000_000 + " a": "b"}
        archive.addfile(inner)
    zipped(tmp_path / "ada.zip", **{"motion_blur.py": STUB})
    ada, x = find_submissions(tmp_path)
    assert ada.sources == {"motion_blur": STUB}
    assert not x.sources
    assert x.trouble


def test_a_link_in_a_zip_file(tmp_path: Path) -> None:
    with zipfile.ZipFile(tmp_path / "link.zip", "w") as archive:
        entry = zipfile.ZipInfo("motion_blur.py")
        entry.create_system, entry.external_attr = 3, 0o120777 << 16
        archive.writestr(entry, "/etc/passwd")
    assert "link" in trouble(tmp_path)


def test_links_in_folders(tmp_path: Path) -> None:
    target = tmp_path / "motion_blur.py"
    target.write_bytes(STUB)
    folder = tmp_path / "class"
    (folder / "file").mkdir(parents=True)
    (folder / "file" / "motion_blur.py").symlink_to(target)
    (folder / "whole").symlink_to(tmp_path, target_is_directory=True)
    for found in find_submissions(folder):
        assert "link" in found.trouble
        assert not found.sources


def test_a_pipe_keeps_nobody_waiting(tmp_path: Path) -> None:
    (tmp_path / "pipe").mkdir()
    os.mkfifo(tmp_path / "pipe" / "motion_blur.py")
    assert "is not a regular file" in trouble(tmp_path)


def test_a_folder_that_can_t_be_read_stops_nobody(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    for student in ("ada", "bob"):
        (tmp_path / student).mkdir()
        (tmp_path / student / "motion_blur.py").write_bytes(STUB)
    locked = tmp_path / "ada" / "motion_blur.py"
    usual = os.open

    def opened(path: str | Path, *how: object) -> int:
        if path == locked:
            # As where a folder's files may be listed and not looked at; whoever is root sees them all.
            raise PermissionError(errno.EACCES, "Permission denied", str(path))
        return usual(path, *how)  # type: ignore[arg-type]

    monkeypatch.setattr(os, "open", opened)
    ada, bob = find_submissions(tmp_path)
    assert (ada.sources, ada.trouble) == ({}, "motion_blur.py: can't be read: Permission denied")
    assert (bob.sources, bob.trouble) == ({"motion_blur": STUB}, "")


@pytest.mark.parametrize("where", [0, 60, -20])
def test_damaged_zip_files(tmp_path: Path, where: int) -> None:
    path = tmp_path / "damaged.zip"
    zipped(path, **{"motion_blur.py": os.urandom(50) + STUB})
    data = bytearray(path.read_bytes())
    data[where : where + 8] = b"damaged!"
    path.write_bytes(data)
    assert trouble(tmp_path)


def test_an_entry_without_a_name(tmp_path: Path) -> None:
    zipped(tmp_path / "nameless.zip", **{".": b""})
    assert trouble(tmp_path)


def test_the_trouble_is_told_without_the_grader_s_folders(tmp_path: Path) -> None:
    (tmp_path / "damaged.zip").write_bytes(b"PK")
    assert str(tmp_path) not in trouble(tmp_path)


@pytest.mark.parametrize(("first", "second"), [("ada", "ada.zip"), ("Ada", "ada.zip")])
def test_two_submissions_with_one_name_stop_only_themselves(
    tmp_path: Path, first: str, second: str
) -> None:
    for name in (first, "bob"):
        (tmp_path / name).mkdir()
        (tmp_path / name / "motion_blur.py").write_bytes(STUB)
    zipped(tmp_path / second, **{"motion_blur.py": STUB})
    found = {one.student: one for one in find_submissions(tmp_path)}
    assert set(found) == {first, second, "bob"}
    for name in (first, second):
        assert found[name].trouble == f"{first} and {second} go by one name: remove or rename one"
        assert not found[name].sources
    assert found["bob"].sources


def test_a_name_too_long_for_a_folder_is_graded_under_a_shorter_one(tmp_path: Path) -> None:
    # 81 letters of three bytes each: the file system takes them, and no two dozen signs more.
    for end in ("一", "二"):
        folder = tmp_path / ("李" * 80 + end)
        folder.mkdir()
        (folder / "motion_blur.py").write_bytes(STUB)
    first, second = find_submissions(tmp_path)
    assert first.sources == second.sources == {"motion_blur": STUB}
    assert first.student != second.student
    assert max(len(one.student.encode()) for one in (first, second)) <= 150
    assert "shortened" in first.remarks[0]


@pytest.mark.parametrize(
    ("name", "safe"),
    [
        ("Zoë Müller-Lüdenscheidt (2)", "Zoë Müller-Lüdenscheidt (2)"),
        ("..", "%2E%2E"),
        (".", "%2E"),
        ("", "%00"),
        ("-rf", "%2Drf"),
        ("a/b\\c", "a%2Fb%5Cc"),
        ("50%", "50%25"),
        ("a\nb", "a%0Ab"),
        ("con", "%63on"),
        ("grades.csv", "%67rades.csv"),
        ("not_protected_canvas.csv", "%6Eot_protected_canvas.csv"),
        ("end.", "end%2E"),
        ("\udcff", "%FF"),
    ],
)
def test_names_are_safe_as_folders(name: str, safe: str) -> None:
    assert safe_name(name) == safe


def test_a_zip_file_named_after_the_folder_above_stays_inside(tmp_path: Path) -> None:
    zipped(tmp_path / "...zip", **{"motion_blur.py": STUB})
    (found,) = find_submissions(tmp_path)
    assert found.student == "%2E%2E"


def test_an_empty_class_is_told(tmp_path: Path) -> None:
    with pytest.raises(CourseError, match="holds no submissions"):
        find_submissions(tmp_path)


def test_files_of_modules_that_are_not_graded_are_nobody_s_trouble(tmp_path: Path) -> None:
    twice = {f"{where}/glossy.py": b"pass" for where in "ab"}
    zipped(tmp_path / "ada.zip", **{"motion_blur.py": STUB}, **twice)
    for name, content in {"motion_blur.py": STUB, **twice}.items():
        (tmp_path / "bob" / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / "bob" / name).write_bytes(content)
    for found in find_submissions(tmp_path, ["motion_blur"]):
        assert (found.sources, found.trouble) == ({"motion_blur": STUB}, "")
    for found in find_submissions(tmp_path, ["motion_blur", "glossy"]):
        assert "glossy.py is in it more than once" in found.trouble


def test_the_file_at_the_top_is_meant(tmp_path: Path) -> None:
    (tmp_path / "ada" / "old").mkdir(parents=True)
    (tmp_path / "ada" / "motion_blur.py").write_bytes(STUB)
    (tmp_path / "ada" / "old" / "motion_blur.py").write_bytes(b"pass")
    (found,) = find_submissions(tmp_path)
    assert found.sources == {"motion_blur": STUB}


def test_names_that_begin_with_dots_are_left_out_only_where_they_are_a_programs(
    tmp_path: Path,
) -> None:
    for name in ("...", "..x", ".git", "bob"):
        (tmp_path / name).mkdir()
        (tmp_path / name / "motion_blur.py").write_text("def f(): pass\n", encoding="utf-8")
    for name in (".py", ".DS_Store", "._bob.py"):
        (tmp_path / name).write_text("def f(): pass\n", encoding="utf-8")
    found = find_submissions(tmp_path)
    assert len(found) == 4
    assert [bool(one.trouble) for one in found if one.student.endswith("py")] == [True]
