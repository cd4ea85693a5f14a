"""The effects of a statement on names: which it defines, reads, and may change, when it runs and when called later.

What isn't known to change nothing is taken to change what it is called on and what it is handed.
"""

import ast
import builtins
import symtable
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field

import numpy as np

from course.base.texts import words

DISPLAY = words(
    "IPython altair bokeh course ipywidgets matplotlib mpl_toolkits plotly pylab seaborn time "
    "timeit tqdm"
)
"""Packages that show, render and measure, and change nothing else."""

SETTINGS = ("numpy", "random", "sys", "warnings", "decimal")
"""Packages of which a call alone in its line may be a setting that functions depend on."""

_PURE = words(
    "abs all any ascii bin bool bytes callable chr complex dict display divmod enumerate filter "
    "float format frozenset getattr hasattr hash help hex id int isinstance issubclass len list "
    "map max min oct ord pow print range repr reversed round set slice sorted str sum super tuple "
    "type zip"
)
"""Functions of Python that change none of their arguments."""

_FRESH = words(
    "abs all any bool chr complex float format hash hex id int isinstance len ord pow print range "
    "repr round str sum type"
)
"""Those whose result shares nothing with an argument that could be changed."""

_LOOKS = words(
    "all any argmax argmin argsort astype bit_length clip conj copy count cumprod cumsum diagonal "
    "difference dot encode endswith flatten format get imag index intersection isdigit issubset "
    "item items join keys lower max mean min ndim nonzero prod ravel real repeat replace reshape "
    "round searchsorted size split squeeze startswith std strip sum swapaxes take title tobytes "
    "tolist transpose union upper values var view"
)
"""Methods of arrays, tables, texts and sets that change nothing."""

_WRITERS = words(
    "copyto fill_diagonal fromfile genfromtxt load loadtxt place put put_along_axis putmask save "
    "savetxt savez savez_compressed seterr seterrcall set_printoptions"
)
"""Functions of NumPy that write to an argument, a file or a setting."""

_PURE_PACKAGES = ("cmath", "functools", "itertools", "math", "numpy", "operator", "scipy", "typing")
_BUILTINS = frozenset(dir(builtins)) | {"display", "get_ipython"}


@dataclass
class NameEffects:
    """What running something does to names.

    Attributes
    ----------
    reads : names that are read
    stores : names of which an item or attribute is set
    hands : names that are handed to what may change them, or have a method called that may
    shares : pairs of a name and another whose value it may come to share
    dynamic : whether it makes names that only running it can tell
    sets : whether it calls a package's function with nothing of the notebook's: that may be a setting
    """

    reads: set[str] = field(default_factory=set)
    stores: set[str] = field(default_factory=set)
    hands: set[str] = field(default_factory=set)
    shares: set[tuple[str, str]] = field(default_factory=set)
    dynamic: bool = False
    sets: bool = False

    @property
    def changes(self) -> set[str]:
        """Names whose values may be changed."""
        return self.stores | self.hands


def scopes(text: str) -> tuple[set[str], set[str], set[str]]:
    """Names that a statement binds, global names that it or a function in it reads, and those a function sets.

    Raises SyntaxError or ValueError where Python can't compile it.
    """
    compile(text, "<cell>", "exec", dont_inherit=True)
    top = symtable.symtable(text, "<cell>", "exec")
    binds = {one.get_name() for one in top.get_symbols() if one.is_assigned() or one.is_imported()}
    reads = {one.get_name() for one in top.get_symbols() if one.is_referenced()}
    sets = set[str]()
    waiting = [(table, True) for table in top.get_children()]
    while waiting:
        table, runs_now = waiting.pop()
        # A name set by := in a comprehension is one around it.
        runs_now = runs_now and table.get_name() in ("listcomp", "setcomp", "dictcomp", "genexpr")
        waiting += [(inner, runs_now) for inner in table.get_children()]
        for one in table.get_symbols():
            if one.is_global():
                reads |= {one.get_name()} if one.is_referenced() else set()
                if one.is_assigned():
                    (binds if runs_now else sets).add(one.get_name())
    return binds, reads, sets


def imported(nodes: Iterable[ast.stmt]) -> dict[str, str]:
    """Name -> what it is of a package, such as ``numpy.where``, for all imports, those below others too."""
    found: dict[str, str] = {}
    for node in (inner for statement in nodes for inner in executed(statement)):
        if isinstance(node, ast.Import):
            for alias in node.names:
                root = alias.name if alias.asname else alias.name.partition(".")[0]
                found[alias.asname or root] = root
        elif isinstance(node, ast.ImportFrom) and not node.level:
            for alias in node.names:
                found[alias.asname or alias.name] = f"{node.module}.{alias.name}"
                if alias.name == "*" and node.module == "numpy":
                    found |= {name: f"numpy.{name}" for name in np.__all__ if name not in found}
    return found


