"""What a misspelt word was meant to be: "did you mean look_at?"."""

from __future__ import annotations

import difflib
from collections.abc import Iterable

from course.formats.yaml.document import LONGEST, PLAIN_KEY, show


def suggest(word: object, known: Iterable[str]) -> str:
    """`did you mean look_at?`, or all that is known where nothing comes near."""
    names = list(known)
    # Comparing is quadratic in the length of the word, which the file decides.
    folded = str(word)[:LONGEST].lower()
    lower: dict[str, str] = {name[:LONGEST].lower(): name for name in names}
    near = [lower[name] for name in difflib.get_close_matches(folded, lower, n=2, cutoff=0.6)]
    if near:
        return f"did you mean {' or '.join(map(_name, near))}?"
    if not names:
        return "there are none"
    listed = ", ".join(map(_name, names[:30]))
    return f"known are {listed}{', ...' if len(names) > 30 else ''}"


def _name(name: str) -> str:
    return name if PLAIN_KEY.fullmatch(name) and len(name) <= LONGEST else show(name)
