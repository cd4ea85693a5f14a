"""Whatever a name leads to that is no regular file of a fair size is refused at once, in one line, by every reader."""

import errno
import os
import re
import socket
import sys
import time
import zipfile
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

import numpy as np
import pytest

from course import load_scene
from course.base import inputs
from course.base.errors import CourseError
from course.base.inputs import InputLimit, opened, read_arrays, read_input
from course.engine.formats.meshes.files import read_mesh
from course.engine.formats.metu.reading import read_elements
from course.engine.formats.pictures.reading import read_picture
from course.engine.functions.effects import Effects
from course.engine.radiosity.viewing import load_solution
from course.school.grading.classes.roster import read_roster
from course.school.grading.references import read_references

pytestmark = pytest.mark.skipif(
    sys.platform == "win32", reason="has no pipes, devices and links like these"
)

READERS: dict[str, Callable[[Path], object]] = {
    "scene.yaml": load_scene,
    "scene.xml": read_elements,
    "scene.json": read_elements,
    "mesh.obj": read_mesh,
    "mesh.ply": read_mesh,
    "mesh.stl": read_mesh,
    "mesh.glb": read_mesh,
    "picture.png": read_picture,
    "picture.jpg": read_picture,
    "picture.exr": read_picture,
    "picture.hdr": read_picture,
    "solution.npz": load_solution,
    "references.npz": lambda path: read_references(path, 0),
    "roster.csv": read_roster,
}
"""What reads the files that a user names, by the name of one."""

SECONDS = 2.0
"""In which a file is refused; the usual time is a thousandth of it."""


def refusal(read: Callable[[Path], object], path: Path) -> str:
    """What is said of a file: one short line that names it, and soon."""
    before = time.perf_counter()
    with pytest.raises(CourseError) as caught:
        read(path)
    assert time.perf_counter() - before < SECONDS
    told = str(caught.value)
    assert told.startswith(f"{path.parent}{os.sep}{path.name}"[:80])
    assert "\n" not in told
    assert len(told) < len(str(path)) + 200
    return told.removeprefix(f"{path}: ")


@pytest.fixture(params=READERS)
def case(request: pytest.FixtureRequest, tmp_path: Path) -> tuple[Callable[[Path], object], Path]:
    return READERS[request.param], tmp_path / request.param


def test_a_pipe_that_nobody_writes_to_is_refused(
    case: tuple[Callable[[Path], object], Path],
) -> None:
    read, path = case
    os.mkfifo(path)
    assert refusal(read, path).startswith("is not a regular file: expected a ")


@pytest.mark.parametrize("device", ["/dev/zero", "/dev/null", "/dev/tty"])
def test_a_link_to_a_device_is_refused(
    case: tuple[Callable[[Path], object], Path], device: str
) -> None:
    read, path = case
    path.symlink_to(device)
    told = refusal(read, path)
    # A process without a terminal can't open its terminal.
    assert told.startswith("is not a regular file: expected a ") or device == "/dev/tty"


def test_a_socket_is_refused(
    case: tuple[Callable[[Path], object], Path], monkeypatch: pytest.MonkeyPatch
) -> None:
    read, path = case
    # The name of a socket is short, so it is made from its folder.
    monkeypatch.chdir(path.parent)
    with socket.socket(socket.AF_UNIX) as end:
        end.bind(path.name)
        assert refusal(read, path).startswith("is not a regular file: expected a ")


def test_a_folder_is_refused(case: tuple[Callable[[Path], object], Path]) -> None:
    read, path = case
    path.mkdir()
    assert refusal(read, path).startswith("is a folder: expected a ")


def test_links_in_a_circle_and_missing_files_are_refused(
    case: tuple[Callable[[Path], object], Path],
) -> None:
    read, path = case
    assert refusal(read, path).startswith("no such file")
    path.symlink_to(path.name)
    assert refusal(read, path).startswith("can't be read: ")


def test_a_file_that_the_system_keeps_closed_is_refused(
    case: tuple[Callable[[Path], object], Path], monkeypatch: pytest.MonkeyPatch
) -> None:
    read, path = case
    path.write_bytes(b"x")

    def refuse(*_: object) -> int:
        raise PermissionError(errno.EACCES, "Permission denied")

    with monkeypatch.context() as patch:
        patch.setattr(os, "open", refuse)
        assert refusal(read, path) == "can't be read: Permission denied"


def test_an_empty_file_is_refused(case: tuple[Callable[[Path], object], Path]) -> None:
    read, path = case
    path.touch()
    refusal(read, path)


def test_names_that_no_file_can_have_are_refused(
    case: tuple[Callable[[Path], object], Path],
) -> None:
    read, path = case
    told = refusal(read, path.with_name("x" * 300 + path.suffix))
    assert told.endswith("...: can't be read: its name is too long for a file")
    with pytest.raises(CourseError, match=r"x\\x00y\.[a-z]+: can't be read: embedded null byte"):
        read(path.with_name("x\0y" + path.suffix))


