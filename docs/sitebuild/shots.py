"""Scenes on a page: a picture, a pair of pictures, a picture with all that belongs to it."""

from html import escape
from pathlib import Path
from typing import Any

from PIL import Image

from course.base.texts import count
from course.engine.formats.yaml.loading import load_description
from sitebuild import pictures
from sitebuild.place import Place


def picture(place: Place, name: str, words: str = "") -> str:
    """Show a scene; ``words`` are for those who don't see it. A picture that lies beside it is shown as it is."""
    planned = pictures.shot(name)
    if shown := _beside(place, planned, words):
        return f'<p class="wide large">{shown}</p>\n'
    return f'<p class="{_wide(planned.size)}">{image(place, planned, words)[0]}</p>\n'


def _beside(place: Place, planned: pictures.Shot, words: str) -> str:
    """The picture that lies beside a scene, rendered as its file says; nothing where none does."""
    beside = planned.scene.with_suffix(".webp")
    if not beside.is_file():
        return ""
    with Image.open(beside) as kept:
        return tag(place.address(f"_pictures/{planned.file}", beside), words, kept.size)


def before_after(place: Place, name: str, words: str = "") -> str:  # noqa: ARG001
    """Show a module's scene without the effect and with it."""
    before, after = pictures.shot(f"before/{name}"), pictures.shot(name)
    left, _ = image(place, before, f"{after.title}: the scene without it")
    right, _ = image(place, after, f"{after.title}: the same scene with it")
    caption = f"{escape(after.title)}: scenes/before/{name}.yaml and scenes/{name}.yaml"
    return slider((left, "without"), (right, "with"), caption, large=fills(after.size))


def slider(
    before: tuple[str, str],
    after: tuple[str, str],
    caption: str,
    below: str = "",
    large: bool = False,
) -> str:
    """Two pictures with a border that moves.

    Parameters
    ----------
    before, after : the picture, as HTML, and the word on it
    caption, below : HTML; what is below stands between pictures and caption
    """
    (left, one), (right, other) = before, after
    kind = "before-after large" if large else "before-after"
    return f"""<figure class="{kind}">
<div class="pair">
<div class="before">{left}<span>{one}</span></div>
<div class="after">{right}<span>{other}</span></div>
</div>
{below}<figcaption>{caption}</figcaption>
</figure>
"""


def shot(place: Place, name: str, words: str = "") -> str:  # noqa: ARG001
    """Show a scene under its title, with its command, its receipt and its file."""
    planned = pictures.shot(name)
    file = place.address(f"_scenes/{name.replace('/', '-')}.yaml", planned.scene)
    if shown := _beside(place, planned, planned.title):
        samples = load_description(planned.scene).description.sampler.samples
        command = f"course render scenes/{name}.yaml"
        said = f"{count(samples, 'sample')} a pixel, as the scene file says"
        return laid_out(planned.title, shown, command, "", planned.scene, file, said, "wide large")
    shown, receipt = image(place, planned)
    text = pictures.receipt_text(planned, receipt) if receipt else "not rendered in this build"
    cost = ""
    if receipt:
        threads, seconds = receipt["threads"], receipt["wall_seconds"]
        each = f"{count(receipt['samples'], 'sample')} a pixel"
        cost = f"{each}, {seconds:.0f} s on {count(threads, 'thread')}"
    return laid_out(
        planned.title, shown, planned.command, text, planned.scene, file, cost, _wide(planned.size)
    )


def laid_out(
    title: str,
    image: str,
    command: str,
    receipt: str,
    scene: Path,
    file: str,
    cost: str = "",
    wide: str = "wide",
) -> str:
    """Lay out a scene with all that belongs to it.

    Parameters
    ----------
    image : HTML
    receipt : what the command prints; empty where nobody has kept it
    file : address of the scene on the site
    cost : what stands below the picture
    wide : classes of what it stands in
    """
    kind = scene.suffix.removeprefix(".")
    folded = ""
    if receipt:
        folded = f"<details><summary>Receipt</summary>\n\n```text\n{receipt}\n```\n\n</details>\n"
    return f"""## {title}

<p class="{wide}">{image}</p>

{cost}

    {command}

{folded}<details><summary>Scene</summary>

```{kind}
{scene.read_text(encoding="utf-8").rstrip()}
```

<p><a href="{file}" download>{scene.name}</a></p>

</details>
"""


def image(
    place: Place, planned: pictures.Shot, alternative: str = ""
) -> tuple[str, dict[str, Any]]:
    """Have the picture made; return it as HTML, and its receipt, which is empty for a blank one."""
    receipt: dict[str, Any] = {}
    if place.blank:
        file = pictures.blank(planned, place.made)
    else:
        file, receipt = pictures.picture(planned)
    address = place.address(f"_pictures/{planned.file}", file)
    return tag(address, alternative or planned.title, planned.size), receipt


def fills(size: tuple[int, int]) -> bool:
    """Whether a picture is shown as wide as its column: it has the pixels, and would not be higher than a screen."""
    return size[0] > pictures.SMALL and size[0] >= 1.2 * size[1]


def _wide(size: tuple[int, int]) -> str:
    return "wide large" if fills(size) else "wide"


def tag(address: str, alternative: str, size: tuple[int, int]) -> str:
    """A picture of a size [pixels] as HTML."""
    return (
        f'<img src="{address}" alt="{escape(alternative)}"'
        f' width="{size[0]}" height="{size[1]}" loading="lazy">'
    )
