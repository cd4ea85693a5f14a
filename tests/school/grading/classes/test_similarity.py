"""Copies are found however they were renamed; what was written independently is not."""

import ast
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import pytest

from course.engine.functions.modules import COURSE
from course.school.grading.classes import similarity
from course.school.grading.classes.engines import apart
from course.school.grading.classes.similarity import (
    LARGEST,
    Similar,
    as_shingles,
    compare,
    shingles,
    statements,
)
from course.school.grading.classes.similarity import find_similar as similar_of
from course.school.grading.classes.submitted import Submission
from course.school.grading.known import known
from course.school.grading.release.stubs import make_stub

SOLUTIONS = Path(__file__).parents[4] / "solutions"
STUBS = {
    module: make_stub((SOLUTIONS / f"{module}.py").read_text("utf-8"), module, module).text
    for module in COURSE
}


def find_similar(
    module: str, sources: Mapping[str, bytes], stub: str, threshold: float = 0.7
) -> list[Similar]:
    given = statements(stub)
    found = {name: as_shingles(shingles(module, text, given)) for name, text in sources.items()}
    return similar_of(module, found, threshold)


def right(module: str) -> dict[str, bytes]:
    """Right submissions that were written independently."""
    found = {path.stem: path.read_bytes() for path in (SOLUTIONS / "right" / module).glob("*.py")}
    return found | {"solution": (SOLUTIONS / f"{module}.py").read_bytes()}


class Disguise(ast.NodeTransformer):
    """What somebody does to a copy: other names, other constants, no docstrings, functions in another order."""

    def visit_Module(self, node: ast.Module) -> ast.AST:
        self.generic_visit(node)
        functions = [one for one in node.body if isinstance(one, ast.FunctionDef)]
        others = [one for one in node.body if one not in functions]
        node.body = [*others, *reversed(functions)]
        return node

    def visit_FunctionDef(self, node: ast.FunctionDef) -> ast.AST:
        self.generic_visit(node)
        local = {arg.arg for arg in ast.walk(node) if isinstance(arg, ast.arg)}
        local |= {
            name.id
            for name in ast.walk(node)
            if isinstance(name, ast.Name) and isinstance(name.ctx, ast.Store)
        }
        for inner in ast.walk(node):
            if isinstance(inner, ast.Name) and inner.id in local:
                inner.id = f"my_{inner.id}"
            elif isinstance(inner, ast.arg):
                inner.arg = f"my_{inner.arg}"
        if ast.get_docstring(node):
            node.body = node.body[1:]
        return node

    def visit_Constant(self, node: ast.Constant) -> ast.AST:
        return ast.Constant(node.value + 1) if type(node.value) is int else node


def disguised(source: bytes) -> bytes:
    return (ast.unparse(Disguise().visit(ast.parse(source))) + "\n\nSPARE = 1\n").encode()


@pytest.mark.parametrize("module", COURSE)
def test_independent_submissions_are_not_alike(module: str) -> None:
    assert len(right(module)) >= 3
    assert not find_similar(module, right(module), STUBS[module], 0.3)


@pytest.mark.parametrize("module", COURSE)
def test_what_is_never_called_is_not_compared(module: str) -> None:
    # Each holds the whole solution too, whose functions its own ones take the place of.
    sources = {one.name: one.source.encode() for one in known(module) if one.right}
    assert not find_similar(module, sources, STUBS[module], 0.3)


@pytest.mark.parametrize("module", COURSE)
def test_renamed_copies_are_found(module: str) -> None:
    sources = right(module)
    copy = disguised(sources["loops" if "loops" in sources else "concentric"])
    (pair,) = find_similar(module, sources | {"zz": copy}, STUBS[module])
    assert pair.second == "zz"
    assert pair.first in ("loops", "concentric")
    assert pair.share > 0.9


def test_a_copy_with_padding_is_found() -> None:
    sources = right("thin_lens")
    padding = b"\n\ndef unused(a, b):\n    return [a * i + b for i in range(9) if i % 2]\n" * 9
    used = sources["loops"].replace(
        b"    return ", b"    for _ in []:\n        print(_)\n    return ", 2
    )
    found = find_similar("thin_lens", sources | {"zz": padding + used}, STUBS["thin_lens"])
    assert [(pair.first, pair.second) for pair in found] == [("loops", "zz")]


