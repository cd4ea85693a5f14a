"""With what a class was graded, for whoever grades it again."""

from __future__ import annotations

from pathlib import Path

import msgspec

from course.atomic import write_text
from course.errors import CourseError
from course.grading.classes.finishing import Terms
from course.grading.classes.keeping import INSTRUCTOR


class Settings(msgspec.Struct, frozen=True):
    """As the options of `course grade` say it; paths are absolute."""

    seed: int
    modules: tuple[str, ...]
    policy: str = ""
    roster: str = ""
    title: str = Terms.title
    submission_seconds: float | None = None

    @property
    def terms(self) -> Terms:
        """What makes grades of points."""
        return Terms(
            Path(self.policy) if self.policy else None,
            Path(self.roster) if self.roster else None,
            self.title,
        )


def settings_of(
    seed: int, modules: tuple[str, ...], terms: Terms, submission_seconds: float | None = None
) -> Settings:
    """The settings of a run."""
    policy, roster = (str(path.resolve()) if path else "" for path in (terms.policy, terms.roster))
    return Settings(seed, modules, policy, roster, terms.title, submission_seconds)


def write_settings(settings: Settings, out: Path) -> None:
    """Keep the settings with what was graded by them."""
    write_text(_path(out), msgspec.json.format(msgspec.json.encode(settings).decode()) + "\n")


def read_settings(out: Path, submission_seconds: float | None = None) -> Settings:
    """The settings of what was graded into a folder.

    Parameters
    ----------
    submission_seconds : in the place of those before; None to keep them

    Raises
    ------
    CourseError
        Nothing was graded into it.
    """
    try:
        settings = msgspec.json.decode(_path(out).read_bytes(), type=Settings)
    except (OSError, msgspec.DecodeError):
        raise CourseError(
            f"{out}: holds no class that was graded; `course grade SUBMISSIONS --out {out}` does that"
        ) from None
    seconds = submission_seconds or settings.submission_seconds
    return msgspec.structs.replace(settings, submission_seconds=seconds)


def _path(out: Path) -> Path:
    return out / INSTRUCTOR / "settings.json"
