"""Names of students that are safe as the names of their folders, and no two the same."""

from __future__ import annotations

import hashlib
import unicodedata
from urllib.parse import quote

LONGEST_NAME = 150
"""Bytes of a student's name, quoted; file systems take 255."""

_PLAIN = " -_@+,()'."
_DEVICES = {
    "con",
    "prn",
    "aux",
    "nul",
    *(f"{port}{n}" for port in ("com", "lpt") for n in "123456789"),
}
_OUTPUTS = (
    "grades.csv",
    "canvas.csv",
    "moodle.csv",
    "class.html",
    "references_",
    "instructor",
)


def same_name(name: str) -> str:
    """What two names share that some file system takes for the same: they differ in case or in accents' spelling."""
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
