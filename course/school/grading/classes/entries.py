"""The files of what was handed in, folder or archive, without unpacking anything to the disk.

Nobody trusts an archive: how many files it may list, how much it may unpack to and how deep archives may lie in each
other is bounded, no path leads out, and no link is followed.
"""

import bz2
import gzip
import lzma
import os
import tarfile
import zipfile
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import partial
from io import BytesIO
from pathlib import Path, PurePosixPath
from typing import TypeVar

from course.base.inputs import opened
from course.base.texts import words
from course.school.grading.submissions import ANY_SIZE, SubmissionError, readable

Found = TypeVar("Found")

LARGEST_ARCHIVE = 50_000_000
"""Bytes of an archive, as it lies on the disk."""

MOST_ENTRIES = 10_000
MOST_BYTES = 200_000_000
"""Of all archives of a submission, unpacked."""

LARGEST_TAR = 64_000_000
"""Bytes of an unpacked tar archive, which is held in memory."""

LONGEST_PART, LONGEST_PATH = 255, 4096
"""Letters of a name in an archive, and of a path, as file systems bound them."""

DEEPEST = 2
"""Archives that may lie in each other."""

_LZMA_BYTES = 128_000_000
_ZIP = (".zip",)
_TAR = (".tar", ".tar.gz", ".tgz", ".tar.bz2", ".tbz2", ".tar.xz", ".txz")
_CLOSED = (".rar", ".7z", ".gz", ".bz2", ".xz", ".zst", ".lz", ".z", ".ace", ".arj", ".cab", ".dmg")
_MAGIC = {b"Rar!": ".rar", b"7z\xbc\xaf": ".7z"}
_NOBODYS = ("__MACOSX", "__pycache__", "site-packages", "dist-packages", "node_modules")
_ENVIRONMENTS = ("pyvenv.cfg", "conda-meta")
"""What lies at the top of an environment of Python."""

_INSTALLED = words(
    "bin compiler_compat conda-meta dlls etc include lib lib64 libs library man pkgs scripts share "
    "ssl tcl"
)
"""Folders of an environment that hold nobody's work."""


@dataclass(frozen=True)
class Entry:
    """A file.

    Attributes
    ----------
    path : where it lies in the submission
    read : up to so many bytes of it; raises `SubmissionError` where it is a link or can't be read
    """

    path: PurePosixPath
    read: Callable[[int], bytes]


@dataclass
class ArchiveBudget:
    """Entries and bytes that the archives of one submission may still list and unpack to."""

    entries: int = MOST_ENTRIES
    bytes: int = MOST_BYTES

    def spend(self, name: str, size: int) -> None:
        """Count one more entry of that size."""
        self.entries -= 1
        self.bytes -= max(0, size)
        if self.entries < 0 or self.bytes < 0:
            raise too_large(name)


def too_large(name: str) -> SubmissionError:
    """The error of an archive over the bounds."""
    return SubmissionError(f"{name}: is too large to be a submission")


def archive_suffix(name: str) -> str:
    """The suffix by which a file is an archive, one that can't be read here included; empty if it is none."""
    lower = name.lower()
    return next((suffix for suffix in (*_ZIP, *_TAR, *_CLOSED) if lower.endswith(suffix)), "")


def is_nobodys(path: PurePosixPath) -> bool:
    """True if a file is hidden or a program's own, such as a file manager's."""
    return any((part.startswith(".") and part != "..") or part in _NOBODYS for part in path.parts)


def own_work(
    found: list[Found], path_of: Callable[[Found], PurePosixPath], remarks: list[str]
) -> Iterator[Found]:
    """What isn't nobody's: without hidden files, and without those of environments of Python, which is told."""
    paths = [path_of(one) for one in found]
    tops = {
        PurePosixPath(*path.parts[: path.parts.index(mark)])
        for mark in _ENVIRONMENTS
        for path in paths
        if mark in path.parts
    }
    passed = set[PurePosixPath]()
    for one, path in zip(found, paths, strict=True):
        top = next((top for top in path.parents if top in tops), None)
        below = "" if top is None else path.parts[len(top.parts)].lower()
        if top is not None and (below in _INSTALLED or below in _ENVIRONMENTS):
            passed.add(top)
        elif not is_nobodys(path):
            yield one
    told = "what is installed in this environment of Python was passed over"
    remarks += [f"{top}: {told}" for top in sorted(passed)]


def _path(entry: Entry) -> PurePosixPath:
    return entry.path


def folder_entries(folder: Path) -> Iterator[Entry]:
    """Files in a folder and below, in the order of their paths."""

    def fail(error: OSError) -> None:
        raise error

    with readable(folder):
        for where, folders, files in os.walk(folder, onerror=fail):
            folders.sort()
            links = [name for name in folders if (Path(where) / name).is_symlink()]
            for name in sorted([*files, *links]):
                path = Path(where) / name
                yield Entry(PurePosixPath(path.relative_to(folder)), file_reader(path))


def file_reader(path: Path) -> Callable[[int], bytes]:
    """A reader of a file on the disk that nobody trusts."""

    def read(limit: int) -> bytes:
        with readable(path):
            if path.is_symlink():
                raise SubmissionError(f"{path}: is a link; submit the file itself")
            with opened(path, "file of a submission", ANY_SIZE, SubmissionError) as file:
                return file.read(limit)

    return read


