"""Messages: every value of numbers comes back as it went, and whatever a forger writes is a broken message."""

import io
import json
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from course.school.grading.pictures.stage import usable
from course.school.grading.worker.framing import (
    DTYPES,
    LARGEST,
    LARGEST_HEAD,
    MOST_ARRAYS,
    BrokenMessage,
    Passed,
    generator,
    pack,
    unpack,
)


def reader(message: bytes, asked: list[int] | None = None) -> Callable[[int], bytearray]:
    """Reads a message, and notes how much of it was asked for."""
    file = io.BytesIO(message)

    def read(count: int) -> bytearray:
        if asked is not None:
            asked.append(count)
        return bytearray(file.read(count).ljust(count, b"\0"))

    return read


def state(**changed: Any) -> dict[str, Any]:
    found: dict[str, Any] = dict(np.random.PCG64(1).state)
    return found | changed


def sent(*values: Any, generators: bool = True) -> list[Any]:
    return unpack(reader(pack({}, [*values])), generators=generators)[1]


@pytest.mark.parametrize("name", DTYPES)
@pytest.mark.parametrize("shape", [(), (0,), (3, 0), (2, 3, 4)], ids=str)
@pytest.mark.parametrize("order", ["C", "F"])
def test_arrays_come_back_as_they_went(name: str, shape: tuple[int, ...], order: Any) -> None:
    array = np.arange(np.prod(shape, dtype=int)).reshape(shape).astype(DTYPES[name], order=order)
    (found,) = sent(array)
    assert type(found) is np.ndarray
    assert (found.dtype, found.shape) == (array.dtype, array.shape)
    assert np.array_equal(found, array)
    assert found.flags.f_contiguous == array.flags.f_contiguous
    assert found.flags.writeable


def test_views_and_other_byte_orders_are_the_same_numbers() -> None:
    wide = np.arange(24.0).reshape(4, 6)
    found = sent(wide[::2, ::3], wide.astype(">f4"))
    assert np.array_equal(found[0], wide[::2, ::3])
    assert found[1].dtype == np.float32
    assert np.array_equal(found[1], wide)


def test_what_is_no_array_comes_back_too() -> None:
    values = [None, True, -3, 2**63, 0.1, float("inf"), "text", (1, (np.ones(2), "x")), np.int8(3)]
    found = sent(*values)
    assert found[:7] == values[:7]
    assert found[7][1][1] == "x"
    assert type(found[8]) is np.int8


def test_a_generator_goes_on_where_it_was_and_is_nothing_to_the_grader() -> None:
    rng = np.random.default_rng(5)
    rng.random(3)
    (copy,) = sent(rng)
    (passed,) = sent(rng, generators=False)
    assert type(passed) is Passed
    # What the grader hands on is the same again.
    (again,) = sent(passed)
    expected = rng.random(4)
    assert np.array_equal(copy.random(4), expected)
    assert np.array_equal(again.random(4), expected)


@pytest.mark.parametrize(
    "passed", [None, 1, Passed(-1), Passed({"state": 1}), Passed(state(uinteger=1 << 90))]
)
def test_what_comes_back_for_a_generator_is_one_or_the_message_is_broken(passed: Any) -> None:
    assert generator(Passed(state())).random() == np.random.Generator(np.random.PCG64(1)).random()
    with pytest.raises(BrokenMessage):
        generator(passed)


