"""A document as one of the description classes; or which value of the file breaks the format, and how.

msgspec alone decides whether a file is right, by the types of the description classes. Its message tells the place of
the first mistake, though not the keys of maps such as `materials`, nor the value and its unit. So this module follows
that place through the document and the types, and words the mistake by the type that it comes to, in plain words such
as `a number > 0 [world unit]`, and by what a key or a value of another shape was probably meant to be.
"""

import re
from typing import Any, Final, TypeVar

import msgspec
from msgspec import inspect

from course.base.errors import SceneError
from course.engine.formats.yaml.description import STEP
from course.engine.formats.yaml.document import Document, Key, KeyPath
from course.engine.formats.yaml.suggestions import meant_by, suggest

# Numbers by kind; the tuple kinds have items of one and the same type.
Number = inspect.FloatType | inspect.IntType
Sequence = inspect.TupleType | inspect.VarTupleType

EXAMPLES: Final = {
    "ConstantEnvironment": "{type: constant, radiance: 0.5}",
    "Rotation": "{axis: [0, 1, 0], degrees: 90}",
}
"""By the name of a description class: how a map is written where a number or a list comes to mind."""

_NOUNS: Final = {inspect.FloatType: "number", inspect.IntType: "whole number"}


def describe(kind: inspect.Type, unit: str | None = None) -> str:
    """Say what a type of `msgspec.inspect` accepts, with range and unit."""
    if isinstance(kind, inspect.Metadata):
        unit = (kind.extra_json_schema or {}).get("x-unit", unit)
        kind = kind.type
    text = _a_map(kind) if isinstance(kind, inspect.StructType) else _describe(kind)
    return f"{text} [{unit}]" if unit else text


def item_type(kind: Sequence, index: int) -> inspect.Type:
    """Type of one item of a list."""
    if isinstance(kind, inspect.TupleType):
        return kind.item_types[index]
    return kind.item_type


def fixed_length(kind: Sequence) -> int | None:
    """The number of items that a list must have; None where any number will do."""
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


Described = TypeVar("Described")

_PLACE: Final = re.compile(r" - at `\$([^`]*)`$")
_KEY: Final = re.compile(r"\.([^.\[]+)|\[([^]]+)\]")
"""A field of a class; or the number of an item, and "..." for any key of a map."""


def convert(document: Document, kind: type[Described]) -> Described:
    """Make what a document describes.

    Raises SceneError for the first value that breaks the format.
    ``kind``: the description class of the whole file.
    """
    try:
        return msgspec.convert(_with_steps(document.data), kind)
    except msgspec.ValidationError as error:
        place = _PLACE.search(str(error))
        keys = _KEY.findall(place[1]) if place else []
        raise _mistake(document, inspect.type_info(kind), keys) from None


def _with_steps(data: dict[str, Any]) -> dict[str, Any]:
    """Add the tags of transform steps, which stand in no file: a step is told by its only key."""
    objects = data.get("objects")
    if not isinstance(objects, list):
        return data
    return {**data, "objects": [_with_tagged_steps(thing) for thing in objects]}


def _with_tagged_steps(thing: Any) -> Any:
    if not (isinstance(thing, dict) and isinstance(thing.get("transform"), list)):
        return thing
    steps = [
        {**step, STEP: next(iter(step)) if len(step) == 1 else ""}
        if isinstance(step, dict)
        else step
        for step in thing["transform"]
    ]
    return {**thing, "transform": steps}


def _mistake(document: Document, kind: inspect.Type, keys: list[tuple[str, str]]) -> SceneError:
    """Word the mistake at msgspec's place; keys that are unknown come first, on the way there too."""
    path: KeyPath = ()
    value: Any = document.data
    unit: str | None = None
    annotation: Any = None
    key: Key
    for name, item in [*keys, ("", "")]:
        kind, unit = _meant(kind, value, unit)
        mistake = _wrong_key(document, kind, path, value)
        if mistake:
            return mistake
        match kind:
            case inspect.StructType() if name:
                fields = {
                    field.encode_name: field.type for field in msgspec.structs.fields(kind.cls)
                }
                key, annotation, unit = name, fields[name], None
                kind = inspect.type_info(annotation)
            case inspect.DictType() if item:
                key = next(each for each in value if not _fits({each: value[each]}, annotation))
                kind = kind.value_type
            case inspect.TupleType() | inspect.VarTupleType() if item:
                kind = item_type(kind, int(item))
                key = int(item)
            case _:
                break
        path, value = (*path, key), value[key]
    if isinstance(kind, inspect.LiteralType):
        return _choice(document, path, value, sorted(map(str, kind.values)))
    return document.unexpected(path, describe(kind, unit))


