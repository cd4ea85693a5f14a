"""Variants of the known wrong submissions: the same mistakes, made by somebody who uses u in another order or sense.

Where rows and senses of u are free, and where the axes of a result are, a right function stays right when they are
exchanged; so a wrong one stays as wrong, and has to be caught and named as before.
"""

from collections.abc import Iterator
from dataclasses import replace

from course.school.grading.checks.declare import declared_function
from course.school.grading.known import KnownSubmission, known

WRAPPED = '''

_as_it_was = {function}


def {function}({signature}):
    """The same, {what}."""
{body}
'''

ROWS = "with the rows of u exchanged"
SENSE = "with u counted the other way"
AXES = "with the axes of its result exchanged"

_BODIES = {
    ROWS: "    return _as_it_was({before}u[::-1].copy())",
    SENSE: "    return _as_it_was({before}np.clip(1 - u, 0, np.nextafter(u.dtype.type(1), u.dtype.type(0))))",
    AXES: "    return np.ascontiguousarray(_as_it_was({before}{last})[::-1])",
}


def variants(module: str) -> Iterator[KnownSubmission]:
    """Those of all wrong submissions of a module."""
    for submission in known(module):
        if not submission.right:
            yield from variants_of(submission)


def variants_of(submission: KnownSubmission) -> Iterator[KnownSubmission]:
    """Of one wrong submission; none where nothing may be exchanged, or where it writes to u, which would be a copy."""
    if submission.caught_by == "untouched":
        return
    function = declared_function(submission.module, submission.function)
    names = [argument.name for argument in function.arguments]
    kinds = []
    if function.free and names[-1] == "u":
        rows = function.argument("u").sizes
        kinds += [*([ROWS] if len(rows) > 1 else []), SENSE]
    if function.symmetric:
        kinds.append(AXES)
    for what in kinds:
        before = "".join(f"{name}, " for name in names[:-1])
        body = _BODIES[what].format(before=before, last=names[-1])
        text = WRAPPED.format(
            function=submission.function, signature=", ".join(names), what=what, body=body
        )
        yield replace(
            submission, name=f"{submission.name}, {what}", source=submission.source + text
        )
