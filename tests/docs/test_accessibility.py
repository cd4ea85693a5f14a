"""Pages can be used without a mouse and by those who hear them: axe's rules of WCAG 2, and the keyboard alone."""

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from tests.browser import assert_fits, tab_to, troubles
from tests.lengths import share

axe = pytest.importorskip(
    "axe_playwright_python.sync_playwright",
    reason='pages are looked at by: pip install -e ".[browser]"',
)


TAGS = {"type": "tag", "values": ["wcag2a", "wcag2aa", "wcag21a", "wcag21aa"]}
BY_COLOUR = ["color-contrast", "link-in-text-block"]
RULES = {"runOnly": TAGS, "rules": {rule: {"enabled": False} for rule in BY_COLOUR}}
"""Rules whose answer is the same in the light and in the dark."""
COLOURS = {"runOnly": {"type": "rule", "values": BY_COLOUR}}
"""Those that look at colours. They take most of the time, nearly all of it in long tables."""

PARTS = 4
"""Pages are judged in so many tests, so that they can run beside each other."""


OPEN = """() => {
  for (const each of document.querySelectorAll("details")) each.open = true;
  for (const slider of document.querySelectorAll("input[type=range]")) {
    slider.value = Number(slider.value) < Number(slider.max) ? Number(slider.value) + 1 : slider.min;
    slider.dispatchEvent(new Event("input", { bubbles: true }));
  }
  return document.querySelectorAll("details:not([open])").length;
}"""
"""Unfold what is folded away, and move each slider by a step."""


TWINS = """(before) => {
  const told = ["alt", "aria-describedby", "aria-label", "aria-labelledby", "href", "id", "src", "title"];
  const drawn = (element) => element instanceof SVGElement;
  const kept = (element) => [...element.attributes].filter((each) => !told.includes(each.name));
  const tag = (element) =>
    element.localName + kept(element).map((each) => ` ${each.name}=${each.value}`).join("");
  const looks = (element) => drawn(element)
    ? element.outerHTML : `<${tag(element)}>${[...element.children].map(looks).join("")}</>`;
  const short = (text) => {
    let [a, b] = [1, 2];
    for (let i = 0; i < text.length; i++) {
      a = Math.imul(a ^ text.charCodeAt(i), 2654435761);
      b = Math.imul(b ^ text.charCodeAt(i), 1597334677);
      a = (a << 7) | (a >>> 25);
      b = (b << 11) | (b >>> 21);
    }
    return `${a >>> 0} ${b >>> 0}`;
  };
  const seen = new Set(before);
  const visit = (parent, path) => {
    const children = [...parent.children];
    children.forEach((child, place) => {
      if (drawn(child)) return;
      const ends = `${place === 0} ${place === children.length - 1} ${place % 2}`;
      const known = short(`${path} ${ends} ${looks(child)}`);
      if (seen.has(known)) {
        child.replaceChildren();
      } else {
        seen.add(known);
        visit(child, `${path}<${tag(child)}>`);
      }
    });
  };
  const styles = [...document.querySelectorAll("style, link[rel=stylesheet]")];
  visit(document.body, styles.map((each) => each.href || each.textContent).join(" "));
  return [...seen];
}"""
"""Empty what has the colours of something before it, on this page or on one with the same styles, in its place.

Twins have the same tags, classes and styles, inside and in all that is around them, and both stand first, last, at an
even or at an odd place: only their words differ. Drawings are left whole, where place decides what is behind words.
Given and returned are fingerprints of 64 bits of all that was seen.
"""


PICTURES = """async () => {
  const faults = [];
  for (const image of document.images) image.loading = "eager";
  for (const image of document.images) {
    await image.decode().catch(() => faults.push(`not loaded: ${image.src}`));
    if (!image.alt.trim()) faults.push(`no alternative text: ${image.src}`);
    const [width, height] = ["width", "height"].map((name) => Number(image.getAttribute(name)));
    const shape = image.naturalWidth / image.naturalHeight;
    if (Math.abs(width / height - shape) > 0.02) faults.push(`another shape: ${image.src}`);
  }
  return [document.images.length, faults];
}"""


