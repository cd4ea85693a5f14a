"""Scenes on a page: a picture, a pair of pictures, a picture with all that belongs to it."""

from __future__ import annotations

from html import escape
from typing import Any

from sitebuild import pictures
from sitebuild.place import Place


def picture(place: Place, name: str, words: str = "") -> str:
    """Show a scene; ``words`` are for those who don't see it."""
    image, _ = _image(place, pictures.shot(name), words)
    return f'<p class="wide">{image}</p>\n'


def before_after(place: Place, name: str, words: str = "") -> str:  # noqa: ARG001
    """Show a module's scene without the effect and with it."""
    before, after = pictures.shot(f"before/{name}"), pictures.shot(name)
    left, _ = _image(place, before, f"{after.title}: the scene without it")
    right, _ = _image(place, after, f"{after.title}: the same scene with it")
    return f"""<figure class="before-after">
<div class="pair">
<div class="before">{left}<span>without</span></div>
<div class="after">{right}<span>with</span></div>
</div>
<figcaption>{escape(after.title)}: scenes/before/{name}.yaml and scenes/{name}.yaml</figcaption>
</figure>
"""


def shot(place: Place, name: str, words: str = "") -> str:  # noqa: ARG001
    """Show a scene under its title, with its command, its receipt and its file."""
    planned = pictures.shot(name)
    image, receipt = _image(place, planned)
    text = pictures.receipt_text(planned, receipt) if receipt else "not rendered in this build"
    scene = planned.scene.read_text(encoding="utf-8").rstrip()
    file = place.address(f"_scenes/{name.replace('/', '-')}.yaml", planned.scene)
    return f"""## {planned.title}

<p class="wide">{image}</p>

    {planned.command}

<details><summary>Receipt</summary>

```text
{text}
```

</details>
<details><summary>Scene</summary>

```yaml
{scene}
```

<p><a href="{file}" download>{name}.yaml</a></p>

</details>
"""


def _image(
    place: Place, planned: pictures.Shot, alternative: str = ""
) -> tuple[str, dict[str, Any]]:
    """Have the picture made; return it as HTML, and its receipt, which is empty for a blank one."""
    receipt: dict[str, Any] = {}
    if place.blank:
        file = pictures.blank(planned, place.made)
    else:
        file, receipt = pictures.picture(planned)
    address = place.address(f"_pictures/{planned.file}", file)
    width, height = planned.size
    return (
        f'<img src="{address}" alt="{escape(alternative or planned.title)}"'
        f' width="{width}" height="{height}" loading="lazy">'
    ), receipt
