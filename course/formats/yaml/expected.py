"""In plain words, what the scene format expects at a place: `a number > 0 [world unit]`.

And what a key or a value of another shape was probably meant to be.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import Final

from msgspec import inspect

# Numbers by kind; the tuple kinds have items of one and the same type.
Number = inspect.FloatType | inspect.IntType
Sequence = inspect.TupleType | inspect.VarTupleType

EXAMPLES: Final = {
    "ConstantEnvironment": "{type: constant, radiance: 0.5}",
    "Rotation": "{axis: [0, 1, 0], degrees: 90}",
}
"""By the name of a description class: how a map is written where a number or a list comes to mind."""

_MOVED = "transform: [{translate: [0, 1, 0]}]"
_TURNED = "transform: [{rotate: {axis: [0, 1, 0], degrees: 90}}]"
_SCALED = "transform: [{scale: 2}]"
_EMITTED = ("radiance", "intensity", "irradiance")
SYNONYMS: Final[dict[str, tuple[str, ...]]] = {
    "fov": ("vertical_fov",),
    "fovy": ("vertical_fov",),
    "field_of_view": ("vertical_fov",),
    "target": ("look_at",),
    "direction": ("look_at",),
    "pos": ("eye", "position", "center", "corner", _MOVED),
    "position": ("eye", "center", "corner", _MOVED),
    "location": ("eye", "position", "center", "corner", _MOVED),
    "center": ("position", "corner", _MOVED),
    "translate": (_MOVED,),
    "translation": (_MOVED, "translate"),
    "rotate": (_TURNED,),
    "rotation": (_TURNED, "rotate"),
    "scale": (_SCALED,),
    "color": _EMITTED,
    "power": _EMITTED,
    "brightness": _EMITTED,
    "strength": _EMITTED,
    "emission": _EMITTED,
    "radiance": ("irradiance", "intensity", "emission"),
    "emissive": ("emission",),
    "intensity": ("irradiance", "radiance"),
    "type": ("shape",),
    "shape": ("type",),
    "size": ("radius", "width", "depth", "height"),
    "path": ("file",),
    "albedo": ("color",),
    "shininess": ("exponent",),
    "reflectivity": ("mirror",),
    "ior": ("refraction_index", "dielectric: {refraction_index: 1.5}"),
    "background": ("environment",),
    "resolution": ("width", "height"),
    "spp": ("samples",),
    "depth": ("max_depth",),
}
"""What other programs call a key: the keys here, each perhaps with a value to show how it is used."""

_NOUNS: Final = {inspect.FloatType: "number", inspect.IntType: "whole number"}


def describe(kind: inspect.Type, unit: str | None = None) -> str:
    """Say what a type of `msgspec.inspect` accepts, with range and unit."""
    if isinstance(kind, inspect.Metadata):
        unit = (kind.extra_json_schema or {}).get("x-unit", unit)
        kind = kind.type
    text = _a_map(kind) if isinstance(kind, inspect.StructType) else _describe(kind)
    return f"{text} [{unit}]" if unit else text


def meant_by(word: object, known: Iterable[str]) -> list[str]:
    """List those known keys that other programs call by this word, written as to be used."""
    names = set(known)
    return [use for use in SYNONYMS.get(str(word).lower(), ()) if use.partition(":")[0] in names]


def item_type(kind: Sequence, index: int) -> inspect.Type:
    """Type of one item of a list."""
    if isinstance(kind, inspect.TupleType):
        return kind.item_types[index]
    return kind.item_type


def fixed_length(kind: Sequence) -> int | None:
    """How many items a list must have; None where any number will do."""
    if isinstance(kind, inspect.TupleType):
        return len(kind.item_types)
    return kind.min_length if kind.min_length == kind.max_length else None


def bounds(kind: Number) -> str:
    """Range of a number as it follows the word number: ` > 0`, ` from 0 to 1`, or nothing."""
    if kind.ge is not None and kind.le is not None:
        return f" from {kind.ge:.12g} to {kind.le:.12g}"
    signs = ((">", kind.gt), (">=", kind.ge), ("<", kind.lt), ("<=", kind.le))
    parts = [f"{sign} {bound:.12g}" for sign, bound in signs if bound is not None]
    return f" {' and '.join(parts)}" if parts else ""


def _describe(kind: inspect.Type) -> str:
    match kind:
        case inspect.Metadata():
            return _describe(kind.type)
        case inspect.FloatType() | inspect.IntType():
            return f"a {_NOUNS[type(kind)]}{bounds(kind)}"
        case inspect.StrType():
            if kind.pattern:
                return f"a text that matches {kind.pattern}"
            return "a text that is not empty" if kind.min_length else "a text"
        case inspect.LiteralType():
            return either(sorted(map(str, kind.values)))
        case inspect.BoolType():
            return "true or false"
        case inspect.NoneType():
            return "null"
        case inspect.TupleType() | inspect.VarTupleType():
            return _describe_list(kind)
        case inspect.UnionType():
            return either(list(dict.fromkeys(map(_describe, kind.types))))
        case _:
            return "a map"


def _a_map(kind: inspect.StructType) -> str:
    keys = [field.encode_name for field in kind.fields]
    if kind.tag_field:
        keys = [kind.tag_field, *keys]
    example = EXAMPLES.get(kind.cls.__name__)
    if example:
        return f"a map with the keys {' and '.join(keys)}, such as {example}"
    return f"a map with keys such as {', '.join(keys[:3])}"


def _describe_list(kind: Sequence) -> str:
    length = fixed_length(kind)
    item = item_type(kind, 0)
    if length is not None and isinstance(item, Sequence):
        return f"{length} lists of {_describe_list(item)}"
    if length is None or not isinstance(item, inspect.FloatType | inspect.IntType):
        return "a list"
    return f"{length} {_NOUNS[type(item)]}s{bounds(item)}"


def either(words: list[str]) -> str:
    """Join alternatives: `a, b or c`."""
    return " or ".join(filter(None, [", ".join(words[:-1]), words[-1]]))