def test_a_sparse_file_of_200_gb_is_refused_unread(
    case: tuple[Callable[[Path], object], Path],
) -> None:
    read, path = case
    path.touch()
    try:
        os.truncate(path, 200 << 30)
    except OSError:
        pytest.skip("this file system has no files of that size")
    assert "bytes: too large for a " in refusal(read, path)


def test_a_sparse_file_that_is_small_enough_is_refused_soon(
    case: tuple[Callable[[Path], object], Path],
) -> None:
    read, path = case
    path.touch()
    # Scenes and rosters may not be larger.
    os.truncate(path, 16 << 20 if path.suffix in (".yaml", ".csv") else 1 << 30)
    refusal(read, path)


@pytest.mark.parametrize(
    ("name", "start"), [("a.exr", b"\x76\x2f\x31\x01\x02\0\0\0"), ("a.hdr", b"#?RADIANCE\n")]
)
def test_a_sparse_picture_with_a_right_beginning_is_refused_soon(
    tmp_path: Path, name: str, start: bytes
) -> None:
    path = tmp_path / name
    path.write_bytes(start)
    os.truncate(path, 1 << 30)
    refusal(read_picture, path)


def test_a_file_that_a_link_leads_to_is_read(tmp_path: Path) -> None:
    (tmp_path / "a").write_bytes(b"content")
    (tmp_path / "b").symlink_to("a")
    assert read_input(tmp_path / "b", "file", InputLimit(7)) == b"content"


def test_a_bound_is_the_most_that_is_read_and_names_its_key(tmp_path: Path) -> None:
    path = tmp_path / "a"
    path.write_bytes(b"12345678")
    assert read_input(path, "file", InputLimit(8)) == b"12345678"
    with pytest.raises(CourseError) as caught:
        read_input(path, "mesh file", InputLimit(7, "limits.bytes"))
    assert str(caught.value) == (
        f"{path}: more than 7 bytes: too large for a mesh file; limits.bytes in the scene file allows more"
    )


def test_a_file_that_grows_while_it_is_read_is_refused(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = tmp_path / "a"
    path.write_bytes(b"1234")

    @contextmanager
    def growing(*args: object) -> Iterator[object]:
        with opened(*args) as stream:  # type: ignore[arg-type]
            with path.open("ab") as other:
                other.write(b"5678")
            yield stream

    monkeypatch.setattr("course.base.inputs.opened", growing)
    with pytest.raises(CourseError, match="more than 7 bytes"):
        read_input(path, "file", InputLimit(7))


def test_descriptors_are_given_back(tmp_path: Path) -> None:
    held = Path("/proc/self/fd")
    if not held.is_dir():
        pytest.skip("only Linux tells what is open")
    before = len(list(held.iterdir()))
    for _ in range(5):
        for name in (tmp_path, Path("/dev/null"), tmp_path / "none"):
            with pytest.raises(CourseError):
                read_input(name, "file", InputLimit(1))
    assert len(list(held.iterdir())) == before


def test_arrays_that_unpack_to_more_than_they_may_are_refused(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = tmp_path / "a.npz"
    np.savez_compressed(path, a=np.zeros(1 << 20, np.uint8))
    assert path.stat().st_size < 1 << 12
    assert read_arrays(path, "file")["a"].size == 1 << 20
    monkeypatch.setattr("course.base.inputs.LARGEST_ARRAYS", 1 << 20)
    # The header of the array is in the archive, too.
    with pytest.raises(CourseError, match="more than 1,048,576 bytes"):
        read_arrays(path, "file")


def test_what_is_no_array_in_a_file_of_arrays_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "a.npz"
    np.savez(path, a=np.zeros(3))
    with zipfile.ZipFile(path, "a") as archive:
        archive.writestr("b.txt", "no array")
    with pytest.raises(CourseError, match="can't be read: expected a file of arrays"):
        read_arrays(path, "file of arrays")


def test_a_folder_of_functions_with_a_name_that_is_too_long_is_refused(tmp_path: Path) -> None:
    with pytest.raises(CourseError, match=r"no folder .* with effect functions"):
        Effects(tmp_path / ("x" * 300))


OWN_FILES = {
    "functions/sources.py": "the functions of one's own, which Python imports all the same",
    "recording/view.py": "its own script",
    "render/cluster/parcel.py": "the course's sources, and files of a scene that has been compiled here",
    "formats/metu/converting.py": "the scene that it has written",
}
"""What reads files by itself all the same, and which."""


def test_no_other_reader_opens_files_by_itself() -> None:
    engine = Path(inputs.__file__).parents[1] / "engine"
    by_itself = re.compile(r"\.read_(bytes|text)\(|np\.load\(|\.open\(\"r|(?<![.\w])open\(")
    found = {
        path.relative_to(engine).as_posix()
        for path in engine.rglob("*.py")
        if by_itself.search(path.read_text(encoding="utf-8"))
    }
    assert found == OWN_FILES.keys()