def _meant(kind: inspect.Type, value: Any, unit: str | None) -> tuple[inspect.Type, str | None]:
    """The type without its description, its unit, and of several types the one that a map or a list has the form of."""
    if isinstance(kind, inspect.Metadata):
        unit = (kind.extra_json_schema or {}).get("x-unit", unit)
        kind = kind.type
    for each in kind.types if isinstance(kind, inspect.UnionType) else ():
        match each:
            case inspect.StructType() if isinstance(value, dict):
                if (
                    list(value) == [each.tag]
                    if each.tag_field == STEP
                    else value.get(each.tag_field) == each.tag
                ):
                    return each, unit
            case inspect.TupleType() | inspect.VarTupleType() if isinstance(value, list):
                if fixed_length(each) in (None, len(value)):
                    return each, unit
    return kind, unit


def _fits(value: Any, annotation: Any) -> bool:
    try:
        msgspec.convert(value, annotation)
    except msgspec.ValidationError:
        return False
    return True


def _wrong_key(
    document: Document, kind: inspect.Type, path: KeyPath, value: Any
) -> SceneError | None:
    """What is wrong with a value that is to be a map, or with its keys, apart from what they hold."""
    match kind:
        case inspect.DictType() if not isinstance(value, dict):
            return document.unexpected(path, "a map from names")
        case inspect.UnionType(types=(inspect.StructType(), *_)):
            structs = [each for each in kind.types if isinstance(each, inspect.StructType)]
            if structs[0].tag_field == STEP:
                return _wrong_step(document, [str(each.tag) for each in structs], path, value)
            return _wrong_tag(document, structs, path, value) if structs[0].tag_field else None
        case inspect.StructType():
            if not isinstance(value, dict):
                return document.unexpected(path, describe(kind))
            fields = {field.encode_name: field for field in kind.fields}
            known = (
                [kind.tag_field, *fields] if kind.tag_field not in (None, STEP) else list(fields)
            )
            for key in value:
                if key not in known:
                    return _unknown(document, (*path, key), known)
            for name, field in fields.items():
                if field.required and name not in value:
                    return document.error(
                        path, f"{name} is missing: expected {describe(field.type)}"
                    )
    return None


def _wrong_step(document: Document, known: list[str], path: KeyPath, value: Any) -> SceneError:
    if not isinstance(value, dict):
        return document.unexpected(path, f"a map with one key, {either(known)}")
    for key in value:
        if key not in known:
            return _unknown(document, (*path, key), known)
    return document.error(
        path,
        f"a step with {len(value)} keys: expected one, {either(known)}; each step is an item of its own",
    )


def _wrong_tag(
    document: Document, structs: list[inspect.StructType], path: KeyPath, value: Any
) -> SceneError:
    tag = str(structs[0].tag_field)
    names = [str(each.tag) for each in structs]
    if not isinstance(value, dict):
        example = EXAMPLES.get(structs[0].cls.__name__, f"{{{tag}: {names[0]}, ...}}")
        return document.unexpected(path, f"a map with {tag}, such as {example}")
    if tag in value:
        return _choice(document, (*path, tag), value[tag], names)
    for key in value:
        if meant_by(key, [tag]):
            return _unknown(document, (*path, key), [tag])
    return document.error(path, f"{tag} is missing: expected {either(names)}")


def _choice(document: Document, path: KeyPath, value: Any, names: list[str]) -> SceneError:
    hint = suggest(value, names) if isinstance(value, str) else ""
    hint = f"; {hint}" if hint.startswith("did") else ""
    return document.unexpected(path, either(names) + hint)


def _unknown(document: Document, path: KeyPath, known: list[str]) -> SceneError:
    meant = meant_by(path[-1], known)
    hint = f"did you mean {either(meant)}?" if meant else suggest(path[-1], known)
    return document.error(path, f"unknown key; {hint}")
