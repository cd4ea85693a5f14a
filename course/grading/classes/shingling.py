"""What submissions are compared by: hashes of runs of neighbouring nodes of a syntax tree.

The work is linear in the size of the tree, and done without recursion: students choose what the tree looks like.
"""

from __future__ import annotations

import ast
import builtins
import warnings
from collections.abc import Iterator, Mapping
from zlib import crc32

from course.grading.classes.reachable import reachable

SHINGLE = 9
"""Nodes of the tree that are compared together."""

LARGEST = 200_000
"""Bytes of a file that is looked at."""

Given = frozenset[int]
"""Statements of a stub, each as a hash of its nodes."""

_BUILTINS = frozenset(dir(builtins))


def statements(stub: str) -> Given:
    """Statements of a stub as `shingles` leaves them out."""
    tree = ast.parse(stub)
    hashes = _hashes(tree)
    return frozenset(hashes[id(node)] for node in ast.walk(tree) if isinstance(node, ast.stmt))


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
        hashes = _hashes(tree)
        found: set[int] = set()
        for own in reachable(module, tree):
            tokens = [crc32(token.encode()) for token in _tokens(own, hashes, given)]
            found.update(
                hash(tuple(tokens[i : i + SHINGLE])) for i in range(len(tokens) - SHINGLE + 1)
            )
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        return set()
    return found


def _hashes(tree: ast.AST) -> dict[int, int]:
    """For the id of each node, a hash of it and of all below that counts."""
    found: dict[int, int] = {}
    waiting: list[tuple[ast.AST, bool]] = [(tree, False)]
    while waiting:
        node, below_is_done = waiting.pop()
        children = [*ast.iter_child_nodes(node)]
        if below_is_done:
            counting = [found[id(child)] for child in children if _counts(child)]
            found[id(node)] = hash((crc32(_token(node).encode()), *counting))
        else:
            waiting.append((node, True))
            waiting += [(child, False) for child in children]
    return found


def _tokens(top: ast.stmt, hashes: Mapping[int, int], given: Given) -> Iterator[str]:
    """The nodes of a statement, parents before children, without what counts for nothing."""
    waiting: list[ast.AST] = [top]
    while waiting:
        node = waiting.pop()
        if not _counts(node) or (isinstance(node, ast.stmt) and hashes[id(node)] in given):
            continue
        yield _token(node)
        waiting += reversed([*ast.iter_child_nodes(node)])


def _counts(node: ast.AST) -> bool:
    """Whether a node is something that its author has thought of."""
    if isinstance(node, ast.expr_context | ast.arguments | ast.alias):
        return False
    if isinstance(node, ast.Expr) and isinstance(node.value, ast.Constant):
        return False  # a docstring
    if isinstance(node, ast.Import | ast.ImportFrom | ast.Raise | ast.Pass):
        return False
    guard = isinstance(node, ast.If) and not node.orelse and isinstance(node.body[-1], ast.Raise)
    return not guard


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
