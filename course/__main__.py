"""`python -m course` is the command `course`."""

import os
import sys

# With -m the current folder comes first, and a submission there may be called `struct.py`.
if not sys.flags.safe_path and not __file__.startswith(f"{sys.path[0]}{os.sep}course{os.sep}"):
    del sys.path[0]

from course.cli.main import main

if __name__ == "__main__":
    main()
