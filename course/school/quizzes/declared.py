"""Questions as ``solutions/quizzes/MODULE.yaml`` declares them: by the names of known wrong submissions.

Texts and pictures are made from the submissions. A student's copy has neither.
"""

from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Literal

import msgspec

from course.base.errors import CourseError
from course.engine.functions.effects import PROJECT
from course.school.grading.known import KnownSubmission, known

RIGHT = "right"
"""Among the answers: the right function."""

Name = Annotated[str, msgspec.Meta(min_length=1)]


class Declared(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """One question.

    Attributes
    ----------
    ask : "which" mistake made a picture; "predict" a mistake's picture; which mistake is "unseen" in the picture
    function : of the module
    mistake : the wrong submission that is the answer
    among : the other answers, wrong submissions of the same function; "right" where pictures are to choose from
    look : number of the way in which the function is looked at; the one of the module's page if not given
    why : why the mistake can't be seen, where it is "unseen"
    held_back : whether the module's page leaves it out, so that its answer is in no public place
    """

    ask: Literal["which", "predict", "unseen"]
    function: Name
    mistake: Name
    among: Annotated[tuple[Name, ...], msgspec.Meta(min_length=2, max_length=4)]
    look: int | None = None
    why: str = ""
    held_back: bool = False


@dataclass(frozen=True)
class Asked:
    """A declared question with its name, and the submissions that it is about.

    Attributes
    ----------
    name : "MODULE-NUMBER"; the same as long as no question is put before it
    wrong : by name, all submissions that it names
    says : by name, what a student is told who makes that mistake
    """

    module: str
    name: str
    declared: Declared
    wrong: dict[str, KnownSubmission]
    says: dict[str, str]

    @property
    def path(self) -> str:
        """MODULE.FUNCTION."""
        return f"{self.module}.{self.declared.function}"


def asked(module: str, folder: Path = PROJECT / "solutions") -> list[Asked]:
    """The questions of a module; none where nobody has declared any.

    Raises CourseError: the file of them can't be read, is not as it should be, or names a submission that isn't there.
    """
    path = folder / "quizzes" / f"{module}.yaml"
    if not path.is_file():
        return []
    try:
        listed = msgspec.yaml.decode(path.read_bytes(), type=list[Declared])
    except OSError as error:
        raise CourseError(f"{path}: questions can't be read: {error.strerror}") from error
    except msgspec.MsgspecError as error:
        raise CourseError(f"{path}: {error}") from error
    wrong = {one.name: one for one in known(module, folder) if not one.right}
    says = {one.mistake: one.says for one in wrong.values() if one.says}
    found = []
    for number, each in enumerate(listed, start=1):
        where = f"{path}: question {number}"
        names = [each.mistake, *(name for name in each.among if name != RIGHT)]
        for name in names:
            if name not in wrong or wrong[name].function != each.function:
                raise CourseError(f"{where}: {each.function} has no wrong submission {name}")
        if len({each.mistake, *each.among}) <= len(each.among):
            raise CourseError(f"{where}: an answer is there twice")
        if (each.ask == "unseen") != bool(each.why):
            raise CourseError(f"{where}: `why` is for a mistake that is unseen, and only for it")
        if RIGHT in each.among and each.ask != "predict":
            raise CourseError(f"{where}: only a picture to be predicted may be the right one")
        chosen = {name: wrong[name] for name in names}
        told = {name: says.get(one.mistake, "") for name, one in chosen.items()}
        found.append(Asked(module, f"{module}-{number:02}", each, chosen, told))
    return found
