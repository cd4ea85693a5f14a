"""The reference of scene files, from their JSON schema: each key with its unit, range, default and pictures."""

import json
from collections.abc import Iterator
from typing import Any

from course.engine.formats.yaml.schema import json_schema
from sitebuild.key_headings import heading, link
from sitebuild.key_pictures import key_pictures
from sitebuild.place import Place

Node = dict[str, Any]

KINDS = {
    "string": "text",
    "number": "number",
    "integer": "integer",
    "boolean": "true or false",
    "null": "null",
    "object": "map",
    "array": "list",
}


def scene_keys(place: Place, name: str = "", words: str = "") -> str:  # noqa: ARG001
    """Return the reference as Markdown: a heading for each map that a scene file may hold, and under it its keys."""
    schema = json_schema()
    return "\n".join(
        line for name in _in_order(schema) for line in _section(place, name, schema["$defs"][name])
    )


def _in_order(schema: Node) -> list[str]:
    """Definitions as they are met from the scene downwards."""
    found: list[str] = []
    waiting = [schema["$ref"]]
    while waiting:
        name = waiting.pop(0).rpartition("/")[2]
        if name not in found:
            found.append(name)
            waiting = [*_references(schema["$defs"][name]), *waiting]
    return found


def _references(node: Any) -> Iterator[str]:
    if isinstance(node, dict):
        if "$ref" in node:
            yield node["$ref"]
        for child in node.values():
            yield from _references(child)
    elif isinstance(node, list):
        for child in node:
            yield from _references(child)


def _section(place: Place, name: str, node: Node) -> list[str]:
    lines = [f"## {heading(name)}", "", node.get("description", ""), ""]
    keys = node.get("properties", {})
    if not keys:
        return [*lines, f"It is {_kind(node)}.", ""]
    required = node.get("required", [])
    for key, value in keys.items():
        facts = [_kind(value), value.get("x-unit", ""), _range(value)]
        facts.append("needed" if key in required else _default(value))
        lines += [
            f"`{key}`: " + "; ".join(fact for fact in facts if fact),
            f": {value.get('description', 'Says which of them it is.')}",
            "",
        ]
        shown = key_pictures(place, name, key)
        if shown:
            lines += [f"  {shown}", ""]
    return lines


def _kind(node: Node) -> str:
    """What may stand there, in words; maps of the format are links to their headings."""
    if "$ref" in node:
        return link(node["$ref"].rpartition("/")[2])
    if "const" in node or "enum" in node:
        values = node.get("enum", [node.get("const")])
        return " or ".join(f"`{value}`" if value is not None else "null" for value in values)
    if "anyOf" in node:
        return " or ".join(dict.fromkeys(_kind(each) for each in node["anyOf"]))
    kind = node.get("type")
    if kind == "array":
        return _list(node)
    if kind == "object":
        values = node.get("additionalProperties")
        if isinstance(values, dict):
            return f"map from names to {_kind(values)}"
        keys = ", ".join(f"`{key}`" for key in node.get("properties", {}))
        return f"map of {keys}" if keys else "map"
    return KINDS.get(str(kind), "any")


def _list(node: Node) -> str:
    each = node.get("items")
    least, most = node.get("minItems"), node.get("maxItems")
    inner = each if isinstance(each, dict) else (node.get("prefixItems") or [{}])[0]
    if least is not None and least == most:
        return f"{least} × {_kind(inner)}"
    return f"list of {_kind(inner)}"


BOUNDS = (("exclusiveMinimum", ">"), ("minimum", "≥"), ("exclusiveMaximum", "<"), ("maximum", "≤"))


def _range(node: Node) -> str:
    """All bounds of a value, those of its alternatives and members included, each once."""
    found = dict.fromkeys(_bounds(node))
    return ", ".join(found)


def _bounds(node: Any) -> Iterator[str]:
    if not isinstance(node, dict):
        return
    here = [f"{sign} {node[name]:.10g}" for name, sign in BOUNDS if name in node]
    if here:
        yield " and ".join(here)
    if "minLength" in node:
        yield f"at least {node['minLength']} character"
    if "pattern" in node:
        yield f"`{node['pattern']}`"
    for each in [*node.get("anyOf", []), *node.get("prefixItems", []), node.get("items")]:
        yield from _bounds(each)


def _default(node: Node) -> str:
    if "default" not in node:
        return ""
    value = node["default"]
    if isinstance(value, dict) and value:
        return "default as there"
    return f"default `{json.dumps(value, ensure_ascii=False)}`"