def executed(node: ast.AST) -> Iterator[ast.AST]:
    """A node and all below it that runs with it: not the bodies of functions."""
    yield node
    for child in ast.iter_child_nodes(node):
        if not (
            isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef) and isinstance(child, ast.stmt)
        ):
            yield from executed(child)


def bodies(node: ast.AST) -> Iterator[ast.AST]:
    """All nodes in the bodies of the functions that a statement defines."""
    for inner in ast.walk(node):
        if isinstance(inner, ast.FunctionDef | ast.AsyncFunctionDef | ast.Lambda):
            for part in inner.body if isinstance(inner.body, list) else [inner.body]:
                yield from ast.walk(part)


def effects(nodes: Iterable[ast.AST], packages: Mapping[str, str]) -> NameEffects:
    """The effects of nodes, each by itself; ``packages``: as from `imported`."""
    found = NameEffects()
    for node in nodes:
        match node:
            case ast.Name(name, ast.Load()):
                found.reads.add(name)
            case ast.Attribute(value, _, ast.Store() | ast.Del()) | ast.Subscript(
                value, _, ast.Store() | ast.Del()
            ):
                found.stores |= shared(value)
                found.dynamic |= _is_namespace(value)
            case ast.Assign(targets, value):
                for target in targets:
                    _share(found, target, value)
            case ast.AnnAssign(target, _, value) | ast.NamedExpr(target, value) if value:
                _share(found, target, value)
            case ast.AugAssign(target, _, value):
                _share(found, target, value)
                found.stores |= shared(target)
            case ast.For(target, value) | ast.AsyncFor(target, value):
                _share(found, target, value)
            case ast.comprehension(target, value):
                _share(found, target, value)
            case ast.withitem(value, ast.expr() as target):
                _share(found, target, value)
            case ast.Match(subject, cases):
                names = {n.name for c in cases for n in ast.walk(c) if isinstance(n, ast.MatchAs)}
                found.shares |= {(n, root) for n in names if n for root in shared(subject)}
            case ast.FunctionDef() | ast.AsyncFunctionDef() | ast.ClassDef():
                for decorator in node.decorator_list:
                    found.hands |= shared(decorator)
            case ast.Expr(ast.Call(function) as call):
                root = dotted(function, packages).partition(".")[0]
                names = {one.id for part in arguments(call) for one in _names(part)}
                if root in SETTINGS and names <= {*packages} and not is_pure(call, packages):
                    found.sets = True
            case ast.Call():
                _call(node, packages, found)
    return found


def _call(node: ast.Call, packages: Mapping[str, str], found: NameEffects) -> None:
    function = node.func
    handed = {root for value in arguments(node) for root in shared(value)} - packages.keys()
    if isinstance(function, ast.Name) and function.id == "exec":
        found.dynamic = True
    if is_pure(node, packages):
        return
    found.hands |= handed
    if isinstance(function, ast.Attribute) and not dotted(function, packages):
        found.hands |= shared(function.value) - packages.keys()
        found.dynamic |= _is_namespace(function.value)
        found.shares |= {(one, other) for one in shared(function.value) for other in handed}


def is_pure(node: ast.Call, packages: Mapping[str, str]) -> bool:
    """Whether a call is known to change none of its arguments, nor what it is called on."""
    function = node.func
    name = dotted(function, packages)
    root, _, rest = name.partition(".")
    last = rest.rpartition(".")[2]
    if any(one.arg == "out" for one in node.keywords):
        return False
    if root == "numpy":
        ufunc = getattr(np, last, None)
        more = isinstance(ufunc, np.ufunc) and len(node.args) > ufunc.nin
        random = "random" in rest and last in ("seed", "shuffle", "set_state")
        return not more and not random and last not in _WRITERS and last != "at"
    if root in _PURE_PACKAGES or root in DISPLAY:
        return True
    if isinstance(function, ast.Name):
        return function.id in _PURE and function.id not in packages
    return isinstance(function, ast.Attribute) and not name and function.attr in _LOOKS


