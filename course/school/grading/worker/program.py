"""The program of the worker process: it imports the student's file and answers calls, nothing else.

Started by ``client.py`` as ``python -I -S program.py SETTINGS``; needs only NumPy and two files beside it, so that
a sandbox need show it nothing of the course. Nothing that this process says is believed: it hands back arrays, and
whether these are right is decided elsewhere. The walls around the student's code are ``confine.py``'s, which the
kernel keeps. The audit hook is none: it tells honest students by name what a function on arrays has no business with.
"""

import io
import json
import linecache
import os
import sys
import traceback
from types import CodeType, FunctionType, ModuleType
from typing import Any


def main() -> None:
    """Answer calls until the grader hangs up."""
    settings = json.loads(sys.argv[1])
    sys.path[:0] = settings["path"]
    import confine  # type: ignore[import-not-found]  # its folder has just been put there
    import framing  # type: ignore[import-not-found]
    import numpy as np
    import numpy.fft
    import numpy.linalg
    import numpy.random

    # "from numpy import *" would import the rest, which starts programs and is not allowed.
    np.__all__[:] = [each for each in np.__all__ if each in vars(np)]
    sys.path.remove(settings["path"][0])
    reply_to = settings["reply"]
    requests = os.fdopen(os.dup(0), "rb")
    os.dup2(os.open(os.devnull, os.O_RDONLY), 0)
    # A debugger would be refused for what it imports, before it finds that nobody can type.
    sys.breakpointhook = lambda *_, **__: input()

    def read(count: int) -> bytearray:
        data = bytearray(count)
        if requests.readinto(data) < count:
            os._exit(0)  # The grader has hung up.
        return data

    def send(head: dict[str, Any], values: list[Any]) -> None:
        sys.stdout.flush()
        data = memoryview(framing.pack(head, values))
        while data:
            data = data[os.write(reply_to, data) :]

    head, (source,) = framing.unpack(read)
    name = head["module"]
    _limit(settings["limits"])
    confine.confine(settings["wall"])
    if settings["readable"]:
        sys.addaudithook(_guard(tuple(settings["readable"])))
    send({"ready": True}, [])
    module = ModuleType(name)
    module.__file__ = f"{name}.py"
    try:
        sys.modules[name] = module
        text = bytes(source)
        linecache.cache[f"{name}.py"] = (
            len(text),
            None,
            # As Python counts lines; str.splitlines would end one at U+2028, too.
            [*io.StringIO(text.decode("utf-8", "replace"), newline=None)],
            f"{name}.py",
        )
        exec(compile(text, f"{name}.py", "exec", dont_inherit=True), module.__dict__)
    except BaseException as error:  # noqa: BLE001 - SystemExit too
        send(_told(error, name), [])
        os._exit(0)
    for borrowed in head["lent"]:
        setattr(module, borrowed, _borrowed(borrowed, send, lambda: framing.unpack(read)))
    defined: dict[Any, Any] = vars(module)
    names = [key for key, value in defined.items() if isinstance(key, str) and callable(value)]
    send({"loaded": True, "names": names[:500], "calls": _calls(defined)[:2000]}, [])
    while True:
        head, values = framing.unpack(read)
        answer, given = _call(module, head, values, np)
        try:
            send(answer, given)
        except TypeError as error:
            send({"error": "bad value", "message": f"it returned {error}"}, [])


def _calls(defined: dict[Any, Any]) -> list[str]:
    """Which functions of the file call which, by way of others too: "f>g"."""
    functions = {
        name: value
        for name, value in defined.items()
        if isinstance(name, str) and type(value) is FunctionType and value.__globals__ is defined
    }
    direct = {name: _named(value.__code__) & functions.keys() for name, value in functions.items()}
    found = []
    for name in functions:
        reached: set[str] = set()
        waiting = [*direct[name]]
        while waiting:
            other = waiting.pop()
            if other not in reached:
                reached.add(other)
                waiting += direct[other]
        found += [f"{name}>{other}" for other in sorted(reached - {name})]
    return found


def _named(code: CodeType) -> set[str]:
    """Names of globals and attributes in a function's code, and in that of functions within it."""
    inner = [constant for constant in code.co_consts if isinstance(constant, CodeType)]
    return set(code.co_names).union(*map(_named, inner))


def _borrowed(name: str, send: Any, receive: Any) -> Any:
    """A function that the grader works out: it has the right one, and this process only sees what comes of it."""

    def function(*arguments: Any, **named: Any) -> Any:
        send({"borrowed": name, "names": [*named]}, [*arguments, *named.values()])
        head, values = receive()
        if "error" in head:
            raise (ValueError if head["type"] == "ValueError" else RuntimeError)(head["message"])
        return values[0]

    return function


