"""The statements of a notebook that the functions of its module come to need, in their order.

All that binds a needed name, or sets an item or attribute of one, is needed as it stands. What only *may* change
something needed, by a call that nobody knows, is kept too, but may fail: in a notebook a cell that fails stops no
other.
What is known to show, to measure or to read goes.
"""

import ast
import sys
from collections import Counter
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field, replace
from typing import Any, TypeGuard

from course.engine.functions.notebook.cells import Statement
from course.engine.functions.notebook.name_effects import (
    DISPLAY,
    NameEffects,
    arguments,
    bodies,
    dotted,
    effects,
    executed,
    imported,
    is_builtin,
    is_fixed,
    is_pure,
    scopes,
)

Place = tuple[int, int]
"""A cell, and a line in it."""


@dataclass
class _Use:
    """A statement and the names that it is about.

    Attributes
    ----------
    statement : it
    binds : names that it binds
    reads : global names that it or a function in it reads
    sets : global names that a function in it sets
    now, later : effects when it runs, and those of the bodies of its functions when they do
    kept : "" for what isn't, "may fail", or "as it is"
    """

    statement: Statement
    binds: set[str]
    reads: set[str]
    sets: set[str]
    now: NameEffects
    later: NameEffects
    kept: str = field(default="", compare=False)

    @property
    def defines_function(self) -> bool:
        return isinstance(self.statement.node, ast.FunctionDef | ast.AsyncFunctionDef)


MAY_FAIL, AS_IT_IS = "may fail", "as it is"


