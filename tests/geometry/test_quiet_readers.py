"""What a library notes in its log about a mesh file doesn't get to the terminal."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).parents[2]
PROGRAM = """
import sys
from pathlib import Path
from course.formats.meshes.files import read_mesh
print(len(read_mesh(Path(sys.argv[1])).triangles))
"""


def test_normals_of_an_stl_file_that_are_no_numbers_print_no_traceback(tmp_path: Path) -> None:
    path = tmp_path / "a.stl"
    path.write_text(
        "solid a\nfacet normal 1 x 0\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n"
        "endloop\nendfacet\nendsolid a\n"
    )
    # In a process of its own, for here pytest listens to the log.
    done = subprocess.run(
        [sys.executable, "-c", PROGRAM, str(path)],
        cwd=ROOT,
        capture_output=True,
        text=True,
        check=False,
    )
    assert (done.returncode, done.stdout, done.stderr) == (0, "1\n", "")
