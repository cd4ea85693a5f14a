"""Whole processes: start-up time of a tiny scene, and peak memory of a large picture."""

import subprocess
import sys
import tempfile
from pathlib import Path
from time import perf_counter

from benchmarks.engine import SCENES
from benchmarks.figures import Figure, summary

REPETITIONS = 9
LIBRARIES = "import numpy, embreex.rtcore_scene, yaml"
PEAK = """
import resource, sys
from course.cli.main import main
try:
    main()
finally:
    # getrusage also counts what the parent had when it forked; Linux has the process's own mark elsewhere.
    try:
        lines = open("/proc/self/status").read().splitlines()
        print(next(int(line.split()[1]) for line in lines if line.startswith("VmHWM")) / 1024)
    except OSError:
        print(resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024)
"""


def measure_processes() -> list[Figure]:
    """Start-up against the bare libraries, memory at 16 and 256 samples."""
    with tempfile.TemporaryDirectory() as folder:
        return [*_start_up(Path(folder)), *_memory(Path(folder))]


def _start_up(folder: Path) -> list[Figure]:
    box = ["-m", "course", "render", str(SCENES / "box.yaml"), "-o", str(folder / "box.png")]
    bare, whole = [], []
    for _ in range(REPETITIONS):
        bare.append(_seconds(["-c", LIBRARIES]))
        whole.append(_seconds(box))
    ratios = [b / a for a, b in zip(bare[1:], whole[1:], strict=True)]
    return [summary("64 x 64 box: whole process / importing its libraries", ratios, 3)]


def _memory(folder: Path) -> list[Figure]:
    peaks = {}
    for samples in (16, 256):
        arguments = ["render", str(SCENES / "direct_light.yaml"), "--size", "1920x1080"]
        arguments += ["--spp", str(samples), "-o", str(folder / "large.png")]
        done = subprocess.run(
            [sys.executable, "-c", PEAK, *arguments], capture_output=True, text=True, check=True
        )
        peaks[samples] = float(done.stdout.splitlines()[-1])
    growth = peaks[256] / peaks[16]
    return [
        summary("1920 x 1080: peak memory at 16 samples [MB]", [peaks[16]], 350),
        summary("1920 x 1080: peak memory at 256 samples [MB]", [peaks[256]], 350),
        summary("1920 x 1080: memory at 256 / at 16 samples", [growth], 1.05),
    ]


def _seconds(arguments: list[str]) -> float:
    start = perf_counter()
    subprocess.run([sys.executable, *arguments], capture_output=True, check=True)
    return perf_counter() - start
