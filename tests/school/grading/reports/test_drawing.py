"""Figures of any numbers that a student's function may give."""

import re
from base64 import b64decode
from io import BytesIO
from threading import Thread
from typing import Any
from xml.etree import ElementTree as ET

import numpy as np
import pytest
from PIL import Image

from course.school.grading.checks.check import Figure
from course.school.grading.checks.result import Result, Status
from course.school.grading.reports.drawing import BROKEN, Drawing, draw, is_noisy, with_own_ids
from tests.lengths import fewer


def pictures(**arrays: Any) -> Drawing:
    return draw(Figure("pictures", "A figure", arrays))


def codes(drawing: Drawing, title: str) -> Any:
    (pixels,) = [panel.pixels for panel in drawing.panels if panel.title == title]
    return pixels


def some_picture(width: int = 48, height: int = 36) -> Any:
    return np.random.default_rng(0).random((3, height, width)) * 0.5


def test_two_pictures_and_their_difference() -> None:
    expected = some_picture()
    yours = expected.copy()
    yours[1, 30, 40] += 0.25
    yours[1, 2, 3] -= 0.125
    drawing = pictures(yours=yours, expected=expected)
    assert [panel.title for panel in drawing.panels] == [
        "Reference",
        "Yours",
        "Signed difference",
        "Reference, the worst region",
        "Yours, the worst region",
    ]
    difference = codes(drawing, "Signed difference").astype(int)
    assert difference.shape == (36, 48, 3)
    assert (difference[0, 0] == 247).all()
    # Brighter is red, darker is blue.
    assert difference[30, 40, 0] > difference[30, 40, 2]
    assert difference[2, 3, 2] > difference[2, 3, 0]
    (panel,) = [panel for panel in drawing.panels if panel.title == "Signed difference"]
    assert "±0.25" in panel.caption
    assert "(40, 30)" in panel.alt
    assert all(panel.alt for panel in drawing.panels)


def test_colours_that_are_swapped_make_no_difference_of_zero() -> None:
    expected = np.zeros((3, 4, 4))
    expected[0] = 0.5
    drawing = pictures(yours=expected[::-1].copy(), expected=expected)
    assert (codes(drawing, "Signed difference") != 247).any()


def test_the_worst_region_is_enlarged_around_the_worst_pixel() -> None:
    expected = np.zeros((3, 36, 48))
    yours = expected.copy()
    yours[:, 20, 24] = 1.0
    region = codes(pictures(yours=yours, expected=expected), "Yours, the worst region")
    assert region.shape == (12, 12, 3)
    assert np.argwhere(region[..., 0]).tolist() == [[6, 6]]
    yours[:, 35, 0] = 2.0
    region = codes(pictures(yours=yours, expected=expected), "Yours, the worst region")
    assert np.argwhere(region[..., 0]).tolist() == [[11, 0]]


def test_the_difference_over_the_noise_finds_its_scale() -> None:
    expected = np.full((3, 36, 48), 0.5)
    noise = np.random.default_rng(1).normal(0, 0.01, expected.shape)
    yours = expected + noise
    yours[:, 10:14, 10:14] += 0.1
    drawing = pictures(yours=yours, expected=expected)
    (panel,) = [panel for panel in drawing.panels if panel.title == "Difference over the noise"]
    assert "noise is not known" in panel.caption
    found = re.search(r"taken as ([\d.]+),", panel.caption)
    assert found is not None
    assert float(found[1]) == pytest.approx(0.01, rel=0.1)


def test_without_any_noise_there_is_no_such_map_but_a_sentence() -> None:
    expected = some_picture()
    yours = expected.copy()
    yours[:, 0, 0] += 0.5
    drawing = pictures(yours=yours, expected=expected)
    assert "Difference over the noise" not in [panel.title for panel in drawing.panels]
    assert "no noise" in " ".join(drawing.notes)


