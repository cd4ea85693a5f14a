"""The generated parts of pages, and when they are made anew.

``<!-- site: scene_keys -->``, ``<!-- site: command_line -->``, ``<!-- site: functions -->``: the references.
``<!-- site: picture NAME -->``: one scene's picture. ``<!-- site: shot NAME -->``: with its command, scene and receipt.
``<!-- site: before_after NAME -->``: a pair of pictures; the pages of modules that have such scenes get it unasked.
"""

from __future__ import annotations

import re
import shutil
from collections.abc import Iterable
from hashlib import sha256
from html import escape
from pathlib import Path
from typing import Any

from sphinx.application import Sphinx
from sphinx.environment import BuildEnvironment
from sphinx.errors import ExtensionError

from course.effects import COURSE
from course.errors import CourseError
from sitebuild import pictures
from sitebuild.command_line import command_line
from sitebuild.scene_keys import scene_keys

MARK = re.compile(r"^<!-- site: (\w+) ?([\w/]*) ?(.*?) ?-->$", re.MULTILINE)


def connect(app: Sphinx) -> None:
    """Expand the comments as pages are read, and hand the pictures over when all are written."""
    app.add_config_value("pictures", "render", "env", str)
    site = Site(app)
    app.connect("env-get-outdated", site.outdated)
    app.connect("source-read", site.expand_page)
    app.connect("build-finished", site.finish)


class Site:
    """One build.

    Parameters
    ----------
    app : Sphinx, not yet configured
    """

    def __init__(self, app: Sphinx) -> None:
        self.app = app
        self.shown: dict[str, Path] = {}

    def outdated(self, app: Sphinx, env: BuildEnvironment, *_: Iterable[str]) -> list[str]:
        """Name the pages whose generated parts are no longer what they were."""
        before: dict[str, str] = getattr(env, "site_parts", {})
        env.site_parts = {}  # type: ignore[attr-defined]
        changed = []
        for name in sorted(env.found_docs):
            source = Path(env.doc2path(name))
            text = self.expanded(name, source.read_text(encoding="utf-8"))
            env.site_parts[name] = sha256(text.encode()).hexdigest()  # type: ignore[attr-defined]
            if before.get(name) not in (None, env.site_parts[name]):  # type: ignore[attr-defined]
                changed.append(name)
        return changed

    def expand_page(self, app: Sphinx, name: str, source: list[str]) -> None:
        """Replace the comments of a page that is about to be parsed."""
        source[0] = self.expanded(name, source[0])

    def finish(self, app: Sphinx, error: Exception | None) -> None:
        """Put the pictures and their scenes beside the pages."""
        if error is not None or app.builder.name != "html":
            return
        for folder in ("_pictures", "_scenes"):
            shutil.rmtree(Path(app.outdir) / folder, ignore_errors=True)
        for target, path in self.shown.items():
            file = Path(app.outdir) / target
            file.parent.mkdir(parents=True, exist_ok=True)
            shutil.copyfile(path, file)

    def expanded(self, page: str, text: str) -> str:
        """Return a page's Markdown with its generated parts."""
        folder, _, module = page.rpartition("/")
        if folder == "modules" and pictures.scene_path(f"before/{module}").is_file():
            text = text.replace(
                "\n## The idea\n", f"\n<!-- site: before_after {module} -->\n\n## The idea\n", 1
            )
        up = "../" * page.count("/")
        return MARK.sub(lambda match: self._part(match, up), text)

    def _part(self, match: re.Match[str], up: str) -> str:
        kind, name, words = match.groups()
        match kind:
            case "scene_keys":
                return scene_keys()
            case "command_line":
                return command_line()
            case "functions":
                return functions()
            case "picture":
                return f'<p class="wide">{self._image(pictures.shot(name), up, words)}</p>\n'
            case "before_after":
                return self._before_after(name, up)
            case "shot":
                return self._shot(pictures.shot(name), up)
        raise ExtensionError(f"{match.group()}: no such part; see docs/sitebuild/parts.py")

    def _picture(self, planned: pictures.Shot) -> dict[str, Any]:
        """Have the picture made; its receipt, empty for a blank one."""
        target = f"_pictures/{planned.file}"
        self.shown[f"_scenes/{planned.name.replace('/', '-')}.yaml"] = planned.scene
        if self.app.config.pictures == "blank":
            self.shown[target] = pictures.blank(planned, Path(self.app.doctreedir) / "blank")
            return {}
        try:
            path, receipt = pictures.picture(planned)
        except CourseError as error:
            raise ExtensionError(f"scenes/{planned.name}.yaml: {error}") from error
        self.shown[target] = path
        return receipt

    def _image(self, planned: pictures.Shot, up: str, alternative: str = "") -> str:
        self._picture(planned)
        width, height = planned.size
        return (
            f'<img src="{up}_pictures/{planned.file}" alt="{escape(alternative or planned.title)}"'
            f' width="{width}" height="{height}" loading="lazy">'
        )

    def _before_after(self, module: str, up: str) -> str:
        before, after = pictures.shot(f"before/{module}"), pictures.shot(module)
        title = escape(after.title)
        return f"""<figure class="before-after">
<div class="pair">
<div class="before">{self._image(before, up, f"{after.title}: the scene without it")}<span>without</span></div>
<div class="after">{self._image(after, up, f"{after.title}: the same scene with it")}<span>with</span></div>
</div>
<figcaption>{title}: scenes/before/{module}.yaml and scenes/{module}.yaml</figcaption>
</figure>
"""

    def _shot(self, planned: pictures.Shot, up: str) -> str:
        receipt = self._picture(planned)
        scene = planned.scene.read_text(encoding="utf-8").rstrip()
        text = pictures.receipt_text(planned, receipt) if receipt else "not rendered in this build"
        file = f"{up}_scenes/{planned.name.replace('/', '-')}.yaml"
        return f"""## {planned.title}

<p class="wide">{self._image(planned, up)}</p>

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

<p><a href="{file}" download>{planned.name}.yaml</a></p>

</details>
"""


def functions() -> str:
    """Return the functions that students write, from the docstrings of their stubs, as Markdown."""
    parts = []
    for module, names in COURSE.items():
        parts += [f"## {module}", "", f"[The page of the module](../modules/{module}.md)", ""]
        parts += ["```{eval-rst}"]
        parts += [f".. autofunction:: assignments.{module}.{name}\n" for name in names]
        parts += ["```", ""]
    return "\n".join(parts)
