"""With what a class is graded, kept for whoever grades it again."""

from pathlib import Path

import msgspec

from course.base.atomic import write_text
from course.base.errors import CourseError
from course.school.grading.classes.policy import Rules, read_policy
from course.school.grading.classes.roster import Roster, read_roster
from course.school.grading.worker.limits import Limits

INSTRUCTOR = "instructor"
"""Folder beside those of the students for what they are not to see."""


class GradingSettings(msgspec.Struct, frozen=True):
    """As the options of `course grade` say it.

    Attributes
    ----------
    seed, modules : what to check
    policy, roster : paths of the files that make grades of points, if there are any
    title : of the assignment, as a learning system knows it
    submission_seconds : that all checks of one submission may take; None for no limit
    """

    seed: int
    modules: tuple[str, ...]
    policy: str = ""
    roster: str = ""
    title: str = "Penumbra"
    submission_seconds: float | None = None

    def read(self) -> tuple[Rules | None, Roster | None]:
        """Policy and roster; raises ``CourseError`` where one can't be read or is wrong."""
        return (
            read_policy(Path(self.policy), self.modules) if self.policy else None,
            read_roster(Path(self.roster)) if self.roster else None,
        )

    def instead(
        self, policy: Path | None, roster: Path | None, title: str | None
    ) -> "GradingSettings":
        """The same with another policy, roster or title, where one is given."""
        return msgspec.structs.replace(
            self,
            policy=str(policy or self.policy),
            roster=str(roster or self.roster),
            title=title or self.title,
        )

    @property
    def limits(self) -> Limits:
        """Limits of the code of one submission."""
        return Limits(submission_seconds=self.submission_seconds)

    def write(self, out: Path) -> None:
        """Keep the settings with what was graded by them; its files by their absolute paths."""
        files = {
            name: str(Path(file).resolve())
            for name, file in (("policy", self.policy), ("roster", self.roster))
            if file
        }
        text = msgspec.json.encode(msgspec.structs.replace(self, **files)).decode()
        write_text(_path(out), msgspec.json.format(text) + "\n")


def read_settings(out: Path, submission_seconds: float | None = None) -> GradingSettings:
    """The settings of what was graded into a folder.

    Raises CourseError: nothing was graded into it.
    ``submission_seconds``: in the place of those before; None to keep them
    """
    try:
        settings = msgspec.json.decode(_path(out).read_bytes(), type=GradingSettings)
    except (OSError, msgspec.DecodeError):
        raise CourseError(
            f"{out}: holds no class that was graded; `course grade SUBMISSIONS --out {out}` does that"
        ) from None
    seconds = submission_seconds or settings.submission_seconds
    return msgspec.structs.replace(settings, submission_seconds=seconds)


def _path(out: Path) -> Path:
    return out / INSTRUCTOR / "settings.json"
