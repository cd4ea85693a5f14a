"""Files that a mesh file names, such as the buffers of glTF: data in the name itself, or a file beside it."""

import base64
import binascii
from dataclasses import dataclass
from pathlib import Path
from urllib.parse import unquote, unquote_to_bytes, urlsplit

from course.base.errors import GeometryError
from course.base.inputs import InputLimit, read_input


@dataclass(frozen=True)
class Beside:
    """The folder of a mesh file, and the most bytes that a file may have."""

    folder: Path
    bound: InputLimit

    def read(self, uri: str) -> bytes:
        """Content of what a relative URI names, in the folder or below it, or that a data URI holds.

        Raises ValueError for any other, and GeometryError for a file that can't be read.
        """
        if uri[:5].lower() == "data:":
            return _data(uri)
        try:
            parts = urlsplit(uri)
        except ValueError:
            parts = None
        name = unquote(uri)
        elsewhere = parts is None or parts.scheme or parts.netloc or name.startswith(("/", "\\"))
        steps = name.replace("\\", "/").split("/")
        if elsewhere or ".." in steps or ":" in steps[0] or not name.isprintable() or not name:
            raise ValueError(f"it names {uri[:80]!r}: expected a file in its own folder")
        path = self.folder.joinpath(*steps)
        if not path.resolve().is_relative_to(self.folder.resolve()):
            raise ValueError(f"it names {uri[:80]!r}, which lies in another folder than its own")
        return read_input(path, "buffer of a mesh file", self.bound, GeometryError)


def _data(uri: str) -> bytes:
    kind, comma, content = uri[5:].partition(",")
    if not comma:
        raise ValueError("it has a data URI without a comma before its data")
    if not kind.lower().endswith(";base64"):
        return unquote_to_bytes(content)
    try:
        return base64.b64decode(unquote(content), validate=True)
    except binascii.Error:
        raise ValueError("it has a data URI that isn't base64") from None
