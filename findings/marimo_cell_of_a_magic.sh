#!/usr/bin/env bash
# marimo 0.25.2: `marimo convert` keeps the code of a notebook's cell under %%time, but turns one under %%capture into a
# comment as a whole. A function that is defined in it is gone from the program, and the exit code is 0. Seen: of two
# functions, each in a cell with one of these magics, the first is an `@app.function`, the second four lines of comment.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
python3 -m venv venv
venv/bin/pip install --quiet --disable-pip-version-check nbformat==5.10.4 marimo==0.25.2
venv/bin/python - <<'PYTHON'
import ast
import subprocess

import nbformat

timed = "%%time\ndef timed(x):\n    return x"
quiet = "%%capture\ndef quiet(x):\n    return 2 * x"
cells = [nbformat.v4.new_code_cell(text) for text in (timed, quiet)]
nbformat.write(nbformat.v4.new_notebook(cells=cells), "notebook.ipynb")
command = ["venv/bin/marimo", "convert", "notebook.ipynb", "-o", "program.py"]
code = subprocess.run(command, check=False, capture_output=True).returncode
with open("program.py") as file:
    text = file.read()
names = {node.name for node in ast.walk(ast.parse(text)) if isinstance(node, ast.FunctionDef)}
print(text)
assert code == 0
assert "timed" in names
assert "quiet" not in names, "the function is kept now"
assert "# def quiet(x):" in text
PYTHON
