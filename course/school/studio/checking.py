"""The program that checks functions for the studio: ``python -m course.school.studio.checking FOLDER MODULE...``.

A process of its own, so that checks can be ended when a file is saved again. It prints a line of JSON before and after
each module.
"""

import json
import sys
from pathlib import Path

from course.base.errors import CourseError
from course.school.grading.progress import as_data, progress


def main() -> None:
    """Check the modules that are named."""
    folder, *modules = sys.argv[1:]

    def say(**told: object) -> None:
        sys.stdout.write(json.dumps(told) + "\n")
        sys.stdout.flush()

    for module in modules:
        try:
            for functions in progress(Path(folder), (module,), lambda name: say(checking=name)):
                say(module=module, functions=as_data(functions))
        except CourseError as error:
            say(module=module, trouble=str(error))


if __name__ == "__main__":
    main()
