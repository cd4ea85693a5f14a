"""The program that checks functions for the studio: ``python -m course.school.studio.checking FOLDER``.

A process of its own, so that checks can be ended when a file is saved again. It waits with everything imported for a
line of JSON on its standard input, {"modules": names, "first": functions}. Before and after each module it prints a
line of JSON, and one in between where the module's functions among ``first`` are known before the others.
"""

import json
import sys
from pathlib import Path

from course.base.errors import CourseError
from course.school.grading.catalog import module_checks
from course.school.grading.progress import as_data, progress, some_of


def main() -> None:
    """Check the modules that are asked for."""
    folder = Path(sys.argv[1])
    # What a check is made of is imported with it.
    module_checks("sampling")
    asked = sys.stdin.readline()
    if not asked:
        return
    wanted = json.loads(asked)

    def say(**told: object) -> None:
        sys.stdout.write(json.dumps(told) + "\n")
        sys.stdout.flush()

    first = [name.partition(".") for name in wanted["first"]]
    for module in wanted["modules"]:
        try:
            names = [name for each, _, name in first if each == module]
            if some := some_of(folder, module, names):
                say(module=module, functions=as_data(some), part=True)
            for functions in progress(folder, (module,), lambda name: say(checking=name)):
                say(module=module, functions=as_data(functions))
        except CourseError as error:
            say(module=module, trouble=str(error))


if __name__ == "__main__":
    main()
