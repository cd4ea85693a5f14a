"""The story of a pixel: why it has its colour in one sentence, and what its rays met, as a tree of lines."""

from collections import Counter, defaultdict
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from textwrap import wrap
from typing import Any

import numpy as np

from course.engine.core.types import Floats64
from course.engine.recording.developed import Step, developed
from course.engine.recording.recorder import RESOLVE, WEIGHTS
from course.engine.recording.recording import Recording
from course.engine.recording.segments import ENVIRONMENT, Segment

DEEPEST = 2
"""Bounces that are told one by one."""

LONE = 0.5
"""Share of a pixel's light from which on a single sample is told."""

FEWEST = 8
"""Samples from which on it is remarkable that one of them carries most of the light."""

LEAST = 0.005
"""Share of the light that is too little to be told."""

SHOWN = 1 / 255
"""Of white: what is darker may be black in a PNG."""

OTHER = 1e-3
"""Relative difference of a colour from its samples' weighted mean that rounding doesn't make."""

MOST_NAMES = 3
"""Objects that are named in a line."""


WIDE = 100
"""Columns of a printed story."""


@dataclass
class Line:
    """A line of the tree, and the lines below it."""

    text: str
    below: "list[Line]" = field(default_factory=list)


@dataclass(frozen=True)
class Story:
    """What became of the samples of a recorded pixel; of a rectangle, of all its pixels together."""

    recording: Recording

    @property
    def segments(self) -> list[Segment]:
        """Of all its samples."""
        return self.recording.segments

    @cached_property
    def color(self) -> Floats64:
        """(3,) mean linear radiance."""
        color: Floats64 = self.recording.linear.astype(np.float64).mean(axis=(1, 2))
        return color

    @cached_property
    def mean(self) -> Floats64:
        """(3,) weighted mean of the samples over all pixels: what ``color`` is if it was resolved rightly."""
        weights = self.recording.weights.astype(np.float64)
        with np.errstate(all="ignore"):
            means = (self.recording.radiance * weights).sum(axis=2) / weights.sum(axis=1)
        mean: Floats64 = means.mean(axis=1)
        return mean

    @cached_property
    def developed(self) -> list[Step]:
        """What the functions of `film` make of the colour; see ``developed``."""
        return developed(self.recording)

    @cached_property
    def shares(self) -> Floats64:
        """(n,) share of each sample in the light of all."""
        light = self.recording.radiance.astype(np.float64).sum(axis=0) * self.recording.weights
        shares: Floats64 = np.divide(light.ravel(), max(float(light.sum()), 1e-300))
        return shares

    @cached_property
    def sources(self) -> dict[str, float]:
        """Where the light comes from, and the share of each, the largest first."""
        light: dict[str, float] = defaultdict(float)
        for one in self.segments:
            light[one.source] += sum(one.radiance)
        total = sum(light.values())
        parts = {name: value / total for name, value in light.items() if total and value > 0}
        return dict(sorted(parts.items(), key=lambda item: -item[1]))

    @property
    def reason(self) -> str:
        """Why the pixel has its colour, in one sentence."""
        recording = self.recording
        radiance = recording.radiance.reshape(3, -1)
        wrong = np.flatnonzero(~np.isfinite(radiance).all(axis=0))
        n = radiance.shape[1]
        if len(wrong):
            values = ", ".join(f"{v:g}" for v in radiance[:, wrong[0]])
            some = f"{_of(len(wrong), n, 'sample')} {_some(len(wrong), 'is', 'are')}"
            return f"{some} not finite: number {wrong[0]} is ({values})"
        if not recording.weights.sum():
            made = f": {WEIGHTS} returned them" if WEIGHTS in recording.asked else ""
            return f"the weights of all samples sum to 0{made}"
        if not self.color.max() > 0:
            resolves = self.mean.max() > 0 and RESOLVE in recording.asked
            return self._resolved if resolves else self._why_black()
        for step in self.developed:
            if step.before.max() > SHOWN and not step.after.max() > 0:
                return f"{step.function} made {_rgb(step.after)} of its colour, {_rgb(step.before)}"
        most = int(self.shares.argmax())
        if n >= FEWEST and self.shares[most] > LONE:
            path = [one for one in self.segments if one.sample == most % recording.settings.samples]
            bright = max(path, key=lambda one: sum(one.radiance))
            return (
                f"one sample of {n}, number {most}, carries {self.shares[most]:.0%} of its light,"
                f" which comes from {bright.source} after {_bounces(bright.depth)}"
            )
        white = recording.settings.display.white
        brighter = f"it is brighter than white ({white:g}): " if self.color.max() > white else ""
        parts = [f"{s:.0%} from {name}" for name, s in self.sources.items() if s >= LEAST]
        shadows = [one for one in self.segments if one.light is not None]
        blocked = [one for one in shadows if one.blocked]
        dark = ""
        if blocked:
            ends = _counted(one.met for one in blocked)
            dark = f"; {_ending(len(blocked), len(shadows))} at {ends}"
        other = ""
        if RESOLVE in recording.asked and not np.allclose(self.color, self.mean, OTHER, OTHER / 10):
            other = f"; {self._resolved}"
        return f"{brighter}its light comes {_listed(parts[:MOST_NAMES])}{dark}{other}"

    @property
    def _resolved(self) -> str:
        """What became of the samples."""
        return (
            f"{RESOLVE} made {_rgb(self.color)} of samples whose weighted mean is {_rgb(self.mean)}"
        )

    def _why_black(self) -> str:
        """Why nothing arrives."""
        camera = [one for one in self.segments if one.kind == "camera"]
        reached = [one for one in self.segments if one.light is None and one.met != ENVIRONMENT]
        if all(one.met == ENVIRONMENT for one in camera):
            asked = Counter(call.function for one in camera for call in one.calls[-1:])
            made = [f"{name} returned 0" for name in asked] or ["the environment is black"]
            return f"nothing is there: its rays hit no object, and {_listed(made)}"
        shadows = [one for one in self.segments if one.light is not None]
        unlit = Counter((light, why) for one in reached for light, why in one.unlit.items())
        reasons = []
        if blocked := [one for one in shadows if one.blocked]:
            by = _counted(one.met for one in blocked)
            reasons.append(f"{_ending(len(blocked), len(shadows))} at {by}")
        if dark := [one for one in shadows if not one.blocked]:
            by = _counted(str(one.material) for one in reached)
            reasons.append(
                f"{_of(len(dark), len(shadows), 'shadow ray')} {_some(len(dark), 'reaches', 'reach')} a light, but"
                f" the material reflects none of it ({by})"
            )
        words = {
            "surface": "the surface faces away from {}",
            "light": "{} shines the other way",
            "material": "the material reflects no light of {}",
        }
        for (light, why), count in unlit.most_common(MOST_NAMES):
            whole = "" if count == len(reached) else f" at {_of(count, len(reached), 'hit')}"
            reasons.append(words[why].format(light) + whole)
        if not reasons:
            return self._why_unlit(reached)
        return "no light arrives: " + _listed(reasons)

    def _why_unlit(self, reached: Sequence[Segment]) -> str:
        """Why nothing arrives where no ray asked a light."""
        world = self.recording.scene.compiled.world
        left = {one.parent for one in self.segments}
        last = [one for one in self.segments if one.light is None and one.number not in left]
        missed = [one for one in last if one.met == ENVIRONMENT]
        asked = Counter(call.function for one in self.segments for call in one.calls)
        if missed and any(one.depth for one in missed):
            chosen = f"; {_listed([*asked][:MOST_NAMES])} chose their directions" if asked else ""
            return (
                f"no light arrives: {_of(len(missed), len(last), 'path')} {_some(len(missed), 'leaves', 'leave')} the"
                f" scene, where it is black{chosen}"
            )
        lit = bool(world.lights) or bool(world.ambient.any())
        return "nothing lights it: " + (
            f"what it shows ({_counted(one.met for one in reached)}) reflects no light of lamps"
            if lit
            else "the scene has no light that shows anything"
        )

    @property
    def tree(self) -> Line:
        """What the rays met, depth by depth."""
        recording, settings = self.recording, self.recording.settings
        area = recording.area
        place = (
            f"{area.x},{area.y}"
            if area.size == 1
            else f"{area.x},{area.y} to {area.x + area.width - 1},{area.y + area.height - 1}"
        )
        root = Line(
            f"pixel {place} of {recording.scene.path.name}: {_rgb(self.color)} from {settings.samples} samples"
        )
        root.below.append(Line(self.reason))
        root.below += self._followed([one for one in self.segments if one.parent is None])
        root.below += [
            Line(f"{step.function} made {_rgb(step.after)} of {_rgb(step.before)}")
            for step in self.developed
        ]
        told = {call.function for one in self.segments for call in one.calls}
        root.below += [
            Line(
                f"{name} was asked {_some(count, 'once', f'{count} times')}, for many rays at once"
            )
            for name, count in recording.asked.items()
            if count and name not in told
        ]
        if any(one.calls for one in self.segments):
            frame = recording.scene.compiled.frame
            root.below.append(
                Line(
                    "positions that functions are given and return are in the compiled scene: "
                    f"{_numbers(frame.center)} is its origin, and {frame.scale:.3g} its unit"
                )
            )
        return root

    def _followed(self, rays: Sequence[Segment]) -> list[Line]:
        """Lines for rays of one depth, by kind."""
        lines = []
        for kind, group in _by(rays, lambda one: one.kind).items():
            own = [one for one in group if any(one.radiance)]
            brings = _some(len(group), "brings", "bring")
            light = f", {brings} {self._share(own)}" if own else ""
            line = Line(
                f"{len(group)} {kind} {_some(len(group), 'ray meets', 'rays meet')}"
                f" {_counted(one.met for one in group)}{light}"
            )
            line.below += self._functions(group)
            numbers = {one.number for one in group}
            after = [one for one in self.segments if one.parent in numbers]
            shadows = [one for one in after if one.light is not None]
            line.below += self._lights(group, shadows)
            rest = [one for one in after if one.light is None]
            if rest and rest[0].depth > DEEPEST:
                line.below.append(Line(self._rest(rest)))
            else:
                line.below += self._followed(rest)
            lines.append(line)
        return lines

    def _lights(self, hits: Sequence[Segment], shadows: Sequence[Segment]) -> list[Line]:
        """Lines for the shadow rays to each light, and the lights that hits can't see."""
        lines = []
        for light, group in _by(shadows, lambda one: str(one.light)).items():
            blocked = [one for one in group if one.blocked]
            text = (
                f"{light}: {_ending(len(blocked), len(group))} at {_counted(o.met for o in blocked)}"
                if blocked
                else f"{light}: all {len(group)} shadow rays arrive"
                if len(group) > 1
                else f"{light}: 1 shadow ray arrives"
            )
            line = Line(
                f"{text}, {_some(len(group), 'brings', 'bring')} {self._share(group)}"
                if any(any(o.radiance) for o in group)
                else text
            )
            line.below = self._functions(group)
            if any(one.shaft for one in group):
                line.below.append(Line(_shafts(group)))
            lines.append(line)
        for (light, why), count in Counter(
            (lamp, w) for o in hits for lamp, w in o.unlit.items()
        ).items():
            if why == "material":
                continue
            which = {
                "surface": _some(count, "faces away from it", "face away from it"),
                "light": _some(count, "is behind it", "are behind it"),
            }[why]
            lines.append(Line(f"{light}: {_of(count, len(hits), 'hit')} {which}"))
        return lines

    def _rest(self, rays: Sequence[Segment]) -> str:
        """A line for all that follows rays of one depth."""
        numbers = {one.number for one in rays}
        below = list(rays)
        for one in self.segments:
            if one.parent in numbers and one.number not in numbers:
                numbers.add(one.number)
                below.append(one)
        deepest = max(one.depth for one in below)
        return f"{len(below)} more rays after up to {_bounces(deepest)} bring {self._share(below)}"

    def _functions(self, group: Sequence[Segment]) -> list[Line]:
        """Lines for the functions that chose these rays, with the means of what they returned."""
        results: dict[str, list[Any]] = defaultdict(list)
        for one in group:
            for call in one.calls:
                results[call.function].append(next(iter(call.results.values()), None))
        lines = []
        for name, values in results.items():
            numbers = [v for v in values if not isinstance(v, str | None)]
            try:
                mean = (
                    np.atleast_1d(np.asarray(numbers, np.float64).mean(axis=0)) if numbers else None
                )
            except ValueError:
                mean = None
            said = "" if mean is None or len(mean) > 4 else f"; mean {_numbers(mean)}"
            times = _some(len(values), "once", f"{len(values)} times")
            lines.append(Line(f"{name} was asked {times}{said}"))
        return lines

    def _share(self, segments: Iterable[Segment]) -> str:
        total = sum(sum(one.radiance) for one in self.segments)
        part = sum(sum(one.radiance) for one in segments)
        return f"{part / total:.0%} of the light" if total else "nothing"

    def __repr__(self) -> str:
        return f"<Story of {self.tree.text}; {self.reason}>"

    def __str__(self) -> str:
        return "\n".join(_lines(self.tree))

    def _repr_html_(self) -> str:
        """Show the view of the rays in a notebook; one that isn't trusted shows a still and a text."""
        from course.engine.recording.inline import frame

        return frame(self)

    @cached_property
    def still(self) -> bytes:
        """The rays as a PNG, for where no page is shown; drawn once, for a notebook asks for it in two forms."""
        from course.engine.recording.inline import still

        return still(self)

    def _repr_png_(self) -> bytes:
        """Show the still."""
        return self.still

    def to_dict(self) -> dict[str, Any]:
        """All that is known, for programs: numbers, strings and lists."""
        recording, settings = self.recording, self.recording.settings
        _, pixels, samples = recording.radiance.shape
        area = recording.area
        offsets, effects = recording.offsets, recording.scene.effects
        return {
            "scene": str(recording.scene.path),
            "area": {"x": area.x, "y": area.y, "width": area.width, "height": area.height},
            "size": [settings.width, settings.height],
            "seed": settings.seed,
            "color": self.color.tolist(),
            "reason": self.reason,
            "sources": self.sources,
            "functions": recording.asked,
            "yours": [name for name in recording.asked if effects.written(*name.split("."))]
            if effects.mixed
            else [],
            "rays": dict(recording.counters.rays),
            "samples": [
                {
                    "pixel": [area.x + p % area.width, area.y + p // area.width],
                    "sample": s,
                    "offset": offsets[:, p, s].tolist(),
                    "weight": float(recording.weights[p, s]),
                    "radiance": recording.radiance[:, p, s].tolist(),
                }
                for p in range(pixels)
                for s in range(samples)
            ],
            "segments": [
                vars(one) | {"calls": [vars(call) for call in one.calls]} for one in self.segments
            ],
        }


def _lines(line: Line, depth: int = 0) -> list[str]:
    """A line and those below it, indented, none longer than a terminal is wide."""
    indent = "  " * depth
    own = wrap(line.text, WIDE, initial_indent=indent, subsequent_indent=f"{indent}    ")
    return own + [each for one in line.below for each in _lines(one, depth + 1)]


def _shafts(shadows: Sequence[Segment]) -> str:
    """Which of the shadow rays to a light must be sent; ``course render --shafts`` leaves out the others."""
    counts = Counter(one.shaft for one in shadows)
    why = {
        "clear": "with nothing between their cell and all of the light",
        "cut off": "with one triangle between their cell and all of it",
    }
    spared = [f"{counts[shaft]} {said}" for shaft, said in why.items() if counts[shaft]]
    if not spared:
        return (
            "shafts: something is between each ray's cell and a part of the light, so all are sent"
        )
    sent = len(shadows) - counts["clear"] - counts["cut off"]
    rest = f"; {sent} must be" if sent else ""
    return f"shafts: {_listed(spared)} need not be sent{rest}"


def _by(segments: Iterable[Segment], key: Callable[[Segment], str]) -> dict[str, list[Segment]]:
    groups: dict[str, list[Segment]] = defaultdict(list)
    for one in segments:
        groups[key(one)].append(one)
    return groups


def _counted(names: Iterable[str]) -> str:
    """Names, the most frequent first, with their numbers where there are several."""
    counts = Counter("the environment" if name == ENVIRONMENT else f"'{name}'" for name in names)
    if len(counts) == 1:
        return next(iter(counts))
    listed = [f"{name} ({count})" for name, count in counts.most_common(MOST_NAMES)]
    rest = len(counts) - len(listed)
    return _listed(listed + ([f"{rest} more"] if rest else []))


def _listed(parts: Sequence[str]) -> str:
    return parts[0] if len(parts) == 1 else ", ".join(parts[:-1]) + " and " + parts[-1]


def _of(count: int, whole: int, noun: str) -> str:
    if count == whole:
        return f"all {whole} {noun}s" if whole != 1 else f"the one {noun}"
    return f"{count} of {whole} {noun}s"


def _ending(count: int, whole: int) -> str:
    return f"{_of(count, whole, 'shadow ray')} {_some(count, 'ends', 'end')}"


def _some(count: int, one: str, many: str) -> str:
    return one if count == 1 else many


def _bounces(depth: int) -> str:
    return "1 bounce" if depth == 1 else f"{depth} bounces"


def _rgb(color: Floats64) -> str:
    return _numbers(color)


def _numbers(values: Iterable[float]) -> str:
    return " ".join(f"{value:.3g}" for value in values)
