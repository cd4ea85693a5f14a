"""Do all that pages say, in a copy of the course: ``python -m tests.docs.following PAGE...``.

Commands go through the real command line, page by page and line by line, so that one finds the files of the one before.
What would take long is shortened by options or by smaller scenes (`SHORTER`, `small`); the few that are not run are
named with the reason (`NOT_RUN`), and a line that nothing here knows is a failure.
"""

import os
import re
import shlex
import shutil
import subprocess
import sys
import tomllib
from collections.abc import Callable, Iterator, Sequence
from contextlib import ExitStack, contextmanager
from functools import partial
from importlib import import_module
from itertools import pairwise
from pathlib import Path
from types import SimpleNamespace
from typing import Any
from unittest import mock

import click
import yaml
from click.testing import CliRunner

from course.cli.main import COMMANDS, commands
from course.engine.functions.modules import COURSE
from tests.docs.blocks import Block, blocks

NOT_RUN = {
    "pip": "installs from the network; its extras are looked up in pyproject.toml",
    "jupyter": "serves until it is ended; tests/school/notebooks opens it in a browser",
    "apt": "changes the machine",
    "activate": "changes the shell; the file is made by the line above it",
    "pytest": "is what runs this",
    "benchmarks": "measures for minutes; that it takes these arguments is checked",
    "make": "recipes are printed by `make -n`; what they call of the course is run",
}
"""What is not run, and why."""

TOOLS = {"ruff", "mypy", "sphinx", "http.server", "pip", "pytest", "sitebuild.ahead", "uv"}
"""Programs that recipes of the Makefile call beside the course."""

TINY = ["--size", "48x32"]
FEW = ["--modules", "adaptive_sampling"]
REFERENCES = ("adaptive_sampling", "thin_lens")
"""Modules whose references are made; tests/school/grading/release makes them all."""

SHORTER: dict[str, list[str]] = {
    "render": [*TINY, "--spp", "4"],
    "bundle": FEW,
    "grade": FEW,
    "calibrate": ["--seeds", "1"],
    "quiz": ["--modules", "film"],
    "portfolio": ["--time-limit", "1"],
    "docs": ["--no-browser"],
}
"""Options added to a command to make it short; of two equal options the last one holds."""

ONCE = {
    "make demo": "README.md",
    "course check": "docs/guides/students.md",
    "course release --out student.zip": "docs/guides/instructors.md",
    "course references": "docs/guides/instructors.md",
    "course status": "README.md",
    "course grade SUBMISSIONS/ --out graded": "README.md",
    "course grade SUBMISSIONS/ --out graded --seed 20261": "docs/guides/instructors.md",
    "course grade SUBMISSIONS/ --out graded --engine dask --address tcp://host:8786": (
        "docs/guides/instructors.md"
    ),
    "course regrade SUBMISSIONS/ --out graded --dry-run": "docs/guides/grades.md",
    "course bundle gradescope --out autograder.zip --seed 20261": "docs/guides/instructors.md",
    "course bundle docker --out image --seed 20261": "docs/guides/instructors.md",
    "course bench": "docs/performance.md",
}
"""What takes seconds however small its scenes are, and the one page for which it is run."""

LIKE = {
    r"course check \w+ --watch": "docs/modules/soft_shadows.md",
    r"course check \w+ --html report.html": "docs/modules/thin_lens.md",
    # The same modules are measured there, and more is done with what is measured.
    r"course bench \w+( --quick)?": "docs/performance.md",
}
"""What the pages of modules say alike, each of its own, and the one page for which it is run."""

TWINS = {"docs/accuracy.md": "docs/performance.md"}
"""Pages that are written by the same commands: what stands on the other is run there."""

SAYS = {
    ("docs/guides/start.md", "course info my_shadow.yaml"): (
        r"calls soft_shadows\.point_on_sphere +my_shadow\.yaml:11"
    ),
    ("docs/guides/start.md", "course render my_shadow.yaml -o soft.png"): "point_on_sphere",
    ("docs/guides/instructors.md", "course release --check"): "up to date",
}
"""What a page says that a command prints."""

