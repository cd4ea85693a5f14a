"""The generated parts of pages, and when they are made anew.

A part is asked for by ``<!-- site: KIND NAME WORDS -->`` on a line of its own; `PARTS` has the kinds. Unasked, a
module's page begins with its task, the pair of its two scenes' pictures if it has two that differ, and its objectives;
what each function looks like when it is right stands before its common mistakes, which are folded, as formula and
sources are; and the quiz stands before "Exercises".
"""

import re
import shutil
from collections.abc import Callable, Iterable
from hashlib import sha256
from pathlib import Path

from sphinx.application import Sphinx
from sphinx.environment import BuildEnvironment
from sphinx.errors import ExtensionError

from course.base.errors import CourseError
from sitebuild import kept, pictures
from sitebuild.cards import cards, module_pages
from sitebuild.command_line import command_line
from sitebuild.convergence import convergence
from sitebuild.diagrams.part import diagram
from sitebuild.functions import functions
from sitebuild.glossary import directives, indexed
from sitebuild.heat_maps import INSTEAD, heat_map
from sitebuild.homage import homage
from sitebuild.live import live
from sitebuild.mistakes.part import mistakes, right
from sitebuild.notebook import notebook
from sitebuild.objectives import objectives, task
from sitebuild.other_shots import metu_shot, radiosity_shot
from sitebuild.pattern_explorer import pattern_explorer
from sitebuild.peer_times import peer_times
from sitebuild.place import Place
from sitebuild.plans import minutes_table, plan
from sitebuild.quiz.part import HEADING, has_questions, quiz
from sitebuild.radiosity_pictures import radiosity_flight, radiosity_steps
from sitebuild.radiosity_scrubber import radiosity_scrubber
from sitebuild.rays import rays
from sitebuild.scene_keys import scene_keys
from sitebuild.series import series
from sitebuild.series_grid import series_grid
from sitebuild.shots import before_after, picture, shot
from sitebuild.signatures import linked
from sitebuild.studio_film import studio_film
from sitebuild.walk import walk_steps

MARK = re.compile(r"^<!-- site: (\w+) ?([\w./]*) ?(.*?) ?-->$", re.MULTILINE)

_LISTS = re.compile(
    r"^Common mistakes:\n\n((?:- .*\n(?: {2}.*\n)*)+)\n<!-- site: mistakes (.*)-->\n", re.MULTILINE
)
_FOLDED = r"""<!-- site: right \2-->

<details class="deep"><summary>Common mistakes, with a picture of each</summary>

\1
<!-- site: mistakes \2-->

</details>
"""
"""A list of common mistakes tells nearly all that is to be found out: it is opened by who wants to know."""

_DEEP = re.compile(r"^## (The integral|Sources)\n\n(.*?)\n(?=^## |\Z)", re.MULTILINE | re.DOTALL)
_SUMMARIES = {
    "The integral": "The formula, and what its symbols mean",
    "Sources": "Books and papers",
}
"""What is folded below these headings, so that a page is read from its picture to its functions without them."""

Part = Callable[[Place, str, str], str]
"""Takes where the part stands, its name and the words after that; returns Markdown."""

PARTS: dict[str, Part] = {
    "before_after": before_after,
    "cards": cards,
    "command_line": command_line,
    "convergence": convergence,
    "diagram": diagram,
    "functions": functions,
    "heat_map": heat_map,
    "homage": homage,
    "live": live,
    "mistakes": mistakes,
    "metu_shot": metu_shot,
    "minutes": minutes_table,
    "module_pages": module_pages,
    "notebook": notebook,
    "objectives": objectives,
    "pattern_explorer": pattern_explorer,
    "peer_times": peer_times,
    "picture": picture,
    "plan": plan,
    "quiz": quiz,
    "radiosity_flight": radiosity_flight,
    "radiosity_scrubber": radiosity_scrubber,
    "radiosity_shot": radiosity_shot,
    "radiosity_steps": radiosity_steps,
    "rays": rays,
    "right": right,
    "scene_keys": scene_keys,
    "series": series,
    "series_grid": series_grid,
    "shot": shot,
    "studio_film": studio_film,
    "task": task,
    "walk": walk_steps,
}


