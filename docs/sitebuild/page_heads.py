"""What a page tells of itself to search engines and to programs that show previews of links, and the map of the site.

Addresses of other pages have to be whole there, with a host. So the canonical link and the picture of a preview (both
of them), and ``sitemap.xml``, are made only where ``html_baseurl`` is set.
"""

import re
from html import escape, unescape
from pathlib import Path
from typing import Any
from urllib.parse import urljoin

from docutils import nodes
from sphinx.application import Sphinx

LONGEST = 200
"""Characters of a description; who shows it cuts it off soon after."""

PICTURE = re.compile(r'src="([^"]*_pictures/(?!before)[^"]+)"')


def connect(app: Sphinx) -> None:
    """Put the lines into each page's head, and write the map when all pages are there."""
    app.connect("html-page-context", _tell)
    app.connect("build-finished", _map)


def description(doctree: nodes.Node) -> str:
    """Return as many whole sentences of a page's first paragraph as are short enough."""
    first = next(doctree.findall(_is_text), None)
    text = " ".join(first.astext().split()) if first else ""
    if len(text) <= LONGEST:
        return text
    whole = text[: LONGEST + 1].rpartition(". ")[0]
    return f"{whole}." if whole else f"{text[: LONGEST - 3].rpartition(' ')[0]} ..."


def _is_text(node: nodes.Node) -> bool:
    return isinstance(node, nodes.paragraph) and isinstance(node.parent, nodes.section)


def tags(title: str, about: str, address: str | None, picture: str | None) -> str:
    """Return the lines of a head.

    Parameters
    ----------
    title : of the page
    about : its description; may be empty
    address, picture : of the page and of a picture on it, with their host; None where no host is known
    """
    told = {"og:title": title, "og:type": "article", "og:site_name": "Penumbra"}
    if about:
        told["og:description"] = about
    if address:
        told["og:url"] = address
    if picture:
        told["og:image"] = picture
    lines = [f'<meta property="{name}" content="{escape(value)}">' for name, value in told.items()]
    if about:
        lines.insert(0, f'<meta name="description" content="{escape(about)}">')
    if picture:
        lines.append('<meta name="twitter:card" content="summary_large_image">')
    return "\n".join(lines) + "\n"


def _tell(*given: Any) -> None:
    """Take what Sphinx gives: itself, the page's name, its template, what the template is told, and the page."""
    app, _, _, context, doctree = given
    context["base"] = _base(app)
    if doctree is None:
        # The search, the index and the page for addresses that aren't there.
        context["pageurl"] = None
        return
    address = context.get("pageurl")
    found = PICTURE.search(context.get("body", ""))
    picture = urljoin(address, unescape(found[1])) if address and found else None
    title = re.sub(r"<[^>]+>", "", unescape(context.get("title", "")))
    context["metatags"] = context.get("metatags", "") + tags(
        title, description(doctree), address, picture
    )


def _base(app: Sphinx) -> str:
    """The site's address with a slash at its end, or ""."""
    base: str = app.config.html_baseurl
    return f"{base.rstrip('/')}/" if base else ""


def _map(app: Sphinx, error: Exception | None) -> None:
    base = _base(app)
    if error is not None or app.builder.name != "html" or not base:
        return
    addresses = (urljoin(base, app.builder.get_target_uri(page)) for page in app.env.found_docs)
    lines = "\n".join(f"  <url><loc>{escape(each)}</loc></url>" for each in sorted(addresses))
    text = (
        '<?xml version="1.0" encoding="UTF-8"?>\n'
        f'<urlset xmlns="http://www.sitemaps.org/schemas/sitemap/0.9">\n{lines}\n</urlset>\n'
    )
    (Path(app.outdir) / "sitemap.xml").write_text(text, encoding="utf-8")
