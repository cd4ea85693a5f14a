"""Files that a user names, opened in one place: regular files only, and none larger than its kind may be.

A pipe might never begin and a device never end. So nothing is read before the file that has been opened, not only
its name, has been looked at, and never more than the bound of its kind.
"""

import codecs
import errno
import os
import stat
import zipfile
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from io import BufferedReader
from pathlib import Path
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from course.base.errors import CourseError

LARGEST_SCENE: Final = 16 << 20
"""Bytes of a scene or another YAML file, and of tables and records of the grading."""

LARGEST_DATA: Final = 1 << 30
"""Bytes of a mesh, a picture or a METU scene, if nobody says otherwise."""

LARGEST_ARRAYS: Final = 4 << 30
"""Bytes of an .npz file, and of all arrays in it."""

MOST_PIXELS: Final = 1 << 27
"""Pixels of a picture, if nobody says otherwise: 16384 x 8192, which take 1.6 GB as linear light."""

_FLAGS: Final = (
    os.O_RDONLY
    # Not to wait for whoever writes to a pipe, nor to get a terminal's signals. Windows has none of these.
    | getattr(os, "O_NONBLOCK", 0)
    | getattr(os, "O_NOCTTY", 0)
    | getattr(os, "O_CLOEXEC", 0)
    | getattr(os, "O_BINARY", 0)
)

_BLOCK: Final = 4096
"""Bytes, with which no kind of file that is read whole begins if they are 0: the disk holds nothing there."""


@dataclass(frozen=True)
class InputLimit:
    """The most that may be read, in bytes or pixels, and the scene's key for it; "" where there is none."""

    most: int
    key: str = ""

    @property
    def remedy(self) -> str:
        """The end of a message about too large an input."""
        return f"; {self.key} in the scene file allows more" if self.key else ""


def shown(path: Path) -> str:
    """A file's name as a message shows it: one line of text, for it may hold line breaks or bytes that are no text."""
    name = str(path)
    return name if name.isprintable() else name.encode("unicode_escape").decode("ascii")


@contextmanager
def opened(
    path: Path, what: str, bound: InputLimit, error: type[CourseError] = CourseError
) -> Iterator[BufferedReader]:
    """Open a regular file for reading; symbolic links are followed.

    Raises a CourseError of the kind of ``error``, in one line that names the file: it is missing, a folder, a pipe, a
    socket, a device or too large, or the system can't open it.

    Parameters
    ----------
    what : what is expected, for messages, such as "mesh file"
    bound : the most bytes that the file may have
    error : what is raised
    """
    try:
        descriptor = os.open(path, _FLAGS)
    except (OSError, ValueError) as trouble:
        raise error(_refused(path, what, trouble)) from trouble
    about = os.fstat(descriptor)
    if not stat.S_ISREG(about.st_mode):
        os.close(descriptor)
        raise error(_irregular(path, what, stat.S_ISDIR(about.st_mode)))
    with os.fdopen(descriptor, "rb") as stream:
        if about.st_size > bound.most:
            raise error(_too_large(path, what, bound))
        yield stream


def read_input(
    path: Path, what: str, bound: InputLimit, error: type[CourseError] = CourseError
) -> bytes:
    """Content of a file; parameters and errors as of `opened`, and one for nothing but zeros at the start."""
    with opened(path, what, bound, error) as stream:
        try:
            start = stream.peek()
            if len(start) >= _BLOCK and not start.strip(b"\0"):
                raise error(f"{shown(path)}: begins with {_BLOCK:,} zeros: expected a {what}")
            # One byte more than it has, and so no more than fits if it grows.
            content = stream.read(os.fstat(stream.fileno()).st_size + 1)
        except OSError as trouble:
            raise error(_refused(path, what, trouble)) from trouble
    if len(content) > bound.most:
        raise error(_too_large(path, what, bound))
    return content


INVISIBLE: Final = "\ufeff\u200b\u200c\u200d\u200e\u200f\u2060\u00ad"
"""Characters that some programs write before a text's first word, and that no editor shows."""

_MARKS: Final = (
    (codecs.BOM_UTF32_LE, "utf-32"),
    (codecs.BOM_UTF32_BE, "utf-32"),
    (codecs.BOM_UTF16_LE, "utf-16"),
    (codecs.BOM_UTF16_BE, "utf-16"),
)
"""Marks of the order of bytes; the longer ones begin as the shorter ones do."""


def without_marks(content: bytes, errors: str = "strict") -> bytes:
    """The bytes of a file, from its first visible character on; where its byte order mark says so, as UTF-8.

    Raises UnicodeDecodeError where bytes aren't what the mark says, unless ``errors`` is "replace".
    """
    for mark, encoding in _MARKS:
        if content.startswith(mark):
            return content.decode(encoding, errors).lstrip(INVISIBLE).encode()
    start = content[: 16 * len(INVISIBLE)].decode("utf-8", "replace")
    unseen = len(start) - len(start.lstrip(INVISIBLE))
    return content[len(start[:unseen].encode()) :] if unseen else content


def text_of(content: bytes, errors: str = "strict") -> str:
    """Text of any file: UTF-8, or what its byte order mark says, without what nobody sees before its first word.

    Raises UnicodeDecodeError where bytes are no such text.
    ``errors``: "replace" puts a mark in the place of such bytes, as for comments of another encoding
    """
    return without_marks(content, errors).decode("utf-8", errors)


def read_arrays(
    path: Path, what: str, wanted: Callable[[str], bool] = lambda _name: True
) -> dict[str, NDArray[Any]]:
    """Arrays of an .npz file by their names, those that are wanted.

    Raises CourseError as `opened` does, and for a file that isn't one, that holds objects, or arrays of more than
    LARGEST_ARRAYS.
    """
    with opened(path, what, InputLimit(LARGEST_ARRAYS)) as stream:
        try:
            with zipfile.ZipFile(stream) as archive:
                size = sum(each.file_size for each in archive.infolist())
            if size > LARGEST_ARRAYS:
                raise CourseError(_too_large(path, what, InputLimit(LARGEST_ARRAYS)))
            stream.seek(0)
            with np.load(stream, allow_pickle=False) as arrays:
                found = {name: arrays[name] for name in arrays.files if wanted(name)}
            # What is in the archive beside arrays comes as bytes.
            if not all(isinstance(each, np.ndarray) for each in found.values()):
                raise ValueError("not all in it are arrays")
            return found
        except CourseError:
            raise
        # Whatever zipfile, zlib and the reader of a header's Python text make of wrong bytes.
        except Exception as trouble:
            raise CourseError(f"{shown(path)}: can't be read: expected a {what}") from trouble


def _refused(path: Path, what: str, trouble: OSError | ValueError) -> str:
    file = shown(path)
    if isinstance(trouble, FileNotFoundError):
        return f"{file}: no such file"
    if isinstance(trouble, ValueError):
        return f"{file}: can't be read: {trouble}"
    if trouble.errno == errno.ENAMETOOLONG:
        return f"{file[:80]}...: can't be read: its name is too long for a file"
    # A socket can't be opened, and on Windows no folder either.
    if trouble.errno == errno.ENXIO or path.is_dir():
        return _irregular(path, what, trouble.errno != errno.ENXIO)
    return f"{file}: can't be read: {trouble.strerror or trouble}"


def _irregular(path: Path, what: str, folder: bool) -> str:
    kind = "is a folder" if folder else "is not a regular file"
    return f"{shown(path)}: {kind}: expected a {what}"


def _too_large(path: Path, what: str, bound: InputLimit) -> str:
    return f"{shown(path)}: more than {bound.most:,} bytes: too large for a {what}{bound.remedy}"
