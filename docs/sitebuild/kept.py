"""Files that builds keep between them: those that no page uses any more are removed."""

from collections.abc import Collection, Iterable
from pathlib import Path

from course.engine.functions.effects import PROJECT

DOCS = PROJECT / "docs"
ROOT = PROJECT / "out" / "docs"

FOLDERS = ("keys", "mistakes", "notebooks", "pictures", "rays", "series")
"""Of `ROOT`, those of files that are kept under a hash of all that decides them."""


def whole(source: Path, pages: Collection[str]) -> bool:
    """Tell whether a build has all pages of the site, so that what it doesn't use is used by none.

    Parameters
    ----------
    source : folder that is built
    pages : that the build has found, by their names without ``.md``
    """
    ours = (path.relative_to(DOCS).with_suffix("").as_posix() for path in DOCS.rglob("*.md"))
    return source.resolve() == DOCS.resolve() and all(page in pages for page in ours)


def forget(used: Iterable[Path]) -> list[Path]:
    """Remove from all folders of kept files what isn't used.

    Parameters
    ----------
    used : as in `forget_unused`, by all pages of the site

    Returns
    -------
    The files that were removed.
    """
    used = list(used)
    return [path for name in FOLDERS for path in forget_unused(ROOT / name, used)]


def forget_unused(folder: Path, used: Iterable[Path]) -> list[Path]:
    """Remove from a folder what isn't used; hidden files stay, for another build may be writing them.

    Parameters
    ----------
    used : files that pages are made of; what has the same name and another suffix, such as a receipt, belongs to them

    Returns
    -------
    The files that were removed.
    """
    names = {path.stem for path in used if path.parent == folder}
    unused = [
        path
        for path in sorted(folder.glob("*"))
        if path.is_file() and path.stem not in names and not path.name.startswith(".")
    ]
    for path in unused:
        path.unlink(missing_ok=True)
    return unused
