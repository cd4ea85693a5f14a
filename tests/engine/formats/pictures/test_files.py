"""Picture files hold what was given, and appear whole or not at all."""

import errno
import io
import json
import os
import sys
from collections.abc import Callable
from pathlib import Path

import numpy as np
import OpenImageIO
import pytest
from numpy.typing import NDArray
from PIL import Image

from course.base.atomic import check_writable, replacing, write_rows, write_text
from course.base.errors import OutputError
from course.engine.formats.pictures.display import linear_to_srgb8
from course.engine.formats.pictures.files import check_picture_path, encode_png, save

Linear = NDArray[np.float32]


@pytest.fixture
def linear() -> Linear:
    """A picture that is wider than high, with values above 1."""
    return np.random.default_rng(3).gamma(0.5, 0.5, (3, 5, 7)).astype(np.float32)


@pytest.fixture(params=[".png", ".exr", ".PNG"])
def suffix(request: pytest.FixtureRequest) -> str:
    """Each kind of file."""
    return str(request.param)


@pytest.fixture
def sealed_folder(tmp_path: Path) -> Path:
    """A folder in which nobody can make a file: for root, one that the kernel keeps."""
    if hasattr(os, "geteuid") and os.geteuid() == 0:
        folder = Path("/proc")
        if not folder.is_dir():
            pytest.skip("root can write to every folder here")
        return folder
    if sys.platform == "win32":
        pytest.skip("folders have no write permission to take away")
    folder = tmp_path / "sealed"
    folder.mkdir(mode=0o500)
    return folder


def test_png_holds_the_srgb_codes(tmp_path: Path, linear: Linear) -> None:
    save(tmp_path / "a.png", linear)
    with Image.open(tmp_path / "a.png") as image:
        assert image.mode == "RGB"
        np.testing.assert_array_equal(np.asarray(image), linear_to_srgb8(linear))


def test_png_says_that_it_is_srgb(linear: Linear) -> None:
    assert b"sRGB\0" in encode_png(linear)


def test_encoded_png_is_the_file(tmp_path: Path, linear: Linear) -> None:
    save(tmp_path / "a.png", linear)
    assert (tmp_path / "a.png").read_bytes() == encode_png(linear)
    with Image.open(io.BytesIO(encode_png(linear))) as image:
        assert image.size == (7, 5)


def test_exr_holds_the_values_bit_for_bit(tmp_path: Path, linear: Linear) -> None:
    linear[0, 0, 0], linear[1, 0, 0] = np.finfo(np.float32).max, np.finfo(np.float32).tiny
    save(tmp_path / "a.exr", linear)
    file = OpenImageIO.ImageInput.open(str(tmp_path / "a.exr"))
    assert file.format_name() == "openexr"
    assert file.spec().channelnames == ("R", "G", "B")
    assert str(file.spec().format) == "float"
    np.testing.assert_array_equal(np.moveaxis(file.read_image(), -1, 0), linear)


def test_the_same_picture_is_the_same_exr_at_any_time(tmp_path: Path, linear: Linear) -> None:
    save(tmp_path / "a.exr", linear)
    content = (tmp_path / "a.exr").read_bytes()
    assert b"capDate" not in content
    # Nor is anything of the file's own name in it.
    save(tmp_path / "b.exr", linear)
    assert (tmp_path / "b.exr").read_bytes() == content


def test_a_picture_that_is_not_contiguous_is_written_alike(
    tmp_path: Path, linear: Linear, suffix: str
) -> None:
    save(tmp_path / f"a{suffix}", linear)
    rows = np.moveaxis(np.ascontiguousarray(np.moveaxis(linear, 0, -1)), -1, 0)
    assert not rows.flags.c_contiguous
    save(tmp_path / f"b{suffix}", rows)
    assert (tmp_path / f"a{suffix}").read_bytes() == (tmp_path / f"b{suffix}").read_bytes()


def test_a_file_of_that_name_is_replaced(tmp_path: Path, linear: Linear, suffix: str) -> None:
    path = tmp_path / f"a{suffix}"
    path.write_text("before")
    save(path, linear)
    assert path.read_bytes()[:6] != b"before"
    assert list(tmp_path.iterdir()) == [path]


def test_a_link_is_followed(tmp_path: Path, linear: Linear) -> None:
    (tmp_path / "far").mkdir()
    link = tmp_path / "link.png"
    try:
        link.symlink_to(tmp_path / "far" / "a.png")
    except OSError:
        pytest.skip("no right to make links here")
    save(link, linear)
    assert link.is_symlink()
    assert (tmp_path / "far" / "a.png").is_file()
    (tmp_path / "far" / "a.png").unlink()
    (tmp_path / "far").rmdir()
    with pytest.raises(OutputError, match=r"there is no folder .*far: make it first"):
        save(link, linear)


@pytest.mark.skipif(sys.platform == "win32", reason="files have no mode there")
def test_the_mode_of_a_file_is_as_umask_says(tmp_path: Path, linear: Linear) -> None:
    before = os.umask(0o027)
    try:
        save(tmp_path / "a.png", linear)
    finally:
        os.umask(before)
    assert (tmp_path / "a.png").stat().st_mode & 0o777 == 0o640


