"""Pages of the site as plain Markdown: words stand where the site has figures, and for what Sphinx looks up."""

import re
from collections.abc import Iterator, Mapping
from importlib import import_module
from inspect import Signature, cleandoc, getdoc, isclass, isfunction, signature
from typing import Any

KINDS = {
    "convergence": "a plot of error against samples",
    "diagram": "a diagram",
    "heat_map": "a heat map",
    "homage": "a picture without and with it, under a slider",
    "live": "a view with sliders",
    "mistakes": "pictures of these mistakes",
    "pattern_explorer": "a pattern to try",
    "rays": "the rays of one pixel, in 3D",
    "series": "a series of pictures, with a slider",
    "shot": "a picture",
    "walk": "a ray's way through the hierarchy",
}
"""Kind of a part of the site -> what a reader would see there; others are figures."""

_DIRECTIVES = re.compile(r"^```\{eval-rst\}\n(.*?)^```$", re.MULTILINE | re.DOTALL)
_PART = re.compile(r"^<!-- site: (\w+) ?([\w./]*) ?(.*?) ?-->$", re.MULTILINE)


def plain_pages(contents: Mapping[str, bytes]) -> dict[str, bytes]:
    """The same files; in pages, which end in .md, what stands for a part of the site tells of it.

    Where a command makes the same of a scene that is among the files, or of a notebook, that is told instead.
    """

    def told(part: re.Match[str]) -> str:
        kind, name, words = part.groups()
        scene = f"scenes/{name}.yaml"
        what, command = _MADE_BY.get(kind, ("", ""))
        if what and (scene in contents or f"docs/notebooks/{name}.ipynb" in contents):
            return f"*[{what}: `{command.format(scene=scene, words=words, name=name)}`]*"
        return f"*[On the course's site (`course docs`): {KINDS.get(kind, 'a figure')}.]*"

    def plain(page: str) -> str:
        return _DIRECTIVES.sub(
            lambda found: "\n\n".join(_described(found[1])), _PART.sub(told, page)
        )

    return {
        name: plain(content.decode()).encode() if name.endswith(".md") else content
        for name, content in contents.items()
    }


def _described(directives: str) -> Iterator[str]:
    """What directives name: signature, or attributes and methods, and the docstring."""
    for name in re.findall(r"^\.\. auto\w+:: ([\w.]+)$", directives, re.MULTILINE):
        module, _, own = name.rpartition(".")
        yield from _of(getattr(import_module(module), own), own)


def _of(thing: Any, name: str) -> Iterator[str]:
    given = _parameters(thing) if isfunction(thing) else ""
    yield f"```text\n{name}{given}\n\n{cleandoc(getdoc(thing) or '')}\n```"
    for each, member in vars(thing).items() if isclass(thing) else ():
        if not each.startswith("_") and (isfunction(member) or isinstance(member, property)):
            yield from _of(member, f"{name}.{each}")


def _parameters(function: Any) -> str:
    """Names and defaults; what they are is in the docstring."""
    known = [one for name, one in signature(function).parameters.items() if name != "self"]
    told = [one for one in known if one.default is one.empty or not callable(one.default)]
    return str(Signature([one.replace(annotation=one.empty) for one in told]))


_MADE_BY = {
    "rays": ("The rays of one pixel, in 3D", "course pixel {scene} {words} --html rays.html"),
    "notebook": (
        "The notebook with its outputs on the course's site",
        "jupyter lab docs/notebooks/{name}.ipynb",
    ),
    "before_after": ("A picture of it", "course render {scene} -o after.png"),
    "picture": ("A picture", "course render {scene}"),
    "shot": ("A picture", "course render {scene}"),
}
"""Kind of a part -> what it shows, and the command that makes it."""
