#!/usr/bin/env bash
# nbconvert 7.17.0: "Save as Python" makes one text of all that stands under %%time, handed to get_ipython(). The file
# is valid Python and defines none of the functions of that cell; whoever imports it gets a NameError for get_ipython.
# Seen: get_ipython().run_cell_magic('time', '', 'def f(x):\n    return x\n')
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/env"
"$folder/env/bin/python" -m pip install --quiet --disable-pip-version-check nbconvert==7.17.0 nbformat==5.10.4 ipython==9.18.1
"$folder/env/bin/python" - <<'PYTHON'
import ast

import nbconvert
import nbformat

cells = [nbformat.v4.new_code_cell("%%time\ndef f(x):\n    return x")]
notebook = nbformat.v4.new_notebook(cells=cells, metadata={"language_info": {"name": "python", "file_extension": ".py"}})
script, _ = nbconvert.PythonExporter().from_notebook_node(notebook)
print("nbconvert", nbconvert.__version__)
print(script.strip())
defined = [node.name for node in ast.walk(ast.parse(script)) if isinstance(node, ast.FunctionDef)]
assert defined == [], "the script defines the functions of a timed cell now"
assert "run_cell_magic" in script
PYTHON