def test_an_unknown_suffix_is_told_with_the_known_ones(tmp_path: Path, linear: Linear) -> None:
    for name in ("a.gif", "a", ".png", "a.png.txt"):
        for attempt in (lambda path: save(path, linear), check_picture_path):
            with pytest.raises(OutputError, match=r"must end in \.png or \.exr"):
                attempt(tmp_path / name)
    assert not list(tmp_path.iterdir())


def refused_places(tmp_path: Path, suffix: str) -> list[tuple[Path, str]]:
    """Where a picture can't be, and what is said of it."""
    (tmp_path / "file").write_text("")
    (tmp_path / f"folder{suffix}").mkdir()
    return [
        (tmp_path / "nowhere" / f"a{suffix}", "there is no folder .*nowhere"),
        (tmp_path / "file" / f"a{suffix}", "file is not a folder"),
        (tmp_path / f"folder{suffix}", "it is a folder"),
        (tmp_path / f"{'a' * 300}{suffix}", "too long"),
    ]


def test_a_place_that_cannot_be_is_told_before_and_after(
    tmp_path: Path, linear: Linear, suffix: str
) -> None:
    for path, told in refused_places(tmp_path, suffix):
        for attempt in (lambda path: save(path, linear), check_picture_path):
            with pytest.raises(OutputError, match=told) as caught:
                attempt(path)
            assert str(path) in str(caught.value)
    assert {path.name for path in tmp_path.iterdir()} == {"file", f"folder{suffix}"}


def test_a_folder_that_cannot_be_written_is_named(
    sealed_folder: Path, linear: Linear, suffix: str
) -> None:
    path = sealed_folder / f"a{suffix}"
    for attempt in (lambda path: save(path, linear), check_picture_path):
        with pytest.raises(OutputError, match=r"the folder .* can't be written") as caught:
            attempt(path)
        assert str(sealed_folder) in str(caught.value)


def test_rows_of_data_are_a_line_each(tmp_path: Path) -> None:
    path = tmp_path / "rows.json"
    data = {"made by": "a test", "checks": {"a": {"right": 1.5, "unseen": ["b"]}, "c": []}}
    write_rows(path, data, depth=2)
    assert json.loads(path.read_text()) == data
    assert len(path.read_text().splitlines()) == 7
    write_rows(path, [("a", "b"), ("c", None)], depth=1)
    assert path.read_text() == '[\n ["a", "b"],\n ["c", null]\n]\n'


@pytest.mark.skipif(not Path("/dev/null").is_char_device(), reason="no such device")
def test_a_device_is_never_replaced() -> None:
    for attempt in (check_writable, lambda path: write_text(path, "")):
        with pytest.raises(OutputError, match="not a regular file"):
            attempt(Path("/dev/null"))
    assert Path("/dev/null").is_char_device()


def test_a_check_leaves_everything_as_it_was(tmp_path: Path) -> None:
    path = tmp_path / "a.png"
    check_picture_path(path)
    assert not list(tmp_path.iterdir())
    path.write_text("before")
    check_picture_path(path)
    assert path.read_text() == "before"


def fails(error: BaseException) -> Callable[[Path], None]:
    """A way to write half a file and fail."""

    def write(path: Path) -> None:
        path.write_text("half")
        raise error

    return write


@pytest.mark.parametrize(
    ("error", "seen", "told"),
    [
        (OSError(errno.ENOSPC, "No space left on device"), OutputError, "no space left on device"),
        (ValueError("a defect"), ValueError, "a defect"),
        (KeyboardInterrupt("Ctrl-C"), KeyboardInterrupt, "Ctrl-C"),
    ],
)
def test_a_failed_write_leaves_nothing(
    tmp_path: Path, error: BaseException, seen: type[BaseException], told: str
) -> None:
    path = tmp_path / "a.png"
    with pytest.raises(seen, match=told), replacing(path) as temporary:
        fails(error)(temporary)
    assert not list(tmp_path.iterdir())


def test_a_failed_write_leaves_what_was_there(tmp_path: Path) -> None:
    path = tmp_path / "a.png"
    path.write_text("before")
    with pytest.raises(OutputError), replacing(path) as temporary:
        fails(OSError("a defect of the disk"))(temporary)
    assert path.read_text() == "before"
    assert list(tmp_path.iterdir()) == [path]


def test_a_failing_library_leaves_nothing(
    tmp_path: Path, linear: Linear, monkeypatch: pytest.MonkeyPatch
) -> None:
    closed = []

    class File:
        def open(self, name: str, _: object) -> bool:
            Path(name).write_text("half")
            return True

        def write_image(self, _: object) -> bool:
            return False

        def geterror(self) -> str:
            return "the disk is full"

        def close(self) -> bool:
            closed.append(True)
            return True

    monkeypatch.setattr(OpenImageIO.ImageOutput, "create", lambda _: File())
    with pytest.raises(OutputError, match="the disk is full"):
        save(tmp_path / "a.exr", linear)
    assert closed
    assert not list(tmp_path.iterdir())


def test_a_file_appears_only_when_it_is_whole(tmp_path: Path) -> None:
    path = tmp_path / "a.json"
    with replacing(path) as temporary:
        temporary.write_text("half")
        assert not path.exists()
        assert temporary.parent == tmp_path
    assert path.read_text() == "half"


def test_text_is_utf8_with_plain_line_ends(tmp_path: Path) -> None:
    write_text(tmp_path / "a.txt", "σ\nλ\n")
    assert (tmp_path / "a.txt").read_bytes() == b"\xcf\x83\n\xce\xbb\n"
