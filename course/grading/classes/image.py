"""The folder that a container image is built from which grades: the project, references, and a Dockerfile."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path

from course.errors import OutputError
from course.grading.classes.bundle import REFERENCES, gradescope_contents

HOME = "/opt/penumbra-grader"
"""Where the grader lies in the image."""

IMAGE = "penumbra-grader"

DOCKERFILE = f"""\
# Grades submissions, as PrairieLearn's external grader or with `course grade`:
#     docker build -t {IMAGE} .
FROM python:3.12-slim
# Either shuts students' code in: where the host doesn't allow the first, the other does.
RUN apt-get update \\
    && apt-get install -y --no-install-recommends bubblewrap libseccomp2 \\
    && rm -rf /var/lib/apt/lists/*
COPY penumbra {HOME}/penumbra
RUN pip install --no-cache-dir --disable-pip-version-check --editable {HOME}/penumbra
COPY {REFERENCES} run {HOME}/
# Students' code runs as a user of its own, which owns nothing: the course with its solutions is root's alone.
RUN chown -R 0:0 {HOME} && chmod -R go-rwx {HOME} && chmod u+x {HOME}/run
USER root
CMD ["{HOME}/run"]
"""

RUN = """\
#!/bin/sh
# PrairieLearn runs this for each submission.
# Alone with itself: a folder that a student hands in is no place to import from.
exec python -I -m course.grading.classes.prairielearn_run \\
    --references {home}/{references} --seed {seed} --modules {modules} --seconds {seconds}{trusted}
"""

READ_ME = """\
# A container that grades

It holds the solutions and the seed: not for students, and no place that they can pull from.

    docker build -t {image} .

A class, from the folder `submissions` into the folder `graded`:

    docker run --rm --network none -v "$PWD/submissions:/submissions:ro" -v "$PWD/graded:/graded" {image} \\
        course grade /submissions --out /graded --seed {seed} --modules {modules}

One submission, laid out as by PrairieLearn (`/grade/student` in, `/grade/results/results.json` out):

    docker run --rm --network none -v "$PWD/job:/grade" {image}
"""


def image_contents(
    project: Path,
    seed: int,
    modules: Sequence[str],
    seconds: float,
    *,
    trusted: bool = False,
) -> dict[str, bytes]:
    """Path in the folder -> content.

    Parameters
    ----------
    project : the course with its solutions
    seed, modules : what to check; the references for them are made now
    seconds : that PrairieLearn gives a submission
    trusted : whether to grade where the code can't be kept from doing harm, too
    """
    run = RUN.format(
        home=HOME,
        references=REFERENCES,
        seed=seed,
        modules=",".join(modules),
        seconds=f"{seconds:g}",
        trusted=" --trust-submissions" if trusted else "",
    )
    read_me = READ_ME.format(image=IMAGE, seed=seed, modules=",".join(modules))
    needed = {
        name: content
        for name, content in gradescope_contents(project, seed, modules).items()
        if name == REFERENCES or name.startswith("penumbra/")
    }
    own = {"Dockerfile": DOCKERFILE, "run": run, "README.md": read_me}
    return {name: text.encode() for name, text in own.items()} | needed


def check_folder(out: Path) -> None:
    """Refuse a folder in which something would be written over; raises ``OutputError``."""
    if out.exists() and (not out.is_dir() or any(out.iterdir())):
        raise OutputError(f"{out}: is there already and not an empty folder; choose another")


def write_folder(contents: Mapping[str, bytes], out: Path) -> int:
    """Write files into a folder that is new or empty; the number of files.

    Raises
    ------
    OutputError
        The folder holds something, or can't be written.
    """
    check_folder(out)
    try:
        for name, content in contents.items():
            path = out / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_bytes(content)
            if content.startswith(b"#!"):
                path.chmod(0o755)
    except OSError as error:
        raise OutputError(f"{out}: can't be written: {error.strerror}") from error
    return len(contents)
