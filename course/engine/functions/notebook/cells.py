"""A notebook's cells as Jupyter runs them: IPython's own transformer makes Python of them, statement by statement.

What only a notebook's machinery can run goes: commands of the system, help, and magics that show something. A magic
that runs its text among the notebook's names (``%time``, ``%%capture``) gives way to that text. Whatever else can't be
taken over is told, by cell and line. Cells count from the top of the notebook, texts among them.
"""

import ast
import json
import re
import shlex
import warnings
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import PurePosixPath, PureWindowsPath
from typing import Any

from IPython.core.inputtransformer2 import TransformerManager

from course.base.texts import words
from course.engine.functions.notebook.reachable import first_line, parsed

RUNS = ("time", "capture", "prun", "debug")
"""Magics that run their text as a part of the notebook."""

CHECKS = "check"
"""The course's own, which does so over a cell."""

SHOWS = words(
    "alias_magic autoawait automagic autoreload bookmark check colors course conda config dirs doctest_mode "
    "help hist history html HTML javascript js latex load_ext logoff logon logstart logstate "
    "logstop lprun ls lsmagic magic mamba markdown matplotlib memit micromamba mprun notebook page "
    "pastebin pdb pdef pdoc pfile pinfo pinfo2 pip precision profile psearch psource pwd "
    "quickref recall reload_ext save sc svg SVG system sx tb timeit unalias unload_ext uv who "
    "who_ls whos xmode"
)
"""Magics that change no name of the notebook."""

WRITES = ("writefile", "file")
"""Magics that write their text into a file."""

NO_NOTEBOOK = (ValueError, KeyError, TypeError, AttributeError, RecursionError)
"""What `read_cells` raises for what is no notebook."""

_DEEPEST = 20
"""Magics that may stand over each other in one cell."""

_LONGEST = 60
"""Characters of a line that is told."""

_FLAGS = ast.PyCF_ONLY_AST | ast.PyCF_ALLOW_TOP_LEVEL_AWAIT
_NO_PYTHON = (SyntaxError, ValueError, RecursionError, MemoryError, RuntimeError)


@dataclass
class Statement:
    """A statement of a cell.

    Attributes
    ----------
    node : its tree, without what only a notebook can run
    text : as the student wrote it, or made from the tree where that is another
    cell, line : where it stands
    whole : whether it is as the student wrote it, line by line
    """

    node: ast.stmt
    text: str
    cell: int
    line: int
    whole: bool = True


@dataclass
class NotebookCode:
    """All of a notebook's code.

    Attributes
    ----------
    statements : in the order of the cells
    files : name -> text of each file that a cell writes
    told : what was left out although it may have defined something
    counts : cell -> the number beside it that Jupyter shows, as in In[5], where the notebook keeps one
    """

    statements: list[Statement] = field(default_factory=list)
    files: dict[str, str] = field(default_factory=dict)
    told: list[str] = field(default_factory=list)
    counts: dict[int, int] = field(default_factory=dict)

    def tell(self, cell: int, line: int, why: str) -> None:
        """Add what was left out, and why."""
        self.told.append(f"cell {cell}, line {line}: {why}")


def read_cells(content: bytes) -> NotebookCode:
    """Read a notebook of any format since 3; raises one of ``NO_NOTEBOOK`` for what is none, or none of Python."""
    notebook = json.loads(content)
    language = notebook.get("metadata", {}).get("kernelspec", {}).get("language", "python")
    if str(language).lower() not in ("python", "python3"):
        raise ValueError(f"its language is {language}")
    found = NotebookCode(counts=counts_of(notebook))
    for number, source in _sources(notebook):
        _read(source.replace("\r\n", "\n").replace("\r", "\n"), number, 0, found)
    return found


def counts_of(notebook: dict[str, Any]) -> dict[int, int]:
    """Of the cells that have been run, by their place, the numbers that Jupyter shows."""
    counts = {number: cell.get("execution_count") for number, cell in _numbered(notebook)}
    return {number: count for number, count in counts.items() if type(count) is int}


def _numbered(notebook: dict[str, Any]) -> Iterator[tuple[int, dict[str, Any]]]:
    # Before format 4 cells lay on sheets, and their text was called input.
    sheets = notebook.get("worksheets", [notebook])
    return enumerate((cell for sheet in sheets for cell in sheet["cells"]), 1)