REPLACED = {"docs/guides/start.md": ("my_shadow.yaml", "type: point")}
"""Part of a scene that replaces a line: in which file, and what stands in that line."""

DIFFER = (("before.png", "after.png"), ("my_shadow.png", "soft.png"))
"""Pictures that a page makes to be compared."""

SETTING = {
    "docs/modules/bounding_volumes.md": """
import numpy as np
from concurrent.futures import ThreadPoolExecutor
rays, half = np.ones((6, 8), np.float32), 4
def walk(part):
    return part.sum(axis=0)
""",
    "docs/guides/notebook.md": "mine = {}",
}
"""What a piece of Python takes for granted."""

MINIMAL: dict[str, Any] = {
    "camera": {"eye": [0, 1, 4], "look_at": [0, 0, 0]},
    "film": {"width": 48, "height": 32},
    "sampler": {"samples": 4},
    "materials": {"grey": {}},
    "lights": [{"type": "point", "position": [0, 3, 3], "intensity": 20}],
    "objects": [{"shape": "sphere", "material": "grey", "segments": 16}],
}
"""What parts of scenes are put into."""

MANY_WORDS = 8
"""Of a command that asks for more than grades, with the options that make it short."""

COARSER = 50
"""Times fewer rays that find what patches see of each other."""

OUTPUTS = ("-o", "--out", "--html", "--json", "--receipt", "--heat-map", "--plots")


class FollowingError(Exception):
    """A line does not do what the page says."""


