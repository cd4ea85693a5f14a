"""The signature under a function's heading, linked to its reference."""

import re
from html import escape

HEADED = re.compile(r"^(## (\w+)\n\n)`(\2\([^`]*\))`", re.MULTILINE)


def linked(module: str, text: str) -> str:
    """Return a module's page, from ``docs/modules``, with its signatures as links."""

    def link(match: re.Match[str]) -> str:
        heading, name, signature = match.groups()
        address = f"../reference/functions.html#assignments.{module}.{name}"
        code = f'<code class="docutils literal">{escape(signature)}</code>'
        return f'{heading}<a class="reference internal" href="{address}">{code}</a>'

    return HEADED.sub(link, text)
