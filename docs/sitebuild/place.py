"""Where on the site a generated part stands, and the files that it brings."""

import shutil
from dataclasses import dataclass, field
from pathlib import Path

from course.base.atomic import replacing


@dataclass(frozen=True)
class Place:
    """A page that is being expanded.

    Attributes
    ----------
    up : from the page's folder to the site's, "" or "../"
    blank : whether the build must not wait for pictures, and shows grey ones
    made : folder of what this build makes and nobody keeps
    files : of the whole site, from address to the file that is copied there
    kept : files from which pages are made and which aren't copied, such as a notebook that was run
    site : where an earlier build's pages are, whose grey pictures give way to those that are made; None for nowhere
    """

    up: str
    blank: bool
    made: Path
    files: dict[str, Path]
    kept: set[Path] = field(default_factory=set)
    site: Path | None = None

    def address(self, target: str, file: Path) -> str:
        """Have the file copied to ``target``, as the site sees it; return its address, as the page sees it."""
        self.files[target] = file
        if self.site is not None and (self.site / target).is_file():
            with replacing(self.site / target) as temporary:
                shutil.copyfile(file, temporary)
        return f"{self.up}{target}"
