"""Every module's notebook runs to its end, stubs and solutions, one after the other in one kernel.

One module here; `make stress` runs them all. Pictures are small here.
"""

import json
import re
from collections.abc import Iterator

import pytest

from course.engine.functions.effects import PROJECT
from course.engine.functions.modules import COURSE
from course.school.notebooks.making import notebook_of
from tests.lengths import LONG
from tests.school.grading.lent import ReferencesFile
from tests.school.notebooks.kernels import Kernel, kernel

CHOSEN = [*COURSE] if LONG else ["soft_shadows"]


@pytest.fixture(scope="module")
def shared(
    tmp_path_factory: pytest.TempPathFactory, references_file: ReferencesFile
) -> Iterator[Kernel]:
    home = tmp_path_factory.mktemp("course")
    (home / "assignments").mkdir()
    (home / "scenes").symlink_to(PROJECT / "scenes")
    with kernel(home / "assignments") as found:
        found.lend({module: references_file(module) for module in CHOSEN})
        yield found


def cells(module: str, folder: str) -> list[str]:
    """Of code; pictures are small."""
    text = (PROJECT / folder / f"{module}.py").read_text(encoding="utf-8")
    document = json.loads(notebook_of(module, text, PROJECT))
    codes = ["".join(one["source"]) for one in document["cells"] if one["cell_type"] == "code"]
    shorter = [re.sub(r"size=\(\d+, \d+\)", "size=(30, 20)", code) for code in codes]
    shorter = [re.sub(r"--patches 1000 --size 300x300", "--patches 200", c) for c in shorter]
    return [
        c.replace("effects=mine))", "effects=mine), seconds=0.1)") if "error_over" in c else c
        for c in shorter
    ]


@pytest.mark.parametrize("folder", ["assignments", "solutions"])
@pytest.mark.parametrize("module", CHOSEN)
def test_a_notebook_runs_to_its_end(shared: Kernel, module: str, folder: str) -> None:
    said = ""
    for cell in cells(module, folder):
        found = shared.run(cell)
        assert not found.error, f"{cell}\n{found.error}"
        said += found.text
    for name in COURSE[module]:
        state = "to do" if folder == "assignments" else "right"
        assert re.search(rf"{state} +{name}\b", said), said
    if folder == "solutions":
        assert said.count("10 of 10 points") == len(COURSE[module])
