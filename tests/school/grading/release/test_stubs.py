"""Stubs: what of a solution is handed out, and what is refused because too much would be."""

import ast
from pathlib import Path

import pytest

from course.engine.functions.effects import PROJECT
from course.engine.functions.modules import COURSE
from course.school.grading.release.stubs import SolutionError, Stub, make_stub, make_stubs

SOLUTION = '''\
"""lens - a lens."""

from __future__ import annotations

import math
from functools import cache, partial

import numpy as np

### BEGIN SOLUTION
SECRET = math.pi


@cache
def _secret():
    return SECRET


### END SOLUTION


LIMIT = 3


def first(a, b=1 / 6, *, c=None):
    """The first one."""
    _check(a)
    ### BEGIN SOLUTION
    x = _secret() * a

    return x + b
    ### END SOLUTION


def second(a):
    """The second one."""
    if _check(a):
        ### BEGIN SOLUTION
        return 1
        ### END SOLUTION
    a = a + 1
    ### BEGIN SOLUTION
    return 2
    ### END SOLUTION


def _check(a):
    return partial(_range, a)()


def _range(a):
    return a > LIMIT
'''

STUB = '''\
"""lens - a lens."""

from __future__ import annotations

from functools import partial

import numpy as np


LIMIT = 3


def first(a, b=1 / 6, *, c=None):
    """The first one."""
    _check(a)
    # TODO lens.first: write your solution here
    raise NotImplementedError("lens.first: not written yet")


def second(a):
    """The second one."""
    if _check(a):
        # TODO lens.second: write your solution here
        raise NotImplementedError("lens.second: not written yet")
    a = a + 1
    # TODO lens.second: write your solution here
    raise NotImplementedError("lens.second: not written yet")


def _check(a):
    return partial(_range, a)()


def _range(a):
    return a > LIMIT
'''

FUNCTION = "def f(a):\n    ### BEGIN SOLUTION\n    return a\n    ### END SOLUTION\n"


def stub_text(text: str) -> str:
    """The stub's text of a solution in solutions/lens.py."""
    return make_stub(text, "lens", "solutions/lens.py").text


def refusal(text: str) -> str:
    """The message with which a solution is refused."""
    with pytest.raises(SolutionError) as caught:
        stub_text(text)
    return str(caught.value)


def test_a_stub_is_the_solution_without_its_regions() -> None:
    stub = make_stub(SOLUTION, "lens", "solutions/lens.py")
    assert stub == Stub("lens", STUB, ("lens.first", "lens.second"))


def test_a_stub_says_which_task_is_not_written_yet() -> None:
    namespace: dict[str, object] = {}
    exec(compile(stub_text(SOLUTION), "lens.py", "exec"), namespace)  # our own text, from above
    first = namespace["first"]
    assert callable(first)
    with pytest.raises(NotImplementedError, match=r"^lens\.first: not written yet$"):
        first(1)


def test_a_function_may_be_a_region_and_nothing_else() -> None:
    assert stub_text(FUNCTION) == (
        "def f(a):\n"
        "    # TODO lens.f: write your solution here\n"
        '    raise NotImplementedError("lens.f: not written yet")\n'
    )


def test_numpy_stays_though_nothing_uses_it_yet() -> None:
    text = "import math\n\nimport numpy as np\nimport os.path\n\n\n" + FUNCTION
    assert stub_text(text).startswith("import numpy as np\n\n\ndef f(a):")


def test_an_import_of_several_names_keeps_those_in_use() -> None:
    text = "from math import (\n    cos,\n    pi as p,\n    sin,\n)\n\n\nX = p\n\n\ndef g(a=X):\n"
    text += FUNCTION.partition("\n")[2]
    assert stub_text(text).startswith("from math import pi as p\n\n\nX = p\n")


def test_a_region_at_the_end_of_the_file_leaves_no_blank_lines() -> None:
    text = FUNCTION + "\n\n### BEGIN SOLUTION\ndef _g():\n    pass\n\n\n### END SOLUTION\n"
    assert stub_text(text) == stub_text(FUNCTION)


@pytest.mark.parametrize(
    ("helper", "name"),
    [
        ("def _g():\n    return _g()", "_g"),
        ("class Helper:\n    pass", "Helper"),
        ("_FACTOR = 2", "_FACTOR"),
        ("TABLE: dict = {}", "TABLE"),
        ("A = [1]\nB = A", "A"),
    ],
)
def test_what_only_the_solution_uses_is_refused_outside_a_region(helper: str, name: str) -> None:
    # The solution's own use of it doesn't count, for it is gone.
    text = helper + "\n\n\n" + FUNCTION.replace("return a", f"return {name}")
    told = refusal(text)
    assert told.startswith(f"solutions/lens.py:1: {name} serves nothing but the solution")
    assert told.endswith("put it in a region at module level")


def test_what_the_stub_uses_by_way_of_something_else_is_handed_out() -> None:
    text = "A = 1\nB = A\n\n\n" + FUNCTION.replace("(a):", "(a=B):")
    assert stub_text(text).startswith("A = 1\nB = A\n")


@pytest.mark.parametrize(
    "text",
    [
        "def _f(a):\n    ### BEGIN SOLUTION\n    return a\n    ### END SOLUTION\n",
        "class A:\n    ### BEGIN SOLUTION\n    x = 1\n    ### END SOLUTION\n",
        "if True:\n    ### BEGIN SOLUTION\n    x = 1\n    ### END SOLUTION\n",
        "    ### BEGIN SOLUTION\n    ### END SOLUTION\n",
    ],
)
def test_a_region_that_is_no_task_is_refused(text: str) -> None:
    assert "a region stands in a public function or at module level" in refusal(text)


