"""`course bench`: what is measured, where it is written, and what is refused before the work."""

import json
import re
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from benchmarks.__main__ import MEASURES
from course.benchmarking import measuring
from course.benchmarking.estimators import BENCHED, FURTHER_BENCHED, Estimator, Module
from course.benchmarking.measuring import FULL, QUICK, Effort, Measured
from course.cli.bench import ELSEWHERE, EXACT
from course.engine.functions.modules import COURSE, MODULES
from tests.benchmarking.curves import curve
from tests.cli.conftest import Run


class Bench:
    """A stand-in for the measurement."""

    def __init__(self) -> None:
        self.measured: list[tuple[str, tuple[str, ...]]] = []
        self.efforts: list[Effort] = []
        self.options: list[dict[str, Any]] = []
        self.error: BaseException | None = None

    def __call__(
        self, module: Module, estimators: tuple[Estimator, ...], effort: Effort, **options: Any
    ) -> Measured:
        if self.error is not None:
            raise self.error
        self.measured.append((module.name, tuple(e.name for e in estimators)))
        self.efforts.append(effort)
        self.options.append(options)
        curves = tuple(replace(curve("sobol", -0.75), estimator=e) for e in estimators)
        return Measured(module, (72, 48), curves)


@pytest.fixture
def bench(monkeypatch: pytest.MonkeyPatch) -> Bench:
    stand_in = Bench()
    monkeypatch.setattr(measuring, "measure", stand_in)
    return stand_in


def test_without_arguments_everything_is_measured(run: Run, bench: Bench) -> None:
    result = run("bench")
    assert result.exit_code == 0, result.output
    assert [name for name, _ in bench.measured] == list(MODULES)
    for name, estimators in bench.measured:
        assert estimators == tuple(e.name for e in BENCHED[name].estimators)
        assert f"{name.replace('_', ' ')}, 72 x 48 pixels" in result.stdout
    assert set(bench.efforts) == {FULL}


def test_modules_and_estimators_can_be_chosen(run: Run, bench: Bench) -> None:
    result = run("bench", "glossy", "soft_shadows", "--estimator", "Ball", "--estimator", "grid 2")
    assert result.exit_code == 0, result.output
    assert bench.measured == [
        ("glossy", ("ball sobol",)),
        ("soft_shadows", ("ball sobol", "grid 2 x 2 sobol")),
    ]


def test_a_module_without_a_chosen_estimator_is_left_out(run: Run, bench: Bench) -> None:
    assert run("bench", "thin_lens", "glossy", "--estimator", "phong").exit_code == 0
    assert [name for name, _ in bench.measured] == ["glossy"]


def test_quick_and_height(run: Run, bench: Bench) -> None:
    assert run("bench", "--quick", "cube_map").exit_code == 0
    assert run("bench", "--height", "33", "cube_map").exit_code == 0
    assert run("bench", "--references", "elsewhere", "cube_map").exit_code == 0
    assert bench.efforts[0] == QUICK
    assert (bench.efforts[1].height, bench.efforts[1].samples) == (33, FULL.samples)
    assert [options["folder"] for options in bench.options] == [
        Path("out", "references"),
        Path("out", "references"),
        Path("elsewhere"),
    ]


def test_json_holds_the_machine_the_effort_and_every_curve(run: Run, bench: Bench) -> None:
    assert run("bench", "--quick", "thin_lens", "--json", "bench.json").exit_code == 0
    data = json.loads(Path("bench.json").read_text(encoding="utf-8"))
    assert {"processor", "threads", "system", "software"} <= data["machine"].keys()
    assert data["effort"]["name"] == "quick"
    (module,) = data["modules"]
    assert module["module"] == "thin_lens"
    assert [e["estimator"] for e in module["estimators"]] == list(dict(bench.measured)["thin_lens"])
    assert module["estimators"][0]["order"]["value"] == pytest.approx(-0.75)


@pytest.mark.usefixtures("bench")
def test_plots_go_into_a_new_folder(run: Run) -> None:
    pytest.importorskip("matplotlib")
    assert run("bench", "glossy", "--plots", Path("new", "folder")).exit_code == 0
    names = {path.name for path in Path("new", "folder").iterdir()}
    assert names == {
        f"glossy_{group}_{kind}.svg"
        for group in BENCHED["glossy"].groups
        for kind in ("samples", "seconds")
    }


