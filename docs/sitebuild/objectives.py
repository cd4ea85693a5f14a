"""What a module teaches, at the top of its page; and of all modules, for those who teach.

``<!-- site: objectives MODULE -->`` stands on the page of a module unasked, and above it its task.
``<!-- site: objectives -->`` lists all.
"""

from collections.abc import Iterator

from course.base.errors import CourseError
from course.engine.functions.modules import COURSE
from sitebuild.place import Place
from sitebuild.teaching_file import Module, minutes, teaching


def objectives(place: Place, name: str, words: str = "") -> str:  # noqa: ARG001
    """Return what one module teaches as Markdown, or what all do.

    Raises
    ------
    CourseError
        There is no such module, or docs/teaching.yaml isn't as it should be.
    """
    known = teaching().modules
    if not name:
        return "\n".join(line for each in known.items() for line in _for_teachers(*each))
    if name not in known:
        raise CourseError(f"no module {name} in docs/teaching.yaml; it has {', '.join(known)}")
    return "\n".join(_for_readers(name, known[name]))


def task(place: Place, name: str, words: str = "") -> str:  # noqa: ARG001
    """What is to be written, and what checks it, in a line."""
    written = ", ".join(f"[{function}](#{function})" for function in COURSE[name])
    return f"**To write** in `assignments/{name}`: {written}. **To check:** `course check {name}`\n"


def title(module: str) -> str:
    """A module's name in words."""
    return module.replace("_", " ").replace("monte carlo", "Monte Carlo")


def _for_readers(name: str, module: Module) -> Iterator[str]:
    """At the top of the page: each objective with the functions that it is about, and the time."""
    yield "```{admonition} What you can do afterwards\n:class: objectives\n"
    for each in module.objectives:
        about = ", ".join(f"[{function}](#{function})" for function in each.functions)
        yield f"- {each.can[0].upper()}{each.can[1:]}: {about}."
    yield ""
    reading, writing, rendering = minutes(name)
    yield (
        f"{reading} minutes to read, about {writing} to write (an estimate), {rendering} to render."
        f"{_needs(module, '')} You should know: {'; '.join(module.knows)}."
    )
    yield "```\n"


def _for_teachers(name: str, module: Module) -> Iterator[str]:
    """On the page for those who teach: each objective with the checks that show it."""
    yield f"### {title(name)[0].upper()}{title(name)[1:]}\n"
    yield f"[The page of the module](../modules/{name}.md).{_needs(module, '../modules/')}\n"
    yield "| objective | shown by |"
    yield "| --- | --- |"
    for each in module.objectives:
        checks = ", ".join(f"`{check}`" for check in each.shown_by)
        yield f"| {each.can[0].upper()}{each.can[1:]}. | {checks} |"
    yield ""


def _needs(module: Module, folder: str) -> str:
    if not module.needs:
        return ""
    links = " and ".join(f"[{title(each)}]({folder}{each}.md)" for each in module.needs)
    return f" Builds on {links}."