def _sources(notebook: dict[str, Any]) -> Iterator[tuple[int, str]]:
    """Number and text of each cell of code."""
    for number, cell in _numbered(notebook):
        if cell["cell_type"] == "code":
            source = cell["source"] if "source" in cell else cell["input"]
            yield number, source if isinstance(source, str) else "".join(source)


def _read(text: str, cell: int, above: int, found: NotebookCode, depth: int = 0) -> None:
    """Add the statements of a cell, or of the text below its magic, which has so many lines above it."""
    # Blank lines at the beginning are no part of what IPython gives back.
    blank = len(text) - len(re.sub(r"\A(?:[ \t\f]*\n)+", "", text))
    above, text = above + text[:blank].count("\n"), text[blank:]
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # of somebody else's text
            code = TransformerManager().transform_cell(text)  # type: ignore[no-untyped-call]
            tree = compile(code, "<cell>", "exec", _FLAGS, dont_inherit=True)
    except _NO_PYTHON as error:
        line = above + (getattr(error, "lineno", None) or 1)
        found.tell(cell, line, "is no Python, so the cell is left out")
        return
    if magic := _cell_magic(tree):
        _read_magic(*magic, cell, above, found, depth)
        return
    code_lines, own_lines = code.rstrip().split("\n"), text.rstrip().split("\n")
    for node in tree.body:
        line = above + _own_line(code_lines, own_lines, first_line(node))
        lines = _Lines(found, cell, line - first_line(node))
        try:
            found.statements += _statements(node, lines, code_lines, line)
        except RecursionError:
            found.tell(cell, line, "is nested too deeply, so it is left out")


def _statements(node: ast.stmt, lines: "_Lines", code: list[str], line: int) -> list[Statement]:
    """What stays of a statement without lines for the shell."""
    original = ast.dump(node)
    visited = lines.visit(node)
    kept = visited if isinstance(visited, list) else [visited]
    if kept == [node] and ast.dump(node) == original:
        return [Statement(node, _segment(code, node), lines.cell, line)]
    return [
        Statement(one, _unparsed(one), lines.cell, line, whole=False)
        for one in kept
        if not isinstance(one, ast.Pass)
    ]


def _read_magic(
    name: str, options: str, body: str, cell: int, above: int, found: NotebookCode, depth: int
) -> None:
    if name in (*RUNS, CHECKS) and depth < _DEEPEST:
        _read(body, cell, above + 1, found, depth + 1)
    elif name in WRITES and (file := _written(options)):
        path, appended = file
        found.files[path] = (found.files.get(path, "") if appended else "") + body
    elif name == "timeit":
        tree = parsed(body)
        if tree is None or not all(isinstance(node, ast.Expr) for node in tree.body):
            found.tell(cell, above + 1, "what stands under %%timeit defines nothing outside of it")
    elif name not in SHOWS:
        found.tell(cell, above + 1, f"the cell is left out, as %%{name} is no Python here")


def _written(options: str) -> tuple[str, bool] | None:
    """Name of the file that is written, without folders, and whether it is appended to."""
    try:
        words = shlex.split(options)
    except ValueError:
        words = options.split()
    names = [word for word in words if word not in ("-a", "--append")]
    if len(names) != 1:
        return None
    return PurePosixPath(PureWindowsPath(names[0]).as_posix()).name, len(words) > 1


def _cell_magic(tree: ast.Module) -> tuple[str, str, str] | None:
    match tree.body:
        case [ast.Expr(ast.Call() as call)]:
            name, values = _magic(call)
            if name == "run_cell_magic" and len(values) == 3:
                return values[0], values[1], values[2]
    return None


def _magic(node: ast.AST) -> tuple[str, list[str]]:
    """Name and texts of a call of the notebook's shell; empty for any other."""
    match node:
        case ast.Call(ast.Attribute(ast.Call(ast.Name("get_ipython"), []), name), arguments):
            texts = [one.value for one in arguments if isinstance(one, ast.Constant)]
            return name, [text for text in texts if isinstance(text, str)]
    return "", []


