"""Small changes of a student's code, one place at a time: what a slip of the pen would make of it.

Only lines that the student has written are changed, not those of the stub. Text is put in the place of text, so all
else of the file, its comments and its lines stay what they are.
"""

import ast
from collections.abc import Callable, Iterator
from dataclasses import dataclass

Kind = str
"""What is changed: "root", "function", "sign", "factor", "order", "power" or "constant"."""

Span = tuple[int, int]

TWINS = {"sin": "cos", "cos": "sin", "floor": "ceil", "minimum": "maximum", "maximum": "minimum"}
"""Functions that take each other's place."""

DROPPED = ("sqrt", "cbrt", "square", "abs", "absolute", "clip", "floor")
"""Functions in whose place their first argument stands."""

ORDERED = ("arctan2", "atan2", "cross", "divide", "subtract")
"""Functions of two arguments that may be mixed up."""


@dataclass(frozen=True)
class SourceChange:
    """A student's module with one place changed.

    Attributes
    ----------
    function : the public function that it is about
    kind : which sort of change it is
    line : of the first changed character, from 1
    before, after : that line, without indentation
    source : the whole changed file
    """

    function: str
    kind: Kind
    line: int
    before: str
    after: str
    source: str


def changes(source: str, functions: tuple[str, ...], given: str) -> Iterator[SourceChange]:
    """Every change that is known of, from top to bottom.

    Parameters
    ----------
    source : the student's file; one that is not Python has none
    functions : public functions of the module
    given : the stub, whose lines are left alone
    """
    try:
        tree = ast.parse(source)
    except (SyntaxError, ValueError, RecursionError):
        return
    text = _Text(source)
    stub = {line.strip() for line in given.splitlines()}
    defined = {node.name: node for node in tree.body if isinstance(node, ast.FunctionDef)}
    for name in functions:
        for node in _reached(name, defined, functions):
            for kind, (first, last), new in _replacements(node, text):
                if "\n" in source[first:last]:
                    continue  # The line would not tell what was changed.
                changed = _without_parentheses(source[:first], new, source[last:])
                line = source.count("\n", 0, first)
                before, after = (each.splitlines()[line].strip() for each in (source, changed))
                if before not in stub and before != after and _tree(changed):
                    yield SourceChange(name, kind, line + 1, before, after, changed)


def _without_parentheses(before: str, new: str, after: str) -> str:
    """The parts put together; parentheses that change nothing are left out."""
    changed = before + new + after
    bare = before + new[1:-1] + after
    return bare if new.startswith("(") and _tree(bare) == _tree(changed) else changed


def _tree(source: str) -> str:
    """What a text says to Python; empty if nothing."""
    try:
        return ast.dump(ast.parse(source))
    except (SyntaxError, ValueError, RecursionError):
        return ""


def _reached(
    name: str, defined: dict[str, ast.FunctionDef], public: tuple[str, ...]
) -> Iterator[ast.AST]:
    """What is computed by a function and the private ones that it calls, without what it refuses."""
    seen, waiting = set(), [name]
    while waiting:
        one = waiting.pop()
        if one in seen or one not in defined:
            continue
        seen.add(one)
        for statement in defined[one].body:
            for node in _computing(statement):
                yield node
                if isinstance(node, ast.Name) and node.id in defined and node.id not in public:
                    waiting.append(node.id)


def _computing(node: ast.AST) -> Iterator[ast.AST]:
    """The nodes below, but for texts, checks that raise, and types."""
    raises = isinstance(node, ast.If) and any(isinstance(each, ast.Raise) for each in node.body)
    if raises or isinstance(node, ast.Raise | ast.JoinedStr | ast.Import | ast.ImportFrom):
        return
    yield node
    for child in ast.iter_child_nodes(node):
        yield from _computing(child)


class _Text:
    """Places of nodes as indices into a text."""

    def __init__(self, source: str) -> None:
        self.source = source
        self._starts = [0]
        self._lines = source.splitlines(keepends=True)
        for line in self._lines:
            self._starts.append(self._starts[-1] + len(line))

    def span(self, node: ast.expr) -> Span:
        """First and last index of a node, which Python tells in bytes of its lines."""
        assert node.end_lineno is not None
        assert node.end_col_offset is not None
        return (
            self._index(node.lineno, node.col_offset),
            self._index(node.end_lineno, node.end_col_offset),
        )

    def of(self, node: ast.expr) -> str:
        """A node's text, in parentheses where others would tear it apart."""
        first, last = self.span(node)
        text = self.source[first:last]
        whole = isinstance(node, ast.Name | ast.Constant | ast.Call | ast.Subscript | ast.Attribute)
        return text if whole else f"({text})"

    def _index(self, line: int, offset: int) -> int:
        text = self._lines[line - 1].encode()[:offset].decode(errors="ignore")
        return self._starts[line - 1] + len(text)


