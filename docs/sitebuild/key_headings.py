"""The headings under which the reference of scene files has the definitions of the schema."""

import re


def heading(name: str) -> str:
    """Return the heading under which a definition stands: LensDescription is "Lens"."""
    first, *others = re.findall(r"[A-Z][a-z]*", name.removesuffix("Description"))
    return " ".join([first, *(word.lower() for word in others)])


def link(name: str) -> str:
    """Return a link of Markdown to the heading of a definition, in the same page."""
    title = heading(name)
    return f"[{title}](#{title.lower().replace(' ', '-')})"
