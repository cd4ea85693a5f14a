"""A notebook as a page: its cells, what they print and the pictures they show, run by the build and kept."""

import base64
import json
from collections.abc import Iterator
from hashlib import sha256
from html import escape
from io import BytesIO
from pathlib import Path
from typing import Any

import click
from PIL import Image

from course.base.atomic import replacing
from course.benchmarking.references import engine_hash
from course.engine.functions.effects import PROJECT, Effects
from sitebuild import webp
from sitebuild.place import Place

Node = dict[str, Any]

NOTEBOOKS = PROJECT / "docs" / "notebooks"
KEPT = PROJECT / "out" / "docs" / "notebooks"

SCENES = PROJECT / "scenes"

SECONDS = 300
"""At most, for one cell."""

BLANK = (300, 200)
"""Pixels of a picture that stands in."""


def notebook(place: Place, name: str, words: str = "") -> str:  # noqa: ARG001
    """Show a notebook; its first heading is left to the page."""
    source = NOTEBOOKS / f"{name}.ipynb"
    if place.blank:
        shown = source
    else:
        shown = executed(source)
        place.kept.add(shown)
    file = place.address(f"_notebooks/{name}.ipynb", source)
    cells: list[Node] = json.loads(shown.read_text(encoding="utf-8"))["cells"]
    parts = [f'<p><a href="{file}" download>{name}.ipynb</a></p>\n']
    for number, cell in enumerate(cells):
        text = "".join(cell["source"])
        if cell["cell_type"] == "markdown":
            parts.append(text.partition("\n")[2] if number == 0 else text)
        else:
            parts.append(f"```python\n{text}\n```\n")
            outputs = _stand_in(cell) if place.blank else cell["outputs"]
            parts += _shown(place, f"{name}-{number}", cell, outputs)
    return "\n\n".join(parts) + "\n"


def executed(source: Path, kept: Path = KEPT) -> Path:
    """Run a notebook, unless it is kept as it was run; return the file that has the outputs.

    Raises
    ------
    nbclient.exceptions.CellExecutionError
        A cell has raised an error.
    """
    path = kept / f"{source.stem}-{_key(source)}.ipynb"
    if not path.is_file():
        import nbformat
        from nbclient import NotebookClient

        click.echo(f"running docs/notebooks/{source.name}", err=True)
        kept.mkdir(parents=True, exist_ok=True)
        run = nbformat.read(source, as_version=4)
        NotebookClient(
            run, timeout=SECONDS, resources={"metadata": {"path": str(PROJECT)}}
        ).execute()
        with replacing(path) as temporary:
            nbformat.write(run, temporary)
    return path


def _key(source: Path) -> str:
    """Hash of the cells, of the engine that runs them, and of the scenes that they name."""
    text = source.read_text(encoding="utf-8")
    hashed = sha256(text.encode() + engine_hash(Effects().folder.resolve()).encode())
    for scene in sorted(SCENES.glob("*.yaml")):
        if scene.name in text:
            hashed.update(scene.read_bytes())
    return hashed.hexdigest()[:16]


def _stand_in(cell: Node) -> list[Node]:
    """Outputs of a cell that wasn't run: grey for a picture, a line for what it prints."""
    outputs: list[Node] = []
    if "alt" in cell["metadata"]:
        grey = BytesIO()
        Image.new("RGB", BLANK, webp.GREY).save(grey, "PNG")
        png = base64.b64encode(grey.getvalue()).decode()
        outputs.append({"output_type": "display_data", "data": {"image/png": png}})
    if "print(" in "".join(cell["source"]):
        outputs.append({"output_type": "stream", "text": ["not run in this build"]})
    return outputs


def _shown(place: Place, name: str, cell: Node, outputs: list[Node]) -> Iterator[str]:
    """What a cell has printed and shown."""
    pictures = 0
    for output in outputs:
        if output["output_type"] == "stream":
            yield f"```text\n{''.join(output['text']).rstrip()}\n```\n"
        elif "image/png" in output["data"]:
            pictures += 1
            png = base64.b64decode("".join(output["data"]["image/png"]))
            file = place.made / f"{name}-{pictures}.png"
            file.parent.mkdir(parents=True, exist_ok=True)
            file.write_bytes(png)
            address = place.address(f"_notebooks/{file.name}", file)
            width, height = Image.open(BytesIO(png)).size
            yield (
                f'<p class="wide"><img src="{address}" alt="{escape(cell["metadata"]["alt"])}"'
                f' width="{width}" height="{height}" loading="lazy"></p>\n'
            )
        elif text := "".join(output["data"].get("text/plain", "")):
            # A bar that is done is empty.
            yield f"```text\n{text}\n```\n"