def _replacements(node: ast.AST, text: _Text) -> Iterator[tuple[Kind, Span, str]]:
    for kind, find in _FINDERS.items():
        for span, new in find(node, text):
            yield kind, span, new


Finder = Callable[[ast.AST, _Text], Iterator[tuple[Span, str]]]


def _name(node: ast.Call) -> str:
    return node.func.attr if isinstance(node.func, ast.Attribute) else getattr(node.func, "id", "")


def _root(node: ast.AST, text: _Text) -> Iterator[tuple[Span, str]]:
    if isinstance(node, ast.Call) and node.args and _name(node) in DROPPED:
        yield text.span(node), text.of(node.args[0])


def _function(node: ast.AST, text: _Text) -> Iterator[tuple[Span, str]]:
    if isinstance(node, ast.Call) and _name(node) in TWINS:
        last = text.span(node.func)[1]
        name = _name(node)
        yield (last - len(name), last), TWINS[name]


def _sign(node: ast.AST, text: _Text) -> Iterator[tuple[Span, str]]:
    if isinstance(node, ast.UnaryOp) and isinstance(node.op, ast.USub):
        yield text.span(node), text.of(node.operand)
    if isinstance(node, ast.BinOp) and isinstance(node.op, ast.Add | ast.Sub):
        old, new = ("+", "-") if isinstance(node.op, ast.Add) else ("-", "+")
        start, end = text.span(node.left)[1], text.span(node.right)[0]
        between = text.source[start:end]
        if "#" not in between and old in between:
            place = start + between.index(old)
            yield (place, place + 1), new


def _factor(node: ast.AST, text: _Text) -> Iterator[tuple[Span, str]]:
    if isinstance(node, ast.BinOp) and isinstance(node.op, ast.Mult):
        for one, other in ((node.left, node.right), (node.right, node.left)):
            if _is_plain(one):
                yield text.span(node), text.of(other)
    if isinstance(node, ast.BinOp) and isinstance(node.op, ast.Div):
        yield text.span(node), text.of(node.left)


def _is_plain(node: ast.expr) -> bool:
    """A factor that is easily forgotten: a number, pi, a name or one row of an array."""
    return isinstance(node, ast.Constant | ast.Name | ast.Attribute | ast.Subscript)


def _order(node: ast.AST, text: _Text) -> Iterator[tuple[Span, str]]:
    pair: list[ast.expr] = []
    if isinstance(node, ast.Call) and _name(node) in ORDERED and len(node.args) == 2:
        pair = node.args
    elif isinstance(node, ast.Call) and _name(node) == "where" and len(node.args) == 3:
        pair = node.args[1:]
    elif isinstance(node, ast.Tuple | ast.List) and isinstance(node.ctx, ast.Load):
        numbers = all(isinstance(each, ast.Constant | ast.UnaryOp) for each in node.elts)
        pair = [] if numbers else node.elts[:2]
    if len(pair) == 2:
        one, other = (text.span(each) for each in pair)
        between = text.source[one[1] : other[0]]
        yield ((one[0], other[1]), text.source[slice(*other)] + between + text.source[slice(*one)])
    if isinstance(node, ast.Subscript) and isinstance(node.slice, ast.Constant):
        other_row = {0: "1", 1: "0"}.get(node.slice.value)  # type: ignore[arg-type]
        if other_row is not None and type(node.slice.value) is int:
            yield text.span(node.slice), other_row


def _power(node: ast.AST, text: _Text) -> Iterator[tuple[Span, str]]:
    if isinstance(node, ast.BinOp) and isinstance(node.op, ast.Pow):
        yield text.span(node), text.of(node.left)


def _constant(node: ast.AST, text: _Text) -> Iterator[tuple[Span, str]]:
    """A number in a sum or a product; indices, sizes and shapes are left alone."""
    if isinstance(node, ast.BinOp) and not isinstance(node.op, ast.Pow):
        for one in (node.left, node.right):
            value = one.value if isinstance(one, ast.Constant) else None
            if isinstance(value, int | float) and value and not isinstance(value, bool):
                yield text.span(one), f"{2 * value:g}"


_FINDERS: dict[Kind, Finder] = {
    "root": _root,
    "function": _function,
    "sign": _sign,
    "factor": _factor,
    "order": _order,
    "power": _power,
    "constant": _constant,
}