class Page:
    """A page that is being followed.

    Parameters
    ----------
    name : path of the page in the project
    folder : the copy, which is also the working folder
    """

    def __init__(self, name: str, folder: Path) -> None:
        self.name = name
        self.folder = folder
        self.names: dict[str, Any] = {}
        self.cluster: Any = None

    def follow(self) -> None:
        """Do everything; print what was done."""
        text = (self.folder / self.name).read_text(encoding="utf-8")
        seen: set[str] = set()
        for block in blocks(self.folder / self.name):
            line = _without_comment(block.text)
            try:
                if line in seen:
                    done = "as above"
                elif ONCE.get(line, self.name) != self.name and not _speaks_of(block):
                    done = f"as in {ONCE[line]}"
                elif other := self._like(line):
                    done = f"like in {other}"
                elif self.name in TWINS and line in self._twin():
                    done = f"as in {TWINS[self.name]}"
                else:
                    done = self._do(block)
            except Exception as error:
                raise FollowingError(
                    f"{self.name}:{block.line}: {block.text}\n{type(error).__name__}: {error}"
                ) from error
            seen.add(line)
            click.echo(f"{self.name}:{block.line}: {done}: {block.text.splitlines()[0]}")
        for file in re.findall(r"`(graded/[\w./]+)`", text):
            if not Path(file.replace("STUDENT", "ada")).is_file():
                raise FollowingError(f"{self.name}: `course grade` did not write {file}")
        for extra in re.findall(r'"\.\[(\w+)\]"', text):
            if extra not in extras():
                raise FollowingError(f"{self.name}: pyproject.toml has no extra {extra}")

    def _like(self, line: str) -> str | None:
        """The page for which a line of another module is run."""
        if self.name != f"docs/modules/{(*line.split(), '', '')[2]}.md":
            return None
        pages = [page for known, page in LIKE.items() if re.fullmatch(known, line)]
        return pages[0] if pages and pages[0] != self.name else None

    def _twin(self) -> set[str]:
        return {_without_comment(block.text) for block in blocks(Path(TWINS[self.name]))}

    def _do(self, block: Block) -> str:
        match block.kind:
            case "command":
                return self._line(block.text)
            case "inline":
                return self._line(f"{block.text} --help" if _speaks_of(block) else block.text)
            case "python":
                return self._python(block.text)
            case "yaml" | "text" if name := _other_file(block):
                Path(name).write_text(block.text, encoding="utf-8")
                return "saved"
            case "yaml":
                return self._yaml(block)
            case "bibtex":
                return "compared with CITATION.cff by tests/docs/test_citation.py"
        raise FollowingError(f"nothing is known of code of the kind {block.kind!r}")

    def _line(self, line: str) -> str:
        words = shlex.split(line.replace("\\", "/"), comments=True)
        words[0] = re.sub(r"^\.venv/(bin|Scripts)/", "", words[0])
        match words:
            case [_, "-m", "course"]:
                _invoke(["--help"])
                return "described"
            case ["course", *rest] | [_, "-m", "course", *rest]:
                return self._course(rest, line)
            case ["make", target]:
                return self._make(target)
            case ["pip", *rest] | [_, "-m", "pip", *rest]:
                return _pip(rest)
            case ["python3", "-m", "venv", ".venv"] | ["py", "-3", "-m", "venv", ".venv"]:
                made = ["-m", "venv", "--without-pip", ".venv"]
                subprocess.run([sys.executable, *made], check=True)
                return "run"
            case ["source", file]:
                if not Path(file).is_file() and "venv" not in file:
                    raise FollowingError(f"{file} is not there")
                return f"not run ({NOT_RUN['activate']})"
            case ["activate"]:
                return f"not run ({NOT_RUN['activate']})"
            case ["apt", "install", "bubblewrap" | "libseccomp2"]:
                return f"not run ({NOT_RUN['apt']})"
            case ["jupyter", "lab", place] if Path(place).exists():
                return f"not run ({NOT_RUN['jupyter']})"
            case ["python", "-m", "pytest"]:
                return f"not run ({NOT_RUN['pytest']})"
            case ["python", "-m", module, *rest] if module.partition(".")[0] == "benchmarks":
                return _benchmark(module, rest)
        raise FollowingError("a line of a kind that tests/docs/following.py does not know")

    def _course(self, words: list[str], line: str) -> str:
        name = words[0]
        if "--help" in words:
            _invoke(words)
            return "described"
        if name in ("check", "calibrate"):
            # What stands for a module; in paths it is the name of a file that is there. And to calibrate another module
            # takes ten times as long.
            quick = "thin_lens" if name == "calibrate" else "adaptive_sampling"
            other = {"NAME", *COURSE} if name == "calibrate" else {"NAME"}
            words = [quick if word in other else word for word in words]
        if "--address" in words:
            if not self._start_cluster():
                return "not run (dask is not installed)"
            words[words.index("--address") + 1] = self.cluster.scheduler_address
        written = self._written(words)
        for path in written:
            _remove(path)
        words += (
            [] if name in ("bundle", "grade") and "--modules" in words else SHORTER.get(name, [])
        )
        if name == "grade" and len(words) > MANY_WORDS and "--address" not in words:
            # As many processes as there are cores are started for the line that asks for nothing but grades.
            words += ["--jobs", "1"]
        if "--error" in words:
            # An error can be aimed at with 8 samples or more.
            words += ["--spp", "8"]
        if "--spp" in words and words[words.index("--spp") + 1] == "1":
            del words[-2:]
        if name == "radiosity" and not any(word.endswith(".npz") for word in words[1:2]):
            words += [*TINY, "--patches", "40"]
            # Where patches are divided, all is worked out again at each step.
            words += ["--split", "0.3"] if "--split" in words else []
        elif name == "radiosity":
            words += TINY
        with _small(words), _few_references(name), _coarse(words):
            output = _run(words)
        for path in written:
            if not [*path.parent.glob(f"{path.stem}*{path.suffix}")]:
                raise FollowingError(f"{path} was not written; it printed:\n{output}")
        for first, second in DIFFER:
            if Path(second) in written and Path(first).read_bytes() == Path(second).read_bytes():
                raise FollowingError(f"{second} is the same picture as {first}")
        said = SAYS.get((self.name, _without_comment(line)))
        if said is not None and not re.search(said, output):
            raise FollowingError(f"expected {said!r}, it printed:\n{output}")
        return "run"

    def _written(self, words: list[str]) -> list[Path]:
        """What a line says that it writes."""
        pairs = pairwise(words)
        found = [Path(value) for option, value in pairs if option in OUTPUTS]
        if words[0] == "render" and not found and words[1].endswith(".yaml"):
            found.append(Path(f"{Path(words[1]).stem}.png"))
        # What is graded again has been graded before.
        kept = words[0] == "regrade" or ("--effects" in words and "assignments" in words)
        return [] if kept else found

    def _start_cluster(self) -> bool:
        try:
            from distributed import LocalCluster
        except ImportError:
            return False
        if self.cluster is None:
            self.cluster = LocalCluster(
                n_workers=1,
                threads_per_worker=1,
                dashboard_address=None,
                host="127.0.0.1",
                processes=False,
                protocol="tcp",
            )
        return True

    def _make(self, target: str) -> str:
        environment = {name: value for name, value in os.environ.items() if "MAKE" not in name}
        # It looks for a Python by starting one after the other, each time that its name is needed.
        given = [] if target == "setup" else [f"PYTHON={sys.executable}"]
        command = ["make", "-n", *given, target]
        printed = subprocess.run(
            command, capture_output=True, text=True, env=environment, check=False
        )
        if printed.returncode:
            raise FollowingError(printed.stderr)
        called = re.findall(r"python\" -m ([\w.]+)([^|&\n]*)", printed.stdout)
        for module, rest in called:
            if module == "course":
                self._course(shlex.split(rest), "")
            elif module.partition(".")[0] == "benchmarks":
                _benchmark(module, shlex.split(rest))
            elif module not in TOOLS:
                raise FollowingError(f"make {target} calls {module}, which nothing here knows")
        return f"printed ({NOT_RUN['make']})"

    def _python(self, text: str) -> str:
        if not self.names:
            exec(SETTING.get(self.name, ""), self.names)
        with _small():
            exec(compile(text, self.name, "exec"), self.names)
            for expression, shape, dtype in re.findall(
                r"^(\S+)  # (\(\d.*?\)) (\w+)$", text, re.MULTILINE
            ):
                found = eval(expression, self.names)
                if (str(found.shape), str(found.dtype)) != (shape, dtype):
                    raise FollowingError(f"{expression} is {found.shape} {found.dtype}")
        return "run"

    def _yaml(self, block: Block) -> str:
        found = yaml.safe_load(block.text)
        if found is None:
            return self._comment(block.text)
        if isinstance(found, dict) and {"camera", "objects"} <= found.keys():
            name = re.search(r"Save this as `([\w.]+)`", block.before)
            self._render(block.text, Path(name[1] if name else "shown.yaml"))
            return "rendered"
        scene = dict(MINIMAL)
        if isinstance(found, list):
            known = "objects" if "shape" in found[0] else "lights"
            scene[known] = [*scene[known], *found]
        elif found.keys() <= _keys():
            scene |= found
        else:
            found = {"materials": found}
        if isinstance(found, dict) and "materials" in found:
            # A ball of each is seen.
            balls = [{**MINIMAL["objects"][0], "material": name} for name in found["materials"]]
            scene["materials"] = MINIMAL["materials"] | found["materials"]
            scene["objects"] = [*found.get("objects", MINIMAL["objects"]), *balls]
        self._render(yaml.safe_dump(scene), Path("scenes", "part.yaml"))
        if self.name in REPLACED and isinstance(found, list):
            file, there = REPLACED[self.name]
            lines = Path(file).read_text(encoding="utf-8").splitlines(keepends=True)
            new = [block.text if there in line else line for line in lines]
            if new == lines:
                raise FollowingError(f"{file} has no line with {there}")
            self._render("".join(new), Path(file))
        return "rendered within a small scene"

    def _comment(self, text: str) -> str:
        """The line that tells an editor where the schema is: the line above has written it."""
        schema = re.fullmatch(r"# yaml-language-server: \$schema=(\S+)\n", text)
        if schema is None or not Path("scenes", schema[1]).is_file():
            raise FollowingError("it is nothing but a comment, and names no schema that is there")
        return "checked"

    def _render(self, text: str, path: Path) -> None:
        path.write_text(text, encoding="utf-8")
        _run(["render", str(path), "-o", "part.png", *SHORTER["render"]])