def _faults(page: Any, rules: dict[str, Any]) -> list[str]:
    if not page.evaluate("'axe' in window"):
        page.evaluate(axe.Axe().axe_script)
    options = rules | {"resultTypes": ["violations"]}
    found = page.evaluate("(options) => axe.run(document, options)", options)
    assert found["testEngine"]["name"] == "axe-core"
    return [
        f"{fault['id']}: {fault['help']}: {node['html'][:160]}"
        for fault in found["violations"]
        for node in fault["nodes"]
    ]


@pytest.mark.parametrize("part", range(PARTS))
def test_every_page_opens_on_both_screens_and_axe_finds_nothing(
    browser: Any, site: Path, part: int
) -> None:
    context = browser.new_context(offline=True)
    page = context.new_page()
    trouble, pictures = troubles(page), 0
    seen: list[str] = []
    files = sorted(site.rglob("*.html"))[part::PARTS]
    assert len(files) > 6
    # Pages beside each other are made alike; the front's is of a kind of its own, and opened longest of all.
    files = [*([site / "index.html"] if part == 0 else []), *share(files, 4)]
    for file in files:
        page.set_viewport_size({"width": 1280, "height": 900})
        page.emulate_media(color_scheme="light")
        page.goto(file.as_uri())
        assert_fits(page, 1280)
        page.set_viewport_size({"width": 390, "height": 900})
        page.emulate_media(color_scheme="dark")
        page.goto(file.as_uri())
        assert_fits(page, 390)
        number, faults = page.evaluate(PICTURES)
        assert faults == [], file.name
        pictures += number
        assert trouble == []
        page.emulate_media(color_scheme="light")
        assert page.evaluate(OPEN) == 0
        assert _faults(page, RULES) == [], file.name
        seen = page.evaluate(TWINS, seen)
        assert _faults(page, COLOURS) == [], f"{file.name}, light, narrow"
        page.set_viewport_size({"width": 1280, "height": 900})
        page.emulate_media(color_scheme="dark")
        assert _faults(page, COLOURS) == [], f"{file.name}, dark, wide"
        # What a page says of the parts that were taken out of it is not counted.
        page.goto("about:blank")
        trouble.clear()
    # Most stand on the front page.
    assert pictures > (50 if part == 0 else 20)
    context.close()


PALE = "<!doctype html><html lang=en><title>A</title><main><h1>Words</h1><p style='color:#aaa'>Pale words</p></main>"


@pytest.mark.parametrize(
    ("text", "rules", "fault"),
    [
        (PALE, COLOURS, "color-contrast"),
        (PALE.replace("</main>", "<img src='data:,'></main>"), RULES, "image-alt"),
        (PALE.replace("</main>", "<input></main>"), RULES, "label"),
        (PALE.replace(" lang=en", ""), RULES, "html-has-lang"),
    ],
)
def test_axe_finds_what_is_wrong(
    browser: Any, text: str, rules: dict[str, Any], fault: str
) -> None:
    page = browser.new_page()
    page.set_content(text)
    assert any(found.startswith(f"{fault}:") for found in _faults(page, rules))
    page.close()


def test_axe_sees_what_was_folded_away(browser: Any) -> None:
    page = browser.new_page()
    page.set_content(
        PALE.replace("<p", "<details><summary>More</summary><p").replace("</p>", "</p></details>")
    )
    assert _faults(page, COLOURS) == []
    page.evaluate(OPEN)
    assert [fault.split(":")[0] for fault in _faults(page, COLOURS)] == ["color-contrast"]
    page.close()


