"""`<!-- site: walk bounding_volumes -->`: steps of a ray through a hierarchy, under a slider (_static/series.js)."""

import json
from html import escape

from sitebuild.diagrams.bounding_volumes import hierarchy
from sitebuild.diagrams.figure import drawing
from sitebuild.diagrams.walk import panels, walk
from sitebuild.place import Place


def walk_steps(place: Place, name: str, words: str = "") -> str:  # noqa: ARG001
    """Show all steps side by side, or with the script one at a time; ``words`` are the caption."""
    tree = hierarchy()
    steps = walk(tree)
    frames = []
    for k, step in enumerate(steps):
        drawn = "".join(
            drawing(each, f"walk-{k}-{side}")
            for each, side in zip(
                panels(tree, step, k, len(steps) - 1), ("boxes", "tree"), strict=True
            )
        )
        counted = f"Tested: boxes {len(step.asked)}, triangles {len(step.triangles)}."
        frames.append(
            f'<div class="frame{" first" if k == 0 else ""}"><div class="panels wide of-2">{drawn}</div>'
            f"<p>{escape(step.words)} <b>{counted}</b></p></div>"
        )
    shown = [f"{k} of {len(steps) - 1}" for k in range(len(steps))]
    sliders = escape(json.dumps([{"name": "step", "start": 0, "words": shown}]))
    rows = "\n".join(frames)
    return f"""<figure class="diagram series" id="walk-{name}" data-sliders="{sliders}" \
style="--shown: 740px; --columns: 2">
<div class="frames">
{rows}
</div>
<figcaption>{escape(words)}</figcaption>
</figure>
"""