def _other_file(block: Block) -> str:
    """The name under which a page has a file saved that is no scene; a command below reads it."""
    name = re.search(r"Save this as `([\w.]+)`", block.before)
    return name[1] if name and "camera:" not in block.text else ""


def _speaks_of(block: Block) -> bool:
    """Whether it is a command's bare name within a sentence: nobody is told to type it."""
    words = block.text.split()
    return (
        block.kind == "inline" and words[0] == "course" and words[-1] in (*COMMANDS, "gradescope")
    )


def _without_comment(line: str) -> str:
    return re.split(r"\s+# ", line)[0].strip()


def _run(words: list[str]) -> str:
    """Run a command of the course; return what it printed."""
    name = words[0]
    if "--watch" in words:
        with _saved_once(Path("assignments", f"{words[1]}.py")) as saved:
            output = _invoke(words, 130)
        if not saved or output.count("of") < 2 or output.count("watching") != 2:
            raise FollowingError(f"it did not check again when the file was saved:\n{output}")
        return output
    if name in ("studio", "view"):
        return _opened(words)
    if name == "check":
        output = _invoke(words, 3)
        if "to do" not in output:
            raise FollowingError(f"the functions are not said to be to do:\n{output}")
        return output
    if name in ("render", "radiosity") and "assignments" in words:
        output = _invoke(words, 1)
        if not re.search(r"\w+\.\w+: not written yet", output):
            raise FollowingError(f"no function is named that is missing:\n{output}")
        # As when they are written.
        words = ["solutions" if word == "assignments" else word for word in words]
    return _invoke(words)


