"""The series of pictures that the site has, as docs/series.yaml says them."""

from collections.abc import Iterator
from functools import lru_cache
from itertools import product
from pathlib import Path
from typing import Annotated, Any

import msgspec

from course.base.errors import CourseError
from course.engine.formats.yaml.document import KeyPath
from course.engine.formats.yaml.overriding import Overrides

FILE = Path(__file__).parents[1] / "series.yaml"

SAMPLES: KeyPath = ("sampler", "samples")
PATTERN: KeyPath = ("sampler", "type")
"""What these two keys hold, the command line takes as options."""

Count = Annotated[int, msgspec.Meta(ge=1)]


class Slider(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """One thing that changes.

    Attributes
    ----------
    name : what it is called
    key : its key path in the scene file
    values : what stands there, as YAML would give it
    labels : what readers see instead of a value
    unit : of all values
    start : the place of the value that is shown first
    """

    name: Annotated[str, msgspec.Meta(min_length=1)]
    key: Annotated[tuple[str | int, ...], msgspec.Meta(min_length=1)]
    values: Annotated[tuple[Any, ...], msgspec.Meta(min_length=2)]
    labels: tuple[str, ...] = ()
    unit: str = ""
    start: Annotated[int, msgspec.Meta(ge=0)] = 0

    def __post_init__(self) -> None:
        if self.labels and len(self.labels) != len(self.values):
            raise ValueError(f"{len(self.values)} values and {len(self.labels)} labels")
        if self.start >= len(self.values):
            raise ValueError(f"start is {self.start}, and there are {len(self.values)} values")

    @property
    def shown(self) -> tuple[str, ...]:
        """The values as readers see them, without the unit."""
        return self.labels or tuple(f"{value}" for value in self.values)

    def words(self, place: int) -> str:
        """A value with what it counts or its unit: 16 samples, 0.4 world units, sobol."""
        unit = self.unit
        if self.key == SAMPLES:
            unit = "sample" if self.values[place] == 1 else "samples"
        return f"{self.shown[place]} {unit}".rstrip()


class Series(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """Pictures of a scene that differ in one thing or in two; see docs/series.yaml."""

    scene: str
    size: tuple[Count, Count]
    samples: Count
    title: str
    alt: str
    sliders: Annotated[tuple[Slider, ...], msgspec.Meta(min_length=1, max_length=2)]
    enlarge: Count = 1

    def __post_init__(self) -> None:
        for slider in self.sliders:
            if f"{{{slider.name}}}" not in self.alt:
                raise ValueError(f"alt doesn't say {{{slider.name}}}")

    def steps(self) -> Iterator[tuple[int, ...]]:
        """Each choice of values, by their places; the last slider changes fastest."""
        return product(*(range(len(slider.values)) for slider in self.sliders))

    def overrides(self, step: tuple[int, ...]) -> Overrides:
        """What a step puts into the scene, the number of samples apart."""
        return {key: value for key, value in self._chosen(step) if key != SAMPLES}

    def samples_of(self, step: tuple[int, ...]) -> int:
        """A step's samples a pixel."""
        return int(dict(self._chosen(step)).get(SAMPLES, self.samples))

    def alternative(self, step: tuple[int, ...]) -> str:
        """What a step's picture shows, in words."""
        text = self.alt
        for slider, place in zip(self.sliders, step, strict=True):
            text = text.replace(f"{{{slider.name}}}", slider.words(place))
        return text

    def _chosen(self, step: tuple[int, ...]) -> Iterator[tuple[KeyPath, Any]]:
        for slider, place in zip(self.sliders, step, strict=True):
            yield slider.key, slider.values[place]


@lru_cache(maxsize=8)
def read(text: str) -> dict[str, Series]:
    """Read all series, by their names.

    Raises
    ------
    CourseError
        The file is not as it should be.
    """
    try:
        return msgspec.yaml.decode(text, type=dict[str, Series])
    except msgspec.MsgspecError as error:
        raise CourseError(f"{FILE.name}: {error}") from error


def series_named(name: str) -> Series:
    """Return the series of that name.

    Raises
    ------
    CourseError
        There is none, or the file is not as it should be.
    """
    known = read(FILE.read_text(encoding="utf-8"))
    if name not in known:
        raise CourseError(f"{FILE.name} has no series {name}; it has {', '.join(known)}")
    return known[name]
