"""The numbers behind the documentation's plots: what comes back from a file is what was measured."""

import json
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from benchmarks.figures import Figure, write_ratios
from benchmarks.report import keep, publish
from course.base.errors import OutputError
from course.benchmarking.measuring import FULL, QUICK, Effort
from course.benchmarking.plot_data import (
    STYLES,
    Plot,
    Record,
    Series,
    command,
    comparisons,
    read_records,
    record,
    rounded,
    write_records,
)
from course.engine.functions.effects import PROJECT
from tests.benchmarking.curves import curve, measured

MACHINE = {"processor": "An Example 3000", "threads": "2 of 4 logical cores"}
LINE = Series("Sobol", 2, {"samples": (1, 4), "seconds": (0.5, 2.25)}, (0.25, 0.125), order=-0.5)
GRID = Series("grid", 1, {"samples": (1, 4), "seconds": (1.0, 2.0)}, (0.5, 0.25), limit=0.125)
PLOT = Plot("samplers", "some", {"samples": "samples", "seconds": "s"}, "RMSE", (LINE, GRID))
RECORD = Record("a command", "2 seeds", MACHINE, (PLOT,))


def test_a_record_comes_back_as_it_was(tmp_path: Path) -> None:
    path = tmp_path / "data.json"
    other = Record("b", "", MACHINE, (Plot("a", "b", {}, "c", (), floor=0.5, slope=False),))
    write_records(path, {"one": RECORD, "two": other})
    assert read_records(path) == {"one": RECORD, "two": other}


def test_records_are_merged_by_module(tmp_path: Path) -> None:
    path = tmp_path / "data.json"
    write_records(path, {"one": RECORD, "two": RECORD})
    newer = Record("newer", "", {}, ())
    write_records(path, {"two": newer, "three": newer})
    assert read_records(path) == {"one": RECORD, "two": newer, "three": newer}


def test_a_list_of_numbers_is_one_line(tmp_path: Path) -> None:
    path = tmp_path / "data.json"
    write_records(path, {"one": RECORD})
    lines = path.read_text(encoding="utf-8").splitlines()
    assert [line.strip() for line in lines if "seconds" in line and "[" in line] == [
        '"seconds": [0.5, 2.25]',
        '"seconds": [1.0, 2.0]',
    ]


@given(st.floats(1e-12, 1e12))
def test_numbers_keep_six_digits(value: float) -> None:
    assert rounded(value) == pytest.approx(value, rel=0.5e-5)
    assert rounded(value) == float(f"{value:.5e}")


def test_what_has_no_place_on_logarithmic_axes_is_left_out(tmp_path: Path) -> None:
    line = Series("a", 0, {"samples": (1, 2, 4, 8)}, (0.5, 0.0, float("nan"), 0.25))
    path = tmp_path / "data.json"
    write_records(path, {"m": Record("", "", {}, (Plot("p", "p", {}, "y", (line,)),))})
    (kept,) = read_records(path)["m"].plots[0].series
    assert kept == Series("a", 0, {"samples": (1, 8)}, (0.5, 0.25))


@pytest.mark.parametrize("text", ["", "[]", '{"a": 3}', '{"a": {"plots": [{}]}}'])
def test_another_file_is_refused(tmp_path: Path, text: str) -> None:
    path = tmp_path / "data.json"
    path.write_text(text, encoding="utf-8")
    with pytest.raises(OutputError, match="remove it and measure again"):
        read_records(path)
    assert path.read_text(encoding="utf-8") == text


def test_a_comparison_has_every_curve_along_both_axes() -> None:
    (plot,) = comparisons(measured(curve("random", -0.5), curve("sobol", -1.0, floor=1e-4)))
    random, sobol = plot.series
    assert (random.name, sobol.name) == ("random", "Sobol")
    assert (random.style, sobol.style) == (STYLES["random"], STYLES["sobol"])
    samples = (1, 4, 16, 64, 256)
    assert random.x["samples"] == sobol.x["samples"] == samples
    assert random.x["seconds"] == pytest.approx([0.01 * n for n in samples])
    assert random.y == pytest.approx([0.1 * n**-0.5 for n in samples])
    assert random.order == pytest.approx(-0.5)
    assert sobol.order == pytest.approx(-1.0)
    # The worst of the references.
    assert plot.floor == 1e-4