def _call(
    module: ModuleType, head: dict[str, Any], values: list[Any], np: Any
) -> tuple[dict[str, Any], list[Any]]:
    function = getattr(module, head["function"], None)
    if not callable(function):
        return {"error": "missing"}, []
    named = dict(zip(head["names"], values[len(values) - len(head["names"]) :], strict=True))
    arguments = values[: len(values) - len(named)]
    before = None
    if head["look"]:
        np.random.seed(
            None
        )  # A state that no call before can have left, so that seeding shows too.
        before = _random_state(np)
    try:
        value = function(*arguments, **named)
    except BaseException as error:  # noqa: BLE001 - SystemExit too
        return _told(error, module.__name__), []
    if not head["look"]:
        return {}, [value]
    overwrote = any(array.tobytes() != was for array, was in _EARLIER)
    _EARLIER[:] = [(array, array.tobytes()) for array in _arrays(value, np)]
    return {"moved": _random_state(np) != before, "overwrote": overwrote}, [value, *arguments]


_EARLIER: list[tuple[Any, bytes]] = []
"""Arrays that the last call returned that was looked at, and what they held."""


def _arrays(value: Any, np: Any) -> list[Any]:
    parts = value if isinstance(value, tuple | list) else (value,)
    return [part for part in parts if type(part) is np.ndarray and part.dtype.kind in "biuf"]


def _random_state(np: Any) -> tuple[bytes, str]:
    """NumPy's global random state; its 624 words as bytes, for as text they would take a millisecond."""
    state = np.random.get_state(legacy=False)
    key = state["state"].pop("key", b"")
    return bytes(key), repr(state)


def _told(error: BaseException, name: str) -> dict[str, Any]:
    if isinstance(error, NotImplementedError):
        return {"error": "not written", "message": str(error)[:500]}
    rows = traceback.format_exception(type(error), error, error.__traceback__)
    # A syntax error ends with its line, a caret under it and its text, any other with its text alone.
    last = traceback.format_exception_only(error) if isinstance(error, SyntaxError) else rows[-1:]
    # Only what stands in the student's file concerns the student.
    kept = [row for row in rows[: -len(last)] if f'"{name}.py"' in row][-6:]
    kept += [row[:500] for row in last]
    try:
        message = str(error)[:500]
    except Exception:  # noqa: BLE001 - a message that can't be made is none
        message = ""
    return {
        "error": "raised",
        "type": type(error).__name__[:80],
        "message": message,
        "traceback": "".join(kept)[-3000:],
    }


def _limit(limits: dict[str, int]) -> None:
    try:
        import resource
    except ImportError:  # Windows has none; the clock is watched from outside
        return
    for name, value in limits.items():
        which = getattr(resource, f"RLIMIT_{name}", None)
        if which is not None:
            try:
                resource.setrlimit(which, (value, value))
            except (ValueError, OSError):
                continue  # The system's own limit is lower.


_FORBIDDEN = (
    *("ctypes.", "gc.", "mmap.", "os.", "pty.", "resource.", "shutil.", "signal.", "subprocess."),
    *("ftplib.", "http.", "smtplib.", "socket.", "urllib.", "webbrowser."),
    *("sqlite3.", "tempfile."),
)
_HARMLESS = {"os.listdir", "os.scandir", "os.add_dll_directory", "os.putenv", "os.unsetenv"}
_NO_IMPORT = {
    *("_posixsubprocess", "_ctypes", "ctypes", "_socket", "_multiprocessing", "resource"),
    *("course", "solutions"),
}


def _guard(readable: tuple[str, ...]) -> Any:
    fspath, realpath, separator = os.fspath, os.path.realpath, os.sep
    write_flags = os.O_WRONLY | os.O_RDWR | os.O_CREAT | os.O_TRUNC | os.O_APPEND

    def refuse(what: str) -> None:
        raise PermissionError(f"not allowed while grading: {what}")

    def visible(path: Any) -> bool:
        if isinstance(path, int):
            return True
        text = realpath(fspath(path))
        text = text.decode("utf-8", "replace") if isinstance(text, bytes) else text
        return any(text == root or text.startswith(root + separator) for root in readable)

    def guard(event: str, arguments: tuple[Any, ...]) -> None:
        if event == "open":
            path, mode, flags = arguments
            writes = (
                bool(flags & write_flags)
                if isinstance(flags, int)
                else any(c in str(mode) for c in "wax+")
            )
            if writes or not visible(path):
                refuse(f"opening {path!r}")
        elif event in ("os.listdir", "os.scandir"):
            if not visible(arguments[0] if arguments and arguments[0] is not None else "."):
                refuse(f"{event}({arguments[0]!r})")
        elif event == "import":
            if arguments[0].partition(".")[0] in _NO_IMPORT:
                refuse(f"import {arguments[0]}")
        elif event.startswith(_FORBIDDEN) and event not in _HARMLESS:
            refuse(event)

    return guard


if __name__ == "__main__":
    main()
