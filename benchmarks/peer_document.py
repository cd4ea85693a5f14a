"""The tables of docs/peers.md, made of all cases that docs/data/peers.json keeps."""

from collections.abc import Sequence
from pathlib import Path
from statistics import median

from benchmarks.mitsuba_scalar import ALIKE
from benchmarks.peer_cases import FORMS, QUICK, Effort, Measured, Result
from course.benchmarking.documents import replace_marked
from course.benchmarking.tables import Table

MARK = "python -m benchmarks.peers"
SIZE = (400, 300)


def write_document(cases: Sequence[Measured], document: Path) -> None:
    """Put the tables between the marks of a document.

    Raises OutputError: it isn't there, has not got the marks, or can't be written.
    """
    results = [case.result for case in cases]
    parts = _sources(cases)
    forms = [form for form in FORMS if any(r.form == form for r in results)]
    for number, table in enumerate(tables(results)):
        parts.append(f"### {table.title[0].upper()}{table.title[1:]}")
        # The tables of times come first, one for each form.
        parts += [f"<!-- site: peer_times {form} -->" for form in forms[number : number + 1]]
        parts.append(table.markdown())
    without = [
        f"- {r.effect}, {r.form}: {', '.join(r.without) or 'as it is'}"
        + (f"; {ALIKE[r.effect]}" if r.alike else "")
        for r in results
    ]
    parts += ["What the scenes do without:", "\n".join(without)]
    replace_marked(document, MARK, "\n\n".join(parts))


def command(effort: Effort) -> str:
    """What was run."""
    return MARK + (" --quick" if effort == QUICK else "") + " --write"


def _sources(cases: Sequence[Measured]) -> list[str]:
    """How and where the cases were measured; where that isn't the same for all, which were measured so."""
    alike: list[list[Measured]] = []
    for case in cases:
        for group in alike:
            if (group[0].effort, group[0].about) == (case.effort, case.about):
                group.append(case)
                break
        else:
            alike.append([case])
    parts = []
    for group in alike:
        effort, about = group[0].effort, group[0].about
        names = ", ".join(f"{case.result.effect} {case.result.form}" for case in group)
        parts += [
            f"Made by `{command(effort)}`, pictures of {SIZE[0]} x {SIZE[1]}, medians of {effort.rounds} rounds"
            + (f": {names}." if len(alike) > 1 else "."),
            Table("", ("machine", ""), tuple(about.items())).markdown(),
        ]
    return parts


WAYS = ("uniform", "adaptive", "uniform, compiled", "adaptive, compiled")


def tables(results: list[Result]) -> list[Table]:
    """Everything, for people."""
    measured = [form for form in FORMS if any(r.form == form for r in results)]
    return [
        *(time_table(form, [r for r in results if r.form == form]) for form in measured),
        ratio_table(results),
        process_table(results),
        agreement_table(results),
    ]


def _ways(results: list[Result]) -> list[str]:
    """The ways to render that were measured."""
    found = {o.name for r in results for t in r.targets for o in t.ours}
    return [name for name in WAYS if name in found]


def time_table(form: str, results: list[Result]) -> Table:
    """Seconds to the same errors, and ours over theirs."""
    names = _ways(results)
    rows = []
    for r in results:
        for t in r.targets:
            ours = {o.name: o.seconds for o in t.ours}
            cells = [_beside(ours.get(name), t.theirs.seconds) for name in names]
            about = f"{t.error:.2e}", t.theirs.name, f"{t.theirs.seconds:.3f}"
            rows.append((_effect(r), str(t.samples), *about, *cells))
    return Table(
        f"seconds to the same error, Mitsuba {form}; in brackets ours / Mitsuba's",
        ("scene", "samples", "RMSE", "Mitsuba's fastest sampler", f"Mitsuba {form}", *names),
        tuple(rows),
    )


def ratio_table(results: list[Result]) -> Table:
    """The worst, the middle and the best error of each scene."""
    names = _ways(results)
    rows = [
        (f"{_effect(r)}, {r.form}", *(_spread(r.ratios(name)) for name in names)) for r in results
    ]
    title = "ours / Mitsuba's: the worst, the middle and the best of a scene's errors"
    return Table(title, ("scene", *names), tuple(rows))


def process_table(results: list[Result]) -> Table:
    """Whole processes."""
    rows = [
        (
            f"{_effect(r)}, {r.form}",
            f"{r.middle.error:.2e}",
            f"{r.process:.2f}",
            _beside(r.our_process, r.process),
        )
        for r in results
    ]
    title = "whole processes to the same error"
    return Table(title, ("scene", "RMSE", "Mitsuba", "ours"), tuple(rows))


def agreement_table(results: list[Result]) -> Table:
    """Converged pictures."""
    rows = []
    for r in results:
        a, error = r.agreement, r.middle.error
        numbers = (f"{a.largest:.1f}", f"{a.far:.2%}", f"{a.rms:.1e}", f"{a.rms / error:.2f}")
        rows.append((f"{_effect(r)}, {r.form}", *numbers, f"{a.mean:+.3%}", f"{a.where}"))
    return Table(
        "converged pictures: Mitsuba's against ours",
        (
            "scene",
            "largest |t|",
            "|t| > 4.5",
            "RMS beyond noise",
            "/ RMSE above",
            "mean",
            "worst at",
        ),
        tuple(rows),
    )


def _effect(r: Result) -> str:
    return f"{r.effect} ≈" if r.alike else r.effect


def _spread(ratios: list[float]) -> str:
    """The worst, the middle and the best of sorted ratios."""
    if not ratios:
        return "-"
    return " · ".join(f"{r:.2f}" for r in dict.fromkeys((ratios[-1], median(ratios), ratios[0])))


def _beside(ours: float | None, theirs: float) -> str:
    return "-" if ours is None else f"{ours:.3f} ({ours / theirs:.2f})"
