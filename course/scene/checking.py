"""Which value of a scene file breaks the format, and how.

msgspec says yes or no. Where it says no, its message leaves out the keys of maps such as
`materials`, the value and the unit, so this module walks the document along the description classes
to find the same mistake and to word it.
"""

from __future__ import annotations

import re
from typing import Any

from msgspec import inspect

from course.errors import SceneError
from course.scene.description.scene import SceneDescription
from course.scene.description.transforms import STEP
from course.scene.document import Document, KeyPath, suggest
from course.scene.expected import (
    EXAMPLES,
    Number,
    Sequence,
    describe,
    either,
    fixed_length,
    item_type,
    meant_by,
)


def find_mistake(document: Document, kind: type = SceneDescription) -> SceneError | None:
    """Find the first value that breaks the format, in the order of the description classes.

    Parameters
    ----------
    kind : type
        The description class of the whole file.

    Returns
    -------
    SceneError or None
        The error to raise; None where every value is of the right type and within its range.
    """
    return _Walk(document).check(inspect.type_info(kind), (), document.data)


class _Walk:
    """One method for each kind of type; each returns the first mistake below a key path."""

    def __init__(self, document: Document) -> None:
        self._document = document

    def check(
        self, kind: inspect.Type, path: KeyPath, value: Any, unit: str | None = None
    ) -> SceneError | None:
        match kind:
            case inspect.Metadata():
                extra = kind.extra_json_schema or {}
                return self.check(kind.type, path, value, extra.get("x-unit", unit))
            case inspect.StructType():
                return self._struct(kind, path, value)
            case inspect.UnionType():
                return self._union(kind, path, value, unit)
            case inspect.DictType():
                return self._dict(kind, path, value)
            case inspect.TupleType() | inspect.VarTupleType():
                return self._list(kind, path, value, unit)
            case inspect.LiteralType():
                return self._literal(kind, path, value)
        if _accepts(kind, value):
            return None
        return self._document.unexpected(path, describe(kind, unit))

    def _struct(self, kind: inspect.StructType, path: KeyPath, value: Any) -> SceneError | None:
        if not isinstance(value, dict):
            return self._document.unexpected(path, _a_map(kind))
        fields = {field.encode_name: field for field in kind.fields}
        tag = kind.tag_field if kind.tag_field != STEP else None
        known = [tag, *fields] if tag else list(fields)
        for key in value:
            if key not in known:
                return self._unknown((*path, key), known)
        if tag and value.get(tag) != kind.tag:
            return self._tag([kind], path, value)
        for name, field in fields.items():
            if name in value:
                mistake = self.check(field.type, (*path, name), value[name])
                if mistake:
                    return mistake
            elif field.required:
                return self._document.error(
                    path, f"{name} is missing: expected {_described(field.type)}"
                )
        return None

    def _union(
        self, kind: inspect.UnionType, path: KeyPath, value: Any, unit: str | None
    ) -> SceneError | None:
        structs = [each for each in kind.types if isinstance(each, inspect.StructType)]
        if structs and structs[0].tag_field == STEP:
            return self._step(structs, path, value)
        if structs and structs[0].tag_field:
            return self._tagged(structs, path, value)
        for each in kind.types:
            if _accepts(each, value):
                return None
            if _same_shape(each, value):
                return self.check(each, path, value, unit)
        return self._document.unexpected(path, describe(kind, unit))

    def _step(
        self, structs: list[inspect.StructType], path: KeyPath, value: Any
    ) -> SceneError | None:
        by_key = {str(each.tag): each for each in structs}
        if not isinstance(value, dict):
            return self._document.unexpected(path, f"a map with one key, {either(list(by_key))}")
        for key in value:
            if key not in by_key:
                return self._unknown((*path, key), list(by_key))
        if len(value) != 1:
            return self._document.error(
                path,
                f"a step with {len(value)} keys: expected one, {either(list(by_key))}; "
                "each step is an item of its own",
            )
        return self._struct(by_key[next(iter(value))], path, value)

    def _tagged(
        self, structs: list[inspect.StructType], path: KeyPath, value: Any
    ) -> SceneError | None:
        tag = str(structs[0].tag_field)
        if not isinstance(value, dict):
            first = structs[0]
            example = EXAMPLES.get(first.cls.__name__, f"{{{tag}: {first.tag}, ...}}")
            return self._document.unexpected(path, f"a map with {tag}, such as {example}")
        for each in structs:
            if value.get(tag) == each.tag:
                return self._struct(each, path, value)
        return self._tag(structs, path, value)

    def _tag(
        self, structs: list[inspect.StructType], path: KeyPath, value: dict[str, Any]
    ) -> SceneError:
        tag = str(structs[0].tag_field)
        names = [str(each.tag) for each in structs]
        if tag not in value:
            for key in value:
                if meant_by(key, [tag]):
                    return self._unknown((*path, key), [tag])
            return self._document.error(path, f"{tag} is missing: expected {either(names)}")
        return self._choice((*path, tag), value[tag], names)

    def _literal(self, kind: inspect.LiteralType, path: KeyPath, value: Any) -> SceneError | None:
        if value in kind.values:
            return None
        return self._choice(path, value, sorted(map(str, kind.values)))

    def _choice(self, path: KeyPath, value: Any, names: list[str]) -> SceneError:
        hint = suggest(value, names) if isinstance(value, str) else ""
        hint = f"; {hint}" if hint.startswith("did") else ""
        return self._document.unexpected(path, either(names) + hint)

    def _dict(self, kind: inspect.DictType, path: KeyPath, value: Any) -> SceneError | None:
        if not isinstance(value, dict):
            return self._document.unexpected(path, "a map from names")
        for key, item in value.items():
            mistake = self.check(kind.value_type, (*path, key), item)
            if mistake:
                return mistake
        return None

    def _list(
        self, kind: Sequence, path: KeyPath, value: Any, unit: str | None
    ) -> SceneError | None:
        length = fixed_length(kind)
        if not isinstance(value, list) or (length is not None and len(value) != length):
            return self._document.unexpected(path, describe(kind, unit))
        for index, item in enumerate(value):
            mistake = self.check(item_type(kind, index), (*path, index), item, unit)
            if mistake:
                return mistake
        return None

    def _unknown(self, path: KeyPath, known: list[str]) -> SceneError:
        meant = meant_by(path[-1], known)
        hint = f"did you mean {either(meant)}?" if meant else suggest(path[-1], known)
        return self._document.error(path, f"unknown key; {hint}")


