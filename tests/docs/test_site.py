"""The site, built with grey pictures: without a warning, every link leads somewhere, no page asks another host."""

import re
from collections.abc import Iterator
from dataclasses import dataclass, field
from html import unescape
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urlsplit

import pytest

from course.cli.main import COMMANDS
from course.engine.formats.yaml.schema import json_schema
from course.engine.functions.effects import PROJECT
from course.engine.functions.modules import COURSE

HEAVIEST = 1_500_000
"""Bytes of a page, with its styles, scripts and what isn't loaded only when it is scrolled to."""

RESOURCES = {"img": "src", "script": "src", "link": "href", "source": "src", "iframe": "src"}


@dataclass
class Page(HTMLParser):
    """What a page links to, what it loads, and the names in it that can be linked to."""

    path: Path
    tags: list[tuple[str, dict[str, str]]] = field(default_factory=list)
    text: list[str] = field(default_factory=list)

    def __post_init__(self) -> None:
        super().__init__()
        self.feed(self.path.read_text(encoding="utf-8"))

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.tags.append((tag, {name: value or "" for name, value in attrs}))

    def handle_data(self, data: str) -> None:
        self.text.append(data)

    @property
    def names(self) -> set[str]:
        return {given["id"] for _, given in self.tags if "id" in given}

    @property
    def links(self) -> list[str]:
        return [given["href"] for tag, given in self.tags if tag == "a" and "href" in given]

    @property
    def resources(self) -> list[str]:
        return [
            given[RESOURCES[tag]]
            for tag, given in self.tags
            if tag in RESOURCES and RESOURCES[tag] in given
        ]

    def of(self, tag: str) -> list[dict[str, str]]:
        return [given for name, given in self.tags if name == tag]


@pytest.fixture(scope="module")
def pages(site: Path) -> dict[Path, Page]:
    return {path: Page(path) for path in sorted(site.rglob("*.html"))}


def _inside(pages: dict[Path, Page], found: str) -> Iterator[tuple[Page, str, Path, str]]:
    """Page, address, the file that it names and the place in it, of everything that isn't on another host."""
    for page in pages.values():
        for address in getattr(page, found):
            parts = urlsplit(address)
            if not (parts.scheme or parts.netloc):
                target = page.path.parent / unquote(parts.path) if parts.path else page.path
                yield page, address, target.resolve(), unquote(parts.fragment)


def test_there_is_a_page_for_each_document(site: Path, pages: dict[Path, Page]) -> None:
    for source in (PROJECT / "docs").rglob("*.md"):
        name = source.relative_to(PROJECT / "docs").with_suffix(".html")
        assert site / name in pages


def test_every_link_leads_somewhere(pages: dict[Path, Page]) -> None:
    checked = 0
    for page, address, target, place in _inside(pages, "links"):
        assert target.is_file(), f"{page.path.name}: {address}"
        if place and target in pages:
            assert place in pages[target].names, f"{page.path.name}: {address}"
        checked += 1
    assert checked > 1000


def test_every_picture_script_and_style_is_there(pages: dict[Path, Page]) -> None:
    for page, address, target, _ in _inside(pages, "resources"):
        # The search page's preview and the like are addresses of pages.
        assert target.is_file(), f"{page.path.name}: {address}"


def test_no_page_asks_another_host(site: Path, pages: dict[Path, Page]) -> None:
    for page in pages.values():
        for address in page.resources:
            parts = urlsplit(address)
            assert not parts.netloc, f"{page.path.name}: {address}"
            assert parts.scheme in ("", "data"), f"{page.path.name}: {address}"
    styles = [*site.rglob("*.css")]
    assert styles
    for style in styles:
        text = re.sub(r"/\*.*?\*/", "", style.read_text(encoding="utf-8"), flags=re.DOTALL)
        asked = re.findall(r"""(?:url\(|@import)\s*["']?\s*((?:https?:)?//[^"')\s]+)""", text)
        assert not asked, f"{style.name}: {asked}"