def test_stubs_and_short_files_are_not_compared() -> None:
    stub = STUBS["motion_blur"].encode()
    body = b"return np.add(np.multiply(time, 2), np.sqrt(time)) - time * 3  #"
    short = stub.replace(b"raise NotImplementedError", body)
    given = statements(STUBS["motion_blur"])
    assert len(shingles("motion_blur", stub, frozenset())) > 10
    assert not shingles("motion_blur", stub, given)
    assert shingles("motion_blur", short, given)
    sources = {"a": stub, "b": stub, "c": short, "d": short, "e": b"", "f": b""}
    assert not find_similar("motion_blur", sources, STUBS["motion_blur"])


def test_what_is_no_python_is_nobody_s_copy() -> None:
    nested = b"x = " + b"(" * 5000 + b")" * 5000
    signs = b"x = " + b"-" * 90_000 + b"1"
    sources = {
        f"{name} {i}": text
        for name, text in {"no": b"def f(:", "deep": nested, "nul": b"\0", "signs": signs}.items()
        for i in range(2)
    }
    assert not find_similar("motion_blur", sources, STUBS["motion_blur"])


def test_of_a_class_of_200_each_text_is_read_once_and_the_copies_are_found(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    variants = [*right("thin_lens").values()]
    class_ = [
        Submission(f"{i:03}", (), {"thin_lens": variants[i % len(variants)]}) for i in range(200)
    ]
    read: list[int] = []
    apart = similarity.apart

    def counted(function: Any, items: Sequence[Any], jobs: int) -> Any:
        read.append(len(items))
        return apart(function, items, jobs)

    monkeypatch.setattr(similarity, "apart", counted)
    kept = tmp_path / "kept.npz"
    found = compare(class_, ["thin_lens"], kept)
    assert {(pair.first, pair.second) for pair in found.similar} == {
        (f"{j:03}", f"{i:03}") for i in range(200) for j in range(i) if (i - j) % len(variants) == 0
    }
    # What is kept needs no process, and what has changed is read alone.
    assert compare(class_, ["thin_lens"], kept) == found
    changed = [*class_[:-1], Submission("199", (), {"thin_lens": variants[0] + b"#"})]
    compare(changed, ["thin_lens"], kept)
    assert read == [len(variants), 0, 1]
    kept.write_bytes(b"PK, but damaged")
    assert compare(class_, ["thin_lens"], kept) == found


def slow(_: object) -> None:
    while True:
        pass


def test_a_text_that_takes_too_long_costs_only_itself() -> None:
    assert apart(slow, ["a", "b"], seconds=0.5) == {0: None, 1: None}


def hungry(size: int) -> int:
    return len(bytearray(size))


def test_a_text_that_takes_too_much_memory_costs_only_itself() -> None:
    assert apart(hungry, [10_000_000_000, 10]) == {0: None, 1: 10}


def test_a_file_that_is_too_large_is_told(tmp_path: Path) -> None:
    source = right("thin_lens")["solution"]
    large = source + b"#" * LARGEST
    class_ = [
        Submission("ada", (), {"thin_lens": source}),
        Submission("bob", (), {"thin_lens": large}),
    ]
    assert compare(class_, ["thin_lens"], tmp_path / "kept.npz").left_out == (("bob", "thin_lens"),)


def test_each_node_of_a_nested_file_is_looked_at_twice_and_no_more(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    # Every statement lies in all those before it: what is done for each must not look at all that is in it.
    depth = 90
    nested = "".join(f"{' ' * i}if u:\n" for i in range(1, depth))
    source = f"def point_on_disk(u):\n{nested}{' ' * depth}u = [{'u,' * 3000}]\n return u\n"
    given = statements(STUBS["thin_lens"])
    looked: list[ast.AST] = []
    token = similarity._token

    def counted(node: ast.AST) -> str:
        looked.append(node)
        return token(node)

    monkeypatch.setattr(similarity, "_token", counted)
    assert shingles("thin_lens", source.encode(), given)
    assert len(looked) <= 2 * sum(1 for _ in ast.walk(ast.parse(source)))
