"""Plots: a figure for each comparison, labels that can be read, the same file for the same numbers."""

from dataclasses import replace
from itertools import pairwise
from pathlib import Path
from xml.etree import ElementTree as ET

import msgspec
import pytest
from hypothesis import given
from hypothesis import strategies as st

from course.base.errors import CourseError
from course.benchmarking.estimators import BENCHED, Module
from course.benchmarking.labels import spread
from course.benchmarking.measuring import Measured
from course.benchmarking.plot_data import comparisons
from course.benchmarking.plots import STYLE, check_matplotlib, draw, write_comparisons
from tests.benchmarking.curves import curve, measured

ABOUT = "RMSE against the converged picture; 1234 x 1234 pixels, mean of 3 seeds"

FOUR = measured(
    curve("regular", -0.5, scale=0.09, bias=0.01),
    curve("random", -0.5),
    curve("jittered", -0.75),
    curve("sobol", -0.75, scale=0.099),
)


@given(st.lists(st.floats(0, 1), max_size=12), st.floats(0.01, 0.2))
def test_labels_are_a_line_apart_and_in_order(heights: list[float], gap: float) -> None:
    placed = spread(heights, gap)
    pairs = sorted(zip(heights, placed, strict=True))
    assert sorted(placed) == pytest.approx([height for _, height in pairs])
    assert all(b - a >= gap * (1 - 1e-6) for a, b in pairwise(sorted(placed)))


@given(st.lists(st.integers(0, 100), unique=True, max_size=12))
def test_labels_that_are_apart_stay_where_they_are(heights: list[int]) -> None:
    assert spread(heights, 0.99) == pytest.approx(heights)


def test_labels_that_meet_move_by_as_little_as_they_can() -> None:
    assert spread([0.5, 0.5], 0.1) == pytest.approx([0.45, 0.55])
    # The third is pushed by the first two, which move back as far.
    assert spread([0.5, 0.5, 0.56], 0.1) == pytest.approx([0.42, 0.52, 0.62])


def test_without_matplotlib_the_extra_is_named(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("course.benchmarking.plots.find_spec", lambda _: None)
    with pytest.raises(CourseError, match=r"pip install -e '\.\[bench\]'"):
        check_matplotlib()


def words(path: Path) -> list[str]:
    tree = ET.parse(path)
    return ["".join(node.itertext()) for node in tree.iter("{http://www.w3.org/2000/svg}text")]


def test_figures_say_what_they_show(tmp_path: Path) -> None:
    pytest.importorskip("matplotlib")
    written = write_comparisons(FOUR, tmp_path, "a fast machine")
    names = ["soft_shadows_samplers_samples.svg", "soft_shadows_samplers_seconds.svg"]
    assert [path.name for path in written] == names
    samples, seconds = map(words, written)
    for text in (samples, seconds):
        assert "Soft shadows: some ways to place samples" in text
        assert "RMSE against the converged picture; 72 x 48 pixels, mean of 3 seeds" in text
        assert "error of the reference itself" in text
    assert {"samples for each pixel", "order -1/2", "1", "4", "16", "64", "256"} <= {*samples}
    orders = {"regular": -0.5, "random": -0.5, "jittered": -0.75, "Sobol": -0.75}
    assert {f"{name}  {order:.2f}" for name, order in orders.items()} <= {*samples}
    assert {"seconds", "a fast machine", *orders} <= {*seconds}


def test_a_grid_is_told_by_its_floor(tmp_path: Path) -> None:
    pytest.importorskip("matplotlib")
    grid = curve("grid sobol", -0.5, samples=(1, 4, 16), points=4, bias=0.0123)
    samples = words(write_comparisons(measured(curve("sobol", -1.0), grid), tmp_path, "")[0])
    assert "shadow rays for each pixel" in samples
    assert "bias 0.0123" in samples
    (tmp_path / "alone").mkdir()
    alone = words(write_comparisons(measured(grid), tmp_path / "alone", "")[0])
    assert not any("-0.50" in text for text in alone)
    # 16 samples of 4 points each.
    assert "64" in alone
    assert "256" not in alone


@pytest.mark.parametrize("module", BENCHED.values(), ids=list(BENCHED))
def test_every_label_is_within_its_figure(module: Module) -> None:
    pytest.importorskip("matplotlib")
    from matplotlib import rc_context
    from matplotlib.backends.backend_agg import FigureCanvasAgg

    # Of two lines at a time the ends meet, so that labels are moved.
    curves = tuple(
        replace(curve("random", -0.5 - 0.01 * (number // 2)), estimator=estimator)
        for number, estimator in enumerate(module.estimators)
    )
    everything = Measured(module, (1234, 1234), curves)
    for plot in comparisons(everything):
        for axis in plot.axes:
            with rc_context(STYLE):
                titled = msgspec.structs.replace(plot, title=f"{module.title}: {plot.title}")
                note = "A Processor With A Very Long Name And 64 Cores"
                figure = draw(titled, axis, ABOUT, note)
                renderer = FigureCanvasAgg(figure).get_renderer()
                for text in [*figure.texts, *figure.axes[0].texts]:
                    box = text.get_window_extent(renderer)
                    assert box.x0 >= 0, text
                    assert box.y0 >= 0, text
                    assert box.x1 <= figure.bbox.x1, text
                    assert box.y1 <= figure.bbox.y1, text


def test_the_same_numbers_make_the_same_file(tmp_path: Path) -> None:
    pytest.importorskip("matplotlib")
    bytes_of = []
    for name in ("a", "b"):
        (tmp_path / name).mkdir()
        bytes_of.append(
            [path.read_bytes() for path in write_comparisons(FOUR, tmp_path / name, "x")]
        )
    assert bytes_of[0] == bytes_of[1]


def test_one_estimator_alone_can_be_drawn(tmp_path: Path) -> None:
    pytest.importorskip("matplotlib")
    alone = measured(curve("sobol", -1.0, samples=(1,)))
    assert len(write_comparisons(alone, tmp_path, "")) == 2


def test_what_was_not_measured_has_no_figure(tmp_path: Path) -> None:
    pytest.importorskip("matplotlib")
    item = measured(curve("sobol", -1.0))
    nothing = replace(item, module=replace(item.module, groups={"lights": "none of them"}))
    assert write_comparisons(nothing, tmp_path, "") == []
