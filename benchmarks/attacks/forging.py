"""Attacks on the score: submissions whose function is wrong and that try to be paid for it all the same.

Each is the body of a function that is wrong, and lines before it; it gains if it earns more than the wrong function by
itself, or if a check ends in an error of the grader.
"""

from textwrap import dedent, indent

from course.engine.functions.effects import PROJECT

MODULE = "motion_blur"
FUNCTION = "to_object_space"
WRONG = "return np.zeros((3, len(time)), time.dtype)"

_SOLUTION = (PROJECT / "solutions" / f"{MODULE}.py").read_text(encoding="utf-8")

_TOOLS = """
import ctypes, gc, inspect, os, sys, threading
import time as clock
import __main__
framing = sys.modules["framing"]

def program_frames():
    frame = sys._getframe()
    while frame:
        yield frame
        frame = frame.f_back

def reply_to():
    return next(f.f_locals["reply_to"] for f in program_frames() if "reply_to" in f.f_locals)

def requests():
    return next(f.f_locals["requests"] for f in program_frames() if "requests" in f.f_locals)

def framed(head):
    head = head if isinstance(head, bytes) else head.encode()
    return b"%08x" % len(head) + head

def write(data):
    os.write(reply_to(), data)
"""


def submission(name: str) -> str:
    """The source of one; "" is the wrong function without an attack."""
    before, body = FORGING.get(name, ("", WRONG))
    return (
        f"{_SOLUTION}\n{_TOOLS}\n{dedent(before)}\n"
        f"def {FUNCTION}(origins, velocity, time):\n{indent(dedent(body).strip(), '    ')}\n"
    )


def _values(*heads: str) -> dict[str, tuple[str, str]]:
    return {f"head {head[:60]!r}": ("", f"write(framed({head!r}))\n{WRONG}") for head in heads}


def _returned(*values: str) -> dict[str, tuple[str, str]]:
    return {f"returns {value[:60]}": ("", f"return {value}") for value in values}