def _invoke(words: list[str], code: int = 0) -> str:
    done = CliRunner().invoke(commands, words, prog_name="course")
    if done.exit_code != code:
        raise FollowingError(
            f"exit code {done.exit_code} instead of {code}, {done.exception!r}; it printed:\n{done.output}"
        )
    return done.output


def _opened(words: Sequence[str]) -> str:
    """Have a page served, and press Ctrl-C; return what was printed."""
    pressed = SimpleNamespace(wait=mock.Mock(side_effect=KeyboardInterrupt), set=mock.Mock())
    with mock.patch("course.cli.serving.threading", SimpleNamespace(Event=lambda: pressed)):
        output = _invoke([*words, "--no-browser"])
    if not re.match(r"http://127\.0\.0\.1:\d+/\?token=\S{32}\n", output):
        raise FollowingError(f"no address of a page is printed:\n{output}")
    return output


@contextmanager
def _saved_once(path: Path) -> Iterator[list[Path]]:
    """While a file is watched: save it once, then press Ctrl-C."""
    saved: list[Path] = []

    def wait(_seconds: float) -> None:
        if saved:
            raise KeyboardInterrupt
        saved.append(path)
        os.utime(path, ns=(1, 1))

    with mock.patch("course.cli.watching.time", SimpleNamespace(sleep=wait)):
        yield saved


@contextmanager
def _small(words: Sequence[str] = ()) -> Iterator[None]:
    """Small pictures and few samples where no option asks for them, and one module where none is named."""
    import course
    import course.benchmarking.documents  # has to know all modules
    from course.benchmarking import estimators, measuring

    little = measuring.Effort("little", 11, (1, 4, 16), 1, 16)
    smaller: Callable[..., Any] = partial(_smaller, course.render)
    known = estimators.BENCHED | estimators.FURTHER_BENCHED
    named = [name for name in known if name in words] or ["motion_blur"]
    with (
        mock.patch.object(measuring, "FULL", little),
        mock.patch.object(measuring, "QUICK", little),
        # A copy of the course has no compiled loops; to compile them took longer than all else that pages say.
        mock.patch.object(measuring, "available", return_value=False),
        mock.patch.object(estimators, "BENCHED", {name: known[name] for name in named}),
        mock.patch.object(estimators, "FURTHER_BENCHED", {}),
        mock.patch("course.cli.demo.SCENES", Path("few").absolute()),
        mock.patch("course.cli.demo.SHOWN", ("ball",)),
        mock.patch.object(course, "render", smaller),
    ):
        yield


