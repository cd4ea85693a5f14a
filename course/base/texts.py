"""Text that somebody else has written, made fit for every file and terminal."""

import re

LONGEST = 20_000
"""Characters of one text that is kept; a program can print without end."""

_ESCAPES = re.compile(r"\x1b\[[0-9;?]*[ -/]*[@-~]")
_UNFIT = re.compile(
    # What XML 1.0 doesn't allow (controls, lone surrogates, U+FFFE and U+FFFF) and the C1 controls ...
    "[^\t\n\x20-\x7e\xa0-\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]"
    # ... and what turns the direction of the text around it, so that it reads otherwise than it is.
    "|[\u061c\u200e\u200f\u202a-\u202e\u2066-\u2069]"
)
_REPLACEMENT = "\ufffd"


def clean(text: str, longest: int = LONGEST) -> str:
    """The text without terminal colours; what no file can hold is U+FFFD, the replacement character.

    The result encodes as UTF-8 and may stand in XML 1.0; it is not escaped for HTML, XML or a spreadsheet.
    ``longest``: from how many characters on the middle of the text is left out
    """
    over = len(text) - longest
    if over > 0:
        half = longest // 2
        text = f"{text[:half]}\n[{over} characters left out]\n{text[len(text) - half :]}"
    text = text.replace("\r\n", "\n").replace("\r", "\n")
    return _UNFIT.sub(_REPLACEMENT, _ESCAPES.sub("", text))


def clean_line(text: str) -> str:
    """The same in one line."""
    return " ".join(clean(text).split("\n"))


def count(number: int, noun: str) -> str:
    """Say how many: `count(1, "thread")` is "1 thread", `count(2, "thread")` "2 threads"."""
    return f"{number:,} {noun}" if number == 1 else f"{number:,} {noun}s"


def words(text: str) -> frozenset[str]:
    """The words of a list in our own sources."""
    return frozenset(text.split())
