"""`make bench`: measure the engine and print what was found beside what it must reach.

Every figure is a ratio within this run: absolute times mean nothing from one machine, or one minute, to the next.
Nothing here decides a test.
"""

from __future__ import annotations

import json
import platform
import sys
from pathlib import Path

from benchmarks.convergence import measure_convergence
from benchmarks.effects import measure_effects
from benchmarks.engine import measure_engine
from benchmarks.figures import Figure, print_figures
from benchmarks.process import measure_processes

OUT = Path("out/bench/engine.json")


def main() -> None:
    """Measure everything, print and write it."""
    figures: list[Figure] = []
    for measure in (measure_engine, measure_effects, measure_processes, measure_convergence):
        figures += measure()
    print_figures(figures)
    OUT.parent.mkdir(parents=True, exist_ok=True)
    machine = {"machine": platform.platform(), "python": sys.version.split()[0]}
    OUT.write_text(json.dumps({**machine, "figures": [f.to_dict() for f in figures]}, indent=2))
    print(f"written to {OUT}")


if __name__ == "__main__":
    main()