FORGING: dict[str, tuple[str, str]] = {
    "a reply of its own": ("", f"write(framing.pack({{'moved': False}}, [{WRONG[7:]}]))\n{WRONG}"),
    "two replies, one for the next call": (
        "",
        f"write(2 * framing.pack({{'moved': False}}, [{WRONG[7:]}]))\n{WRONG}",
    ),
    "a thousand replies": (
        "",
        f"write(1000 * framing.pack({{'moved': False}}, [{WRONG[7:]}]))\n{WRONG}",
    ),
    "a reply from a thread later on": (
        "def later(data):\n    clock.sleep(0.05)\n    os.write(data[0], data[1])\n",
        (
            "data = reply_to(), framing.pack({'moved': False}, [np.zeros((3, len(time)), time.dtype)])\n"
            f"threading.Thread(target=later, args=(data,)).start()\n{WRONG}"
        ),
    ),
    "a reply that tells that it isn't written": ("", "raise NotImplementedError"),
    "a message that trickles": (
        "",
        "for byte in framed('{' + ' ' * 200):\n    write(bytes([byte]))\n    clock.sleep(0.02)",
    ),
    "reads the next requests": (
        "",
        f"os.set_blocking(requests().fileno(), False)\nrequests().read()\n{WRONG}",
    ),
    "closes the pipes": ("", f"os.closerange(0, 64)\n{WRONG}"),
    "puts another pipe there": (
        "",
        f"os.dup2(os.open('/dev/null', os.O_RDONLY), reply_to())\n{WRONG}",
    ),
    "looks for arrays in memory": (
        "",
        """
        for thing in gc.get_objects():
            for value in (thing if isinstance(thing, (list, tuple)) else [thing]):
                if type(value) is np.ndarray and value.shape == (3, len(time)) and value is not origins:
                    return value
        """
        + WRONG,
    ),
    "looks for references in frames": (
        "",
        """
        for frame in program_frames():
            for name, value in list(frame.f_locals.items()):
                if "expected" in name or "reference" in name:
                    return value
        """
        + WRONG,
    ),
    "patches NumPy's comparisons": (
        (
            "np.allclose = np.array_equal = np.isclose = lambda *a, **k: True\n"
            "np.testing.assert_allclose = lambda *a, **k: None\n"
        ),
        WRONG,
    ),
    "records what NumPy computes": (
        (
            "SEEN = []\nold = np.subtract\n"
            "np.subtract = lambda *a, **k: SEEN.append(old(*a, **k)) or SEEN[-1]\n"
        ),
        f"return next((s for s in SEEN if np.shape(s) == origins.shape), {WRONG[7:]})",
    ),
    "traces the program": (
        (
            "SEEN = []\nsys.settrace(lambda f, e, a: SEEN.append(f.f_locals) or None)\n"
            "threading.settrace(lambda *a: None)\nsys.setprofile(lambda f, e, a: None)\n"
        ),
        WRONG,
    ),
    "patches the program": (
        (
            "__main__._call = lambda module, head, values, np: ({'moved': False, 'score': 1e6}, [values[0]])\n"
            "__main__._told = lambda *a: {'moved': False}\n__main__._guard = lambda *a: None\n"
        ),
        WRONG,
    ),
    "patches the framing": (
        (
            "framing.BrokenMessage = Exception\nframing.LARGEST = 1 << 62\n"
            "old_pack = framing.pack\n"
            "framing.pack = lambda head, values: old_pack({**head, 'passed': True, 'points': 99}, values)\n"
        ),
        WRONG,
    ),
    "puts another program into the modules": (
        "sys.modules['numpy'] = sys.modules['framing'] = sys.modules[__name__]\n",
        WRONG,
    ),
    "replies when it is imported": (
        "write(framing.pack({'loaded': True, 'names': ['to_object_space']}, []))\n",
        WRONG,
    ),
    "a name for every function": ("def __getattr__(name):\n    return lambda *a: a[0]\n", WRONG),
    "ends the process well": ("", f"write(framing.pack({{}}, [{WRONG[7:]}]))\nos._exit(0)"),
    "exit": ("", "sys.exit(0)"),
    "exit handlers": (
        "import atexit\natexit.register(lambda: os.write(1, b'{\"score\": 100}'))\n",
        "sys.exit(0)",
    ),
    "signal handlers": (
        "import signal\nfor n in (1, 2, 10, 12, 15, 24):\n    signal.signal(n, lambda *a: os._exit(0))\n",
        WRONG,
    ),
    "an error of the grader's name": (
        "class GraderError(Exception): pass\nGraderError.__module__ = 'course.school.grading.errors'\n",
        "raise GraderError('grader error')",
    ),
    "an error without a text": (
        "class Odd(BaseException):\n    def __str__(self): raise self\n    __repr__ = __str__\n",
        "raise Odd()",
    ),
    "an error with an endless text": ("", "raise ValueError('x' * 10_000_000)"),
    "a group of errors": ("", "raise BaseExceptionGroup('all', [KeyboardInterrupt()] * 1000)"),
    "out of memory": ("", "raise MemoryError"),
    "overflow": ("", "raise OverflowError"),
    "an array that says yes": (
        (
            "class Yes(np.ndarray):\n    def __eq__(self, other): return np.ones(self.shape, bool)\n"
            "    def __array_ufunc__(self, *a, **k): return np.zeros(())\n"
        ),
        f"return ({WRONG[7:]}).view(Yes)",
    ),
    "a generator whose state is none": (
        (
            "class G(np.random.Generator):\n    class bit_generator:\n        state = -1\n"
            "class H(np.random.Generator): bit_generator = property(lambda self: type('B', (), {'state': -1}))\n"
        ),
        "return H(np.random.PCG64())",
    ),
    "pickles": ("class P:\n    def __reduce__(self): return (exit, ())\n", "return P()"),
    "the result on standard output": (
        "",
        f'print(\'{{"score": 100, "tests": [], "points": 99}}\', flush=True)\n{WRONG}',
    ),
    "asks for what it wasn't lent": (
        "",
        (
            "write(framing.pack({'borrowed': 'to_object_space', 'names': []}, [origins, velocity, time]))\n"
            "head, values = framing.unpack(lambda n: bytearray(requests().read(n)))\nreturn values[0]"
        ),
    ),
    "asks for functions of other modules": (
        "",
        (
            "write(framing.pack({'borrowed': '__class__', 'names': []}, []))\n"
            "head, values = framing.unpack(lambda n: bytearray(requests().read(n)))\nreturn values[0]"
        ),
    ),
    "changes its arguments into the answer": (
        "",
        "origins[...] = 0\nvelocity[...] = 0\ntime[...] = 0\nreturn origins",
    ),
    **_values(
        '{"arrays": Infinity, "values": []}',
        '{"arrays": 1e999, "values": [{"array": 0}]}',
        '{"arrays": [{"dtype": "O", "shape": [3], "layout": "C", "frozen": false}], "values": [{"array": 0}]}',
        '{"arrays": [{"dtype": "float32", "shape": [-1], "layout": "C", "frozen": false}], "values": [{"array": 0}]}',
        '{"arrays": [{"dtype": "float64", "shape": [99999999999999], "layout": "C", "frozen": false}], "values": []}',
        '{"arrays": [], "values": [{"rng": -1}]}',
        '{"arrays": [], "values": [{"value": NaN}]}',
        '{"arrays": [], "values": [{"value": 1' + "0" * 5000 + "}]}",
        '{"arrays": [], "values": ' + "[" * 100_000,
        '{"error": "raised", "type": [], "message": {}, "arrays": [], "values": []}',
        '{"error": "grader error", "arrays": [], "values": []}',
        '{"error": ["raised"], "arrays": [], "values": []}',
        '{"moved": [], "arrays": [], "values": [{"tuple": []}]}',
        '{"values": null, "arrays": null}',
        "null",
        "[]",
        "1",
        '"text"',
        "\x00\xff",
        "",
    ),
    **_returned(
        "None",
        "()",
        "(np.zeros(3), np.zeros(3))",
        "[[1, 2], [3]]",
        "'passed'",
        "True",
        "float('nan')",
        "10 ** 400",
        "np.array([[object()] * 3] * 3)",
        "np.zeros((3, len(time)), 'datetime64[s]')",
        "np.zeros((3, len(time)), [('a', 'f4')])",
        "np.full((3, len(time)), np.nan, time.dtype)",
        "np.full((3, len(time)), np.inf, time.dtype)",
        "np.zeros((3, len(time)), 'S4')",
        "np.ma.masked_all((3, len(time)))",
        "np.zeros((1,) * 32)",
        "np.broadcast_to(np.float32(0), (3, 1 << 40))",
        "np.zeros((3, len(time)), complex)",
        "np.random.default_rng(0)",
        "(x for x in origins)",
        "lambda *a: origins",
        "np",
    ),
}
"""Name -> (lines before the function, its body)."""