def connect(app: Sphinx) -> None:
    """Expand the comments as pages are read, and hand the files over when all are written."""
    # Pages whose parts change with it are read again by what their parts are.
    app.add_config_value("pictures", "render", "", str)
    site = Site(app)
    app.connect("env-get-outdated", site.outdated)
    app.connect("source-read", site.expand_page)
    app.connect("build-finished", site.finish)


class Site:
    """One build.

    Parameters
    ----------
    app : Sphinx, not yet configured
    """

    def __init__(self, app: Sphinx) -> None:
        self.app = app
        self.files: dict[str, Path] = {}
        self.kept: set[Path] = set()
        self._expanded: dict[tuple[str, str], str] = {}

    def outdated(self, app: Sphinx, env: BuildEnvironment, *_: Iterable[str]) -> list[str]:
        """Name the pages whose generated parts are no longer what they were."""
        before: dict[str, str] = getattr(env, "site_parts", {})
        env.site_parts = {}  # type: ignore[attr-defined]
        changed = []
        for name in sorted(env.found_docs):
            source = Path(env.doc2path(name)).read_text(encoding="utf-8")
            text = self._expanded[name, source] = self.expanded(name, source)
            env.site_parts[name] = sha256(text.encode()).hexdigest()  # type: ignore[attr-defined]
            if before.get(name) not in (None, env.site_parts[name]):  # type: ignore[attr-defined]
                changed.append(name)
        return changed

    def expand_page(self, app: Sphinx, name: str, source: list[str]) -> None:
        """Replace the comments of a page that is about to be parsed."""
        source[0] = self._expanded.get((name, source[0])) or self.expanded(name, source[0])

    def finish(self, app: Sphinx, error: Exception | None) -> None:
        """Put the pictures, scenes and data beside the pages."""
        if error is not None or app.builder.name != "html":
            return
        for folder in {target.partition("/")[0] for target in self.files}:
            shutil.rmtree(Path(app.outdir) / folder, ignore_errors=True)
        for target, path in self.files.items():
            file = Path(app.outdir) / target
            file.parent.mkdir(parents=True, exist_ok=True)
            shutil.copyfile(path, file)
        if app.config.pictures != "blank" and kept.whole(Path(app.srcdir), app.env.found_docs):
            kept.forget([*self.files.values(), *self.kept])

    def expanded(self, page: str, text: str) -> str:
        """Return a page's Markdown with its generated parts."""
        blank = self.app.config.pictures == "blank"
        place = Place(
            up="../" * page.count("/"),
            blank=blank,
            made=Path(self.app.doctreedir) / "made",
            files=self.files,
            kept=self.kept,
            site=None if blank else Path(self.app.outdir),
        )
        return MARK.sub(lambda match: _part(match, place), with_marks(page, text))


def with_marks(page: str, text: str) -> str:
    """Return a page's Markdown with the comments in it that ask for parts, those that stand there unasked, too."""
    folder, _, module = page.rpartition("/")
    if folder == "modules":
        text = _DEEP.sub(_folded, linked(module, text))
    # Entries of the index stand before headings: what is folded ends above them.
    text = indexed(page, text)
    if folder == "modules":
        heading = f"\n<!-- site: task {module} -->\n"
        if module not in INSTEAD and pictures.scene_path(f"before/{module}").is_file():
            heading += f"\n<!-- site: before_after {module} -->\n"
        heading += f"\n<!-- site: objectives {module} -->\n\n## The phenomenon\n"
        text = _LISTS.sub(_FOLDED, text.replace("\n## The phenomenon\n", heading, 1))
        if has_questions(module):
            asked = f"\n## {HEADING}\n\n<!-- site: quiz {module} -->\n\n## Exercises\n"
            text = text.replace("\n## Exercises\n", asked, 1)
    return directives(text) if page == "glossary" else text


def _folded(match: re.Match[str]) -> str:
    heading, text = match.groups()
    summary = f'<details class="deep"><summary>{_SUMMARIES[heading]}</summary>'
    return f"## {heading}\n\n{summary}\n\n{text}\n\n</details>\n\n"


def _part(match: re.Match[str], place: Place) -> str:
    kind, name, words = match.groups()
    if kind not in PARTS:
        raise ExtensionError(f"{match.group()}: no such part; there are {', '.join(PARTS)}")
    try:
        return PARTS[kind](place, name, words)
    except CourseError as error:
        raise ExtensionError(f"{match.group()}: {error}") from error
