"""The student archive: the course without its solutions.

What goes in is listed, not what stays out: a file that nobody thought of can't give a solution away. Stubs are made
afresh, so that no half-written assignment of the author is handed out, and so are the references that checks need
where no solutions are. The finished archive is searched for every line of every solution before it gets its name.
"""

import shutil
import tempfile
import zipfile
from collections.abc import Container, Iterable, Mapping
from contextlib import suppress
from pathlib import Path

from course.base.atomic import replacing
from course.base.errors import CourseError, OutputError
from course.engine.functions.effects import PACKAGE
from course.engine.functions.modules import COURSE
from course.school.grading.pictures.whole import NAME
from course.school.grading.references import make_references
from course.school.grading.release.folder import made_contents
from course.school.grading.release.pages import plain_pages
from course.school.grading.release.stubs import find_regions
from course.school.grading.report import USUAL_SEED

SCENES = {
    "scenes": {
        *(".yaml", ".xml", ".json", ".md"),
        *(".webp", ".png", ".exr"),
        *(".ply", ".obj", ".stl", ".glb"),
    }
}
PAGES = {"docs": {".md", ".json", ".ipynb"}}
"""Reports tell students to read some of them, and these name the others."""

FOLDERS = {
    "course": {".py", ".typed", ".json", ".jinja", ".html", ".css", ".js"},
    **SCENES,
    **PAGES,
}
"""Folders that students get, and the kinds of file in them."""

LICENSES = ("LICENSE", "docs/LICENSE")

FILES = (*LICENSES, "pyproject.toml")

REFERENCES = "course/school/grading/data/references.npz"

TELLING = 24
"""Lines shorter than this are nobody's solution: `return x` stands everywhere."""

TELLS_NOTHING = "with np.errstate("
"""What begins like this says only what NumPy warns of, and stands wherever a product may overflow."""


_SCRIPT = b"#!"


class LeakError(CourseError):
    """A file of the archive holds a line of a solution."""


def archive_contents(project: Path, site: Path | None = None) -> dict[str, bytes]:
    """Path in the archive -> content, for everything that students get.

    Raises
    ------
    LeakError
        A line of a solution stands somewhere in it; names the file and the line.
    CourseError
        There is no site in ``site``.

    Parameters
    ----------
    site : folder of the built site, which is put in as ``site/``; None for pages without pictures alone
    """
    contents = made_contents(project / "solutions", copy=True, site=site is not None)
    if site is not None:
        contents |= _site(site)
    contents |= plain_pages(project_files(project, FILES, FOLDERS))
    contents[REFERENCES] = reference_file((*COURSE, NAME), USUAL_SEED)
    _search(contents, project)
    return contents


def _site(folder: Path) -> dict[str, bytes]:
    """The files of the built site, as they are read in a browser."""
    if not (folder / "index.html").is_file():
        raise CourseError(
            f"{folder}: no index.html there: expected the built site, as `make docs` makes it"
        )
    return {
        f"site/{path.relative_to(folder).as_posix()}": path.read_bytes()
        for path in sorted(folder.rglob("*"))
        if path.is_file() and not {"_sources", ".doctrees"} & {*path.relative_to(folder).parts}
    }


def write_archive(project: Path, out: Path, site: Path | None = None) -> int:
    """Write the student archive as a folder or, if ``out`` ends in .zip, as a zip file; the number of files.

    ``site``: see ``archive_contents``

    Raises
    ------
    OutputError
        The folder exists and isn't empty, or nothing can be written there.
    LeakError
        See ``archive_contents``.
    """
    if out.suffix != ".zip":
        # Before the references are made, which takes a while.
        check_folder(out)
    contents = archive_contents(project, site)
    if out.suffix == ".zip":
        return write_zip({f"penumbra/{name}": text for name, text in contents.items()}, out)
    return write_folder(contents, out)


def project_files(
    project: Path, files: Iterable[str], folders: Mapping[str, Container[str]]
) -> dict[str, bytes]:
    """Path -> content of some files of a project, and of those of some kinds in its folders.

    The package ``course`` is a folder of each project, wherever it is installed.
    """
    contents = {name: (project / name).read_bytes() for name in files if (project / name).is_file()}
    for folder, suffixes in folders.items():
        home = project / folder
        if folder == "course" and not home.is_dir():
            home = PACKAGE
        for path in sorted(home.rglob("*")):
            if path.is_file() and path.suffix in suffixes:
                contents[f"{folder}/{path.relative_to(home).as_posix()}"] = path.read_bytes()
    return contents


def reference_file(modules: Iterable[str], seed: int) -> bytes:
    """Content of a file of ``make_references``."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "references.npz"
        make_references(modules, seed, path)
        return path.read_bytes()


def write_zip(contents: Mapping[str, bytes], out: Path) -> int:
    """Write a .zip file, in which scripts can be executed; the number of its files, or ``OutputError``."""
    with replacing(out) as temporary, zipfile.ZipFile(temporary, "w") as file:
        for name, content in contents.items():
            # A fixed date: the same course gives the same archive, byte for byte.
            entry = zipfile.ZipInfo(name)
            entry.create_system = 3  # Unix, so that the permissions count
            entry.external_attr = (0o100755 if content.startswith(_SCRIPT) else 0o100644) << 16
            file.writestr(entry, content, zipfile.ZIP_DEFLATED)
    return len(contents)


def check_folder(out: Path) -> None:
    """Refuse a folder in which something would be written over; raises ``OutputError``."""
    if out.exists() and (not out.is_dir() or any(out.iterdir())):
        raise OutputError(f"{out}: is there already and not an empty folder; choose another")


def write_folder(contents: Mapping[str, bytes], out: Path) -> int:
    """Write files into a folder that is new or empty, scripts so that they can be executed; the number of files.

    Raises OutputError: the folder holds something, or can't be written.
    """
    check_folder(out)
    try:
        for name, content in contents.items():
            path = out / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_bytes(content)
            if content.startswith(_SCRIPT):
                path.chmod(0o755)
    except BaseException as error:
        # What is half there would be taken for whole, and the next attempt refused because of it.
        for top in {out / Path(name).parts[0] for name in contents}:
            shutil.rmtree(top, ignore_errors=True)
            with suppress(OSError):
                top.unlink()
        if not isinstance(error, OSError):
            raise
        raise OutputError(f"{out}: can't be written: {error.strerror}") from error
    return len(contents)


def solution_lines(folder: Path) -> set[str]:
    """Every telling line between the markers of the solutions, of answers, exams and quizzes, without indentation."""
    lines: set[str] = set()
    for path in sorted(folder.glob("*.py")):
        text = path.read_text(encoding="utf-8")
        rows = text.splitlines()
        for region in find_regions(text, str(path)):
            lines |= {row.strip() for row in rows[region.begin : region.end - 1]}
    for kind in ("answers/*.md", "exams/*.md", "quizzes/*.yaml"):
        for path in folder.glob(kind):
            lines |= {row.strip() for row in path.read_text(encoding="utf-8").splitlines()}
    return {line for line in lines if len(line) >= TELLING and not line.startswith(TELLS_NOTHING)}


def _search(contents: dict[str, bytes], project: Path) -> None:
    lines = solution_lines(project / "solutions")
    for name, content in contents.items():
        for number, row in enumerate(content.decode("utf-8", "replace").splitlines(), start=1):
            if row.strip() in lines:
                raise LeakError(f"{name}:{number} holds a line of a solution: {row.strip()}")
