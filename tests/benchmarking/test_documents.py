"""The measured parts of the documentation: in their place, and nothing else touched."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from course.benchmarking.documents import MARK, replace_marked, write_documents
from course.benchmarking.estimators import BENCHED
from course.benchmarking.measuring import QUICK
from course.effects import PROJECT
from course.errors import OutputError
from tests.benchmarking.curves import curve, measured

BEGIN, END = "<!-- m: begin -->", "<!-- m: end -->"
MACHINE = {"processor": "An Example 3000", "threads": "2 of 4 logical cores"}


def test_what_is_between_the_marks_is_replaced(tmp_path: Path) -> None:
    path = tmp_path / "a.md"
    path.write_text(f"before\n{BEGIN}\nold\n{END}\nafter\n", encoding="utf-8")
    for _ in range(2):
        replace_marked(path, "m", "new")
        assert path.read_text(encoding="utf-8") == f"before\n{BEGIN}\n\nnew\n\n{END}\nafter\n"


@pytest.mark.parametrize(
    "text", ["", f"{BEGIN}\n", f"{END}\n{BEGIN}\n", f"{BEGIN}{BEGIN}{END}", f"{BEGIN}{END}{END}"]
)
def test_a_file_without_both_marks_is_left_alone(tmp_path: Path, text: str) -> None:
    path = tmp_path / "a.md"
    path.write_text(text, encoding="utf-8")
    with pytest.raises(OutputError, match="once each"):
        replace_marked(path, "m", "new")
    assert path.read_text(encoding="utf-8") == text


def test_a_missing_file_is_told(tmp_path: Path) -> None:
    with pytest.raises(OutputError, match="can't be read"):
        replace_marked(tmp_path / "a.md", "m", "new")


def test_both_documents_get_tables_figures_and_the_machine(tmp_path: Path) -> None:
    for name in ("accuracy.md", "performance.md"):
        text = f"# Title\n\n<!-- {MARK}: begin -->\n<!-- {MARK}: end -->\n"
        (tmp_path / name).write_text(text, encoding="utf-8")
    results = [measured(curve("random", -0.5), curve("sobol", -1.0))]
    written = write_documents(results, QUICK, MACHINE, tmp_path)
    accuracy, performance = (path.read_text(encoding="utf-8") for path in written)
    assert [path.name for path in written] == ["accuracy.md", "performance.md"]
    assert "figures/soft_shadows_samplers_samples.svg" in accuracy
    assert "figures/soft_shadows_samplers_seconds.svg" in performance
    for text in (accuracy, performance):
        assert "An Example 3000, 2 of 4 logical cores" in text
        assert "`course bench --write-docs --quick`" in text
        assert "| sobol |" in text


@pytest.mark.parametrize("name", ["accuracy.md", "performance.md"])
def test_the_documents_have_their_marks_and_their_figures(name: str) -> None:
    text = (PROJECT / "docs" / name).read_text(encoding="utf-8")
    assert text.count(f"<!-- {MARK}: begin -->") == text.count(f"<!-- {MARK}: end -->") == 1
    figures = re.findall(r"\]\((figures/\w+\.svg)\)", text)
    assert all((PROJECT / "docs" / figure).is_file() for figure in figures)
    expected = sum(len(module.groups) for module in BENCHED.values())
    assert len(set(figures)) >= expected
