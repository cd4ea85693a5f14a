"""Freed memory is kept for the next batch: counted in page faults, where the C library would give it back."""

import os
import platform
import sys
from collections.abc import Callable
from pathlib import Path

import pytest

from course import Scene
from tests.processes import python

ROOT = Path(__file__).parents[3]

# Each array is larger than any that was freed before it. As it comes, glibc takes such a block from the system and
# gives it back: all its pages are new. If it keeps what is freed, only those are new that no array has had before.
PROGRAM = """
import resource
import numpy as np

def faults():
    return resource.getrusage(resource.RUSAGE_SELF).ru_minflt

first = faults()
{before}
second = faults()
for size in range(256 << 10, 2 << 20, 32 << 10):
    np.empty(size, np.uint8)[::4096] = 1
print(second - first, faults() - second)
"""
KEEP = "from course.engine.render.memory import keep_freed_memory; first = faults(); keep_freed_memory()"


def page_faults(before: str) -> tuple[int, int]:
    """Of what is done before, and of a row of arrays after it, in a process of its own."""
    usual = {name: value for name, value in os.environ.items() if "MALLOC" not in name}
    done = python("-c", PROGRAM.format(before=before), environment=usual)
    own, after = done.stdout.split()
    return int(own), int(after)


@pytest.fixture(scope="module")
def given_back() -> int:
    """Page faults of the arrays where nothing has been done before; skips where freed memory is kept anyway."""
    if sys.platform != "linux" or platform.libc_ver()[0] != "glibc":
        pytest.skip("only glibc gives freed blocks back and learns from it to keep them")
    _, faults = page_faults("pass")
    pages = sum(range(256 << 10, 2 << 20, 32 << 10)) // os.sysconf("SC_PAGE_SIZE")
    if faults < pages // 2:
        pytest.skip("this system keeps freed memory as it is set")
    return faults


def test_blocks_are_kept_once_a_large_one_has_been_freed(given_back: int) -> None:
    own, after = page_faults(KEEP)
    assert after < given_back / 4
    assert own < 100, "that one block is never touched"


def test_rendering_begins_with_it(given_back: int, make_scene: Callable[..., Scene]) -> None:
    scene = make_scene(film={"width": 4, "height": 4})
    load = f"from course import load_scene, render; scene = load_scene({str(scene.path)!r})"
    if page_faults(load)[1] < given_back / 2:
        pytest.skip("loading happens to free a large block here")
    assert page_faults(f"{load}; render(scene, threads=1)")[1] < given_back / 4
