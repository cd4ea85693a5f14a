"""Names: what that of a file says, as students and learning systems name files, and folders' names for students."""

import hashlib
import re
import unicodedata
from collections.abc import Iterable
from dataclasses import dataclass
from urllib.parse import quote

PYTHON, NOTEBOOK = ".py", ".ipynb"

LONGEST_NAME = 150
"""Bytes of a student's name, quoted; file systems take 255."""

NOT_CERTAIN = "not_protected_"
"""Before the names of tables for learning systems in which a grade may be forged. Canvas makes an assignment of every
column that it doesn't know, Moodle refuses such a table or asks for a meaning, and any line is a student's: so only the
name can say it."""

_COPY = re.compile(r"(?:\s*\(\d{1,3}\)|[-_\s]+\d{1,2}|[-_\s]+(?:copy|kopie|copie|copia))+$", re.I)
_SEPARATORS = "-_. \t"
_PLAIN = " -_@+,()'."
_DEVICES = {
    *("con", "prn", "aux", "nul"),
    *(f"{p}{n}" for p in ("com", "lpt") for n in range(1, 10)),
}
_OUTPUTS = (
    *("grades.csv", "canvas.csv", "moodle.csv", "class.html"),
    *("lecture.html", "references_", "instructor", NOT_CERTAIN),
)


@dataclass(frozen=True)
class NamedFile:
    """The meaning of a file's name.

    Attributes
    ----------
    module : which it is; empty if the name doesn't tell
    owner : the rest of the name; empty if there is none
    exact : whether it is the module's own name
    suffix : PYTHON, NOTEBOOK, or empty for any other file
    """

    module: str
    owner: str
    exact: bool
    suffix: str


def read_name(name: str, modules: Iterable[str]) -> NamedFile:
    """Which module a file is by its name: thin_lens.py, Thin_Lens.py, thin_lens (1).py, alice-thin-lens-2.py."""
    stem, suffix = _split(name)
    if not suffix:
        return NamedFile("", stem, False, "")
    plain = _COPY.sub("", stem)
    folded = _folded(plain)
    # The longest first: importance_sampling is no submission of sampling.
    for module in sorted(modules, key=len, reverse=True):
        if folded == module or folded.replace("_", "") == module.replace("_", ""):
            return NamedFile(module, "", name == f"{module}{PYTHON}", suffix)
        if folded.endswith(f"_{module}"):
            return NamedFile(module, plain[: -len(module)].rstrip(_SEPARATORS), False, suffix)
        if folded.startswith(f"{module}_"):
            return NamedFile(module, plain[len(module) :].lstrip(_SEPARATORS), False, suffix)
    return NamedFile("", stem, False, suffix)


def _split(name: str) -> tuple[str, str]:
    lower = name.lower()
    # Some systems add .txt to what they take for dangerous.
    for ending, suffix in ((".py.txt", PYTHON), (PYTHON, PYTHON), (NOTEBOOK, NOTEBOOK)):
        if lower.endswith(ending) and len(name) > len(ending):
            return name[: -len(ending)], suffix
    return name, ""


def _folded(stem: str) -> str:
    # One sign for one, so that places in the folded name are places in the name.
    return re.sub(r"[-\s.]", "_", stem.lower())


def same_name(name: str) -> str:
    """The same text for two names that a file system may take for one: they differ in case or in accents' spelling."""
    return unicodedata.normalize("NFC", name).casefold()


def safe_name(name: str) -> str:
    """A name that is safe as the name of a folder, different for different names.

    Letters, digits, spaces and some signs stay; all else becomes %XX, as it does in addresses of the web.
    """
    safe = "".join(
        sign if sign.isalnum() or sign in _PLAIN else quote(sign, safe="", errors="surrogateescape")
        for sign in name
    )
    start = safe[:1]
    stem = safe.partition(".")[0].rstrip().casefold()
    if start in ("", ".", " ", "-") or stem in _DEVICES or safe.casefold().startswith(_OUTPUTS):
        safe = "".join(f"%{byte:02X}" for byte in start.encode()) + safe[1:] or "%00"
    if safe[-1:] in (".", " "):
        safe = f"{safe[:-1]}%{ord(safe[-1]):02X}"
    return safe


def short_name(safe: str) -> str:
    """A safe name itself, or its beginning and a number made from all of it where it is too long for a folder."""
    if len(safe.encode()) <= LONGEST_NAME:
        return safe
    number = hashlib.sha256(safe.encode()).hexdigest()[:8]
    start = safe.encode()[: LONGEST_NAME - 10].decode("utf-8", "ignore")
    return f"{start.rstrip(' .%')}~{number}"
