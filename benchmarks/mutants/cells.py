"""Right submissions as notebooks: cut at random, with what people try out between. They earn what the file earns."""

import ast
import json
import random
from dataclasses import replace
from itertools import pairwise

from course.engine.functions.notebook.reading import read_notebook
from course.school.grading.known import KnownSubmission

NOISE = (
    "%matplotlib inline\nimport matplotlib.pyplot as plt",
    "plt.figure(); plt.show()",
    "!pip install numpy",
    "some thoughts of mine",
    "np.random.default_rng?",
    "trial = [i for i in range(3)]\nfor one in trial:\n    print(one)",
    "# \u2028 pasted",
    "raise KeyboardInterrupt",
)
"""Cells that have nothing to do with the functions, and would end a module's import or change nothing."""


def in_cells(source: str, rng: random.Random) -> bytes:
    """A module's text as a notebook: cut between statements at random, a magic over some cells, others between."""
    lines = source.split("\n")
    starts = [
        min([node.lineno, *(one.lineno for one in getattr(node, "decorator_list", ()))])
        for node in ast.parse(source).body
    ]
    cuts = [0, *sorted(line - 1 for line in starts[1:] if rng.random() < 0.6), len(lines)]
    cells = ["\n".join(lines[first:last]) for first, last in pairwise(cuts)]
    cells = [f"%%time\n{cell}" if rng.random() < 0.2 else cell for cell in cells]
    for _ in range(5):
        cells.insert(rng.randrange(1, len(cells) + 1), rng.choice(NOISE))
    made = [{"cell_type": "code", "source": cell.splitlines(keepends=True)} for cell in cells]
    return json.dumps({"cells": made, "nbformat": 4}).encode()


def as_notebook(submission: KnownSubmission, seed: int) -> KnownSubmission:
    """A submission with what is read from its notebook in the place of its file."""
    content = in_cells(submission.source, random.Random(f"{seed} {submission.name}"))
    found = read_notebook(f"{submission.name}.ipynb", content, [submission.module])
    return replace(submission, source=found.sources[submission.module].decode())
