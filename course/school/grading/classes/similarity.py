"""Pairs of submissions that are too much alike, found in their syntax trees.

What a student may change without thinking counts for nothing: names, constants, comments, docstrings, the order of
functions, code that nothing calls. What everybody has counts for nothing either: the statements of the stub, the heads
of its functions, and guards that do nothing but raise. What remains is compared by its runs of SHINGLE neighbouring
nodes. A pair that is found is worth a look, never a verdict.

Each file is parsed once, apart from the grader, and what came of it is kept. The work is linear in the size of the
tree, and done without recursion: students choose what the tree looks like.
"""

import ast
import builtins
import hashlib
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from zipfile import BadZipFile
from zlib import crc32

import numpy as np
from numpy.typing import NDArray

from course.base.atomic import replacing
from course.engine.functions.effects import PROJECT
from course.engine.functions.notebook.reachable import parsed, reachable
from course.school.grading.classes.engines import apart
from course.school.grading.classes.submitted import Submission
from course.school.grading.release.stubs import make_stub

SHINGLE = 9
"""Nodes of the tree that are compared together."""

LARGEST = 200_000
"""Bytes of a file that is looked at."""

ALIKE = 0.7
"""Share of the smaller submission's shingles that the larger one has too."""

FEWEST = 40
"""Shingles; short files are alike without anybody's having copied."""

_FORMAT = "1"
"""Goes up when what is kept would come out otherwise."""

Given = frozenset[int]
"""Statements of a stub, each as a hash of its nodes."""

Shingles = NDArray[np.int64]
"""What one submission is compared by: sorted, each once."""

_BUILTINS = frozenset(dir(builtins))


@dataclass(frozen=True)
class Similar:
    """Two submissions of a module that are alike.

    Attributes
    ----------
    module : str
    first, second : the students, in the order of the alphabet
    share : of the smaller one's shingles that the other one has, 0 to 1
    """

    module: str
    first: str
    second: str
    share: float


@dataclass(frozen=True)
class Compared:
    """The result of comparing a class.

    Attributes
    ----------
    similar : pairs that are too much alike
    left_out : student and module of files that are too large or took too long to be compared
    """

    similar: tuple[Similar, ...] = ()
    left_out: tuple[tuple[str, str], ...] = ()


def compare(
    submissions: Sequence[Submission], modules: Sequence[str], kept: Path, jobs: int = 1
) -> Compared:
    """Compare the submissions of a class, module by module.

    Parameters
    ----------
    kept : file in which what came of each text is kept from run to run
    jobs : processes
    """
    stubs = {module: _stub(module) for module in modules}
    texts: dict[str, _Text] = {}
    keys: dict[tuple[str, str], str] = {}
    for one in submissions:
        for module, source in one.sources.items():
            text = module, source, stubs[module]
            keys[one.student, module] = key = _key(text)
            if len(source) <= LARGEST:
                texts[key] = text
    found = _of_texts(texts, kept, jobs)
    similar: list[Similar] = []
    for module in modules:
        of_module = {
            student: found[key]
            for (student, name), key in keys.items()
            if name == module and key in found
        }
        similar += find_similar(module, of_module)
    left_out = tuple(file for file, key in keys.items() if key not in found)
    return Compared(tuple(similar), left_out)


_Text = tuple[str, bytes, str]
"""Module, source, stub."""


def _key(text: _Text) -> str:
    """The same for the same text."""
    module, source, stub = text
    parts = (_FORMAT.encode(), module.encode(), stub.encode(), source)
    return hashlib.sha256(b"\0".join(hashlib.sha256(part).digest() for part in parts)).hexdigest()


def _of_texts(texts: Mapping[str, _Text], kept: Path, jobs: int) -> dict[str, Shingles]:
    """Shingles of texts, from earlier runs or made now; texts that took too long are left out."""
    found = {key: own for key, own in _read(kept).items() if key in texts}
    new = [text for key, text in texts.items() if key not in found]
    for place, own in apart(_compared_by, new, jobs).items():
        # One that took too long is tried again by the next run: it may have been the machine's doing.
        if own is not None:
            found[_key(new[place])] = own
    if new:
        with replacing(kept) as temporary, temporary.open("wb") as file:
            np.savez_compressed(file, **found)  # type: ignore[arg-type]
    return found


def _compared_by(text: _Text) -> Shingles:
    module, source, stub = text
    return as_shingles(shingles(module, source, statements(stub)))


def _read(path: Path) -> dict[str, Shingles]:
    try:
        with np.load(path, allow_pickle=False) as file:
            return {name: file[name] for name in file.files}
    except (OSError, ValueError, EOFError, BadZipFile):
        return {}  # Not there, or not ours.


def _stub(module: str) -> str:
    path = PROJECT / "solutions" / f"{module}.py"
    text = path.read_text(encoding="utf-8")
    return make_stub(text, module, str(path.relative_to(PROJECT))).text


def as_shingles(found: Iterable[int]) -> Shingles:
    """Hashes as they are compared and kept."""
    return np.unique(np.fromiter(found, np.int64))


def find_similar(
    module: str, found: Mapping[str, Shingles], threshold: float = ALIKE
) -> list[Similar]:
    """Pairs of submissions of one module that are alike, the most alike first.

    Parameters
    ----------
    found : student -> what the submission is compared by
    threshold : least share that is told
    """
    students = sorted(student for student, own in found.items() if own.size >= FEWEST)
    if len(students) < 2:
        return []
    size = np.array([found[student].size for student in students])
    _, columns = np.unique(np.concatenate([found[one] for one in students]), return_inverse=True)
    starts = np.concatenate([[0], np.cumsum(size)])
    # The process that parses a file waits for no library.
    from scipy.sparse import csr_array

    has = csr_array((np.ones(columns.size, np.int32), columns, starts))
    shared = (has @ has.T).toarray()
    share = np.triu(shared / np.minimum(size[:, None], size), 1)
    return sorted(
        (
            Similar(module, students[i], students[j], float(share[i, j]))
            for i, j in zip(*np.nonzero(share >= threshold), strict=True)
        ),
        key=lambda pair: (-pair.share, pair.first, pair.second),
    )


def statements(stub: str) -> Given:
    """Statements of a stub as `shingles` leaves them out."""
    tree = ast.parse(stub)
    hashes = _hashes(tree)
    return frozenset(hashes[id(node)] for node in ast.walk(tree) if isinstance(node, ast.stmt))


def shingles(module: str, source: bytes, given: Given) -> set[int]:
    """Shingles of a submission: hashes of runs of nodes in what the student wrote.

    Parameters
    ----------
    given : statements of the stub

    Returns
    -------
    set of int
        Empty if the file can't be parsed or is very large.
    """
    found: set[int] = set()
    tree = parsed(source) if len(source) <= LARGEST else None
    if tree is None:
        return found
    hashes = _hashes(tree)
    for own in reachable(module, tree):
        tokens = [crc32(token.encode()) for token in _tokens(own, hashes, given)]
        found.update(hash(tuple(tokens[i : i + SHINGLE])) for i in range(len(tokens) - SHINGLE + 1))
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
    """True if a node is something that its author has thought of."""
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
