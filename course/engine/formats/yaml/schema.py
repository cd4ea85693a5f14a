"""The scene format as a JSON schema, for editors that complete and check scene files.

An editor with a YAML language server uses it where a scene file says, in its first line,
`# yaml-language-server: $schema=scene.schema.json`.
"""

from typing import Any, Final

import msgspec

from course.engine.formats.yaml.description import STEP, SceneDescription

_ONE_EMISSION: Final = {
    "oneOf": [
        {
            "required": [given],
            "properties": {given: {"not": {"type": "null"}}, other: {"type": "null"}},
        }
        for given, other in (("intensity", "radiance"), ("radiance", "intensity"))
    ]
}


def json_schema() -> dict[str, Any]:
    """Make the JSON schema of the scene format.

    Returns JSON Schema 2020-12 with descriptions, ranges, defaults and, under `x-unit`, units. What takes more
    than one key to see, such as the name of a material, only loading checks.
    """
    generated = msgspec.json.schema(SceneDescription)
    definitions = {name: _tidy(each) for name, each in generated["$defs"].items()}
    for name in ("RectangleLight", "SphereLight"):
        definitions[name] |= _ONE_EMISSION
    return {
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "$id": "urn:penumbra:scene",
        "title": "Penumbra scene",
        "description": "A scene for the Penumbra ray tracer.",
        "$ref": generated["$ref"],
        "$defs": definitions,
    }


def _tidy(node: Any) -> Any:
    """Leave out what is not JSON Schema or stands in no file: discriminators and the step's tag."""
    if isinstance(node, list):
        return [_tidy(item) for item in node if item != STEP]
    if isinstance(node, dict):
        return {
            key: _tidy(item) for key, item in node.items() if key not in {STEP, "discriminator"}
        }
    return node