def _accepts(kind: inspect.Type, value: Any) -> bool:
    match kind:
        case inspect.FloatType():
            return _is_number(value, int | float) and _within(kind, value)
        case inspect.IntType():
            return _is_number(value, int) and _within(kind, value)
        case inspect.StrType():
            return (
                isinstance(value, str)
                and len(value) >= (kind.min_length or 0)
                and re.search(kind.pattern or "", value) is not None
            )
        case inspect.BoolType():
            return isinstance(value, bool)
        case inspect.NoneType():
            return value is None
    return False


def _is_number(value: object, types: Any) -> bool:
    return isinstance(value, types) and not isinstance(value, bool)


def _within(kind: Number, value: float) -> bool:
    return (
        (kind.gt is None or value > kind.gt)
        and (kind.ge is None or value >= kind.ge)
        and (kind.lt is None or value < kind.lt)
        and (kind.le is None or value <= kind.le)
    )


def _same_shape(kind: inspect.Type, value: object) -> bool:
    """Whether a list or map in the file is the one that the type means, if perhaps a wrong one."""
    match kind:
        case inspect.TupleType() | inspect.VarTupleType():
            return isinstance(value, list) and len(value) == fixed_length(kind)
        case inspect.StructType():
            return isinstance(value, dict)
    return False


def _described(kind: inspect.Type) -> str:
    unit = None
    if isinstance(kind, inspect.Metadata):
        unit = (kind.extra_json_schema or {}).get("x-unit")
        kind = kind.type
    return _a_map(kind) if isinstance(kind, inspect.StructType) else describe(kind, unit)


def _a_map(kind: inspect.StructType) -> str:
    keys = [field.encode_name for field in kind.fields]
    if kind.tag_field:
        keys = [kind.tag_field, *keys]
    example = EXAMPLES.get(kind.cls.__name__)
    if example:
        return f"a map with the keys {' and '.join(keys)}, such as {example}"
    return f"a map with keys such as {', '.join(keys[:3])}"