def dotted(node: ast.expr, packages: Mapping[str, str]) -> str:
    """What something is of a package: ``numpy.add.at`` for np.add.at; empty for all else."""
    parts: list[str] = []
    while isinstance(node, ast.Attribute | ast.Call | ast.Subscript):
        if isinstance(node, ast.Attribute):
            parts.append(node.attr)
            node = node.value
        elif packages.get(_root(node), "").partition(".")[0] in DISPLAY:
            # Whatever comes of what shows something shows something.
            node = node.func if isinstance(node, ast.Call) else node.value
        else:
            return ""
    if isinstance(node, ast.Name) and node.id in packages:
        return ".".join([packages[node.id], *reversed(parts)])
    return ""


def _root(node: ast.expr) -> str:
    while isinstance(node, ast.Attribute | ast.Call | ast.Subscript):
        node = node.func if isinstance(node, ast.Call) else node.value
    return node.id if isinstance(node, ast.Name) else ""


def arguments(node: ast.Call) -> list[ast.expr]:
    """The values that a call hands over."""
    return [*node.args, *(one.value for one in node.keywords)]


def shared(node: ast.expr | None) -> set[str]:
    """Names whose values, or parts of them, may be in a value."""
    match node:
        case ast.Name(name):
            return {name}
        case ast.Attribute(value) | ast.Subscript(value) | ast.Starred(value) | ast.Await(value):
            return shared(value)
        case ast.NamedExpr(target, value):
            return shared(target) | shared(value)
        case ast.Call(function):
            if isinstance(function, ast.Name) and function.id in _FRESH:
                return set()
            own = shared(function.value) if isinstance(function, ast.Attribute) else set()
            return own | {root for one in arguments(node) for root in shared(one)}
        case ast.IfExp(_, first, second):
            return shared(first) | shared(second)
        case ast.BoolOp(_, values) | ast.Tuple(values) | ast.List(values) | ast.Set(values):
            return {root for one in values for root in shared(one)}
        case ast.Dict(_, values):
            return {root for one in values for root in shared(one)}
        case (
            ast.ListComp(element, parts)
            | ast.SetComp(element, parts)
            | ast.GeneratorExp(element, parts)
        ):
            return shared(element) | {root for part in parts for root in shared(part.iter)}
        case ast.DictComp(_, element, parts):
            return shared(element) | {root for part in parts for root in shared(part.iter)}
        case ast.Lambda(body=body):
            return {one.id for one in _names(body)}
    return set()


def _names(node: ast.AST) -> Iterator[ast.Name]:
    return (one for one in ast.walk(node) if isinstance(one, ast.Name))


def _share(found: NameEffects, target: ast.expr, value: ast.expr) -> None:
    names = {one.id for one in _names(target)}
    found.shares |= {(name, root) for name in names for root in shared(value)}


def _is_namespace(node: ast.expr) -> bool:
    """Whether it is ``globals()``, or another that does as well."""
    return isinstance(node, ast.Call) and (
        getattr(node.func, "id", "") in ("globals", "locals", "vars") and not node.args
    )


def is_builtin(name: str) -> bool:
    """Whether a name needs no definition."""
    return name in _BUILTINS


def is_fixed(node: ast.expr | None, fixed: set[str], packages: Mapping[str, str]) -> bool:
    """Whether a value can't be changed in place: numbers, texts, and tuples of these."""
    match node:
        case ast.Constant():
            return True
        case ast.Name(name):
            return name in fixed
        case ast.UnaryOp(_, operand):
            return is_fixed(operand, fixed, packages)
        case ast.BinOp(left, _, right):
            return is_fixed(left, fixed, packages) and is_fixed(right, fixed, packages)
        case ast.Tuple(values):
            return all(is_fixed(one, fixed, packages) for one in values)
        case ast.Compare() | ast.JoinedStr():
            return True
        case ast.Attribute():
            return dotted(node, packages) in _NUMBERS
        case ast.Call(ast.Name(name)):
            return name in _FRESH
        case ast.Call(function, values):
            root, _, last = dotted(function, packages).partition(".")
            scalar = last in _SCALARS or root == "math"
            return scalar and all(is_fixed(one, fixed, packages) for one in values)
    return False


_SCALARS = words(
    "float32 float64 float16 int8 int16 int32 int64 uint8 uint16 uint32 uint64 dtype sqrt exp log "
    "sin cos tan finfo iinfo"
)
_NUMBERS = frozenset(
    [f"{package}.{name}" for package in ("numpy", "math") for name in ("pi", "e", "inf", "nan")]
    + [f"numpy.{name}" for name in _SCALARS]
)
