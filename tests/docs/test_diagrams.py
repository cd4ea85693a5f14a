"""The figures of the modules' pages: each page has some, they say what they show, and their geometry is right."""

import re
from collections import Counter
from importlib import import_module
from typing import Any
from xml.etree import ElementTree as ET

import numpy as np
import pytest

from course.engine.functions.effects import PROJECT
from course.engine.functions.modules import COURSE

pytest.importorskip("sphinx", reason='the site needs: pip install -e ".[docs]"')
pytest.importorskip("latex2mathml", reason='the site needs: pip install -e ".[docs]"')

from sitebuild.diagrams import (
    adaptive_sampling,
    blurred_transparency,
    bounding_volumes,
    cube_map,
    house,
    penumbra,
    radiosity,
    streak,
)
from sitebuild.diagrams.canvas import Canvas, clipped, meeting
from sitebuild.diagrams.figure import html, symbols
from sitebuild.diagrams.part import diagram, figure
from sitebuild.diagrams.view import View

from course.base.errors import CourseError

STYLES = (PROJECT / "docs" / "_static" / "diagrams.css").read_text(encoding="utf-8")

NAMES = [
    f"{module}/{name}"
    for module in COURSE
    for name in import_module(f"sitebuild.diagrams.{module}").FIGURES
]


def asked_for(module: str) -> list[str]:
    text = (PROJECT / "docs" / "modules" / f"{module}.md").read_text(encoding="utf-8")
    return re.findall(r"^<!-- site: diagram (\S+) -->$", text, re.MULTILINE)


def drawings(name: str) -> list[ET.Element]:
    """The SVG elements of a figure, as the page gets them."""
    text = diagram(None, name)  # type: ignore[arg-type]
    return [ET.fromstring(svg) for svg in re.findall(r"<svg .*?</svg>", text, re.DOTALL)]


@pytest.mark.parametrize("module", COURSE)
def test_each_page_shows_its_figures_the_idea_and_the_steps(module: str) -> None:
    asked = asked_for(module)
    assert sorted(asked) == sorted(name for name in NAMES if name.startswith(f"{module}/"))
    assert len(asked) >= 2
    text = (PROJECT / "docs" / "modules" / f"{module}.md").read_text(encoding="utf-8")
    idea, algorithm = (
        text.partition(f"\n## {title}\n")[2].partition("\n## ")[0]
        for title in ("The idea", "The algorithm")
    )
    assert "<!-- site: diagram" in idea
    assert f"<!-- site: diagram {module}/steps -->" in algorithm


def test_an_unknown_figure_is_refused() -> None:
    with pytest.raises(CourseError, match="no such figure; there are penumbra"):
        figure("soft_shadows/penumbrella")


@pytest.mark.parametrize("name", NAMES)
def test_a_figure_is_one_block_of_html(name: str) -> None:
    html = diagram(None, name)  # type: ignore[arg-type]
    # A blank line would end the block, and Markdown would read the rest.
    assert "\n\n" not in html.rstrip("\n")
    # Labels and captions have letters where formulas have LaTeX's names of them.
    assert "\\" not in html
    assert len(figure(name).caption) > 30


@pytest.mark.parametrize("name", NAMES)
def test_a_drawing_tells_those_who_do_not_see_it(name: str) -> None:
    for svg in drawings(name):
        assert svg.get("role") == "img"
        named = [svg.find(f"*[@id='{key}']") for key in svg.get("aria-labelledby", "").split()]
        assert [element.tag for element in named if element is not None] == ["title", "desc"]
        title, description = (element.text or "" for element in named if element is not None)
        assert 4 < len(title) < 80
        assert len(description) > 18
        assert "$" not in title + description
    assert len({svg.findtext("title") for svg in drawings(name)}) == len(drawings(name))


@pytest.mark.parametrize("module", COURSE)
def test_no_id_is_there_twice(module: str) -> None:
    text = "".join(diagram(None, name) for name in asked_for(module))  # type: ignore[arg-type]
    assert max(Counter(re.findall(r' id="([^"]+)"', text)).values()) == 1


@pytest.mark.parametrize("name", NAMES)
def test_colours_are_those_of_the_page(name: str) -> None:
    styled = set(re.findall(r"\.([a-z-]+)", STYLES))
    for svg in drawings(name):
        for element in svg.iter():
            assert not set(element.keys()) & {"fill", "stroke", "style", "color"}, element.attrib
            assert set(element.get("class", "").split()) - styled <= {"label"}, element.attrib