@pytest.mark.parametrize(
    "value",
    [
        np.array([object()]),
        np.array(["text"]),
        np.ones(2, complex),
        object(),
        2**64,
        "x" * (LARGEST_HEAD + 1),
        [0.0] * LARGEST_HEAD,
        [np.float32(1)] * (MOST_ARRAYS + 1),
        np.broadcast_to(np.float64(1), LARGEST // 8 + 1),
        np.ones(3).view(type("Own", (np.ndarray,), {})),
    ],
    ids=["objects", "texts", "complex", "object", "int", "text", "list", "many", "large", "own"],
)
def test_what_is_no_numbers_or_too_many_is_not_sent(value: Any) -> None:
    with pytest.raises(TypeError):
        pack({}, [value])


def test_tuples_without_end_are_not_sent() -> None:
    value: Any = 1
    for _ in range(100):
        value = (value,)
    with pytest.raises(TypeError):
        pack({}, [value])


def array(**changed: Any) -> dict[str, Any]:
    return {"dtype": "float32", "shape": [1], "layout": "C", "frozen": False} | changed


def nested(depth: int) -> str:
    return '{"tuple": [' * depth + "1" + "]}" * depth


FORGED: dict[str, str | dict[str, Any]] = {
    "no object": "[]",
    "no JSON": "{",
    "not UTF-8": "\udcff",
    "tokens": '{"values": [], "arrays": (}',
    "infinitely many arrays": '{"values": [], "arrays": Infinity}',
    "a number of arrays": {"values": [], "arrays": 3},
    "too many arrays": {"values": [], "arrays": [array(shape=[0])] * (MOST_ARRAYS + 1)},
    "no values": {"arrays": []},
    "values that are none": {"values": {}, "arrays": []},
    "a value that is none": {"values": [3], "arrays": []},
    "a value of nothing": {"values": [{}], "arrays": []},
    "a list as a value": {"values": [{"value": [1]}], "arrays": []},
    "a number of many digits": {"values": [{"value": 10**400}], "arrays": []},
    "a number of too many digits": '{"arrays": [], "values": [{"value": 1' + "0" * 5000 + "}]}",
    "an array that isn't there": {"values": [{"array": 0}], "arrays": []},
    "an array from the end": {"values": [{"array": -1}], "arrays": [array()]},
    "an array by truth": {"values": [{"array": False}], "arrays": [array()]},
    "objects": {"values": [], "arrays": [array(dtype="object")]},
    "a dtype that is evaluated": {"values": [], "arrays": [array(dtype="f4,f4")]},
    "a dtype that is none": {"values": [], "arrays": [array(dtype=[])]},
    "negative sizes": {"values": [], "arrays": [array(shape=[-1, -4])]},
    "sizes that are none": {"values": [], "arrays": [array(shape=[1.5])]},
    "endless sizes": '{"values": [], "arrays": [{"dtype": "int8", "shape": [1e999]}]}',
    "a shape that is none": {"values": [], "arrays": [array(shape=3)]},
    "too many axes": {"values": [], "arrays": [array(shape=[1] * 65)]},
    "large beside nothing": {"values": [], "arrays": [array(shape=[0, 10**30])]},
    "too large an array": {"values": [], "arrays": [array(shape=[LARGEST])]},
    "large ones together": {"values": [], "arrays": [array(shape=[LARGEST // 16])] * 5},
    "a generator of -1": {"values": [{"rng": state(has_uint32=-1)}], "arrays": []},
    "a generator of nothing": {"values": [{"rng": -1}], "arrays": []},
    "a generator of another kind": {"values": [{"rng": {"state": [1] * 700}}], "arrays": []},
    "a generator in a generator": {"values": [{"rng": {"a": {"b": {"c": {}}}}}], "arrays": []},
    "tuples without end": '{"arrays": [], "values": [' + nested(50) + "]}",
    "a tuple of no list": {"values": [{"tuple": 1}], "arrays": []},
    "brackets without end": "[" * (LARGEST_HEAD - 1),
    "objects without end": '{"a":' * (LARGEST_HEAD // 6),
    "a head of lists": {"values": [], "arrays": [], "message": [["x"]]},
    "a head of objects": {"values": [], "arrays": [], "names": {"a": 1}},
    "an error that is none": {"values": [], "arrays": [], "error": 1},
}


@pytest.mark.parametrize("name", FORGED)
def test_what_is_forged_is_a_broken_message_and_nothing_else(name: str) -> None:
    head = FORGED[name]
    text = head if isinstance(head, str) else json.dumps(head)
    data = text.encode("utf-8", "surrogateescape")
    asked: list[int] = []
    with pytest.raises(BrokenMessage):
        unpack(reader(b"%08x" % len(data) + data, asked), generators=False)
    # It is known from the head alone, but for what only shows when the values are put together.
    assert sum(asked) <= len(data) + 8 + 4


@pytest.mark.parametrize(
    "length", [b"00100001", b"ffffffff", b"-0000001", b"nonsense", b"\xff" * 8, b"0x000001"]
)
def test_a_head_is_not_even_read_when_it_is_too_long(length: bytes) -> None:
    asked: list[int] = []
    with pytest.raises(BrokenMessage):
        unpack(reader(length, asked))
    assert sum(asked) <= 8 + 1


def test_truth_is_0_or_1() -> None:
    head = json.dumps(
        {"values": [{"array": 0}], "arrays": [array(dtype="bool", shape=[3])]}
    ).encode()
    _, (found,) = unpack(reader(b"%08x" % len(head) + head + b"\x00\x02\xff"))
    assert found.view(np.uint8).tolist() == [0, 1, 1]


@pytest.mark.parametrize("name", DTYPES)
def test_every_dtype_is_usable_in_a_picture(name: str) -> None:
    value = np.ones((2, 5), DTYPES[name])
    found = usable("thin_lens.point_on_disk", value)
    assert found.dtype == np.float32
    assert (found == 1).all()


@pytest.mark.parametrize(
    ("layout", "given"),
    [
        ("C", np.arange(12.0).reshape(3, 4)),
        ("F", np.asfortranarray(np.arange(12.0).reshape(3, 4))),
        ("scattered", np.arange(48.0).reshape(6, 8)[::2, ::2]),
        ("scattered", np.broadcast_to(np.float32(2), (3, 4))),
    ],
    ids=["rows", "columns", "every other", "one number"],
)
def test_arguments_come_in_the_memory_layout_that_they_have(layout: str, given: Any) -> None:
    data = pack({}, [given])
    ((found,), (plain,)) = (
        unpack(reader(data), generators=generators)[1] for generators in (True, False)
    )
    assert (found == given).all()
    assert found.flags.writeable == given.flags.writeable
    assert found.flags.c_contiguous == (layout == "C")
    assert found.flags.f_contiguous == (layout == "F")
    # What comes from a worker is as plain as can be.
    assert plain.flags.writeable
    assert plain.flags.c_contiguous or plain.flags.f_contiguous
