"""A notebook is graded as Jupyter runs it: the same cells are run by IPython's own shell, and give the same."""

import ast
import json
import random
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from IPython.core.interactiveshell import InteractiveShell
from traitlets.config import Config

from benchmarks.mutants.cells import in_cells
from course.engine.functions.modules import COURSE
from course.engine.functions.notebook.reading import Notebook, NotebookError, read_notebook
from course.engine.functions.notebook.reading import converted as converted_notebook
from course.engine.functions.sources import cells_of
from course.school.grading.classes.job import GradingJob, grade_job
from course.school.grading.classes.keeping import fingerprint
from course.school.grading.classes.settings import GradingSettings
from course.school.grading.classes.submitted import find_submissions
from course.school.grading.grading import grade
from course.school.grading.known import known
from course.school.grading.places import told_of
from course.school.grading.references import references
from course.school.grading.reports.classes import ClassLine, write_class_page, write_grades

BLUR = "def displacement(velocity, time):\n    return np.asarray(velocity)[:, None] * time * {factor}\n"
VELOCITY, TIME = np.array([1.0, 2.0, -3.0]), np.array([0.0, 0.5])


def notebook(*cells: str, **more: Any) -> bytes:
    made: list[dict[str, Any]] = [
        {"cell_type": "code", "metadata": {}, "source": cell.splitlines(keepends=True)}
        for cell in cells
    ]
    return json.dumps({"cells": made, "nbformat": 4, "metadata": {}} | more).encode()


def converted(*cells: str) -> Notebook:
    found = converted_notebook((notebook(*cells), ("motion_blur",)))
    assert isinstance(found, Notebook)
    return found


def moved(source: bytes) -> Any:
    """What a module's function gives."""
    space: dict[str, Any] = {"__name__": "motion_blur"}
    exec(compile(source, "motion_blur.py", "exec", dont_inherit=True), space)
    return space["displacement"](VELOCITY, TIME)


