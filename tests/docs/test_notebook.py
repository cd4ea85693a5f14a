"""The tutorial notebook: without outputs in the repository, and run from its first cell to its last."""

import base64
import re
from io import BytesIO
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from PIL import Image

from course.engine.functions.effects import PROJECT

pytest.importorskip("nbformat", reason='notebooks need: pip install -e ".[notebook]"')
pytest.importorskip("nbclient", reason='notebooks are run by: pip install -e ".[notebook]"')
pytest.importorskip("ipykernel", reason='notebooks are run by: pip install -e ".[notebook]"')
pytest.importorskip("sphinx", reason='the site needs: pip install -e ".[docs]"')

import nbformat
from sitebuild import notebook
from sitebuild.place import Place

SOURCE = PROJECT / "docs" / "notebooks" / "first_look.ipynb"


@pytest.fixture(scope="module")
def kept(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return tmp_path_factory.mktemp("kept")


@pytest.fixture(scope="module")
def cells(kept: Path) -> list[Any]:
    """The code cells, run."""
    run = nbformat.read(notebook.executed(SOURCE, kept), as_version=4)
    return [cell for cell in run.cells if cell.cell_type == "code"]


def test_it_is_kept_without_outputs() -> None:
    source = nbformat.read(SOURCE, as_version=4)
    nbformat.validate(source)
    for cell in source.cells:
        if cell.cell_type == "code":
            assert (cell.outputs, cell.execution_count) == ([], None)


def _pictures(cells: list[Any]) -> list[Image.Image]:
    return [
        Image.open(BytesIO(base64.b64decode(output.data["image/png"])))
        for cell in cells
        for output in cell.outputs
        if "image/png" in output.get("data", {})
    ]


def test_every_cell_runs_and_shows_what_its_text_says(cells: list[Any]) -> None:
    assert [cell.execution_count for cell in cells] == [*range(1, len(cells) + 1)]
    soft, hard, difference, curves = _pictures(cells)
    assert soft.size == hard.size == (300, 200)
    # A hard shadow is where the penumbra was; far from shadows they are alike.
    apart = np.abs(np.asarray(soft, np.float64) - np.asarray(hard, np.float64)).max(axis=2)
    assert apart.max() > 60
    assert np.median(apart) < 8
    assert difference.width > 300
    assert curves.width > 300


def test_the_error_falls_as_the_text_says(cells: list[Any]) -> None:
    printed = "".join(cells[-1].outputs[0]["text"])
    errors = {
        line.split()[0]: [float(error) for error in re.findall(r"0\.\d+", line)]
        for line in printed.splitlines()
    }
    # The seeds are fixed, so chance decides nothing here.
    ratios = np.divide(errors["random"][:-1], errors["random"][1:])
    assert np.all((ratios > 1.8) & (ratios < 2.2))
    assert errors["sobol"][-1] < errors["random"][-1] / 2


def test_every_picture_has_its_text(cells: list[Any]) -> None:
    for cell in cells:
        if _pictures([cell]):
            assert cell.metadata["alt"]


def test_what_was_run_is_kept(cells: list[Any], kept: Path) -> None:
    assert cells
    before = [(file, file.stat().st_mtime_ns) for file in kept.iterdir()]
    notebook.executed(SOURCE, kept)
    assert [(file, file.stat().st_mtime_ns) for file in kept.iterdir()] == before
    assert len(before) == 1


def test_the_page_has_cells_outputs_and_the_file(
    cells: list[Any], kept: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    run = notebook.executed(SOURCE, kept)
    monkeypatch.setattr(notebook, "executed", lambda _: run)
    place = Place("../", blank=False, made=tmp_path, files={})
    text = notebook.notebook(place, "first_look")
    assert text.count("```python") == len(cells)
    assert text.count("```text") == 2
    assert text.count("<img") == len(place.files) - 1 == 4
    assert place.files["_notebooks/first_look.ipynb"] == SOURCE
    assert "# A first look" not in text
    blank = notebook.notebook(
        SimpleNamespace(**vars(place) | {"blank": True, "address": place.address}), "first_look"
    )
    # What stands in for outputs looks as they do.
    assert (blank.count("<img"), blank.count("```text")) == (4, 2)
    assert re.findall(r'alt="[^"]*"', blank) == re.findall(r'alt="[^"]*"', text)
