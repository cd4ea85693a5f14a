"""What the site has beyond its Markdown pages, as one Sphinx extension.

A page asks for a generated part by a comment on a line of its own, ``<!-- site: NAME ARGUMENTS -->``, so that the page
is right as a file of the repository too; see ``sitebuild.parts``.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from sphinx.application import Sphinx


def setup(app: Sphinx) -> dict[str, Any]:
    """Connect the parts to Sphinx's events."""
    # Here, for whoever only draws figures needs no Sphinx.
    from sitebuild import captions, docstrings, mathematics, numbers, page_heads, parts

    captions.connect(app)
    docstrings.connect(app)
    mathematics.connect(app)
    numbers.connect(app)
    page_heads.connect(app)
    parts.connect(app)
    return {"version": "1", "parallel_read_safe": False, "parallel_write_safe": True}