@pytest.mark.parametrize(("deviation", "noisy"), [(0.05, False), (1e-5, True)])
def test_what_is_no_noise_or_next_to_none_measures_nothing(deviation: float, noisy: bool) -> None:
    expected = some_picture()
    yours = expected + np.random.default_rng(1).normal(0, deviation, expected.shape)
    yours[:, 10:14, 10:14] += 0.1
    figure = Figure("pictures", "", {"yours": yours, "expected": expected})
    drawing = draw(figure, noisy=noisy)
    titles = [panel.title for panel in drawing.panels]
    assert "Signed difference" in titles
    assert "Difference over the noise" not in titles
    assert bool(drawing.notes) == noisy


def test_functions_that_draw_or_get_random_numbers_make_noise() -> None:
    paths = {"soft_shadows.light_grid": False, "soft_shadows.point_on_sphere": True}
    paths |= {"sampling.ball_by_rejection": True, "textures.texture_lookup": False}
    for path, noisy in paths.items():
        module, function = path.split(".")
        result = Result(module, function, "", "", "picture", Status.FAILED, 0, 1)
        assert is_noisy(result) == noisy


def test_a_difference_that_nobody_sees_is_pale_and_told() -> None:
    expected = some_picture()
    yours = expected.copy()
    yours[:, 3, 4] += 1e-5
    drawing = pictures(yours=yours, expected=expected)
    (panel,) = [panel for panel in drawing.panels if panel.title == "Signed difference"]
    assert "Colours end at ±0.005; the largest difference is 1e-05." in panel.caption
    assert (np.abs(codes(drawing, "Signed difference").astype(int) - 247) < 3).all()
    # Of a dark picture more is seen.
    dark = pictures(yours=yours * 1e-3 + 1e-4, expected=expected * 1e-3)
    (panel,) = [panel for panel in dark.panels if panel.title == "Signed difference"]
    assert "±0.0001" in panel.caption


def test_of_large_pictures_some_pixels_are_drawn_and_that_is_told() -> None:
    drawing = pictures(yours=np.full((3, 360, 480), 0.5))
    assert codes(drawing, "Yours").shape == (180, 240, 3)
    assert "one in 2" in " ".join(drawing.notes)


def test_pixels_that_are_no_numbers_are_magenta_and_counted() -> None:
    expected = some_picture()
    yours = expected + 0.1
    yours[0, 3, 4] = np.nan
    yours[2, 5, 6] = np.inf
    drawing = pictures(yours=yours, expected=expected)
    assert "NaN or infinite at 2 of 1728 pixels" in " ".join(drawing.notes)
    for title in ("Yours", "Signed difference"):
        magenta = (codes(drawing, title) == BROKEN).all(axis=-1)
        assert np.argwhere(magenta).tolist() == [[3, 4], [5, 6]]
    (panel,) = [panel for panel in drawing.panels if panel.title == "Signed difference"]
    assert "±0.1" in panel.caption
    assert "nan" not in panel.caption


@fewer
@pytest.mark.parametrize(
    "array",
    [
        np.full((3, 36, 48), np.nan),
        np.full((3, 36, 48), -np.inf),
        np.full((3, 36, 48), 1.7e308),
        np.full((3, 36, 48), -1.7e308),
        np.full((3, 36, 48), 2**63, np.uint64),
        np.ones((3, 1, 1), bool),
        np.zeros((3, 36, 48), np.float16),
    ],
    ids=lambda array: f"{getattr(array, 'dtype', array)}{getattr(array, 'shape', '')}",
)
@pytest.mark.parametrize("kind", ["pictures", "points", "histogram"])
def test_nothing_is_too_odd_for_a_drawing_or_a_sentence(kind: Any, array: Any) -> None:
    for arrays in ({"yours": array}, {"yours": array, "expected": some_picture()}, {}):
        points = {name: each.reshape(len(each), -1)[:2] for name, each in arrays.items()}
        drawing = draw(Figure(kind, "A figure", points if kind == "points" else arrays))
        assert drawing.panels or drawing.notes or not arrays


def test_where_no_number_is_finite_that_is_said() -> None:
    drawing = draw(Figure("points", "", {"yours": np.full((2, 9), np.nan)}))
    assert "This can't be drawn: Yours has no finite points." in drawing.notes


def test_an_unknown_kind_is_a_sentence() -> None:
    odd: Any = "sculpture"
    assert "can't be drawn" in draw(Figure(odd, "A figure", {})).notes[0]


