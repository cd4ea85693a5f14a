"""A whole Mitsuba process: read an exported scene, render it once, write the picture.

``python -m benchmarks.mitsuba_process FOLDER llvm|llvm-robust|scalar own|native SAMPLER SAMPLES THREADS OUT.exr``
"""

import sys
from pathlib import Path

from benchmarks.mitsuba_export import read
from benchmarks.mitsuba_llvm import LlvmScene
from benchmarks.mitsuba_scalar import NativeScene
from benchmarks.mitsuba_variants import start_llvm, start_scalar


def main(
    folder: str, form: str, kind: str, sampler: str, samples: str, threads: str, out: str
) -> None:
    """Do what the command line says; ``kind``: whether with Mitsuba's own integrators or with ours for it."""
    exported = read(Path(folder))
    (start_scalar if form == "scalar" else start_llvm)(int(threads))
    robust = form == "llvm-robust"
    scene = (NativeScene if kind == "native" else LlvmScene)(exported, robust=robust)
    picture = scene.render(sampler, int(samples), 0)
    import mitsuba

    mitsuba.Bitmap(picture).write(out)


if __name__ == "__main__":
    main(*sys.argv[1:])
