"""The functions that students write, from the docstrings of their stubs."""

from course.engine.functions.modules import COURSE
from sitebuild.place import Place


def functions(place: Place, name: str = "", words: str = "") -> str:  # noqa: ARG001
    """Return the reference of all of them as Markdown."""
    parts = []
    for module, names in COURSE.items():
        parts += [f"## {module}", "", f"[The page of the module](../modules/{module}.md)", ""]
        parts += ["```{eval-rst}"]
        parts += [f".. autofunction:: assignments.{module}.{each}\n" for each in names]
        parts += ["```", ""]
    return "\n".join(parts)
