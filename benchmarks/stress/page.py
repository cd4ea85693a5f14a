"""The section "Numerical stability" of the documentation, written from a run."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from benchmarks.stress.report import share_at_edges
from benchmarks.stress.rows import Row, rows_of
from benchmarks.stress.verdict import FALSE_FAIL, GAIN, ROUNDING, Verdict

PAGE = Path(__file__).resolve().parents[2] / "docs" / "accuracy.md"
BEGIN = "<!-- stress suite: begin -->"
END = "<!-- stress suite: end -->"

TEXT = """\
## Numerical stability

A scene in nanometres or in parsecs, far from the origin, made of slivers, seen and lit at a millionth of a radian, is
the same picture as its well-conditioned twin: at the origin, of unit size, cut into two triangles where the other is
cut into thousands. `make stress` renders {cells:,} such cells, in which every two levels of any two axes meet
(unless no file can hold the two together), and says of each:

- **Finite.** Every pixel is finite and not negative, and NumPy has nothing to warn of.
- **No energy is created.** No pixel is brighter than a bound that follows from the scene. In a furnace, the same shapes
  in a uniform radiance of 1, no pixel shows more than 1.
- **Equal to its twin.** The pictures have the same random numbers. Whatever a ray meets lies by a stated shift apart
  at most: the rounding of float32, and what each level adds. So every pixel differs by at most

      {gain:g} * shift * (1 + bounces) * steepness + {rounding:g} * 2^-24 * (brightest pixel)

  and, where an object is the light, by the error of its area besides.
  How steeply a pixel answers to a change of the scene is measured on the twin. Where a small change lets a sample meet
  another thing, it may also do so in the cell: at such edges as many pixels may differ as the shift explains (the
  quantile of a Poisson distribution at {false_fail:g}), and none may show what is not seen around it. A flat patch and
  a closed box of mirrors have a radiance in closed form, and there the bound is rounding alone; not one ray, in up to
  65 bounces, gets out of the box.
- **Physics.** Plates of glass, clear, coloured and frosted, and sheets of metal are held against Fresnel's formulae in
  another form, in float64, and against the sum over all ways through a plate: this would show a reflectance that cell
  and twin have wrong alike.

The worst that was found on each level of each axis: the deviation from the twin as a share of its brightest pixel, the
same as a share of its bound, the brightest pixel as a share of what the scene can bring, and the most pixels at the
edges of one picture that show something else ({edges:.0%} of all pixels are at edges). {outcome}
"""


def write_page(verdicts: Sequence[Verdict], page: Path = PAGE) -> None:
    """Put the section into the page, in place of the one that is there."""
    section = f"{BEGIN}\n{section_of(verdicts)}{END}\n"
    text = page.read_text(encoding="utf-8") if page.is_file() else "# Accuracy\n\n"
    if BEGIN in text and END in text:
        before, rest = text.split(BEGIN, 1)
        text = before + section + rest.split(END, 1)[1].removeprefix("\n")
    else:
        text = text.rstrip("\n") + "\n\n" + section
    page.parent.mkdir(parents=True, exist_ok=True)
    page.write_text(text, encoding="utf-8")


def section_of(verdicts: Sequence[Verdict]) -> str:
    """The section in Markdown."""
    rows = rows_of(verdicts)
    failed = rows[-1].failed
    outcome = "Every cell passed." if failed == 0 else f"{failed} cells failed."
    text = TEXT.format(
        cells=len(verdicts),
        gain=GAIN,
        rounding=ROUNDING,
        false_fail=FALSE_FAIL,
        outcome=outcome,
        edges=share_at_edges(verdicts),
    )
    lines = ["| axis | level | cells | failed | deviation | of its bound | energy | at edges |"]
    lines += ["| --- | --- | --: | --: | --: | --: | --: | --: |"]
    lines += [_line(row, previous) for row, previous in zip(rows, [None, *rows], strict=False)]
    return text + "\n" + "\n".join(lines) + "\n\n"


def _line(row: Row, previous: Row | None) -> str:
    axis = "" if previous is not None and previous.axis == row.axis else row.axis
    numbers = f"{row.cells} | {row.failed} | {row.error:.1e} | {row.share:.0%} | {row.energy:.4f}"
    return f"| {axis} | {row.level} | {numbers} | {row.jumps} |"
