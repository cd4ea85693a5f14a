"""What each module teaches and the plans of a course, as docs/teaching.yaml says them."""

import re
from functools import lru_cache
from math import ceil
from pathlib import Path
from typing import Annotated

import msgspec

from course.base.errors import CourseError

DOCS = Path(__file__).parents[1]
FILE = DOCS / "teaching.yaml"

WORDS_PER_MINUTE = 119
"""Half the rate at which adults read non-fiction in silence, 238 words a minute: M. Brysbaert, "How many words do we
read per minute?", Journal of Memory and Language, 2019. That formulas and figures double the time is an assumption."""

Count = Annotated[int, msgspec.Meta(ge=1)]
Text = Annotated[str, msgspec.Meta(min_length=1)]


class Objective(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """What somebody can who has passed some checks.

    Attributes
    ----------
    can : begins with a verb
    shown_by : the checks, "function/check"
    """

    can: Text
    shown_by: Annotated[tuple[Text, ...], msgspec.Meta(min_length=1)]

    @property
    def functions(self) -> tuple[str, ...]:
        """Functions whose checks show it, once each."""
        return tuple(dict.fromkeys(check.partition("/")[0] for check in self.shown_by))


class Module(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """What one module teaches; see docs/teaching.yaml."""

    write: Text
    lacks: str = ""
    writing: Count
    rendering: Count
    needs: tuple[str, ...]
    knows: Annotated[tuple[Text, ...], msgspec.Meta(min_length=1)]
    objectives: Annotated[tuple[Objective, ...], msgspec.Meta(min_length=1)]


class Week(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """One week of a plan: its modules, and what else is done."""

    modules: Annotated[tuple[str, ...], msgspec.Meta(min_length=1)]
    also: Text


class Teaching(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """The whole file."""

    modules: dict[str, Module]
    plans: dict[str, tuple[Week, ...]]


def teaching() -> Teaching:
    """Read the file.

    Raises
    ------
    CourseError
        It is not as it should be.
    """
    return _read(FILE.read_text(encoding="utf-8"))


@lru_cache(maxsize=4)
def _read(text: str) -> Teaching:
    try:
        return msgspec.yaml.decode(text, type=Teaching)
    except msgspec.MsgspecError as error:
        raise CourseError(f"{FILE.name}: {error}") from error


def reading_minutes(page: str) -> int:
    """Minutes to read a page of Markdown, rounded up to five; see `WORDS_PER_MINUTE`.

    Code isn't counted; a formula counts as a word.
    """
    page = re.sub(r"^```.*?^```$|<!--.*?-->", "", page, flags=re.DOTALL | re.MULTILINE)
    page = re.sub(r"^ {4}.*$", "", page, flags=re.MULTILINE)
    page = re.sub(r"\$\$.+?\$\$|\$.+?\$", " formula ", page, flags=re.DOTALL)
    page = re.sub(r"\]\([^)]*\)", "]", page)
    return 5 * ceil(len(re.findall(r"\w[\w'-]*", page)) / WORDS_PER_MINUTE / 5)


def minutes(name: str) -> tuple[int, int, int]:
    """Minutes to read a module's page, to write its functions, and to render the pictures at its top."""
    module = teaching().modules[name]
    page = (DOCS / "modules" / f"{name}.md").read_text(encoding="utf-8")
    return reading_minutes(page), module.writing, ceil(module.rendering / 60)
