"""How Sphinx builds the site: `make docs`."""

import gc
import sys
from os import environ
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent))
sys.path.insert(0, str(Path(__file__).parents[1]))

from course import __version__

# Documents are trees that stay to the end. To look through them again and again for garbage takes a tenth of a build.
gc.set_threshold(200_000, 20, 20)

project = "Penumbra"
author = "The Penumbra authors"
copyright = author  # noqa: A001
version = release = __version__

extensions = ["myst_parser", "sphinx.ext.autodoc", "sitebuild"]
exclude_patterns = ["_build", "sitebuild", "_static", "_templates"]

# Headings are linked as in the repository, by the slugs that hosts of Markdown files make of them.
myst_enable_extensions = ["deflist", "dollarmath"]
myst_heading_anchors = 4

# Formulas are MathML: no script, no font to load, read aloud by screen readers.
html_math_renderer = "mathml"

smartquotes = False
autodoc_member_order = "bysource"
python_use_unqualified_type_names = True

html_theme = "furo"
html_title = "Penumbra"
# Where the site will be, for canonical links, previews and sitemap.xml; empty if nobody knows.
html_baseurl = environ.get("SITE_ADDRESS", "")
html_static_path = ["_static"]
html_favicon = "_static/favicon.svg"
templates_path = ["_templates"]
html_additional_pages = {"404": "404.html"}
html_css_files = [
    "site.css",
    "key_pictures.css",
    "diagrams.css",
    "plots.css",
    "series.css",
    "picture_grid.css",
    "pattern_explorer.css",
    "mistakes.css",
    "slides.css",
    "live.css",
    "quiz.css",
    "cards.css",
    ("print.css", {"media": "print"}),
]
html_js_files = [
    ("before_after.js", {"defer": "defer"}),
    ("scrollers.js", {"defer": "defer"}),
    ("folded.js", {"defer": "defer"}),
    ("search_words.js", {"defer": "defer"}),
    ("plot_values.js", {"defer": "defer"}),
    ("series.js", {"defer": "defer"}),
    ("patterns.js", {"defer": "defer"}),
    ("pattern_explorer.js", {"defer": "defer"}),
    ("printing.js", {"defer": "defer"}),
    ("mistakes.js", {"defer": "defer"}),
    ("live.js", {"defer": "defer"}),
    ("drag_models.js", {"defer": "defer"}),
    ("drag.js", {"defer": "defer"}),
    ("slides.js", {"defer": "defer"}),
]
html_search_scorer = str(Path(__file__).parent / "sitebuild" / "search_scorer.js")
html_copy_source = False
html_show_sphinx = False
html_last_updated_fmt = None
html_theme_options = {
    "light_css_variables": {
        "color-brand-primary": "#7a4d0c",
        "color-brand-content": "#7a4d0c",
        "color-brand-visited": "#6b4a86",
    },
    "dark_css_variables": {
        "color-brand-primary": "#e8b866",
        "color-brand-content": "#e8b866",
        "color-brand-visited": "#c3a5dc",
    },
}

# "render" draws every picture with this engine and keeps it; "blank" puts grey in their places.
pictures = "render"
