#!/usr/bin/env bash
# nbformat 5.10.4: the list of lines that it writes for a cell is divided by str.splitlines, so also at U+2028, form
# feeds and others that end no line of Python. Who joins the list with nothing gets the cell; who takes its items for
# lines, or counts them, has a comment's second half for code.
# Seen: ['# pasted\u2028', 'from a page\n', 'x = 1'], 3 items where Python sees 2 lines.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/env"
"$folder/env/bin/python" -m pip install --quiet --disable-pip-version-check nbformat==5.10.4
"$folder/env/bin/python" - <<'PYTHON'
import ast
import json

import nbformat

cell = "# pasted\u2028from a page\nx = 1"
notebook = nbformat.v4.new_notebook(cells=[nbformat.v4.new_code_cell(cell)])
(written,) = json.loads(nbformat.writes(notebook))["cells"]
print("nbformat", nbformat.__version__)
print(written["source"])
assert ast.parse(cell).body[0].lineno == 2
assert "".join(written["source"]) == cell
assert len(written["source"]) == 3, "lines of a cell are those of Python now"
PYTHON
