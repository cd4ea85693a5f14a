"""`python -m benchmarks.attacks`: all attacks behind all walls, as root and as another user; what held is written."""

import json
import sys
from pathlib import Path

import click

from benchmarks.attacks.running import ATTACKS, Outcome, outcomes, run_all
from benchmarks.attacks.walls import OPEN, WALLS
from course.engine.functions.effects import PROJECT

OUT = PROJECT / "docs" / "data" / "grading" / "attacks.json"


@click.command()
@click.option("--behind", type=click.Choice([*WALLS, OPEN]), help="Only run here, and print.")
@click.option("--reaching", is_flag=True, help="Leave out those on the score.")
@click.option(
    "--every", type=click.IntRange(1), default=1, help="Only each so manieth, with --behind."
)
@click.option("--first", type=click.IntRange(0), default=0, help="The first of them.")
@click.option("--walls", multiple=True, type=click.Choice([*WALLS]), help="Only behind these.")
@click.option("--users", multiple=True, type=click.Choice(["root", "another"]))
@click.option("--out", type=click.Path(path_type=Path, dir_okay=False), default=OUT)
def main(
    behind: str | None,
    reaching: bool,
    every: int,
    first: int,
    walls: tuple[str, ...],
    users: tuple[str, ...],
    out: Path,
) -> None:
    """Attack the grader, print what held and write it."""
    if behind is not None:
        sys.exit(run_all(behind, reaching=reaching, every=every, first=first))
    rows: list[dict[str, object]] = []
    for user in users or ("root", "another"):
        scores = not reaching
        for wall in walls or WALLS:
            # Those on the score come through the pipe, which is the same behind every wall: once for each user.
            row = _row(user, wall, not scores)
            scores = scores and "tried" not in row
            print(f"{user:>8}  {wall:<22} {row['told']}", flush=True)
            for name, what in row.get("failed", {}).items():
                print(f"{'':>10}{name}: {what}")
            rows.append(row)
    document = {"attacks": len(ATTACKS), "walls": rows}
    out.write_text(json.dumps(document, indent=1) + "\n", encoding="utf-8")
    print(f"{len(ATTACKS)} attacks; {out} written")
    sys.exit(any(row.get("failed") for row in rows))


def _row(user: str, wall: str, reaching: bool) -> dict[str, object]:
    try:
        found = outcomes(user, wall, reaching=reaching)
    except LookupError as error:
        return {"user": user, "wall": wall, "told": f"not here: {error}"}
    failed = {one.name: _told(one) for one in found if not one.held}
    told = f"{len(found)} attacks, {len(failed)} with gain or effect"
    return {"user": user, "wall": wall, "told": told, "tried": len(found), "failed": failed}


def _told(outcome: Outcome) -> str:
    return "; ".join(filter(None, (outcome.gain, *outcome.effects)))


if __name__ == "__main__":
    main()
