"""A module from a notebook's cells, each line of which keeps its place: cell, and line in it."""

import __future__

import ast
import linecache
from collections import defaultdict
from importlib.abc import Loader
from importlib.machinery import ModuleSpec
from pathlib import Path
from types import CodeType, ModuleType

from course.engine.functions.notebook.reachable import first_line
from course.engine.functions.sources import ModuleCells, code_name


class CellsLoader(Loader):
    """Runs what a notebook has of a module; see ``Loader``.

    Parameters
    ----------
    name : of the module
    path : the notebook
    cells : what it has
    """

    def __init__(self, name: str, path: Path, cells: ModuleCells) -> None:
        self._name, self._path, self._cells = name, path, cells

    def create_module(self, spec: ModuleSpec) -> None:
        """Leave it to Python."""

    def exec_module(self, module: ModuleType) -> None:
        """Run it, statement by statement."""
        for code in self._codes():
            exec(code, module.__dict__)

    def _codes(self) -> list[CodeType]:
        text, places = self._cells.text.decode("utf-8"), self._cells.places
        tree, flags, codes = ast.parse(text, str(self._path)), 0, []
        self._keep_lines(text)
        for node in tree.body:
            cell, line = places[first_line(node) - 1] if places else (0, first_line(node))
            ast.increment_lineno(node, line - first_line(node))
            if isinstance(node, ast.ImportFrom) and node.module == "__future__":
                features = (getattr(__future__, alias.name, None) for alias in node.names)
                flags |= sum(feature.compiler_flag for feature in features if feature)
            file = code_name(self._path, cell) if cell else str(self._path)
            one = ast.Module([node], [])
            codes.append(compile(one, file, "exec", flags, dont_inherit=True))
        return codes

    def _keep_lines(self, text: str) -> None:
        """Have tracebacks and messages find the lines of the cells."""
        cells: dict[int, dict[int, str]] = defaultdict(dict)
        for (cell, line), row in zip(self._cells.places, text.split("\n"), strict=False):
            cells[cell].setdefault(line, row)
        for cell, rows in cells.items():
            lines = [f"{rows.get(n, '')}\n" for n in range(1, max(rows) + 1)]
            file = code_name(self._path, cell)
            linecache.cache[file] = (sum(map(len, lines)), None, lines, file)