@contextmanager
def _few_references(command: str) -> Iterator[None]:
    """Those of some modules alone: of all they take a quarter of a minute, and what pages hand in needs no others."""
    places = {
        "bundle": "course.school.grading.release.archive",
        "grade": "course.school.grading.classes.grading",
        "references": "course.school.grading.references",
        "regrade": "course.school.grading.classes.grading",
        "release": "course.school.grading.release.archive",
    }
    if command not in places:
        yield
        return
    from course.school.grading.references import make_references

    def few(modules: Sequence[str], *rest: Any) -> int:
        return make_references([name for name in modules if name in REFERENCES], *rest)

    with mock.patch(f"{places[command]}.make_references", few):
        yield


@contextmanager
def _coarse(words: Sequence[str]) -> Iterator[None]:
    """Few rays between patches, and METU's balls of few triangles: no option of a command says how many there are."""
    with ExitStack() as coarser:
        if words[0] == "radiosity":
            from course.engine.radiosity import radiosity, solving

            few = partial(solving.gathered, rays=solving.GATHER_RAYS // COARSER)
            shooting = partial(solving.Shooting, lamp_rays=solving.LAMP_RAYS // COARSER)
            coarser.enter_context(mock.patch.object(radiosity, "gathered", few))
            coarser.enter_context(mock.patch.object(radiosity, "Shooting", shooting))
        if any(word.endswith(".xml") for word in words):
            from course.engine.formats.metu import objects

            coarser.enter_context(mock.patch.object(objects, "SEGMENTS", ()))
        yield


def _smaller(render: Callable[..., Any], scene: Any, **choices: Any) -> Any:
    """Render as `course.render` does, in a small size unless one is asked for, with few samples."""
    small = {"size": choices.get("size") or (48, 32), "spp": min(choices.get("spp") or 4, 8)}
    return render(scene, **choices | small)


def _benchmark(module: str, words: list[str]) -> str:
    """Have the arguments of a benchmark read, without measuring."""
    file = Path(*module.split("."))
    name = f"{module}.__main__" if file.is_dir() else module
    main = import_module(name).main
    assert isinstance(main, click.Command)
    words = ["adaptive_sampling" if word == "NAME" else word for word in words]
    main.make_context(module, words)
    return f"not run ({NOT_RUN['benchmarks']})"


def _pip(words: list[str]) -> str:
    match words:
        case ["install", "-e", "."] | ["install", "penumbra_course-0.1.0-py3-none-any.whl"]:
            pass
        case ["install", "-e", what] | ["install", what] if found := re.fullmatch(
            r"(?:\.|penumbra-course|penumbra_course-0\.1\.0-py3-none-any\.whl)\[(\w+)\]", what
        ):
            if found[1] not in extras():
                raise FollowingError(f"pyproject.toml has no extra {found[1]}")
        case _:
            raise FollowingError("pip is asked for something else than to install the course")
    return f"not run ({NOT_RUN['pip']})"


def extras() -> dict[str, Any]:
    """The extras that can be installed."""
    project = tomllib.loads(Path("pyproject.toml").read_text(encoding="utf-8"))["project"]
    found: dict[str, Any] = project["optional-dependencies"]
    return found


def _keys() -> set[str]:
    """The keys that a scene file has at the top."""
    from course.engine.formats.yaml.schema import json_schema

    schema = json_schema()
    name = schema["$ref"].rpartition("/")[2]
    return set(schema["$defs"][name]["properties"])


def _remove(path: Path) -> None:
    if path.is_dir() and not path.is_symlink():
        shutil.rmtree(path)
    path.unlink(missing_ok=True)


def main(names: Sequence[str]) -> None:
    """Follow the pages, each to its first mistake; what one of them makes isn't there for the next."""
    there, mistakes = _all(), []
    for name in names:
        page = Page(name, Path.cwd())
        try:
            page.follow()
        except FollowingError as wrong:
            mistakes.append(str(wrong))
        finally:
            # Not left to the end of the process: workers would outlive it.
            if page.cluster is not None:
                page.cluster.close()
        for path in sorted(_all() - there, reverse=True):
            _remove(path)
    sys.exit("\n".join(mistakes) or 0)


def _all() -> set[Path]:
    """Files and folders, but not what Python keeps of modules that it has read."""
    return {
        path for path in Path().rglob("*") if "__pycache__" not in (path.name, path.parent.name)
    }


if __name__ == "__main__":
    main(sys.argv[1:])
