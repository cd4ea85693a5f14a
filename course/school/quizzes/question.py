"""A question with its pictures, ready for a page or a learning platform."""

from dataclasses import dataclass

LETTERS = "ABCDE"


@dataclass(frozen=True)
class ShownPicture:
    """A picture of a question.

    Attributes
    ----------
    title : stands under it
    alt : says it to those who don't see it, and doesn't tell the answer
    png : the file
    """

    title: str
    alt: str
    png: bytes


@dataclass(frozen=True)
class Choice:
    """An answer to choose, and what is said to whoever chooses it."""

    text: str
    told: str


@dataclass(frozen=True)
class Question:
    """One question with one right answer. In texts, what stands between backticks is code.

    Attributes
    ----------
    name : unique, of letters, digits and -
    module, function : that it is about
    asks : paragraphs above the pictures
    shown : pictures
    choices : in their order, which is not to be changed where they are letters of pictures
    answer : number of the right choice, from 0
    explained : said with the right answer
    """

    name: str
    module: str
    function: str
    asks: tuple[str, ...]
    shown: tuple[ShownPicture, ...]
    choices: tuple[Choice, ...]
    answer: int
    explained: str

    @property
    def title(self) -> str:
        """For lists of questions; it tells no answer."""
        return f"{self.module}.{self.function}, question {int(self.name.rpartition('-')[2])}"