def test_styles_have_no_colour_of_their_own() -> None:
    assert not re.findall(r"#[0-9a-f]{3,8}\b|\brgba?\(|\bhsla?\(|\b(?:white|black)\b", STYLES)


@pytest.mark.parametrize("name", NAMES)
def test_labels_are_in_the_drawing_and_apart(name: str) -> None:
    for panel in figure(name).panels:
        canvas = panel.canvas
        # As wide as half a telephone's screen or as the whole: a unit is at least a pixel there.
        assert canvas.width in (172, 350)
        for k, (x0, y0, x1, y1, text) in enumerate(canvas.boxes):
            assert 0 <= x0 <= x1 <= canvas.width, text
            assert 0 <= y0 <= y1 <= canvas.height, text
            for a0, b0, a1, b1, other in canvas.boxes[:k]:
                both = min(x1, a1) - max(x0, a0), min(y1, b1) - max(y0, b0)
                assert min(both) < 1, f"{text} over {other}"


@pytest.mark.parametrize("name", NAMES)
def test_what_is_drawn_is_in_the_drawing(name: str) -> None:
    for panel, svg in zip(figure(name).panels, drawings(name), strict=True):
        for element in svg.iter():
            spots = np.array(
                [[float(v) for v in spot.split(",")] for spot in element.get("points", "").split()]
                + [
                    [float(element.get(x, "nan")), float(element.get(y, "nan"))]
                    for x, y in (("x1", "y1"), ("x2", "y2"), ("cx", "cy"))
                    if element.get(x)
                ]
            ).reshape(-1, 2)
            assert np.isfinite(spots).all()
            assert (spots >= -1).all(), element.attrib
            assert (spots <= (panel.canvas.width + 1, panel.canvas.height + 1)).all(), (
                element.attrib
            )


def test_a_browser_finds_all_words_large_enough_inside_and_apart(browser: Any) -> None:
    """As the pages show them at 390 pixels, whose column of text is 358 wide."""
    figures = "".join(diagram(None, name) for name in NAMES)  # type: ignore[arg-type]
    body = "width:358px;margin:0;font-family:Helvetica,Arial,sans-serif"
    script = """() => [...document.querySelectorAll('svg')].map(svg => ({
        name: svg.querySelector('title').textContent,
        size: [svg.viewBox.baseVal.width, svg.viewBox.baseVal.height],
        scale: svg.getScreenCTM().a,
        sizes: [...svg.querySelectorAll('tspan')].map(run => parseFloat(getComputedStyle(run).fontSize)),
        boxes: [...svg.querySelectorAll('text')].map(text => {
            const box = text.getBBox();
            return [box.x, box.y, box.x + box.width, box.y + box.height];
        })}))"""
    page = browser.new_page(viewport={"width": 390, "height": 800})
    page.set_content(f'<style>{STYLES}</style><body style="{body}">{figures}')
    found: list[dict[str, Any]] = page.evaluate(script)
    page.close()
    assert len(found) == sum(len(figure(name).panels) for name in NAMES)
    for svg in found:
        assert min(svg["sizes"], default=11) * svg["scale"] >= 11, svg["name"]
        boxes = np.array(svg["boxes"]).reshape(-1, 4)
        # A box is as high as the font's tallest letters; few labels have these.
        assert (boxes[:, :2] >= (0, -2)).all(), svg["name"]
        assert (boxes[:, 2:] <= np.add(svg["size"], (0, 3))).all(), svg["name"]


# The vocabulary


def test_a_point_lies_where_the_window_says() -> None:
    canvas = Canvas(100, 60, (0, 4, 0, 2), 10)
    np.testing.assert_allclose(canvas.at((2, 1)), (50, 30))
    np.testing.assert_allclose(canvas.at((0, 0)), (10, 50))
    np.testing.assert_allclose(canvas.away((0, 0), 20, -20), (1, 1))
    down = Canvas(100, 60, (0, 4, 2, 0), 10)
    np.testing.assert_allclose(down.at((0, 0)), (10, 10))
    stretched = Canvas(100, 60, (0, 4, 0, 8), 10, stretch=True)
    np.testing.assert_allclose(stretched.at((4, 8)), (90, 10))
    np.testing.assert_allclose(stretched.away((0, 0), 20, -20), (1, 4))


