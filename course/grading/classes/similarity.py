"""Pairs of submissions that are too much alike, found in their syntax trees.

What a student may change without thinking counts for nothing: names, constants, comments, docstrings, the order of
functions, code that nothing calls. What everybody has counts for nothing either: the statements of the stub, the heads
of its functions, and guards that do nothing but raise. What remains is compared by its runs of SHINGLE neighbouring
nodes. A pair that is found is worth a look, never a verdict.
"""

from __future__ import annotations

import ast
import builtins
import warnings
from collections import defaultdict
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from zlib import crc32

import numpy as np

from course.effects import COURSE

SHINGLE = 9
"""Nodes of the tree that are compared together."""

ALIKE = 0.7
"""Share of the smaller submission's shingles that the larger one has too."""

FEWEST = 40
"""Shingles; short files are alike without anybody's having copied."""

LARGEST = 200_000
"""Bytes of a file that is looked at."""

Given = frozenset[tuple[str, ...]]
"""Statements of a stub, as their nodes."""

_BUILTINS = frozenset(dir(builtins))


@dataclass(frozen=True)
class Similar:
    """Two submissions of a module that are alike.

    Attributes
    ----------
    module : str
    first, second : the students, in the order of the alphabet
    share : of the smaller one's shingles that the other one has, 0 to 1
    shingles : of the smaller one
    """

    module: str
    first: str
    second: str
    share: float
    shingles: int


def find_similar(
    module: str, sources: Mapping[str, bytes], stub: str, threshold: float = ALIKE
) -> list[Similar]:
    """Pairs of submissions of one module that are alike, the most alike first.

    Parameters
    ----------
    sources : student -> the file
    stub : the text that all began with
    threshold : least share that is told
    """
    given = statements(stub)
    found = {student: shingles(module, source, given) for student, source in sources.items()}
    students = sorted(student for student, own in found.items() if len(own) >= FEWEST)
    if len(students) < 2:
        return []
    owners: dict[int, list[int]] = defaultdict(list)
    for number, student in enumerate(students):
        for shingle in found[student]:
            owners[shingle].append(number)
    shared = np.zeros((len(students), len(students)), np.int32)
    for who in owners.values():
        if len(who) > 1:
            shared[np.ix_(who, who)] += 1
    size = np.array([len(found[student]) for student in students])
    smaller = np.minimum(size[:, None], size)
    share = np.triu(shared / smaller, 1)
    return sorted(
        (
            Similar(module, students[i], students[j], float(share[i, j]), int(smaller[i, j]))
            for i, j in zip(*np.nonzero(share >= threshold), strict=True)
        ),
        key=lambda pair: (-pair.share, pair.first, pair.second),
    )


def statements(stub: str) -> Given:
    """Statements of a stub as `shingles` leaves them out."""
    nothing: Given = frozenset()
    return frozenset(
        tuple(_tokens(node, nothing))
        for node in ast.walk(ast.parse(stub))
        if isinstance(node, ast.stmt)
    )


def shingles(module: str, source: bytes, given: Given) -> set[int]:
    """What a submission is compared by: hashes of runs of nodes in what the student wrote.

    Parameters
    ----------
    given : statements of the stub

    Returns
    -------
    set of int
        Empty if the file can't be parsed or is very large.
    """
    if len(source) > LARGEST:
        return set()
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # of escapes in somebody else's strings
            tree = ast.parse(source)
        found: set[int] = set()
        for own in _reachable(module, tree):
            tokens = [crc32(token.encode()) for token in _tokens(own, given)]
            found.update(
                hash(tuple(tokens[i : i + SHINGLE])) for i in range(len(tokens) - SHINGLE + 1)
            )
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        return set()
    return found


def _reachable(module: str, tree: ast.Module) -> Iterator[ast.stmt]:
    """Statements that the module's functions come to use; of definitions with one name the last."""
    defined: dict[str, ast.stmt] = {}
    for node in tree.body:
        for name in _names_defined(node):
            defined[name] = node
    waiting, seen = [name for name in COURSE[module] if name in defined], set[int]()
    while waiting:
        node = defined[waiting.pop()]
        if id(node) not in seen:
            seen.add(id(node))
            yield node
            waiting += [
                inner.id
                for inner in ast.walk(node)
                if isinstance(inner, ast.Name) and inner.id in defined
            ]


def _names_defined(node: ast.stmt) -> Iterable[str]:
    if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef | ast.ClassDef):
        return [node.name]
    if isinstance(node, ast.Import | ast.ImportFrom):
        return []
    return [
        inner.id
        for inner in ast.walk(node)
        if isinstance(inner, ast.Name) and isinstance(inner.ctx, ast.Store)
    ]


def _tokens(top: ast.stmt, given: Given) -> Iterator[str]:
    """The nodes of a statement, parents before children, without what counts for nothing."""
    waiting: list[ast.AST] = [top]
    while waiting:
        node = waiting.pop()
        if isinstance(node, ast.stmt) and _counts_for_nothing(node, given):
            continue
        if isinstance(node, ast.expr_context | ast.arguments | ast.alias):
            continue
        yield _token(node)
        waiting += reversed([*ast.iter_child_nodes(node)])


def _counts_for_nothing(node: ast.stmt, given: Given) -> bool:
    if isinstance(node, ast.Expr) and isinstance(node.value, ast.Constant):
        return True  # a docstring
    if isinstance(node, ast.Import | ast.ImportFrom | ast.Raise | ast.Pass):
        return True
    if isinstance(node, ast.If) and not node.orelse and isinstance(node.body[-1], ast.Raise):
        return True
    nothing: Given = frozenset()
    return bool(given) and tuple(_tokens(node, nothing)) in given


def _token(node: ast.AST) -> str:
    """A node's kind, and those of its names that can't be renamed: NumPy's and Python's."""
    kind = type(node).__name__
    if isinstance(node, ast.Attribute):
        return f"{kind} {node.attr}"
    if isinstance(node, ast.Call) and isinstance(node.func, ast.Name) and node.func.id in _BUILTINS:
        return f"{kind} {node.func.id}"
    if isinstance(node, ast.keyword):
        return f"{kind} {node.arg}"
    return kind