@pytest.mark.parametrize(
    ("text", "line"),
    [
        # In a text, where it is no code.
        ('def f(a):\n    """A.\n    ### BEGIN SOLUTION\n    ### END SOLUTION\n    """\n', 3),
        # A bracket is open.
        ("x = [\n### BEGIN SOLUTION\n    1,\n### END SOLUTION\n]\n", 2),
        # From within one function into the next.
        (FUNCTION.replace("return a", "return a\n\n\ndef g(a):") + "    return a\n", 2),
        # A decorator without its function.
        ("### BEGIN SOLUTION\n@a\n### END SOLUTION\ndef f(a):\n    return a\n", 1),
    ],
)
def test_a_region_that_cuts_a_statement_is_refused(text: str, line: int) -> None:
    told = refusal(text)
    assert told.startswith(f"solutions/lens.py:{line}: the region cuts the statement of line")


@pytest.mark.parametrize(
    ("text", "told"),
    [
        (
            FUNCTION + "\n\ndef g(a):\n    return a\n",
            "lens.py:7: g has no region, so its stub would be the solution",
        ),
        (
            "### BEGIN SOLUTION\ndef g(a):\n    return a\n\n\n### END SOLUTION\n",
            "lens.py:2: g stands inside a region, so no stub would have it",
        ),
        ("x = 1\n### END SOLUTION\n", "lens.py:2: '### END SOLUTION' closes no region"),
        ("x = 1\ndef f(:\n", "lens.py:2: not Python: "),
        ("x = '\0'\n", "lens.py:1: not Python: "),
        # It is its stub that is none.
        (
            "def f(\n    ### BEGIN SOLUTION\n    a,\n    ### END SOLUTION\n):\n    return a\n",
            "lens.py (without its regions):3: not Python: ",
        ),
    ],
)
def test_what_makes_no_stub_is_refused_with_file_and_line(text: str, told: str) -> None:
    assert refusal(text).startswith(f"solutions/{told}")


def test_written_tasks_are_those_whose_error_is_gone() -> None:
    stub = make_stub(SOLUTION, "lens", "solutions/lens.py")
    assert stub.written(STUB) == []
    assert stub.written("") == []
    assert stub.written("def firstly():\n    return 1\n") == []
    done = STUB.replace('raise NotImplementedError("lens.first: not written yet")', "return a")
    assert stub.written(done) == ["lens.first"]


def test_a_folder_gives_its_modules_in_the_order_of_their_names(tmp_path: Path) -> None:
    for name in ("b.py", "a.py", "__init__.py", "_shared.py", "notes.txt"):
        (tmp_path / name).write_text(FUNCTION, encoding="utf-8")
    assert [(stub.module, stub.tasks) for stub in make_stubs(tmp_path)] == [
        ("a", ("a.f",)),
        ("b", ("b.f",)),
    ]


def test_line_ends_of_another_system_make_the_same_stub(tmp_path: Path) -> None:
    (tmp_path / "lens.py").write_bytes(SOLUTION.replace("\n", "\r\n").encode())
    assert make_stubs(tmp_path) == [make_stub(SOLUTION, "lens", "")]


def test_a_folder_without_solutions_is_refused(tmp_path: Path) -> None:
    for folder in (tmp_path, tmp_path / "nowhere"):
        with pytest.raises(SolutionError, match="there are no solutions"):
            make_stubs(folder)


def test_a_solution_that_is_no_text_is_refused(tmp_path: Path) -> None:
    (tmp_path / "lens.py").write_bytes(b"\xff\xfe")
    with pytest.raises(SolutionError, match=r"lens\.py: can't be read"):
        make_stubs(tmp_path)


# ---------------------------------------------------------------- the course's own solutions

SOLUTIONS = PROJECT / "solutions"
STUBS = {stub.module: stub for stub in make_stubs(SOLUTIONS)}


def public(text: str) -> dict[str, ast.FunctionDef]:
    """The functions of a module that students know of."""
    return {
        node.name: node
        for node in ast.parse(text).body
        if isinstance(node, ast.FunctionDef) and not node.name.startswith("_")
    }


def test_every_module_that_the_engine_knows_has_its_stub() -> None:
    assert STUBS.keys() == COURSE.keys()


@pytest.mark.parametrize("module", COURSE)
def test_the_tasks_of_a_stub_are_the_functions_of_its_module(module: str) -> None:
    assert STUBS[module].tasks == tuple(f"{module}.{name}" for name in COURSE[module])


@pytest.mark.parametrize("module", COURSE)
def test_a_stub_has_the_signatures_and_docstrings_of_the_solution(module: str) -> None:
    stub = public(STUBS[module].text)
    solution = public((SOLUTIONS / f"{module}.py").read_text(encoding="utf-8"))
    assert stub.keys() == solution.keys()
    for name, node in stub.items():
        assert ast.dump(node.args) == ast.dump(solution[name].args)
        assert ast.get_docstring(node) == ast.get_docstring(solution[name])
        assert f"Task: {module}.{name}." in str(ast.get_docstring(node))


@pytest.mark.parametrize("module", COURSE)
def test_no_line_of_a_region_is_in_a_stub(module: str) -> None:
    inside = False
    secret, open_ = set(), set()
    for line in (SOLUTIONS / f"{module}.py").read_text(encoding="utf-8").splitlines():
        if line.strip().startswith("###"):
            inside = not inside
        else:
            (secret if inside else open_).add(line.strip())
    leaked = (secret - open_) & {line.strip() for line in STUBS[module].text.splitlines()}
    assert secret
    assert not leaked
