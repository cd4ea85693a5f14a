"""The measured parts of the documentation: in their place, and nothing else touched."""

import re
from dataclasses import replace
from pathlib import Path

import pytest

from course.base.errors import OutputError
from course.benchmarking.documents import (
    MARK,
    NAMES,
    check_documents,
    replace_marked,
    write_documents,
)
from course.benchmarking.estimators import BENCHED, FURTHER_BENCHED
from course.benchmarking.measuring import FULL, QUICK
from course.benchmarking.plot_data import read_records
from course.engine.functions.effects import PROJECT
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


@pytest.fixture
def docs(tmp_path: Path) -> Path:
    """Two documents with marks and nothing between them."""
    for name in NAMES:
        text = f"# Title\n\n<!-- {MARK}: begin -->\n<!-- {MARK}: end -->\n"
        (tmp_path / name).write_text(text, encoding="utf-8")
    check_documents(tmp_path)
    return tmp_path


def _headings(path: Path) -> list[str]:
    return re.findall(r"^### (.+)$", path.read_text(encoding="utf-8"), re.MULTILINE)


def test_both_documents_get_tables_plots_and_the_machine(docs: Path) -> None:
    results = [measured(curve("random", -0.5), curve("sobol", -1.0))]
    written = write_documents(results, QUICK, MACHINE, docs)
    assert [path.relative_to(docs).as_posix() for path in written] == [*NAMES, "data/bench.json"]
    accuracy, performance = (path.read_text(encoding="utf-8") for path in written[:2])
    assert "<!-- site: convergence soft_shadows samples -->" in accuracy
    assert "<!-- site: convergence soft_shadows seconds -->" in performance
    for text in (accuracy, performance):
        assert "An Example 3000, 2 of 4 logical cores" in text
        assert "`course bench soft_shadows --write-docs --quick`" in text
        assert "| sobol |" in text


def test_modules_that_were_not_measured_stay_as_they_are(docs: Path) -> None:
    soft = measured(curve("sobol", -1.0))
    others = [
        replace(soft, module=replace(soft.module, name=name)) for name in ("glossy", "textures")
    ]
    # The later ones first: documents have the course's order all the same.
    write_documents(others, QUICK, MACHINE, docs)
    before = (docs / "accuracy.md").read_text(encoding="utf-8")
    write_documents([measured(curve("random", -0.5))], FULL, MACHINE, docs)
    after = (docs / "accuracy.md").read_text(encoding="utf-8")
    for name in NAMES:
        assert _headings(docs / name) == ["Soft shadows", "Glossy", "Textures"]
    assert after.endswith(before[before.index("### Glossy") :])
    assert "`course bench soft_shadows --write-docs`" in after
    assert set(read_records(docs / "data" / "bench.json")) == {"soft_shadows", "glossy", "textures"}
    # Measured again, a module is replaced.
    write_documents([measured(curve("sobol", -1.0))], QUICK, MACHINE, docs)
    text = (docs / "accuracy.md").read_text(encoding="utf-8")
    assert "`course bench soft_shadows --write-docs`" not in text
    assert text.count("### Soft shadows") == 1


def test_a_data_file_of_something_else_is_told_before_the_work(docs: Path) -> None:
    (docs / "data" / "bench.json").write_text('{"glossy": 3}', encoding="utf-8")
    with pytest.raises(OutputError, match="measure again"):
        check_documents(docs)


@pytest.mark.parametrize("name", NAMES)
def test_the_documents_have_their_marks_and_every_module(name: str) -> None:
    text = (PROJECT / "docs" / name).read_text(encoding="utf-8")
    assert text.count(f"<!-- {MARK}: begin -->") == text.count(f"<!-- {MARK}: end -->") == 1
    shown = re.findall(
        r"^<!-- site: convergence (\w+) (?:samples|seconds) -->$", text, re.MULTILINE
    )
    assert shown == [*BENCHED, *FURTHER_BENCHED]
    assert set(shown) == set(read_records(PROJECT / "docs" / "data" / "bench.json"))
