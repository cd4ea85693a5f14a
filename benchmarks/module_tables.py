"""`python -m benchmarks.module_tables`: the tables of modules in the README and of their checks in docs/grading.md.

What only an author can say of a module stands in docs/teaching.yaml; what can be counted is counted.
"""

from pathlib import Path

import msgspec

from course.benchmarking.documents import replace_marked
from course.engine.functions.effects import PROJECT
from course.engine.functions.modules import COURSE, FURTHER, MODULES, TAUGHT
from course.school.grading.catalog import module_checks

KINDS = {"convergence": "order", "picture": "picture", "bias": "bias", "speed": "speed"}
"""Kinds of checks, as the page calls them and as checks do."""

TEACHING = PROJECT / "docs" / "teaching.yaml"
WARM_UP = "sampling"


def said(key: str) -> dict[str, str]:
    """What docs/teaching.yaml says of each module under a key; "" where it says nothing."""
    modules = msgspec.yaml.decode(TEACHING.read_bytes())["modules"]
    return {name: modules[name].get(key, "") for name in COURSE}


def modules_table() -> str:
    """What one writes in each module, for the README."""
    write = said("write")
    further = [name for name in TAUGHT if name in FURTHER and name != WARM_UP]
    parts = {"": [WARM_UP], "The six core modules": list(MODULES), "Further modules": further}
    lines = ["| module | you write |", "| --- | --- |"]
    for title, names in parts.items():
        lines += [f"| **{title}** | |"] if title else []
        lines += [f"| [{name}](docs/modules/{name}.md) | {write[name]} |" for name in names]
    return "\n".join(lines)


def kinds_of(module: str) -> list[int]:
    """How many functions a module has, and for how many of them there is a check of each kind."""
    checks = module_checks(module).checks
    found = [
        len({each.function for each in checks if each.kind == kind}) for kind in KINDS.values()
    ]
    return [len(COURSE[module]), *found]


def kinds_table() -> str:
    """Which kinds of checks each further module has, and why not others."""
    lacks = said("lacks")
    lines = [
        f"| further module | functions | {' | '.join(KINDS)} | what is not there, and why |",
        "| --- |" + " ---: |" * (1 + len(KINDS)) + " --- |",
    ]
    lines += [
        f"| {name} | {' | '.join(map(str, kinds_of(name)))} | {lacks[name]} |" for name in FURTHER
    ]
    return "\n".join(lines)


TABLES = {
    "modules": (Path("README.md"), modules_table),
    "kinds": (Path("docs", "grading.md"), kinds_table),
}
"""Marks, the files that they stand in, and what stands between them."""


def main() -> None:
    """Write all tables."""
    for mark, (file, made) in TABLES.items():
        replace_marked(PROJECT / file, mark, made())
        print(f"written to {file}")


if __name__ == "__main__":
    main()
