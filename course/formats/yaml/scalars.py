"""What an unquoted YAML word means: the core schema of YAML 1.2, with numbers kept in bounds.

Unlike YAML 1.1, which PyYAML resolves, `1e-3` is a number and `yes`, `no`, `on`, `off` are texts.
"""

from __future__ import annotations

import math
import re

# The square of a number within these is finite and not zero in float64.
LARGEST = 1e150
SMALLEST = 1e-150

_NULL = {"", "~", "null", "Null", "NULL"}
_BOOLEAN = {
    **dict.fromkeys(("true", "True", "TRUE"), True),
    **dict.fromkeys(("false", "False", "FALSE"), False),
}
_INTEGER = re.compile(r"[-+]?[0-9]+|0o[0-7]+|0x[0-9a-fA-F]+", re.ASCII)
_FLOAT = re.compile(r"[-+]?(?:\.[0-9]+|[0-9]+(?:\.[0-9]*)?)(?:[eE][-+]?[0-9]+)?", re.ASCII)
_NOT_FINITE = re.compile(r"[-+]?\.(?:inf|Inf|INF)|\.(?:nan|NaN|NAN)", re.ASCII)
_MOST_DIGITS = 160


def resolve(word: str) -> str | int | float | bool | None:
    """Give an unquoted word its value.

    Raises ValueError for a number that is infinite, not a number, or larger or smaller than float64 can square; the
    message says what was expected.
    ``word``: a plain scalar, without quotes around it.

    YAML 1.2.2, section 10.3.2, tag resolution of the core schema.
    """
    if word in _NULL:
        return None
    if word in _BOOLEAN:
        return _BOOLEAN[word]
    if _NOT_FINITE.fullmatch(word):
        raise ValueError("a finite number")
    if _INTEGER.fullmatch(word):
        return _integer(word)
    if _FLOAT.fullmatch(word):
        return _float(word)
    return word


def _integer(word: str) -> int:
    # int() takes time quadratic in the number of digits, and refuses more than some thousands.
    sign, base = (-1 if word[0] == "-" else 1), {"0o": 8, "0x": 16}.get(word[:2], 10)
    digits = (word[2:] if base != 10 else word.lstrip("+-")).lstrip("0") or "0"
    number = sign * int(digits, base) if len(digits) <= _MOST_DIGITS else math.inf
    if abs(number) > LARGEST:
        raise ValueError(_within_bounds())
    return int(number)


def _float(word: str) -> float:
    number = float(word)
    # A zero that is written with another digit than 0 has underflowed.
    written_as_zero = re.search("[1-9]", re.split("[eE]", word)[0]) is None
    if not (written_as_zero or SMALLEST <= abs(number) <= LARGEST) or math.isinf(number):
        raise ValueError(_within_bounds())
    return number


def _within_bounds() -> str:
    return "0 or a number from 1e-150 to 1e150 in size"
