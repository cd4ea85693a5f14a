"""`python -m course` is the command `course`."""

from __future__ import annotations

from course.cli.main import main

if __name__ == "__main__":
    main()
