"""What answers packets of rays: Embree by its own interface, in the library that embreex brings along, or its stand-in.

This is the one file that calls Embree without embreex. Where library or Numba is missing, ``available`` says so.
"""

import ctypes
import os
from functools import cache
from importlib.util import find_spec
from pathlib import Path
from typing import Any

from course.base.errors import CourseError
from course.engine.casters.choice import chosen
from course.engine.loops.numpy_loops import loops

NATIVE = {16: 34, 8: 33, 4: 32}
"""Rays of a packet -> the property of Embree's device that is not 0 where it follows so many at once."""

WIDTH_VARIABLE = "COURSE_PACKET_WIDTH"
"""Environment variable: 4, 8 or 16 rays of a packet in the place of what suits the processor; pictures are the same."""

_KINDS = ("rtcIntersect", "rtcOccluded")


@cache
def available() -> bool:
    """Whether Numba is installed, NumPy's loops are found, and the caster takes packets: embreex's library can."""
    if find_spec("numba") is None or loops() is None:
        return False
    return chosen() == "numba" or (chosen() == "embree" and library() is not None)


@cache
def library() -> ctypes.CDLL | None:
    """The library that embreex has loaded, with its functions declared."""
    spec = find_spec("embreex")
    if spec is None or spec.origin is None:
        return None
    home = Path(spec.origin).parent
    # Where the tools that repair wheels put libraries on Linux, Windows and macOS.
    folders = (home.parent / "embreex.libs", home, home / ".dylibs")
    found = [file for folder in folders if folder.is_dir() for file in folder.glob("*embree4*")]
    if not found:
        return None
    embree = ctypes.CDLL(str(found[0]))
    pointer, size = ctypes.c_void_p, ctypes.c_size_t
    declarations: dict[str, tuple[Any, list[Any]]] = {
        "rtcNewDevice": (pointer, [ctypes.c_char_p]),
        "rtcGetDeviceError": (ctypes.c_int, [pointer]),
        "rtcNewScene": (pointer, [pointer]),
        "rtcSetSceneFlags": (None, [pointer, ctypes.c_int]),
        "rtcNewGeometry": (pointer, [pointer, ctypes.c_int]),
        "rtcSetSharedGeometryBuffer": (
            None,
            [pointer, ctypes.c_int, ctypes.c_uint, ctypes.c_int, pointer, size, size, size],
        ),
        "rtcCommitGeometry": (None, [pointer]),
        "rtcAttachGeometry": (ctypes.c_uint, [pointer, pointer]),
        "rtcReleaseGeometry": (None, [pointer]),
        "rtcCommitScene": (None, [pointer]),
        "rtcReleaseScene": (None, [pointer]),
        "rtcGetDeviceProperty": (ctypes.c_ssize_t, [pointer, ctypes.c_int]),
        **{f"{kind}{n}": (None, [pointer] * 4) for kind in _KINDS for n in NATIVE},
    }
    try:
        for name, (result, arguments) in declarations.items():
            function = getattr(embree, name)
            function.restype, function.argtypes = result, arguments
    except AttributeError:
        return None
    return embree


@cache
def device() -> int:
    """Embree's device, one for the process."""
    embree = library()
    assert embree is not None
    return int(embree.rtcNewDevice(None))


@cache
def width() -> int:
    """Rays of a packet: as many as Embree follows at once on this processor, which follows more of them one by one.

    Raises CourseError if ``WIDTH_VARIABLE`` is none of them.
    """
    if chosen() == "numba":
        # As its stand-in takes them.
        return 16
    if wanted := os.environ.get(WIDTH_VARIABLE):
        if wanted not in map(str, NATIVE):
            raise CourseError(f"{WIDTH_VARIABLE}={wanted}: expected 4, 8 or 16")
        return int(wanted)
    embree = library()
    assert embree is not None
    native = (n for n, number in NATIVE.items() if embree.rtcGetDeviceProperty(device(), number))
    return next(native, min(NATIVE))


def queries() -> tuple[str, ...]:
    """What the compiled loops call by name: nearest hits, and whether anything is in the way."""
    return tuple(f"{kind}{width()}" for kind in _KINDS)


def name_queries() -> None:
    """Let compiled loops find the queries by their names, which are Embree's for its stand-in too."""
    import llvmlite.binding

    for name, address in zip(queries(), _addresses(), strict=True):
        llvmlite.binding.add_symbol(name, address)


def _addresses() -> tuple[int, ...]:
    if chosen() == "numba":
        from course.engine.casters import cast_kernels

        return cast_kernels.intersect.address, cast_kernels.occlude.address
    embree = library()
    addresses = [ctypes.cast(getattr(embree, name), ctypes.c_void_p).value for name in queries()]
    return tuple(address or 0 for address in addresses)