def test_an_arrow_ends_at_its_tip() -> None:
    canvas = Canvas(100, 100, (0, 100, 100, 0))
    canvas.arrow((10, 20), (70, 20))
    line, head = canvas.elements
    assert head.get("points", "").split()[0] == "70,20"
    assert 10 < float(line.get("x2", 0)) < 70


def test_a_label_has_symbols_and_indices() -> None:
    canvas = Canvas(100, 100)
    canvas.label((50, 50), "area $A_i^2$ cos", "c")
    runs = [(run.text, run.get("class")) for run in canvas.elements[0]]
    assert runs == [
        ("area ", None),
        ("A", "symbol slanted"),
        ("i", "index slanted"),
        ("2", "index"),
        (" cos", None),
    ]
    assert [run.get("dy") for run in canvas.elements[0]] == [None, None, "4", "-9", "5"]
    assert symbols("$x_i$ < $cos^2$") == "<i>x</i><sub><i>i</i></sub> &lt; cos<sup>2</sup>"


def test_lines_meet_and_polygons_are_cut() -> None:
    np.testing.assert_allclose(meeting((0, 0), (2, 2), (0, 1), (5, 1)), (1, 1))
    square = np.array([[0.0, 2, 2, 0], [0, 0, 2, 2]])
    part = clipped(square, (1, 1), (5, 5))
    assert sorted(map(tuple, part.T)) == [(1, 1), (1, 2), (2, 1), (2, 2)]
    assert clipped(square, (3, 3), (4, 4)).size == 0


@pytest.mark.parametrize("up", [1, 2])
def test_a_view_is_a_rotation_with_its_axis_upwards(up: int) -> None:
    view = View(33, 20, up)
    np.testing.assert_allclose(view.axes @ view.axes.T, np.eye(3), atol=1e-12)
    assert np.linalg.det(view.axes) == pytest.approx(1)
    x, y = view(np.eye(3)[up])
    assert (x, y) == (pytest.approx(0, abs=1e-12), pytest.approx(np.cos(np.radians(20))))


# What the figures claim


@pytest.mark.parametrize(
    ("diameter", "a", "b"), [(1.3, 2.1, 1.5), (0.5, 4.0, 1.0), (2.0, 1.0, 3.0)]
)
def test_the_penumbra_is_as_wide_as_the_page_says(diameter: float, a: float, b: float) -> None:
    near, far = penumbra.penumbra_of(diameter, a, b)
    assert far - near == pytest.approx(diameter * b / a)


def test_the_penumbra_is_drawn_as_wide_as_it_is() -> None:
    svg = drawings("soft_shadows/penumbra")[0]
    shadow, lamp = (
        np.array([spot.split(",") for spot in polygon.get("points", "").split()], float)
        for polygon in svg.findall("polygon[@class='wash']")
    )
    assert shadow[:, 1].argmin() == lamp[:, 1].argmax() == 2
    wide, tall = np.ptp(shadow, axis=0) / np.ptp(lamp, axis=0)
    # Coordinates are written to a tenth of a unit.
    assert wide == pytest.approx(tall, abs=0.005)
    np.testing.assert_allclose(shadow[2], lamp[2])


def test_the_unfolded_cube_has_the_pages_table() -> None:
    text = (PROJECT / "docs" / "modules" / "cube_map.md").read_text(encoding="utf-8")
    rows = re.findall(r"^\| \$(\S+)\$ \| (\d) \| \$(\S+)\$ \| \$(\S+)\$ \|$", text, re.MULTILINE)
    assert len(rows) == 6
    for name, number, along, down in rows:
        axes = cube_map.axes_of(int(number))
        assert [cube_map.name_of(axis).replace("\N{MINUS SIGN}", "-") for axis in axes] == [
            name,
            along,
            down,
        ]


def test_faces_that_touch_unfolded_share_that_edge() -> None:
    # From a face to its right neighbour one goes along u; the next one's u then points away from the first face.
    touching = 0
    for face, (column, row) in cube_map.NET.items():
        own, along, down = cube_map.axes_of(face)
        for other, place in cube_map.NET.items():
            beside = cube_map.axes_of(other)
            if place == (column + 1, row):
                np.testing.assert_array_equal((along, -own, down), beside)
                touching += 1
            if place == (column, row + 1):
                np.testing.assert_array_equal((down, along, -own), beside)
                touching += 1
    # Six faces in one piece.
    assert touching == 5