class _Lines(ast.NodeTransformer):
    """Takes lines for the notebook's shell out of a statement, in whatever is below it."""

    def __init__(self, found: NotebookCode, cell: int, above: int) -> None:
        self.found, self.cell, self.above = found, cell, above
        self.functions = 0

    def visit(self, node: ast.AST) -> Any:
        if not isinstance(node, ast.stmt):
            return super().visit(node)
        if isinstance(node, ast.Expr) and _magic(node.value)[0]:
            return self._line(node)
        inside = isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef)
        if isinstance(node, ast.If) and not self.functions:
            # In a notebook it is; what is imported has its own name.
            node.test = _Named("__name__", "__main__").visit(node.test)
        self.functions += inside
        self.generic_visit(node)
        self.functions -= inside
        return self._tell(node) if any(map(self._is_shells, _own(node))) else node

    def visit_Call(self, node: ast.Call) -> ast.AST:
        name, texts = _magic(node)
        if name == "run_line_magic" and len(texts) == 2 and texts[0] in RUNS:
            tree = parsed(texts[1])
            match tree and tree.body:
                case [ast.Expr(value)]:
                    return value
        return self.generic_visit(node)

    def _is_shells(self, node: ast.AST) -> bool:
        waits = isinstance(node, ast.Await | ast.AsyncFor | ast.AsyncWith) and not self.functions
        return waits or (isinstance(node, ast.Name) and node.id == "get_ipython")

    def _line(self, node: ast.Expr) -> Any:
        name, texts = _magic(node.value)
        if name in ("system", "getoutput"):
            return ast.Pass()
        if name in ("run_line_magic", "run_cell_magic") and len(texts) in (2, 3):
            magic, text = texts[0], texts[-1]
            tree = parsed(re.sub(r"\A(?:-\w+\s+)+", "", text)) if magic in RUNS else None
            if tree is not None:
                return tree.body or ast.Pass()
            if magic in SHOWS:
                return ast.Pass()
        return self._tell(node)

    def _tell(self, node: ast.stmt) -> ast.stmt:
        text = ast.unparse(node).partition("\n")[0]
        for pattern, short in _SHORT:
            text = pattern.sub(short, text)
        if len(text) > _LONGEST:
            text = f"{text[:_LONGEST]}..."
        self.found.tell(self.cell, self.above + node.lineno, f"left out: {text}")
        return ast.Pass()


_SHORT = (
    (re.compile(r"get_ipython\(\)\.run_line_magic\('(\w+)', ['\"](.*)['\"]\)"), r"%\1 \2"),
    (re.compile(r"get_ipython\(\)\.(?:getoutput|system)\(['\"](.*)['\"]\)"), r"!\1"),
)
"""How lines for the shell looked before IPython rewrote them."""


class _Named(ast.NodeTransformer):
    """Puts a text in the place of a name."""

    def __init__(self, name: str, value: str) -> None:
        self.name, self.value = name, value

    def visit_Name(self, node: ast.Name) -> ast.expr:
        return ast.Constant(self.value) if node.id == self.name else node


def _own(node: ast.AST) -> Iterator[ast.AST]:
    """A statement and what belongs to it, without the statements in it."""
    yield node
    for child in ast.iter_child_nodes(node):
        if not isinstance(child, ast.stmt | ast.ExceptHandler | ast.match_case):
            yield from _own(child)


def _own_line(code: list[str], own: list[str], line: int) -> int:
    """The line of the student's text that a line of IPython's was: a magic over several lines becomes one."""
    if len(code) == len(own):
        return line
    for above in range(line, 0, -1):
        text = code[above - 1]
        if text.strip() and text in own[above - 1 :]:
            return own.index(text, above - 1) + 1 + line - above
    return line


def _segment(lines: list[str], node: ast.stmt) -> str:
    """The text of a statement; others may stand on its first and last line."""
    assert node.end_lineno is not None
    first, last = first_line(node), node.end_lineno
    parts = [line.encode() for line in lines[first - 1 : last]]
    parts[-1] = parts[-1][: node.end_col_offset]
    if first == node.lineno:
        parts[0] = parts[0][node.col_offset :]
    text = b"\n".join(parts).decode("utf-8", "replace")
    again = parsed(text)
    same = again is not None and [ast.dump(one) for one in again.body] == [ast.dump(node)]
    return text if same else _unparsed(node)


def _unparsed(node: ast.stmt) -> str:
    return ast.unparse(ast.fix_missing_locations(node))
