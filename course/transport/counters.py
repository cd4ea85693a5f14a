"""What a thread has done: the numbers of the receipt, one set a thread, added up at the end."""

from __future__ import annotations

from dataclasses import dataclass, field
from time import perf_counter

from course.geometry.embree import QueryTime

RAY_KINDS = ("camera", "shadow", "reflection", "refraction")


@dataclass
class Counters:
    """Counts and seconds of one thread.

    Attributes
    ----------
    rays : kind -> rays cast
    numbers : dimension -> numbers drawn
    seconds : stage -> seconds
    embree : seconds inside Embree, and the tests of a hierarchy in its place
    """

    rays: dict[str, int] = field(default_factory=lambda: dict.fromkeys(RAY_KINDS, 0))
    numbers: dict[str, int] = field(default_factory=dict)
    seconds: dict[str, float] = field(default_factory=dict)
    embree: QueryTime = field(default_factory=QueryTime)
    _since: float = field(default_factory=perf_counter)

    def start(self) -> None:
        """Begin to measure; the next ``lap`` counts from here."""
        self._since = perf_counter()

    def lap(self, stage: str) -> None:
        """The time since the last lap belongs to that stage."""
        now = perf_counter()
        self.seconds[stage] = self.seconds.get(stage, 0.0) + now - self._since
        self._since = now

    def drew(self, dimension: str, count: int) -> None:
        """Numbers were drawn."""
        self.numbers[dimension] = self.numbers.get(dimension, 0) + count

    def add(self, other: Counters) -> None:
        """Take in another thread's counts."""
        for mine, theirs in ((self.rays, other.rays), (self.numbers, other.numbers)):
            for key, count in theirs.items():
                mine[key] = mine.get(key, 0) + count
        for stage, seconds in other.seconds.items():
            self.seconds[stage] = self.seconds.get(stage, 0.0) + seconds
        self.embree.seconds += other.embree.seconds
        self.embree.box_tests += other.embree.box_tests
        self.embree.triangle_tests += other.embree.triangle_tests
