"""Counters for the receipt, the report that comes with a picture: one set per thread, added up at the end."""

from collections import Counter
from dataclasses import dataclass, field
from time import perf_counter

from course.engine.core.accelerator import QueryStats


@dataclass
class Counters:
    """Counts and seconds of one thread.

    Attributes
    ----------
    rays : kind -> rays cast
    spared : reason -> shadow rays that weren't sent
    numbers : name of a dimension -> random numbers drawn
    seconds : stage -> seconds
    embree : seconds inside Embree, or the tests of a student's BVH
    """

    rays: Counter[str] = field(
        default_factory=lambda: Counter(camera=0, shadow=0, reflection=0, refraction=0)
    )
    spared: Counter[str] = field(default_factory=Counter)
    numbers: Counter[str] = field(default_factory=Counter)
    seconds: dict[str, float] = field(default_factory=dict)
    embree: QueryStats = field(default_factory=QueryStats)
    _since: float = field(default_factory=perf_counter)

    def start(self) -> None:
        """Start the clock of the next ``lap``."""
        self._since = perf_counter()

    def lap(self, stage: str) -> None:
        """Add the time since the last lap to a stage."""
        now = perf_counter()
        self.seconds[stage] = self.seconds.get(stage, 0.0) + now - self._since
        self._since = now

    def add(self, other: "Counters") -> None:
        """Add another thread's counters."""
        self.rays.update(other.rays)
        self.spared.update(other.spared)
        self.numbers.update(other.numbers)
        for stage, seconds in other.seconds.items():
            self.seconds[stage] = self.seconds.get(stage, 0.0) + seconds
        self.embree.seconds += other.embree.seconds
        self.embree.box_tests += other.embree.box_tests
        self.embree.triangle_tests += other.embree.triangle_tests
