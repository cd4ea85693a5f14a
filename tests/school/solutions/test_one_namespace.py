"""Cells of several modules' notebooks share one kernel: a name that two solutions give has one meaning in both.

Stubs are cut from the solutions, so what holds here holds for them.
"""

import ast
from collections import defaultdict
from collections.abc import Iterator

from course.engine.functions.effects import PROJECT
from course.engine.functions.modules import COURSE


def given(text: str) -> Iterator[tuple[str, str]]:
    """Each name that a module gives, with its code."""
    for node in ast.parse(text).body:
        if isinstance(node, ast.FunctionDef | ast.ClassDef):
            yield node.name, ast.unparse(node)
        elif isinstance(node, ast.Import | ast.ImportFrom):
            for alias in node.names:
                single = type(node)(**{**dict(ast.iter_fields(node)), "names": [alias]})
                yield alias.asname or alias.name, ast.unparse(single)
        else:
            for part in ast.walk(node):
                if isinstance(part, ast.Name) and isinstance(part.ctx, ast.Store):
                    yield part.id, ast.unparse(node)


def in_conflict(texts: dict[str, str]) -> list[str]:
    codes: dict[str, dict[str, list[str]]] = defaultdict(lambda: defaultdict(list))
    for module, text in texts.items():
        for name, code in given(text):
            codes[name][code].append(module)
    return [f"{name}: {[*of.values()]}" for name, of in codes.items() if len(of) > 1]


def test_a_name_that_two_solutions_give_is_the_same_code() -> None:
    texts = {
        module: (PROJECT / f"solutions/{module}.py").read_text(encoding="utf-8")
        for module in COURSE
    }
    assert in_conflict(texts) == []


def test_another_signature_constant_or_import_is_found() -> None:
    one = "import numpy as np\nfrom math import pi\nEDGE = 1e-3\ndef _check(name): return name\n"
    two = "import numpy as np\nfrom math import tau, pi\nEDGE = 1e-4\ndef _check(name, n): pass\n"
    assert [line.partition(":")[0] for line in in_conflict({"one": one, "two": two})] == [
        "EDGE",
        "_check",
    ]
