"""The student archive: the course without its solutions.

What goes in is listed, not what stays out: a file that nobody thought of can't give a solution away. Stubs are made
afresh, so that no half-written assignment of the author is handed out, and so are the references that checks need
where no solutions are. The finished archive is searched for every line of every solution before it gets its name.
"""

from __future__ import annotations

import tempfile
import zipfile
from pathlib import Path

from course.atomic import replacing
from course.errors import CourseError, OutputError
from course.grading.pictures.whole import NAME
from course.grading.references import make_references
from course.grading.release.regions import find_regions
from course.grading.release.stubs import make_stubs
from course.grading.report import USUAL_SEED
from course.modules import COURSE

FOLDERS = {
    "course": {".py", ".typed", ".json", ".jinja"},
    "scenes": {
        ".yaml",
        ".xml",
        ".json",
        ".webp",
        ".png",
        ".exr",
        ".ply",
        ".obj",
        ".stl",
        ".glb",
        ".md",
    },
    # What reports tell students to read.
    "docs/modules": {".md"},
    "docs/guides": {".md"},
}
"""Folders that students get, and the kinds of file in them."""

FILES = ("README.md", "LICENSE", "pyproject.toml", "Makefile", "docs/grading.md")

REFERENCES = "course/grading/data/references.npz"

TELLING = 24
"""Lines shorter than this are nobody's solution: `return x` stands everywhere."""

TELLS_NOTHING = "with np.errstate("
"""What begins like this says only what NumPy warns of, and stands wherever a product may overflow."""


class LeakError(CourseError):
    """A file of the archive holds a line of a solution."""


def archive_contents(project: Path) -> dict[str, bytes]:
    """Path in the archive -> content, for everything that students get.

    Raises
    ------
    LeakError
        A line of a solution stands somewhere in it; names the file and the line.
    """
    contents = {
        f"assignments/{stub.module}.py": stub.text.encode()
        for stub in make_stubs(project / "solutions")
    }
    for name in FILES:
        if (project / name).is_file():
            contents[name] = (project / name).read_bytes()
    for folder, suffixes in FOLDERS.items():
        for path in sorted((project / folder).rglob("*")):
            if path.is_file() and path.suffix in suffixes and "__pycache__" not in path.parts:
                contents[path.relative_to(project).as_posix()] = path.read_bytes()
    contents[REFERENCES] = _references()
    _search(contents, project)
    return contents


def write_archive(project: Path, out: Path) -> int:
    """Write the student archive as a folder or, if ``out`` ends in .zip, as a zip file; the number of files.

    Raises
    ------
    OutputError
        The folder exists and isn't empty, or nothing can be written there.
    LeakError
        See ``archive_contents``.
    """
    contents = archive_contents(project)
    if out.suffix == ".zip":
        with (
            replacing(out) as temporary,
            zipfile.ZipFile(temporary, "w", zipfile.ZIP_DEFLATED) as file,
        ):
            for name, content in contents.items():
                # A fixed date: the same course gives the same archive, byte for byte.
                file.writestr(zipfile.ZipInfo(f"penumbra/{name}"), content, zipfile.ZIP_DEFLATED)
        return len(contents)
    if out.exists() and (not out.is_dir() or any(out.iterdir())):
        raise OutputError(f"{out}: is there already and not an empty folder; choose another")
    try:
        for name, content in contents.items():
            path = out / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_bytes(content)
    except OSError as error:
        raise OutputError(f"{out}: can't be written: {error.strerror}") from error
    return len(contents)


def _references() -> bytes:
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "references.npz"
        make_references((*COURSE, NAME), USUAL_SEED, path)
        return path.read_bytes()


def solution_lines(folder: Path) -> set[str]:
    """Every telling line between the markers of the solutions, without indentation."""
    lines: set[str] = set()
    for path in sorted(folder.glob("*.py")):
        text = path.read_text(encoding="utf-8")
        rows = text.splitlines()
        for region in find_regions(text, str(path)):
            lines |= {row.strip() for row in rows[region.begin : region.end - 1]}
    return {line for line in lines if len(line) >= TELLING and not line.startswith(TELLS_NOTHING)}


def _search(contents: dict[str, bytes], project: Path) -> None:
    lines = solution_lines(project / "solutions")
    for name, content in contents.items():
        for number, row in enumerate(content.decode("utf-8", "replace").splitlines(), start=1):
            if row.strip() in lines:
                raise LeakError(f"{name}:{number} holds a line of a solution: {row.strip()}")