@pytest.mark.parametrize(
    ("text", "left", "pale"),
    [
        (
            "<p class=a>One<p class=a>two<p class=a>three<p class=a>four<p>five",
            "One two three five",
            0,
        ),
        ("<p>One<p>two<p>three<p class=b>four<p>five<p>six", "One two three four six", 1),
        (
            "<p>One<p>two<p>three<p style='color:#aaa'>four<p>five<p>six",
            "One two three four six",
            1,
        ),
        ("<p>One<p>two<p>three<p><i class=b>four</i><p>five<p>six", "One two three four six", 1),
        (
            "<div>None</div><div><p>one</div><div class=d><p>two</div><div><p>three</div><p>end",
            "None one two end",
            1,
        ),
        (
            "<p>One<p>two<p>three<p>four<p class=e>five<p class=e>six<p>end",
            "One two three five six end",
            1,
        ),
    ],
)
def test_only_what_has_the_colours_of_another_is_left_out(
    browser: Any, text: str, left: str, pale: int
) -> None:
    page = browser.new_page()
    styles = ".b, .d p, .e:nth-child(even) {color: #aaa}"
    page.set_content(f"<!doctype html><style>{styles}</style><body>{text}")
    page.evaluate(TWINS, [])
    assert page.locator("body").inner_text().split() == left.split()
    assert len(_faults(page, COLOURS)) == pale
    page.close()


def test_a_page_before_has_shown_colours_where_it_had_the_same_styles(browser: Any) -> None:
    page = browser.new_page()
    seen: list[str] = []
    for style, text, left, pale in (
        ("p {color: black}", "<p>one<p class=a>two", "one two", 0),
        ("p {color: black}", "<p>three<p class=b>four", "four", 0),
        ("p {color: #aaa}", "<p>five<p class=a>six", "five six", 2),
        ("p {color: #aaa}", "<p>seven<p class=b>eight", "eight", 1),
    ):
        page.set_content(f"<!doctype html><style>{style}</style><body>{text}")
        seen = page.evaluate(TWINS, seen)
        assert page.locator("body").inner_text().split() == left.split()
        assert len(_faults(page, COLOURS)) == pale
    page.close()


@pytest.fixture
def narrow(browser: Any, site: Path) -> Iterator[Any]:
    """A page on a telephone."""
    page = browser.new_page(viewport={"width": 390, "height": 800})
    page.goto((site / "modules" / "soft_shadows.html").as_uri())
    yield page
    page.close()


def test_among_the_first_stops_is_one_that_skips_to_the_text(narrow: Any) -> None:
    tab_to(narrow, ".skip-to-content", 3)
    narrow.wait_for_function("document.activeElement.getBoundingClientRect().top >= -2")
    narrow.keyboard.press("Enter")
    assert narrow.evaluate("location.hash") == "#furo-main-content"
    # The next stop stands in the text.
    narrow.keyboard.press("Tab")
    assert narrow.evaluate("document.activeElement.closest('#furo-main-content, article') !== null")


def test_the_menu_opens_by_keyboard(narrow: Any) -> None:
    menu = narrow.locator(".sidebar-drawer")
    assert menu.bounding_box()["x"] < -100
    tab_to(narrow, "#__navigation")
    focused = narrow.evaluate(
        "getComputedStyle(document.querySelector('.nav-overlay-icon')).outlineStyle"
    )
    assert focused == "solid"
    narrow.keyboard.press("Space")
    narrow.wait_for_function(
        "document.querySelector('.sidebar-drawer').getBoundingClientRect().x >= 0"
    )
    tab_to(narrow, ".sidebar-tree a")
    narrow.keyboard.press("Enter")
    narrow.wait_for_url(lambda url: not url.endswith("soft_shadows.html"))


def test_a_closed_menu_is_passed_over(narrow: Any) -> None:
    for _ in range(8):
        narrow.keyboard.press("Tab")
        assert not narrow.evaluate("document.activeElement.closest('.sidebar-drawer') !== null")


def test_the_search_is_found_and_answers(narrow: Any) -> None:
    tab_to(narrow, "#__navigation")
    narrow.keyboard.press("Space")
    tab_to(narrow, ".sidebar-search")
    narrow.keyboard.type("penumbra")
    narrow.keyboard.press("Enter")
    narrow.wait_for_url("**/search.html?q=penumbra**")
    narrow.wait_for_selector("#search-results li a")
    tab_to(narrow, "#search-results li a")