@pytest.mark.usefixtures("bench")
def test_docs_are_written(run: Run, monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    # Without matplotlib: the site draws the plots.
    monkeypatch.setattr("course.benchmarking.plots.find_spec", lambda _: None)
    docs = tmp_path / "docs"
    docs.mkdir()
    marks = "<!-- course bench: begin -->\n<!-- course bench: end -->\n"
    for name in ("accuracy.md", "performance.md"):
        (docs / name).write_text(f"kept\n{marks}kept too\n", encoding="utf-8")
    monkeypatch.setattr("course.cli.bench.DOCUMENTS", docs)
    result = run("bench", "--write-docs")
    assert result.exit_code == 0, result.output
    text = (docs / "performance.md").read_text(encoding="utf-8")
    assert text.startswith("kept\n")
    assert text.endswith("kept too\n")
    assert "### Cube map" in text
    assert "### Textures" in text
    data = json.loads((docs / "data" / "bench.json").read_text(encoding="utf-8"))
    assert list(data) == [*BENCHED, *FURTHER_BENCHED]
    for name, module in BENCHED.items():
        assert [plot["name"] for plot in data[name]["plots"]] == list(module.groups)


def test_docs_can_be_written_for_some_modules(
    run: Run, bench: Bench, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    marks = "<!-- course bench: begin -->\n<!-- course bench: end -->\n"
    for name in ("accuracy.md", "performance.md"):
        (tmp_path / name).write_text(marks, encoding="utf-8")
    monkeypatch.setattr("course.cli.bench.DOCUMENTS", tmp_path)
    for name in ("glossy", "thin_lens"):
        assert run("bench", name, "--write-docs").exit_code == 0
    assert [name for name, _ in bench.measured] == ["glossy", "thin_lens"]
    data = json.loads((tmp_path / "data" / "bench.json").read_text(encoding="utf-8"))
    assert list(data) == ["glossy", "thin_lens"]


@pytest.mark.parametrize(
    ("arguments", "exit_code", "told"),
    [
        (["--estimator", "nothing"], 1, "no estimator is named like 'nothing'; there are box"),
        (["soft_shadow"], 2, "'soft_shadow'; the modules measured here are supersampling, "),
        *(
            ([name], 2, f"{name} is measured by `python -m benchmarks {name}`")
            for name in ELSEWHERE
        ),
        (["--json", "bench.txt"], 2, "doesn't end in .json"),
        (["--json", "no/folder/b.json"], 1, "there is no folder"),
        (["--height", "10"], 2, "11<=x<=4096"),
        (["--estimator", "sobol", "--write-docs"], 2, "leave --estimator out"),
    ],
)
def test_what_can_not_be_done_is_refused_before_the_work(
    run: Run, bench: Bench, arguments: list[str], exit_code: int, told: str
) -> None:
    result = run("bench", *arguments)
    assert result.exit_code == exit_code
    assert told in result.output
    assert not bench.measured


def test_help_lists_every_module_with_the_command_that_measures_it(run: Run) -> None:
    text = " ".join(run("bench", "--help").output.split())
    here, _, there = text.partition("Modules: ")[2].partition("`python -m benchmarks NAME`")
    named = [re.findall(r"[a-z]+(?:_[a-z]+)*", part) for part in (here, there.partition(": ")[2])]
    assert named == [list(BENCHED | FURTHER_BENCHED), list(ELSEWHERE)]
    # The programs are there, and no module is forgotten.
    assert set(ELSEWHERE) <= set(MEASURES)
    assert {*here.replace(".", "").replace(",", "").split(), *ELSEWHERE, *EXACT} == set(COURSE)


def test_plots_without_matplotlib_are_refused_before_the_work(
    run: Run, bench: Bench, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("course.benchmarking.plots.find_spec", lambda _: None)
    result = run("bench", "--plots", "plots")
    assert result.exit_code == 1
    assert "pip install -e '.[bench]'" in result.stderr
    assert not bench.measured


@pytest.mark.usefixtures("bench")
def test_without_plots_matplotlib_is_not_asked_for(
    run: Run, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("course.benchmarking.plots.find_spec", lambda _: None)
    assert run("bench", "glossy").exit_code == 0


def test_ctrl_c_is_130(run: Run, bench: Bench) -> None:
    bench.error = KeyboardInterrupt()
    assert run("bench", "glossy").exit_code == 130


def test_docs_that_are_not_there_are_told_before_the_work(
    run: Run, bench: Bench, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    monkeypatch.setattr("course.cli.bench.DOCUMENTS", tmp_path)
    result = run("bench", "--write-docs")
    assert result.exit_code == 1
    assert "accuracy.md: can't be read" in result.stderr
    assert not bench.measured
