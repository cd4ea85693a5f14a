"""What pages tell of themselves, whether or not the site has an address; and pages on paper."""

import html
import re
import shutil
import subprocess
import sys
from pathlib import Path
from typing import Any
from xml.etree import ElementTree as ET

import pytest

from course import __version__
from course.engine.functions.effects import PROJECT

pytest.importorskip("furo", reason='the site needs: pip install -e ".[docs]"')
pytest.importorskip("myst_parser", reason='the site needs: pip install -e ".[docs]"')

from docutils.core import publish_doctree
from sitebuild.page_heads import LONGEST, description, tags

DOCS = PROJECT / "docs"

PAGES = {
    "index.md": '# Home\n\nAll *modules* are "here" & there.\n\n```{toctree}\ncite\nmodules/soft_shadows\n```\n',
    "cite.md": "# Cite\n\nHow it is cited.\n",
}


def _built(folder: Path, address: str) -> Path:
    """Three pages, with the configuration of the site."""
    (folder / "source" / "modules").mkdir(parents=True)
    for name, text in PAGES.items():
        (folder / "source" / name).write_text(text, encoding="utf-8")
    shutil.copy(DOCS / "modules" / "soft_shadows.md", folder / "source" / "modules")
    options = ["-D", "pictures=blank", "-D", f"html_baseurl={address}", "-c", str(DOCS)]
    trees = ["-d", str(folder / "trees"), str(folder / "source"), str(folder / "out")]
    command = [sys.executable, "-m", "sphinx", "-Q", "-b", "html", *options, *trees]
    subprocess.run(command, check=True, timeout=280)
    return folder / "out"


@pytest.fixture(scope="module")
def somewhere(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A site that knows where it will be; the slash at the end was forgotten."""
    return _built(tmp_path_factory.mktemp("somewhere"), "https://course.example.org/rays")


@pytest.fixture(scope="module")
def nowhere(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return _built(tmp_path_factory.mktemp("nowhere"), "")


def head(site: Path, page: str) -> dict[str, str]:
    """What a page's head tells by its meta elements and its links."""
    text = (site / page).read_text(encoding="utf-8").partition("</head>")[0]
    told = re.findall(r'<meta (?:name|property)="([^"]+)" content="([^"]*)"', text)
    links = re.findall(r'<link rel="([^"]+)" href="([^"]*)"', text)
    return {name: html.unescape(value) for name, value in [*told, *links]}


def test_a_page_tells_its_title_and_its_first_paragraph(nowhere: Path) -> None:
    told = head(nowhere, "index.html")
    assert told["description"] == told["og:description"] == 'All modules are "here" & there.'
    assert told["og:title"] == "Home"
    assert head(nowhere, "modules/soft_shadows.html")["og:title"] == "Soft shadows"
    assert told["shortcut icon"] == "_static/favicon.svg"
    ET.parse(nowhere / "_static" / "favicon.svg")


def test_without_an_address_nothing_needs_one(nowhere: Path) -> None:
    for page in ("index.html", "modules/soft_shadows.html", "404.html"):
        assert not {"canonical", "og:url", "og:image"} & set(head(nowhere, page))
        assert "<base " not in (nowhere / page).read_text(encoding="utf-8")
    assert not (nowhere / "sitemap.xml").exists()


def test_with_an_address_links_are_whole(somewhere: Path) -> None:
    told = head(somewhere, "modules/soft_shadows.html")
    address = "https://course.example.org/rays/modules/soft_shadows.html"
    assert told["canonical"] == told["og:url"] == address
    picture = told["og:image"].removeprefix("https://course.example.org/rays/")
    # With the effect, and not without.
    assert picture == "_pictures/soft_shadows.webp"
    assert (somewhere / picture).is_file()
    assert "canonical" not in head(somewhere, "404.html")
    assert 'href="https://course.example.org/rays/"' in (somewhere / "404.html").read_text("utf-8")


def test_the_map_has_every_page_and_no_other(somewhere: Path) -> None:
    found = {each.text for each in ET.parse(somewhere / "sitemap.xml").iter() if each.text}
    pages = ("index", "cite", "modules/soft_shadows")
    listed = {address.strip() for address in found} - {""}
    assert listed == {f"https://course.example.org/rays/{page}.html" for page in pages}


def test_pages_say_the_version_and_the_licence(nowhere: Path) -> None:
    for page in ("index.html", "404.html"):
        text = (nowhere / page).read_text(encoding="utf-8")
        edition = re.sub(r"<[^>]+>", "", re.findall(r'class="edition">(.*?)</p>', text)[0])
        assert f"Penumbra {__version__}." in edition
        assert "CC BY 4.0" in edition


def _told(text: str) -> str:
    page = f"Title\n=====\n\n{text}\n"
    return description(publish_doctree(page, settings_overrides={"doctitle_xform": False}))


def test_a_long_paragraph_is_told_in_whole_sentences() -> None:
    sentence = "Rays go everywhere at once. "
    told = _told(f"{sentence * 20}\n\nMore.")
    assert told == (sentence * 7).strip()
    assert len(told) <= LONGEST < len(told) + len(sentence)
    assert _told(sentence) == sentence.strip()
    endless = _told("word " * 99)
    assert endless.endswith("word ...")
    assert len(endless) <= LONGEST
    assert _told("") == ""


def test_what_is_told_cannot_leave_its_attribute() -> None:
    assert 'content="&quot;&gt;&lt;script&gt;"' in tags('"><script>', "", None, None)
    assert "description" not in tags("a", "", None, None)


@pytest.fixture
def paper(nowhere: Path, browser: Any) -> Any:
    """A module's page as it is printed on A4, with 15 mm at each side."""
    page = browser.new_page(viewport={"width": 680, "height": 1000})
    page.add_init_script(
        "window.print = () => { window.printed = [...document.querySelectorAll('article img')]"
        ".map((each) => each.complete && each.naturalWidth > 0); }"
    )
    page.goto((nowhere / "modules" / "soft_shadows.html").as_uri())
    yield page
    page.close()


def test_the_button_prints_when_all_pictures_are_there(paper: Any) -> None:
    paper.get_by_role("button", name="Print this page").click()
    paper.wait_for_function("window.printed")
    printed = paper.evaluate("window.printed")
    assert len(printed) > 30
    assert all(printed)


def test_paper_has_what_is_read_and_nothing_to_be_moved(paper: Any) -> None:
    paper.emulate_media(media="print")
    for hidden in (
        ".sidebar-drawer",
        ".toc-drawer",
        ".skip-to-content",
        "input",
        "button",
        "details:not(.quiz details)",
    ):
        for each in paper.locator(hidden).all():
            assert not each.is_visible(), hidden
    before, after = (
        paper.locator(f".before-after .{name} img").bounding_box() for name in ("before", "after")
    )
    assert before["x"] + before["width"] <= after["x"]
    assert before["y"] == after["y"]
    assert (
        paper.evaluate("getComputedStyle(document.querySelector('.before-after .after')).clipPath")
        == "none"
    )
    assert paper.evaluate("document.documentElement.scrollWidth <= innerWidth")