def unfolded(entries: Iterator[Entry], remarks: list[str]) -> Iterator[Entry]:
    """The entries, those in archives among them; what is told of archives that can't be read goes to the remarks."""
    yield from _unfolded(entries, remarks, ArchiveBudget(), DEEPEST)


def _unfolded(
    entries: Iterator[Entry], remarks: list[str], budget: ArchiveBudget, depth: int
) -> Iterator[Entry]:
    for entry in own_work(list(entries), _path, remarks):
        name = str(entry.path)
        yield entry
        if not archive_suffix(name):
            continue
        if depth == 0:
            remarks.append(f"{name}: lies too deep in other archives to be read")
            continue
        try:
            content = entry.read(LARGEST_ARCHIVE + 1)
            if len(content) > LARGEST_ARCHIVE:
                raise too_large(name)
            inner = archive_entries(name, content, budget, remarks)
            yield from _unfolded(
                (Entry(entry.path / one.path, one.read) for one in inner),
                remarks,
                budget,
                depth - 1,
            )
        except SubmissionError as error:
            remarks.append(str(error))


def archive_entries(
    name: str, content: bytes, budget: ArchiveBudget, remarks: list[str]
) -> list[Entry]:
    """Files of an archive that are somebody's work; ``remarks`` gets what was passed over.

    Raises SubmissionError: it is damaged, too large, of a kind that can't be read, or a path in it leads out.
    """
    suffix = _MAGIC.get(content[:4], archive_suffix(name))
    if suffix in _CLOSED:
        raise SubmissionError(
            f"{name}: is a {suffix} archive, which can't be read here; "
            "unpack it, and hand in the folder or a .zip of it"
        )
    kind = "zip" if suffix in _ZIP else "tar"
    try:
        found = (_zip_entries if kind == "zip" else _tar_entries)(name, content, budget, remarks)
    except SubmissionError:
        raise
    except Exception as error:
        # The ways in which an archive can be damaged have no common class.
        raise SubmissionError(f"{name}: is no {kind} file that can be read: {error}") from error
    for entry in found:
        parts = entry.path.parts
        longest, whole = max(map(len, parts), default=0), len(str(entry.path))
        if longest > LONGEST_PART or whole > LONGEST_PATH:
            raise SubmissionError(f"{name}: a name in it has {whole} letters: too long for a file")
        if entry.path.is_absolute() or ".." in parts or ":" in "".join(parts[:1]):
            raise SubmissionError(f"{name}: {str(entry.path)!r} leads out of the archive")
    return found


def _zip_entries(
    name: str, content: bytes, budget: ArchiveBudget, remarks: list[str]
) -> list[Entry]:
    archive = zipfile.ZipFile(BytesIO(content))
    found = []
    for info in own_work(archive.infolist(), _zip_path, remarks):
        budget.spend(name, info.file_size)
        if not info.is_dir():
            link = (info.external_attr >> 28) == 0xA
            path, shown = _zip_path(info), f"{name}: {info.filename!r}"
            reader = _refuse(f"{shown} is a link; submit the file itself")
            found.append(Entry(path, reader if link else partial(_unzip, archive, info, shown)))
    return found


def _zip_path(info: zipfile.ZipInfo) -> PurePosixPath:
    return PurePosixPath(info.filename.replace("\\", "/"))


def _unzip(archive: zipfile.ZipFile, info: zipfile.ZipInfo, shown: str, limit: int) -> bytes:
    try:
        with archive.open(info) as file:
            # What the directory says of sizes may be a lie: no more than this is unpacked.
            return file.read(limit)
    except Exception as error:
        raise SubmissionError(f"{shown} can't be read: {error}") from error


def _tar_entries(
    name: str, content: bytes, budget: ArchiveBudget, remarks: list[str]
) -> list[Entry]:
    data = _unpacked(content)
    if len(data) > LARGEST_TAR:
        raise too_large(name)
    budget.spend(name, len(data) - len(content))
    found = []
    # Everything is in memory, so no size that a header claims makes it read more than that.
    with tarfile.open(fileobj=BytesIO(data), mode="r:") as archive:
        for member in own_work(archive.getmembers(), _tar_path, remarks):
            budget.spend(name, member.size)
            if member.isdir():
                continue
            reader = _refuse(f"{name}: {member.name!r} is a link or no ordinary file")
            if member.isfile() and not member.issparse():
                piece = data[member.offset_data : member.offset_data + member.size]
                reader = partial(_beginning, piece)
            found.append(Entry(_tar_path(member), reader))
    return found


def _tar_path(member: tarfile.TarInfo) -> PurePosixPath:
    return PurePosixPath(member.name)


def _beginning(content: bytes, limit: int) -> bytes:
    return content[:limit]


def _refuse(why: str) -> Callable[[int], bytes]:
    def read(_: int) -> bytes:
        raise SubmissionError(why)

    return read


def _unpacked(content: bytes) -> bytes:
    """An archive without its compression, cut after more than is allowed."""
    if content.startswith(b"\x1f\x8b"):
        with gzip.GzipFile(fileobj=BytesIO(content)) as file:
            return file.read(LARGEST_TAR + 1)
    if content.startswith(b"BZh"):
        with bz2.BZ2File(BytesIO(content)) as packed:
            return packed.read(LARGEST_TAR + 1)
    if content.startswith(b"\xfd7zXZ"):
        decompressor = lzma.LZMADecompressor(memlimit=_LZMA_BYTES)
        return decompressor.decompress(content, max_length=LARGEST_TAR + 1)
    return content