@pytest.fixture
def shell(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[InteractiveShell]:
    monkeypatch.setenv("IPYTHONDIR", str(tmp_path / "ipython"))
    settings = Config()
    settings.HistoryManager.enabled = False
    yield InteractiveShell.instance(config=settings)
    InteractiveShell.clear_instance()


LIKE_JUPYTER = {
    "time over a definition": ("%%time\n" + BLUR.format(factor=1),),
    "magics over each other": ("\n%%capture\n%%time\n" + BLUR.format(factor=2),),
    "time in a line": (
        "%time factor = [3.0]",
        "factor[0] = %time 2 * factor[0]",
        BLUR.format(factor="factor[0]"),
    ),
    "commands and help": (
        "np.where?\nfiles = !echo\n!echo\n%precision 3\n" + BLUR.format(factor=1),
    ),
    "magic below others": (
        "for i in range(2):\n    %time t = i\n    %matplotlib -l\nfactor = t",
        BLUR.format(factor="factor"),
    ),
    "item": ("one = [0.0]", "one[0] = 5.0", BLUR.format(factor="one[0]")),
    "attribute": (
        "class One: a = 1",
        "One.a = 7",
        BLUR.format(factor="One.a"),
    ),
    "attribute of a function": (
        BLUR.format(factor="displacement.factor"),
        "displacement.factor = 3",
    ),
    "augmented": ("one = np.float32([0.5])", "one *= 3", BLUR.format(factor="one[0]")),
    "rebound": (BLUR.format(factor="f"), "f = 3", "f = f + 1", "g = 9"),
    "called to change": ("t = []", "t.append(4)", "t.extend([5])", BLUR.format(factor="t[1]")),
    "updated": ("t = {}", "t.update(a=6)", BLUR.format(factor="t['a']")),
    "in a loop": (
        "t = np.zeros(4)",
        "for i in range(4):\n    t[i] = i * i",
        BLUR.format(factor="t[3]"),
    ),
    "by another name": ("t = [1, 2]", "s = t", "s.reverse()", BLUR.format(factor="t[0]")),
    "augmented by another name": (
        "t = [1]",
        "s = t",
        "s += [2, 3]",
        BLUR.format(factor="len(t)"),
    ),
    "by rows": ("t = [[1], [2]]", "for r in t:\n    r[0] += 3", BLUR.format(factor="t[1][0]")),
    "handed over": ("t = np.zeros(2)", "np.copyto(t, 8.0)", BLUR.format(factor="t[1]")),
    "handed to out": ("t = np.ones(2)", "np.add(t, 1, out=t)", BLUR.format(factor="t[1]")),
    "ufunc.at": ("t = np.ones(2)", "np.add.at(t, [0, 0], 2)", BLUR.format(factor="t[0]")),
    "by a helper": (
        "t = []\ndef fill():\n    s = t\n    s.append(3)\ndef twice():\n    fill(); fill()",
        "twice()",
        BLUR.format(factor="len(t)"),
    ),
    "global": ("def setup():\n    global k\n    k = 4", "setup()", BLUR.format(factor="k")),
    "registered": (
        "table = {}\ndef register(f):\n    table[f.__name__] = f\n    return f",
        "@register\ndef four():\n    return 4",
        BLUR.format(factor="table['four']()"),
    ),
    "closure": (
        "t = [1]",
        "change = lambda: t.append(6)",
        "change()",
        BLUR.format(factor="t[-1]"),
    ),
    "below if, try and with": (
        "if True:\n    k = 2\ntry:\n    j = 3\nexcept ValueError:\n    j = 4",
        "with np.errstate(all='ignore'):\n    "
        + BLUR.format(factor="k * j").replace("\n", "\n    "),
    ),
    "the notebook is main": ("if __name__ == '__main__':\n    k = 3", BLUR.format(factor="k")),
    "star": (
        "from numpy import *",
        "def displacement(velocity, time):\n    return asarray(velocity)[:, None] * time",
    ),
    "several in a line": ("k = 1; k += 2; print(k)", BLUR.format(factor="k")),
    "walrus": ("(k := 5)", BLUR.format(factor="k")),
    "walrus in a list": ("[k := i for i in range(4)]", BLUR.format(factor="k")),
    "deleted": ("k = 1\nsum = 5\ndel sum", BLUR.format(factor="sum([k, k])")),
    "unpacked": ("(a, *b), k = [1, 2, 3], 4", BLUR.format(factor="b[1] * k")),
    "matched": ("match (1, 2):\n    case (a, k):\n        pass", BLUR.format(factor="k")),
    "setattr": (
        "class One: pass",
        "setattr(One, 'k', 3)",
        BLUR.format(factor="One.k"),
    ),
    "an object": (
        "class Box:\n    def __init__(self):\n        self.k = 1\n    def grow(self):\n        self.k += 1",
        "box = Box()",
        "box.grow()",
        BLUR.format(factor="box.k"),
    ),
    "named by a text": ("globals()['k'] = 3", BLUR.format(factor="k")),
    "exec": ("exec('k = 3')", BLUR.format(factor="k")),
    "redefined": (BLUR.format(factor=1), BLUR.format(factor=2)),
    "wrapped": (
        BLUR.format(factor=1),
        "old = displacement",
        "displacement = lambda *a: 2 * old(*a)",
    ),
    "drawing beside changes": (
        "t = [1]",
        "for i in range(3):\n    t.append(i)\n    display(len(t))",
        "display(t.pop())",
        BLUR.format(factor="len(t)"),
    ),
    "a line that is no line": (
        "# pasted\u2028text\u2029and\x0bmore\x85\nk = 'a\u2028b'",
        "k = len(k) # \u2028\n" + BLUR.format(factor="k"),
    ),
    "ends of lines": ("k = 1\r\nk = 2\rk = 3\r\n", BLUR.format(factor="k")),
    "indented": ("    k = 2\n    k += 1", BLUR.format(factor="k")),
    "prompts": (">>> k = 2\n>>> k += 1", "In [3]: j = 2", BLUR.format(factor="k * j")),
    "doctest in a text": ('k = """\n%time x\n!ls\n"""', BLUR.format(factor="len(k)")),
    "a comment over a magic's name": ("#%%time\nk = 3", BLUR.format(factor="k")),
    "a name of a package that is something else": (
        "import time\nt = time.time()",
        "t = [1]",
        "t.append(4)",
        "from numpy import add as render\ndef render(t): t.append(5)",
        "render(t)",
        BLUR.format(factor="len(t) * t[1]"),
    ),
    "star below try": (
        "try:\n    from numpy import *\nexcept ImportError:\n    pass",
        "def displacement(velocity, time):\n    return asarray(velocity)[:, None] * time",
    ),
    "from the future": (
        "k = 2",
        "from __future__ import annotations",
        "def displacement(velocity: Nothing, time):\n    return velocity[:, None] * time * k",
    ),
}


# IPython warns of U+2028, goes on, and is right.
@pytest.mark.filterwarnings("ignore:.make_tokens_by_line")
@pytest.mark.parametrize("name", LIKE_JUPYTER)
def test_what_jupyter_runs_is_what_is_graded(name: str, shell: InteractiveShell) -> None:
    cells = ("import numpy as np", *LIKE_JUPYTER[name])
    for cell in cells:
        assert shell.run_cell(cell).success, cell
    right = shell.user_ns["displacement"](VELOCITY, TIME)
    found = converted(*cells)
    assert not [told for told in found.told if "no Python" in told]
    np.testing.assert_array_equal(moved(found.sources["motion_blur"]), right)


def test_which_of_several_definitions_counts_is_told_by_cells() -> None:
    cells = (
        BLUR.format(factor="TWICE"),
        "TWICE = 2",
        "import numpy as np",
        "TWICE = 3\nbeside = 1",
    )
    told = "cell 4, line 1: binds TWICE, which cell 2 above does, too: cell 4 counts"
    assert converted(*cells).told[0] == told
    last = converted(*cells, "if True:\n    beside = displacement = abs").told[0]
    assert last == "cell 5, line 1: binds displacement, which cell 1 above does, too: cell 5 counts"
    # Within a cell, and the same import again, is nothing that %%check hasn't seen.
    same = converted(
        "import numpy as np", "import numpy as np\nA = 1\nA = 2", BLUR.format(factor="A")
    )
    assert same.told == ()


def test_cells_are_told_with_the_numbers_that_jupyter_shows(tmp_path: Path) -> None:
    document = json.loads(notebook("TWICE = 2", BLUR.format(factor="TWICE"), "TWICE = 1"))
    for number, cell in enumerate(document["cells"]):
        cell["execution_count"] = 7 + number
    file = tmp_path / "motion_blur.ipynb"
    file.write_text(json.dumps(document), encoding="utf-8")
    assert (
        "cell 3 (In[9]), line 1: binds TWICE, which cell 1 (In[7])"
        in cells_of(file, "motion_blur").told[0]
    )
    assert told_of(file, "motion_blur", "displacement") == f"{file}, cell 2 (In[8]), line 1"
    assert told_of(file, "motion_blur", "shutter_times") == str(file)


def test_what_is_tried_out_beside_is_gone_and_told() -> None:
    found = converted(
        "%matplotlib inline\nimport numpy as np\nimport matplotlib.pyplot as plt\nfrom course import render",
        "scale = np.ones(3)\n" + BLUR.format(factor="scale[0]"),
        "fig, ax = plt.subplots()\nax.plot(displacement(np.ones(3), np.ones(2))[0], scale)",
        "u = np.random.default_rng(1).random(1000)\nwhile True:\n    u += 1",
        "render('scene.yaml')\nplt.imshow(scale[None])\nprint(scale, scale.sum())\nraise SystemExit",
        "assert displacement(np.ones(3), np.ones(2)).shape == (3, 2)\n1 / 0",
    )
    assert ast.dump(ast.parse(found.sources["motion_blur"])) == ast.dump(
        ast.parse("import numpy as np\nscale = np.ones(3)\n" + BLUR.format(factor="scale[0]"))
    )
    assert found.told == ("left out, for no function needs it: cell 3, line 1; cell 4, lines 1, 2",)


@pytest.mark.parametrize(
    ("cell", "told"),
    [
        ("\n\nk = 1\nfiles = !ls -l", "cell 2, line 4: left out: files = !ls -l"),
        ("k = %run other.py", "cell 2, line 1: left out: k = %run other.py"),
        ("k = 1\n%run other.py", "cell 2, line 2: left out: %run other.py"),
        ("%%bash\nls", "cell 2, line 1: the cell is left out, as %%bash is no Python here"),
        ("%%timeit\nk = 1", "cell 2, line 1: what stands under %%timeit defines nothing"),
        ("\n%%time\n\nk = !ls", "cell 2, line 4: left out: k = !ls"),
        ("k = 1\nthis is a remark", "cell 2, line 2: is no Python, so the cell is left out"),
        ("k = await f()", "cell 2, line 1: left out: k = await f()"),
        ("return 3", "cell 2, line 1: left out: 'return' outside function"),
        ("%alias_magic \\\n  a b\nk = 1\nj = !ls", "cell 2, line 4: left out: j = !ls"),
        ("k = " + "-" * 900 + "1", "cell 2, line 1: is n"),
        ("%%writefile helpers.py\nk = 3", "helpers.py, which a cell writes, is left out"),
        ("if 'colab' in str(get_ipython()):\n    k = 1", "cell 2, line 1: left out: if 'colab'"),
    ],
)
def test_what_can_t_be_taken_over_is_told_by_cell_and_line(cell: str, told: str) -> None:
    found = converted("import numpy as np", cell, BLUR.format(factor=1))
    assert any(one.startswith(told) for one in found.told), found.told
    assert moved(found.sources["motion_blur"]).shape == (3, 2)


@pytest.mark.parametrize(
    "cell", ["!ls", "np.sin?", "%matplotlib inline", "%%html\n<b>", "%%timeit\n1+1", "%pip list"]
)
def test_what_changes_nothing_isn_t_worth_a_word(cell: str) -> None:
    assert converted("import numpy as np", cell, BLUR.format(factor=1)).told == ()


def test_a_file_that_a_cell_writes_is_that_file(tmp_path: Path) -> None:
    text = "import numpy as np\n" + BLUR.format(factor=1)
    lens = "def point_on_disk(u):\n    return u\n"
    content = notebook(
        "%%writefile -a motion_blur.py\n" + text[:19],
        "%%file 'work/thin_lens.py'\n" + lens,
        "%%writefile --append motion_blur.py\n" + text[19:],
        "def displacement(velocity, time):\n    return 0",
    )
    for name in ("hw1.ipynb", "motion_blur.ipynb"):
        folder = tmp_path / name.partition(".")[0] / "ada"
        folder.mkdir(parents=True)
        (folder / name).write_bytes(content)
        (found,) = find_submissions(folder.parent, ["thin_lens", "motion_blur"])
        assert found.sources == {"motion_blur": text.encode(), "thin_lens": lens.encode()}
        assert f"{name} was graded as a cell writes it as thin_lens.py" in found.remarks
        assert (
            f"{name}: functions of motion_blur that its cells define were not graded"
            in found.remarks
        )


def test_one_notebook_for_several_modules(tmp_path: Path) -> None:
    (tmp_path / "ada").mkdir()
    for name in ("thin_lens", "motion_blur"):
        text = (Path(__file__).parents[4] / "solutions" / f"{name}.py").read_text("utf-8")
        (tmp_path / "ada" / f"{name}.txt").write_text(text, "utf-8")
    cells = [
        (tmp_path / "ada" / f"{name}.txt").read_text("utf-8")
        for name in ("thin_lens", "motion_blur")
    ]
    (tmp_path / "bob.ipynb").write_bytes(notebook(*cells, "k = 1"))
    for path in (tmp_path / "ada").iterdir():
        path.unlink()
    (tmp_path / "ada" / "all.py").write_text("\n".join(cells), "utf-8")
    for found in find_submissions(tmp_path, ["thin_lens", "motion_blur", "sampling"]):
        assert {*found.sources} == {"thin_lens", "motion_blur"}, found
        assert len([one for one in found.remarks if "whose functions it defines" in one]) == 2


def test_an_older_format_and_other_languages() -> None:
    cell = {"cell_type": "code", "input": ["import numpy as np\n", BLUR.format(factor=1)]}
    old = json.dumps({"nbformat": 3, "worksheets": [{"cells": [cell]}]}).encode()
    found = converted_notebook((old, ("motion_blur",)))
    assert isinstance(found, Notebook)
    assert moved(found.sources["motion_blur"]).shape == (3, 2)
    content = notebook("x <- 1", metadata={"kernelspec": {"language": "R"}})
    with pytest.raises(NotebookError, match="its language is R"):
        read_notebook("a.ipynb", content, ["motion_blur"])


def test_what_may_fail_fails_alone_and_says_so(capsys: pytest.CaptureFixture[str]) -> None:
    found = converted(
        "import numpy as np\nt = [1]",
        "def grow(t):\n    t.append(2)\n    raise OSError('no such file')",
        "grow(t)",
        BLUR.format(factor="len(t)"),
    )
    np.testing.assert_array_equal(moved(found.sources["motion_blur"])[0], 2 * TIME)
    assert "cell 3, line 1 fails here: OSError('no such file')" in capsys.readouterr().out


def test_a_thousand_cells() -> None:
    cells = [f"%time x{i} = np.arange({i})\ny{i} = x{i} + 1 # \u2028" for i in range(998)]
    content = notebook("import numpy as np", *cells, BLUR.format(factor="y5[2]"))
    found = read_notebook("a.ipynb", content, ["motion_blur"])
    np.testing.assert_array_equal(moved(found.sources["motion_blur"])[0], 3 * TIME)
    assert found.sources["motion_blur"].count(b"arange") == 1
    (told,) = found.told
    assert told.endswith("and 989 cells more")


RIGHT = [(module, one.name, one.source) for module in COURSE for one in known(module) if one.right]


@pytest.mark.parametrize("module", COURSE)
def test_right_submissions_in_cells_keep_every_statement_that_counts(module: str) -> None:
    """What is left out has a name that nothing else of the file reads."""
    for seed, (_, name, source) in enumerate(one for one in RIGHT if one[0] == module):
        found = converted_notebook((in_cells(source, random.Random(seed)), (module,)))
        assert isinstance(found, Notebook)
        kept = [ast.dump(node) for node in ast.parse(found.sources[module]).body]
        own = ast.parse(source).body
        assert [one for one in map(ast.dump, own) if one in kept] == kept, name
        read = {
            node.id
            for one in own
            if ast.dump(one) in kept
            for node in ast.walk(one)
            if isinstance(node, ast.Name) and isinstance(node.ctx, ast.Load)
        } | {*COURSE[module]}
        for one in own:
            if ast.dump(one) not in kept and not isinstance(one, ast.Expr):
                names = {getattr(one, "name", "")} | {
                    part.id
                    for part in ast.walk(one)
                    if isinstance(part, ast.Name) and isinstance(part.ctx, ast.Store)
                }
                if isinstance(one, ast.Import | ast.ImportFrom):
                    names |= {(a.asname or a.name).partition(".")[0] for a in one.names}
                if not isinstance(one, ast.FunctionDef | ast.ClassDef):
                    assert not names & read, (name, ast.unparse(one))
                else:
                    assert one.name not in read, (name, one.name)


@pytest.mark.parametrize("module", ["motion_blur", "quasi_monte_carlo"])
def test_the_notebook_earns_what_the_file_earns(module: str) -> None:
    _, _, source = next(one for one in RIGHT if one[0] == module)
    found = converted_notebook((in_cells(source, random.Random(7)), (module,)))
    assert isinstance(found, Notebook)
    for text in (source.encode(), found.sources[module]):
        report = grade(
            {module: text},
            references(0),
            modules=[module],
            only=lambda check: check.prepare is None,
        )
        assert report.points == pytest.approx(report.of)


def test_student_and_class_read_what_was_left_out(tmp_path: Path) -> None:
    cells = ("import numpy as np\nfiles = !ls", BLUR.format(factor=1))
    (tmp_path / "class" / "ada").mkdir(parents=True)
    (tmp_path / "class" / "ada" / "motion_blur.ipynb").write_bytes(notebook(*cells))
    (one,) = find_submissions(tmp_path / "class", ["motion_blur"])
    settings = GradingSettings(0, ("motion_blur",))
    job = GradingJob("ada", {}, "stopped here", settings, remarks=one.remarks)
    graded = grade_job(job, b"")
    told = "motion_blur.ipynb: cell 1, line 2: left out: files = !ls"
    assert len(graded.files) == 5
    for name, content in graded.files.items():
        assert told in content.decode(), name
    write_grades([graded.report], tmp_path / "grades.csv", {"ada": ClassLine(one.remarks)})
    write_class_page([graded.report], [], tmp_path / "class.html", {"ada": ClassLine(one.remarks)})
    for name in ("grades.csv", "class.html"):
        assert told in (tmp_path / name).read_text("utf-8")
    changed = replace(one, remarks=())
    assert fingerprint(one, settings) != fingerprint(changed, settings)


def test_a_notebook_saved_as_a_program(tmp_path: Path) -> None:
    """As nbconvert writes it: magics are calls, and what stood under %%time is a text."""
    body = BLUR.format(factor="k")
    text = (
        "#!/usr/bin/env python\n# coding: utf-8\n\n# In[1]:\n\n\nimport numpy as np\n"
        "get_ipython().run_line_magic('matplotlib', 'inline')\nk = 3\n\n# In[2]:\n\n\n"
        f"get_ipython().run_cell_magic('time', '', {body!r})\nget_ipython().system('ls')\n"
        "j = get_ipython().getoutput('ls')\n"
    )
    (tmp_path / "ada").mkdir()
    (tmp_path / "ada" / "motion_blur.py").write_text(text, "utf-8")
    (found,) = find_submissions(tmp_path, ["motion_blur"])
    np.testing.assert_array_equal(moved(found.sources["motion_blur"])[0], 3 * TIME)
    assert found.remarks == (
        "motion_blur.py, a notebook saved as a program: cell 1, line 16: left out: j = !ls",
    )


def test_bars_of_progress_leave_the_loop() -> None:
    """No worker has tqdm; a table of 3 + 2 + 1 items is filled under its bars."""
    found = converted(
        "import numpy as np\nimport tqdm as bars\nt = []",
        "for i in bars.tqdm(range(3), desc='rows'):\n    t.append(i)",
        "for i in bars.trange(2):\n    t.append(i)",
        "with bars.tqdm(total=2) as bar:\n    bar.update(1)\n    t.append(9)\n    bar.update(1)",
        BLUR.format(factor="len(t)"),
    )
    assert b"tqdm" not in found.sources["motion_blur"]
    np.testing.assert_array_equal(moved(found.sources["motion_blur"])[0], 6 * TIME)
