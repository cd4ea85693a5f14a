"""The statements of a file that the functions of its module come to use."""

import ast
import warnings
from collections.abc import Iterable, Iterator

from course.engine.functions.modules import COURSE


def parsed(text: str | bytes) -> ast.Module | None:
    """The syntax tree of somebody's text; None where there is none."""
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # of escapes in somebody else's strings
            return ast.parse(text)
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        return None


def first_line(node: ast.stmt) -> int:
    """Number of the line where a statement begins, with its decorators."""
    decorators: list[ast.expr] = getattr(node, "decorator_list", [])
    return min([node.lineno, *(decorator.lineno for decorator in decorators)])


def reachable(module: str, tree: ast.Module, imports: bool = False) -> Iterator[ast.stmt]:
    """Statements that the module's functions come to use; of definitions with one name the last.

    ``imports``: whether imports are among them
    """
    defined: dict[str, ast.stmt] = {}
    for node in tree.body:
        for name in _names_defined(node, imports):
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


def _names_defined(node: ast.stmt, imports: bool) -> Iterable[str]:
    if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef | ast.ClassDef):
        return [node.name]
    if isinstance(node, ast.Import | ast.ImportFrom):
        # `import a.b` defines a.
        names = [(alias.asname or alias.name).partition(".")[0] for alias in node.names]
        return names if imports else []
    return [
        inner.id
        for inner in ast.walk(node)
        if isinstance(inner, ast.Name) and isinstance(inner.ctx, ast.Store)
    ]