class Code:
    """The code of a notebook, from which modules can be taken.

    Parameters
    ----------
    statements : of all cells
    told : gets what can't be compiled
    """

    def __init__(self, statements: Sequence[Statement], told: list[str]) -> None:
        self.packages = _packages(statements)
        self.uses: list[_Use] = []
        for one in (_shown_not(statement, self.packages) for statement in statements):
            try:
                binds, reads, sets = scopes(one.text)
            except (SyntaxError, ValueError, RecursionError) as error:
                told.append(f"cell {one.cell}, line {one.line}: left out: {error.args[0]}")
                continue
            now = effects(executed(one.node), self.packages)
            later = effects(bodies(one.node), self.packages)
            self.uses.append(_Use(one, binds, reads, sets, now, later))
        self.bound = set[str]().union(*(use.binds for use in self.uses))
        self.fixed = self._fixed()
        functions = [use for use in self.uses if use.defines_function]
        self.functions = (
            set[str]()
            .union(*(use.binds for use in functions))
            .difference(*(use.binds for use in self.uses if not use.defines_function))
        )
        self.needed, self.may = set[str](), set[str]()
        self.asked = frozenset[str]()

    def module(self, functions: Iterable[str]) -> tuple[str, list[Place], list[Statement]]:
        """The text of what some functions need, where its lines stand, and statements that do something and are left.

        The text is empty where none of the functions is defined.
        """
        self.needed, self.may = {*functions} & self.bound, set()
        self.asked = frozenset(self.needed)
        if not self.needed:
            return "", [], []
        for use in self.uses:
            use.kept = ""
        self._choose()
        future = {use.statement.text: use for use in self.uses if _is_future(use)}
        kept = [use for use in self.uses if use.kept and not _is_future(use)]
        left = [use.statement for use in self.uses if not use.kept and self._does_something(use)]
        texts, places = (
            [*future],
            [place for text, use in future.items() for place in _places(use, text)],
        )
        for use in kept:
            texts.append(_text(use))
            places += _places(use, texts[-1])
        return "\n\n".join(texts), places, left

    def rebound(self) -> list[tuple[str, list[Place]]]:
        """Of the module that was taken last: needed names that several cells bind, with where; its functions first.

        A cell that says what another says, as the same import does, is no other binding.
        """
        bound: dict[str, dict[int, _Use]] = {}
        for use in self.uses:
            # Of a cell its last binding, which is the one that those below it have.
            for name in use.binds & self.needed if use.kept else ():
                bound.setdefault(name, {})[use.statement.cell] = use
        return [
            (name, [(cell, use.statement.line) for cell, use in uses.items()])
            for name, uses in sorted(bound.items(), key=lambda of: (of[0] not in self.asked, of[0]))
            if len({use.statement.text for use in uses.values()}) > 1
        ]

    def _choose(self) -> None:
        """Mark what is kept."""
        if any(use.now.dynamic or use.later.dynamic for use in self.uses):
            # Names made by a text: nobody can say which.
            for use in self.uses:
                self._keep(use, MAY_FAIL)
        before = -1
        while before != (before := self._size()):
            watched = self._watched()
            carriers = self._carriers(watched)
            for use in self.uses:
                if use.kept != AS_IT_IS and (how := self._how(use, watched, carriers)):
                    self._keep(use, how)

    def _size(self) -> int:
        kept = sum(bool(use.kept) + (use.kept == AS_IT_IS) for use in self.uses)
        return kept + len(self.needed) + len(self.may)

    def _keep(self, use: _Use, how: str) -> None:
        use.kept = how
        # A name that += stores to is read, too.
        names = use.reads | use.sets | use.now.stores
        (self.needed if how == AS_IT_IS else self.may).update(names)

    def _how(self, use: _Use, watched: set[str], carriers: set[str]) -> str:
        """How a statement is to be kept, by what is needed until now."""
        shows = any(self._is_display(name) for name in use.now.reads)
        if use.binds & self.needed or (use.now.stores & self.needed - self.fixed and not shows):
            return AS_IT_IS
        if star := _star(use.statement.node):
            root = star.partition(".")[0]
            lacking = any(name not in self.bound and not is_builtin(name) for name in self.needed)
            known = root == "numpy" or root in sys.stdlib_module_names
            if known or lacking:
                return AS_IT_IS
            return "" if root in DISPLAY else MAY_FAIL
        changed = use.now.changes & watched or use.now.reads & carriers
        return MAY_FAIL if changed or use.binds & self.may or use.now.sets else ""

    def _watched(self) -> set[str]:
        """Names whose values may be changed in place, and by that what is needed."""
        watched = (self.needed | self.may) & self.bound
        watched -= self.fixed | self.functions | {*self.packages}
        before = -1
        while before != (before := len(watched)):
            for use in self.uses:
                watched |= {name for name, other in use.now.shares if other in watched}
        return watched

    def _carriers(self, watched: set[str]) -> set[str]:
        """Names of functions that change what is watched when they are called."""
        carriers = set[str]()
        before = -1
        while before != (before := len(carriers)):
            for use in self.uses:
                changed = set(use.later.changes)
                more = -1
                while more != (more := len(changed)):
                    changed |= {other for name, other in use.later.shares if name in changed}
                changed &= use.reads
                sets = use.sets & (self.needed | self.may)
                if changed & watched or use.later.reads & use.reads & carriers or sets:
                    carriers |= use.binds
        return carriers

    def _fixed(self) -> set[str]:
        """Names that are numbers, texts and the like wherever they are bound."""
        fixed = set(self.bound)
        before = -1
        while before != (before := len(fixed)):
            for use in self.uses:
                fixed -= use.binds - _fixed_by(use.statement.node, fixed, self.packages)
        return fixed

    def _is_display(self, name: str) -> bool:
        return self.packages.get(name, "").partition(".")[0] in DISPLAY

    def _is_courses(self, name: str) -> bool:
        return self.packages.get(name, "").partition(".")[0] == "course"

    def _does_something(self, use: _Use) -> bool:
        """Whether a statement defines or changes anything: what is imported only has another name."""
        imports = isinstance(use.statement.node, ast.Import | ast.ImportFrom)
        # What the course has made of functions is a picture to look at.
        made = {name for name in use.binds if self._is_courses(name)}
        return not imports and bool(use.binds - made or use.now.changes - self.functions)


def _fixed_by(node: ast.stmt, fixed: set[str], packages: dict[str, str]) -> set[str]:
    """Names to which a statement gives a value that can't be changed in place."""
    match node:
        case ast.Assign(targets, value) if is_fixed(value, fixed, packages):
            return set[str]().union(*map(_names, targets))
        case ast.AnnAssign(ast.Name(name), _, value) | ast.AugAssign(ast.Name(name), _, value):
            return {name} if is_fixed(value, fixed, packages) else set()
    return set()


def _names(node: ast.AST) -> set[str]:
    return {one.id for one in ast.walk(node) if isinstance(one, ast.Name)}


def _packages(statements: Sequence[Statement]) -> dict[str, str]:
    """What names are of packages: by imports, and what only ever comes of what shows something."""
    nodes = [inner for one in statements for inner in executed(one.node)]
    packages = {"display": "IPython.display"} | imported([one.node for one in statements])
    made = Counter[str]()
    for node in nodes:
        match node:
            case ast.Assign(targets, value) if _is_shown(value, packages):
                pass
            case ast.withitem(value, ast.expr() as target) if _is_shown(value, packages):
                targets = [target]
            case _:
                continue
        names = [name for target in targets for name in _names(target)]
        made.update(names)
        for name in names:
            packages.setdefault(name, dotted(value, packages))
    # A name that is something else elsewhere is nothing that is known.
    bound = Counter(one.id for one in nodes if _is_stored(one))
    bound.update(one.name for one in nodes if _is_definition(one))
    return {name: of for name, of in packages.items() if bound[name] <= made[name]}