def test_all_light_of_the_streak_is_kept() -> None:
    x = np.linspace(-3, 3, 60_001)
    # A ball of diameter 2 R covers that much of the picture at any time.
    total = np.trapezoid(streak.covered(x), x)
    assert total == pytest.approx(2 * streak.RADIUS, rel=1e-6)


@pytest.mark.parametrize(("degrees", "eta"), [(50, 1 / 1.5), (28, 1.5), (39, 1.5)])
def test_rays_are_bent_by_snells_law(degrees: float, eta: float) -> None:
    incoming, outgoing, total, _ = blurred_transparency.bent(degrees, eta)
    assert incoming[0] == pytest.approx(np.sin(np.radians(degrees)))
    assert outgoing[0] == pytest.approx(eta * incoming[0])
    assert outgoing[1] < 0
    assert not total
    assert blurred_transparency.bent(55, 1.5)[2]


def test_cells_cover_the_pixel_and_corners_are_new_once() -> None:
    known: set[tuple[float, float]] = set()
    for (x0, y0, x1, y1), new in adaptive_sampling.levels(3):
        assert ((x1 - x0) * (y1 - y0)).sum() == pytest.approx(1)
        assert not known & set(new)
        known |= set(new)
        corners = adaptive_sampling.corners_of((x0, y0, x1, y1)).reshape(2, -1)
        assert set(zip(*corners.tolist(), strict=True)) == known
    assert (0.5, 0.5) in known


def test_the_ray_is_tested_with_all_triangles_that_it_hits() -> None:
    tree = bounding_volumes.hierarchy()
    first, count, order = tree[2:]
    asked, hit = bounding_volumes.tested(tree), bounding_volumes.met(tree)
    reached = {
        int(t)
        for k in np.flatnonzero(asked & hit & (count > 0))
        for t in order[first[k] : first[k] + count[k]]
    }
    way = bounding_volumes.TARGET - bounding_volumes.ORIGIN
    to_corners = bounding_volumes.triangles() - bounding_volumes.ORIGIN[:, None, None]
    side = way[0] * to_corners[1] - way[1] * to_corners[0]
    crossed = set(np.flatnonzero((side.max(axis=0) > 0) & (side.min(axis=0) < 0)).tolist())
    assert crossed
    assert crossed <= reached
    # What the caption says: some boxes are never asked, and some triangles never tested.
    assert len(count) > asked.sum()
    assert len(reached) < bounding_volumes.COUNT


def test_the_room_in_section_keeps_all_light_and_settles() -> None:
    ends, reflectance, emission, factors = radiosity.section()
    np.testing.assert_allclose(factors.sum(axis=1), 1, atol=1e-12)
    length = np.hypot(*(ends[:, 1] - ends[:, 0]))
    np.testing.assert_allclose(length[:, None] * factors, (length[:, None] * factors).T, atol=1e-12)
    exact = np.linalg.solve(np.eye(emission.size) - reflectance[:, None] * factors, emission)
    lights = radiosity.spreading()
    np.testing.assert_allclose(lights[-1], exact, rtol=1e-4)
    assert (lights[1] > 0).sum() < (lights[2] > 0).sum() == emission.size


def test_a_figure_without_words_has_no_empty_paragraph() -> None:
    text = html(figure("soft_shadows/penumbra"), "name")
    assert "<p>" not in text
    assert 'aria-labelledby="name-1-title name-1-description"' in text


def test_the_picture_of_the_house_has_every_room_and_its_arrows_lead_down() -> None:
    (svg,) = drawings("house/rooms")
    words = {"".join(each.itertext()) for each in svg.iter() if each.tag.endswith("text")}
    folders = [path.parent for path in (PROJECT / "course").rglob("__init__.py")]
    inner = {f"{path.name}/" for path in folders if path.parent.name in {"course", "engine"}}
    assert inner - words == set()
    arrows = [each for each in svg.iter() if each.tag.endswith("line")]
    assert len(arrows) > 10
    assert all(float(each.get("y2", 0)) > float(each.get("y1", 0)) for each in arrows)


def test_a_circle_has_no_floor() -> None:
    assert house.floors({"a": set(), "b": {"a"}, "c": {"a", "b"}}) == [["a"], ["b"], ["c"]]
    with pytest.raises(ValueError, match=r"in a circle: .*'b'"):
        house.floors({"a": set(), "b": {"c"}, "c": {"b"}})
