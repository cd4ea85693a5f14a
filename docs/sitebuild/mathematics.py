"""Formulas as MathML, made from LaTeX when the site is built."""

import re

from docutils import nodes
from latex2mathml.converter import convert
from sphinx.application import Sphinx

PUNCTUATION = re.compile(r"[.,;:?!)]+")

FUNCTION = r"\\(?:cos|sin|tan|arctan|log|ln|exp)(?![a-zA-Z])"


def connect(app: Sphinx) -> None:
    """Offer the renderer `mathml` for `html_math_renderer`."""
    app.add_html_math_renderer("mathml", (_inline, None), (_display, None))
    app.connect("doctree-resolved", lambda *event: join_punctuation(event[1]))


def mathml(formula: str, display: str = "inline") -> str:
    """Convert a formula; an upright d stays upright, and functions stand apart from their neighbours."""
    formula = re.sub(r"\\mathrm\{(\w)\}", r"\\text{\1}", formula)
    formula = re.sub(rf"(?<=[\w}})])\s*({FUNCTION})", r"\\,\1", formula)
    formula = re.sub(rf"({FUNCTION})\s*(?=[\\\w])", r"\1\\,", formula)
    return convert(formula, display=display)


def join_punctuation(doctree: nodes.Node) -> None:
    """Hand formulas the punctuation that follows them, because browsers would let a line begin with it."""
    for node in list(doctree.findall(nodes.math)):
        after = node.next_node(descend=False, siblings=True)
        if isinstance(after, nodes.Text) and (found := PUNCTUATION.match(after)):
            node["after"] = found.group()
            after.parent.replace(after, nodes.Text(after[found.end() :]))


def _inline(translator: nodes.NodeVisitor, node: nodes.math) -> None:
    formula = mathml(node.astext())
    if after := node.get("after"):
        formula = f'<span class="joined">{formula}{after}</span>'
    translator.body.append(formula)  # type: ignore[attr-defined]
    raise nodes.SkipNode


def _display(translator: nodes.NodeVisitor, node: nodes.math_block) -> None:
    # Wide formulas scroll by themselves; the keyboard reaches them too.
    formula = mathml(node.astext(), "block")
    box = f'<div class="formula" tabindex="0" role="group" aria-label="formula">{formula}</div>\n'
    translator.body.append(box)  # type: ignore[attr-defined]
    raise nodes.SkipNode
