"""The rays behind a picture that is wrong."""

from course.school.grading.checks.check import (
    Caller,
    Check,
    Figure,
    ModuleChecks,
    References,
    Trial,
    generator,
)

PICTURE = "picture"
"""The check whose failure asks for the rays behind it."""


def rays_behind(
    checks: ModuleChecks, picture: Check, caller: Caller, references: References, seed: int
) -> tuple[Figure, ...]:
    """Figures of the rays behind a wrong picture; none where no rays are declared or they can't be shown."""
    check = checks.rays.get(picture.function)
    if check is None:
        return ()
    trial = Trial(check.function, caller, generator(seed, checks.module, check))
    try:
        for needed in (picture, check):
            if needed.prepare:
                trial.references = {**trial.references, **references(checks.module, needed)}
        check.run(trial)
    except Exception:  # noqa: BLE001 - the check has said what is wrong, and goes on without them
        return ()
    return tuple(trial.figures)