def _is_stored(node: ast.AST) -> TypeGuard[ast.Name]:
    return isinstance(node, ast.Name) and not isinstance(node.ctx, ast.Load)


def _is_definition(
    node: ast.AST,
) -> TypeGuard[ast.FunctionDef | ast.AsyncFunctionDef | ast.ClassDef]:
    return isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef | ast.ClassDef)


def _is_shown(node: ast.expr, packages: dict[str, str]) -> bool:
    return dotted(node, packages).partition(".")[0] in DISPLAY


def _shown_not(statement: Statement, packages: dict[str, str]) -> Statement:
    """A statement without what shows something: of such calls the arguments stay that may change something."""
    before = ast.dump(statement.node)
    node: ast.stmt = _Shown(packages).visit(statement.node)
    if ast.dump(node) == before:
        return statement
    text = ast.unparse(ast.fix_missing_locations(node))
    return replace(statement, node=node, text=text, whole=False)


class _Shown(ast.NodeTransformer):
    """Takes what shows something out of a statement and of those below it, the bodies of functions left as they are."""

    def __init__(self, packages: dict[str, str]) -> None:
        self.packages = packages
        self.depth = 0

    def visit(self, node: ast.AST) -> Any:
        if _is_definition(node) or isinstance(node, ast.Lambda):
            return node
        self.depth += isinstance(node, ast.stmt)
        node = super().visit(node)
        self.depth -= isinstance(node, ast.stmt)
        return node

    def visit_Expr(self, node: ast.Expr) -> ast.stmt:
        call = self.visit(node.value)
        node.value = call
        if not isinstance(call, ast.Call) or not _is_shown(call.func, self.packages):
            return node
        may = [one for one in arguments(call) if not self._is_idle(one)]
        return ast.Expr(ast.Tuple(may, ast.Load())) if may else ast.Pass()

    def visit_Call(self, node: ast.Call) -> ast.expr:
        self.generic_visit(node)
        name = dotted(node.func, self.packages)
        if name.partition(".")[0] != "tqdm" or not node.args:
            return node
        # A bar of progress gives what it is handed.
        numbers = ast.Call(ast.Name("range", ast.Load()), node.args, [])
        return numbers if name.endswith("trange") else node.args[0]

    def visit_Assign(self, node: ast.Assign) -> ast.stmt:
        self.generic_visit(node)
        below = self.depth > 1 and _is_shown(node.value, self.packages)
        return ast.Pass() if below and self._is_idle(node.value) else node

    def visit_With(self, node: ast.With) -> ast.stmt:
        self.generic_visit(node)
        items = [one for one in node.items if not _is_shown(one.context_expr, self.packages)]
        if len(items) == len(node.items):
            return node
        return ast.With(items, node.body) if items else ast.If(ast.Constant(True), node.body, [])

    def _is_idle(self, node: ast.expr) -> bool:
        """Whether to work out a value changes nothing."""
        calls = [one for one in ast.walk(node) if isinstance(one, ast.Call)]
        return all(is_pure(one, self.packages) for one in calls) and not any(
            isinstance(one, ast.NamedExpr | ast.Await) for one in ast.walk(node)
        )


def _star(node: ast.stmt) -> str:
    """The package of which a statement imports everything."""
    for one in executed(node):
        match one:
            case ast.ImportFrom(module, [ast.alias("*")]):
                return module or "."
    return ""


def _is_future(use: _Use) -> bool:
    node = use.statement.node
    return isinstance(node, ast.ImportFrom) and node.module == "__future__"


def _places(use: _Use, text: str) -> list[Place]:
    """Where the lines of what is kept stand, and the blank one after it."""
    one = use.statement
    own = one.whole and text == one.text
    return [(one.cell, one.line + own * n) for n in range(text.count("\n") + 2)]


def _text(use: _Use) -> str:
    """The text of what is kept; what may fail says so among what the module prints."""
    one = use.statement
    if use.kept == AS_IT_IS:
        return one.text
    lines = "\n".join(f"    {line}" for line in ast.unparse(ast.parse(one.text)).split("\n"))
    where = f"cell {one.cell}, line {one.line} fails here:"
    # A text over several lines would change with its indentation; unparsed, it has none.
    return f"try:\n{lines}\nexcept BaseException as __why:\n    print({where!r}, repr(__why))"
