"""A receipt for people: sections of labels and values, and their lines of text."""

from collections.abc import Mapping, Sequence
from html import escape
from typing import TYPE_CHECKING, Any

from course.base.texts import count

if TYPE_CHECKING:
    from course.engine.render.receipt import Receipt

Rows = Sequence[tuple[str, str]]
Section = tuple[str, Rows]
"""A heading, and under it labels with their values."""

_CASTERS = {"embree": "Embree", "numba": "Numba's BVH", "numpy": "NumPy's BVH"}
"""What answers rays, by the receipt's names."""


NAMED = 4
"""Modules without a call that are named; of more, their number is told."""


def plain_text(title: str, sections: Sequence[Section]) -> str:
    """Return the table as lines of text, headings and labels in columns."""
    headings = max((len(heading) for heading, _ in sections), default=0)
    labels = max((len(label) for _, rows in sections for label, _ in rows), default=0)
    lines = [title]
    for heading, rows in sections:
        for number, (label, value) in enumerate(rows):
            first = heading if number == 0 else ""
            lines.append(f"  {first:<{headings}}  {label:<{labels}}  {value}".rstrip())
    return "\n".join(lines)


def receipt_sections(receipt: Mapping[str, Any]) -> list[Section]:
    """Arrange what a render cost.

    ``receipt``: as `course.engine.render.receipt.Receipt.to_dict` gives it.
    Sections without a row are left out.
    """
    rays = receipt["rays"]
    wall, threads = receipt["wall_seconds"], receipt["threads"]
    spent, inside = wall * threads, receipt["embree_seconds"]
    caster = _CASTERS[receipt["caster"]]
    effects = receipt["effects"]
    yours, standing = effects.get("yours", ()), effects.get("stand-ins", {})
    sections = [
        ("rays", [*_counts(rays), *_total(rays, wall)]),
        ("not sent", _spared(receipt)),
        ("samples", _samples(receipt)),
        ("subdivision", _corners(receipt)),
        ("denoising", _denoising(receipt)),
        ("tests", _tests(receipt)),
        ("numbers", _counts(receipt["numbers"])),
        (
            "effects",
            [
                *(
                    ("yours" if name in yours else "called", name)
                    for name in effects["called"]
                    if name not in standing
                ),
                *(("stand-in", f"{name}: {said}") for name, said in standing.items()),
                *_idle(effects.get("not called", ())),
                *_skipped(effects["skipped"]),
            ],
        ),
        ("seconds", [(stage, f"{time:9.3f}") for stage, time in receipt["seconds"].items()]),
        (
            "time",
            [
                ("wall clock", f"{wall:9.3f} s on {count(threads, 'thread')}"),
                (
                    f"inside {caster}",
                    f"{inside:9.3f} s, {_share(inside, spent)} of all threads' time",
                ),
            ],
        ),
    ]
    return [(heading, rows) for heading, rows in sections if rows]


def receipt_table(receipt: "Receipt") -> str:
    """A receipt as a table of a page."""
    rows = [
        f"<tr><th>{escape(heading) if not n else ''}</th><td>{escape(label)}</td><td>{escape(value)}</td></tr>"
        for heading, rows in receipt_sections(receipt.to_dict())
        for n, (label, value) in enumerate(rows)
    ]
    return f"<table>{''.join(rows)}</table>"


def _corners(receipt: Mapping[str, Any]) -> list[tuple[str, str]]:
    divided = receipt.get("subdivision")
    if divided is None:
        return []
    return [
        (
            "corners",
            f"{divided['corners']:,} of {divided['lattice']:,}, {divided['saved']:.0%} saved",
        ),
        ("shared", f"{divided['shared']:,} times"),
    ]


def _denoising(receipt: Mapping[str, Any]) -> list[tuple[str, str]]:
    found = receipt.get("denoising")
    if found is None:
        return []
    return [
        ("biased", f"a preview: each pixel a mean with {found['neighbours']:.1f} neighbours"),
        ("noise", f"{found['noise']:.3g} before, {found['left']:.3g} after, by its own estimate"),
        ("bias", f"{found['bias']:.3g}, by its own estimate"),
    ]


def _spared(receipt: Mapping[str, Any]) -> list[tuple[str, str]]:
    """Shadow rays whose answers were known, and why."""
    found = receipt.get("spared", {})
    sent = receipt["rays"].get("shadow", 0)
    total = max(sent + found.get("clear", 0) + found.get("cut off", 0), 1)
    why = {
        "clear": "of the shadow rays: nothing between their cell and the whole light",
        "cut off": "of the shadow rays: one triangle between their cell and all of the light",
    }
    rows = [
        (name, f"{_share(found[name], total)} {said}")
        for name, said in why.items()
        if found.get(name)
    ]
    probes = found.get("probes")
    return rows + (
        [("probes", f"{probes:,} rays to see which cells are worth a look")] if probes else []
    )


def _tests(receipt: Mapping[str, Any]) -> list[tuple[str, str]]:
    """Of a hierarchy, by all its rays."""
    rays = max(sum(receipt["rays"].values()), 1)
    return [
        (kind, f"{number:,}, {number / rays:.1f} a ray")
        for kind, number in receipt.get("tests", {}).items()
    ]


def _idle(idle: Sequence[str]) -> list[tuple[str, str]]:
    """Functions of one's own that a picture does without, by name, and the modules of which it uses none."""
    functions = [name for name in idle if "." in name]
    modules = [name for name in idle if "." not in name]
    if modules:
        named = ", ".join(modules) if len(modules) <= NAMED else f"{len(modules)} modules"
        functions.append(f"all of {named}")
    return [("not called", ", ".join(functions))] if functions else []


def _skipped(skipped: Mapping[str, str]) -> list[tuple[str, str]]:
    """One line: most scenes need few of all effects; the receipt as JSON has the reason of each."""
    return [("skipped", f"{len(skipped)} that the scene doesn't need")] if skipped else []


def _samples(receipt: Mapping[str, Any]) -> list[tuple[str, str]]:
    error, mean = receipt["error"], receipt["samples"]
    if error is None:
        return [("a pixel", f"{mean:g}" if mean == int(mean) else f"{mean:.1f} on average")]
    estimated, target = error["estimated"], error["target"]
    missed = (
        ""
        if estimated <= target
        else f", above the target {target:g}: more samples (--spp) bring it down"
    )
    return [
        ("a pixel", f"{mean:.1f} on average, {error['fewest']:,} to {error['most']:,}"),
        ("estimated error", f"{estimated:.3g}{missed}"),
        *(("not bounded", cause) for cause in error.get("not bounded", ())),
        ("saved", f"{error['saved']:.0%} of {error['uniform']:.1f} in every pixel alike"),
    ]


def _counts(counts: Mapping[str, int]) -> list[tuple[str, str]]:
    width = max((len(f"{number:,}") for number in counts.values()), default=0)
    return [(name, f"{number:>{width},}") for name, number in counts.items() if number]


def _total(rays: Mapping[str, int], wall: float) -> list[tuple[str, str]]:
    total = sum(rays.values())
    if total == 0 or wall <= 0.0:
        return []
    return [("a second", f"{total / wall / 1e6:.1f} million")]


def _share(part: float, whole: float) -> str:
    return f"{part / whole:.0%}" if whole > 0.0 else "none"
