"""The archive that Gradescope makes an autograder from.

Its root holds ``setup.sh``, which Gradescope runs once to build an image, and ``run_autograder``, which it runs for
each submission; ``penumbra/`` holds the project as far as grading needs it. What goes in is listed, as it is for
students.
"""

from __future__ import annotations

import tempfile
import zipfile
from collections.abc import Mapping, Sequence
from pathlib import Path

from course.atomic import replacing
from course.grading.classes.job import with_whole
from course.grading.references import make_references

FOLDERS = {"course": {".py", ".typed", ".json", ".jinja"}, "solutions": {".py"}}
"""Folders of the project that grading needs, and the kinds of file in them; its scenes are part of the course."""

FILES = ("README.md", "LICENSE", "pyproject.toml")

LEFT_OUT = ("course/benchmarking/", "solutions/right/", "solutions/wrong/")

REFERENCES = "references.npz"
"""Beside the project in the archive."""

SETUP = """\
#!/usr/bin/env bash
# Gradescope runs this once, as root, to build the image that grades.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"
export DEBIAN_FRONTEND=noninteractive

new_enough() {
    "$1" -c 'import ensurepip, sys, venv; sys.exit(sys.version_info < (3, 11))' 2>/dev/null
}

find_python() {
    for python in python3.14 python3.13 python3.12 python3.11 python3; do
        if new_enough "$python"; then echo "$python"; return; fi
    done
    return 1
}

if command -v apt-get >/dev/null; then
    apt-get update || echo "no lists of packages: going on with what is installed"
    # Either shuts students' code in: where the image doesn't allow the first, the other does.
    apt-get install -y --no-install-recommends bubblewrap || echo "no bubblewrap: going on without it"
    apt-get install -y --no-install-recommends libseccomp2 || echo "no libseccomp: going on without it"
    find_python >/dev/null \\
        || apt-get install -y --no-install-recommends python3 python3-venv && find_python >/dev/null \\
        || apt-get install -y --no-install-recommends python3.12 python3.12-venv && find_python >/dev/null \\
        || apt-get install -y --no-install-recommends python3.11 python3.11-venv
fi
python=$(find_python) || { echo "no Python 3.11 or newer with venv; choose a newer base image" >&2; exit 1; }
"$python" -m venv .venv
.venv/bin/python -m pip --disable-pip-version-check install --editable ./penumbra
# Students' code runs as a user of its own, which owns nothing: the course with its solutions is root's alone.
chown -R 0:0 penumbra references.npz
chmod -R go-rwx penumbra references.npz
.venv/bin/python -m course.grading.classes.gradescope_run --root .. --walls
"""

RUN = """\
#!/usr/bin/env bash
# Gradescope runs this for each submission.
exec /autograder/source/.venv/bin/python -m course.grading.classes.gradescope_run \\
    --root /autograder --seed {seed} --modules {modules}{trusted}
"""


def write_archive(contents: Mapping[str, bytes], out: Path) -> int:
    """Write a .zip file of what `gradescope_contents` gives; the number of its files.

    Raises
    ------
    OutputError
        The file can't be written.
    """
    with replacing(out) as temporary, zipfile.ZipFile(temporary, "w") as file:
        for name, content in contents.items():
            # A fixed date: the same course gives the same archive.
            entry = zipfile.ZipInfo(name)
            executable = name in ("setup.sh", "run_autograder")
            entry.create_system = 3  # Unix, so that the permissions count
            entry.external_attr = (0o100755 if executable else 0o100644) << 16
            file.writestr(entry, content, zipfile.ZIP_DEFLATED)
    return len(contents)


def gradescope_contents(
    project: Path, seed: int, modules: Sequence[str], *, trusted: bool = False
) -> dict[str, bytes]:
    """Path in the archive -> content.

    Parameters
    ----------
    project : the course with its solutions
    seed, modules : what to check; the references for them are made now
    trusted : whether to grade where the code can't be kept from doing harm, too
    """
    trust = " --trust-submissions" if trusted else ""
    run = RUN.format(seed=seed, modules=",".join(modules), trusted=trust)
    contents = {"setup.sh": SETUP.encode(), "run_autograder": run.encode()}
    for name in FILES:
        contents[f"penumbra/{name}"] = (project / name).read_bytes()
    for folder, suffixes in FOLDERS.items():
        for path in sorted((project / folder).rglob("*")):
            name = path.relative_to(project).as_posix()
            if path.is_file() and path.suffix in suffixes and not name.startswith(LEFT_OUT):
                contents[f"penumbra/{name}"] = path.read_bytes()
    with tempfile.TemporaryDirectory() as folder:
        references = Path(folder) / REFERENCES
        make_references(with_whole(modules), seed, references)
        contents[REFERENCES] = references.read_bytes()
    return contents