def test_pages_are_light(pages: dict[Path, Page]) -> None:
    for page in pages.values():
        shown = page.of("img") + page.of("iframe")
        lazy = {given["src"] for given in shown if given.get("loading") == "lazy"}
        local = {address for address in page.resources if not urlsplit(address).scheme} - lazy
        files = {(page.path.parent / unquote(urlsplit(each).path)).resolve() for each in local}
        weight = page.path.stat().st_size + sum(file.stat().st_size for file in files)
        assert weight < HEAVIEST, f"{page.path.name}: {weight} bytes"


def test_every_picture_has_its_text_and_its_size(pages: dict[Path, Page]) -> None:
    for page in pages.values():
        for picture in page.of("img"):
            assert picture.get("alt"), f"{page.path.name}: {picture}"
            if "_pictures/" in picture["src"]:
                assert picture["loading"] == "lazy"
                assert int(picture["width"]) >= 300
                assert int(picture["height"]) >= 200


def test_formulas_are_written_out(pages: dict[Path, Page], site: Path) -> None:
    page = pages[site / "modules" / "soft_shadows.html"]
    assert [given for given in page.of("math") if given.get("display") == "block"]
    for each in pages.values():
        assert "$$" not in "".join(each.text), each.path.name
        assert "\\frac" not in "".join(each.text), each.path.name


@pytest.mark.parametrize("module", COURSE)
def test_a_module_with_two_scenes_shows_both(
    module: str, site: Path, pages: dict[Path, Page]
) -> None:
    page = pages[site / "modules" / f"{module}.html"]
    shown = [given["src"].rpartition("/")[2] for given in page.of("img")]
    pair = [f"before-{module}.webp", f"{module}.webp"]
    # The same picture by Embree and by the hierarchy: there the heat map is what differs.
    if module == "bounding_volumes":
        pair = [f"{module}.webp", f"{module}-heat.webp"]
    there = (PROJECT / "scenes" / "before" / f"{module}.yaml").is_file()
    # A picture may stand beside its heat map again.
    assert list(dict.fromkeys(name for name in shown if name in pair)) == (pair if there else [])


@pytest.mark.parametrize("module", COURSE)
def test_each_signature_leads_to_its_reference(
    module: str, site: Path, pages: dict[Path, Page]
) -> None:
    links = pages[site / "modules" / f"{module}.html"].links
    for name in COURSE[module]:
        assert f"../reference/functions.html#assignments.{module}.{name}" in links


def test_every_key_of_a_scene_is_listed(site: Path, pages: dict[Path, Page]) -> None:
    text = " ".join("".join(pages[site / "reference" / "scene_files.html"].text).split())
    for definition in json_schema()["$defs"].values():
        for key, value in definition.get("properties", {}).items():
            assert key in text
            about = value.get("description", "").replace("`", "")
            assert " ".join(about.split()) in text, key
            assert value.get("x-unit", "") in text, key


def test_a_key_stands_with_its_unit_range_and_default(site: Path) -> None:
    text = (site / "reference" / "scene_files.html").read_text(encoding="utf-8")
    rows = [" ".join(re.sub(r"<[^>]+>", " ", row).split()) for row in text.split("<dt")]
    row = next(row for row in rows if "vertical_fov :" in row)
    assert "number; degree; &gt; 0 and &lt; 180; default 40.0" in row
    assert "Angle from the picture's lower to its upper edge." in unescape(row)
    assert "needed" in next(row for row in rows if "look_at :" in row)


def test_every_command_and_function_is_listed(site: Path, pages: dict[Path, Page]) -> None:
    assert {f"course-{name}" for name in COMMANDS} <= pages[
        site / "reference" / "command_line.html"
    ].names
    listed = pages[site / "reference" / "functions.html"].names
    for module, names in COURSE.items():
        assert {f"assignments.{module}.{name}" for name in names} <= listed