def test_a_grid_of_lights_is_drawn_over_its_rays_with_its_bias() -> None:
    grid = curve("grid sobol", -0.5, samples=(1, 4), points=16, bias=0.03)
    (plot,) = comparisons(measured(curve("sobol", -1.0), grid))
    assert plot.axes["samples"] == "shadow rays for each pixel"
    line = plot.series[1]
    assert line.x["samples"] == (16, 64)
    assert (line.limit, line.order) == (0.03, None)
    # A bias that is as small as the reference's own error is none.
    unclear = curve("grid sobol", -0.5, samples=(1, 4), points=16, bias=1.9e-5)
    assert comparisons(measured(unclear))[0].series[0].limit is None


def test_the_command_measures_the_same_again() -> None:
    assert command("glossy", FULL) == "course bench glossy --write-docs"
    assert command("glossy", QUICK) == "course bench glossy --write-docs --quick"
    lower = Effort("quick", 33, QUICK.samples, QUICK.seeds, QUICK.reference)
    assert command("glossy", lower) == "course bench glossy --write-docs --quick --height 33"
    one = Effort("full", 80, (1,), 1, 2)
    assert record(measured(curve("sobol", -1.0)), one, MACHINE).about == "72 x 48 pixels, 1 seed"


# ---------------------------------------------------------------- the modules' own benchmarks


def test_curves_are_kept_and_published(tmp_path: Path) -> None:
    kept, docs = tmp_path / "kept", tmp_path / "docs"
    kept.mkdir()
    (kept / "radiosity.json").write_text("from another version", encoding="utf-8")
    for about in ("old", "new"):
        keep("radiosity", about, [PLOT], kept)
    assert publish(["radiosity", "engine"], docs, kept) == [docs / "radiosity.json"]
    (found,) = read_records(docs / "radiosity.json").values()
    assert (found.about, found.plots) == ("new", (PLOT,))
    assert found.command == "python -m benchmarks radiosity --write-docs"


def test_a_part_s_figures_leave_the_others_in_the_table(tmp_path: Path) -> None:
    page = tmp_path / "performance.md"
    page.write_text("a\n<!-- make bench: begin -->\n<!-- make bench: end -->\n", encoding="utf-8")
    first, second = (Figure(name, 1.23456, 1.0, 2.0, 3.0) for name in ("first", "second"))
    order = ("engine", "grading")
    write_ratios({"grading": [second]}, {"processor": "slow"}, tmp_path, order)
    write_ratios({"engine": [first]}, {"processor": "fast"}, tmp_path, order)
    text = page.read_text(encoding="utf-8")
    assert text.index("| first | 1.23 |") < text.index("| second | 1.23 |")
    assert "`python -m benchmarks engine --write-docs` on fast." in text
    assert "`python -m benchmarks grading --write-docs` on slow." in text
    data = json.loads((tmp_path / "data" / "ratios.json").read_text(encoding="utf-8"))
    assert data["engine"]["figures"][0]["value"] == 1.23456


@pytest.mark.parametrize("path", sorted((PROJECT / "docs" / "data").glob("*.json")), ids=str)
def test_the_files_of_the_documentation_are_small_and_whole(path: Path) -> None:
    assert path.stat().st_size < 64_000
    if path.stem in ("ratios", "peers", "peer_agreement"):
        return
    for found in read_records(path).values():
        assert found.command
        assert found.machine["processor"]
        for plot in found.plots:
            for series in plot.series:
                assert set(series.x) == set(plot.axes)
                for values in (*series.x.values(), series.y):
                    assert len(values) == len(series.y) > 1
                    assert (np.array(values) > 0).all()