def test_a_picture_is_a_png_that_can_be_enlarged() -> None:
    panel = pictures(yours=some_picture()).panels[0]
    start, _, data = panel.data_uri(3).partition(",")
    assert start == "data:image/png;base64"
    image = np.asarray(Image.open(BytesIO(b64decode(data))))
    assert panel.pixels is not None
    assert (image[1::3, 1::3] == panel.pixels).all()


def test_points_stand_beside_the_expected_ones() -> None:
    rng = np.random.default_rng(2)
    drawing = draw(
        Figure("points", "", {"yours": rng.random((2, 90)), "expected": rng.random((2, 80))})
    )
    assert [panel.title for panel in drawing.panels] == ["Reference", "Yours"]
    assert "90 points" in drawing.panels[1].caption
    assert "unit square" in drawing.panels[1].caption
    disk = draw(Figure("points", "", {"yours": rng.random((2, 90)) - 0.5}))
    assert "unit disk" in disk.panels[0].caption


def test_points_that_lie_far_off_are_told() -> None:
    points = np.random.default_rng(3).random((2, 400))
    points[0, 0] = 1e6
    points[1, 1] = np.nan
    points[1, 2] = 1e300
    drawing = draw(Figure("points", "", {"yours": points}))
    assert "2 of 400 points" in " ".join(drawing.notes)
    assert "1 of them outside" in drawing.panels[0].caption


def test_beside_a_histogram_is_each_value_over_its_number() -> None:
    """By how often its values come, a function that runs backwards is right."""
    u = np.random.default_rng(0).random(1000)
    alone = draw(Figure("histogram", "", {"yours": 1 - u, "u": u})).panels
    assert [one.title for one in alone] == ["How often each value occurs", "Each value over its u"]
    assert "<image" in alone[1].svg
    unknown = draw(Figure("histogram", "", {"yours": 1 - u, "u": u[:7]})).panels
    assert len(unknown) == 1


def test_a_histogram_says_its_range() -> None:
    drawing = draw(Figure("histogram", "", {"yours": np.linspace(0, 1, 1000) ** 2}))
    assert "1000 values from 0 to 1, mean 0.33" in drawing.panels[0].caption
    values = {"yours": np.linspace(0, 2, 90), "expected": np.linspace(0, 1, 90)}
    both = draw(Figure("histogram", "", values)).panels
    assert [panel.title for panel in both] == ["Reference", "Yours"]
    assert ["to 1, mean 0.5" in both[0].caption, "to 2, mean 1" in both[1].caption] == [True, True]


def test_plots_take_the_colour_of_the_page_and_load_nothing() -> None:
    for kind in ("points", "histogram"):
        odd: Any = kind
        panel = draw(Figure(odd, "", {"yours": np.random.default_rng(4).random((2, 50))})).panels[0]
        assert "currentColor" in panel.svg
        assert "http" not in panel.svg
        assert not re.search(r"#000000|stroke: *black", panel.svg)
        uri = panel.data_uri()
        ET.fromstring(b64decode(uri.partition(",")[2]))


def test_two_plots_on_a_page_share_no_name() -> None:
    svg = (
        draw(Figure("points", "", {"yours": np.random.default_rng(5).random((2, 50))}))
        .panels[0]
        .svg
    )
    one, other = (with_own_ids(svg, prefix) for prefix in ("a", "b"))
    names = [set(re.findall(r'\sid="([^"]+)"', text)) for text in (one, other)]
    assert names[0]
    assert not names[0] & names[1]
    used = set(re.findall(r'(?:href="#|url\(#)([^")]+)', one))
    assert used
    assert used <= names[0]


def test_plots_may_be_drawn_by_several_threads() -> None:
    values = np.random.default_rng(6).random((2, 200))
    found: list[int] = []

    def work() -> None:
        figures = [Figure("points", "", {"yours": values})] * 3
        found.extend(len(draw(figure).panels[0].svg) for figure in figures)

    threads = [Thread(target=work) for _ in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert len(found) == 12
    # Names in the file are random, all of one length.
    assert len(set(found)) == 1
