import os
import tracemalloc
from collections.abc import Callable
from itertools import pairwise
from pathlib import Path

import pytest
import yaml

from course.base.errors import SceneError
from course.engine.formats.yaml import tree
from course.engine.formats.yaml.document import Document, show, spell
from course.engine.formats.yaml.suggestions import suggest
from course.engine.formats.yaml.tree import parse_document, read_document


@pytest.fixture(params=["C", "Python"])
def parse(
    request: pytest.FixtureRequest, monkeypatch: pytest.MonkeyPatch
) -> Callable[..., Document]:
    """The same laws hold with PyYAML's C parser and, where that is missing, with its Python one."""
    if request.param == "Python":
        monkeypatch.setattr(tree, "_Loader", yaml.SafeLoader)
    elif not hasattr(yaml, "CSafeLoader"):
        pytest.skip("PyYAML without libyaml")

    def _parse(content: str | bytes) -> Document:
        return parse_document(content.encode() if isinstance(content, str) else content, "a.yaml")

    return _parse


def test_every_key_and_item_knows_its_line(parse: Callable[..., Document]) -> None:
    document = parse(
        "# comment\n"
        "camera:\n"
        "  eye: [0,\n"
        "        1]\n"
        "objects:\n"
        "  - shape: box\n"
        "    size:\n"
        "      - 1\n"
        "\n"
        "  - shape: quad\n"
    )
    lines = {
        (): 1,
        ("camera",): 2,
        ("camera", "eye"): 3,
        ("camera", "eye", 0): 3,
        ("camera", "eye", 1): 4,
        ("objects",): 5,
        ("objects", 0): 6,
        ("objects", 0, "size"): 7,
        ("objects", 0, "size", 0): 8,
        ("objects", 1, "shape"): 10,
    }
    assert {path: document.line(path) for path in lines} == lines
    assert document.where(("objects", 1)) == "a.yaml:10"


def test_what_is_not_in_the_file_has_its_parents_line(parse: Callable[..., Document]) -> None:
    document = parse("x: 1\ncamera:\n  eye: [0]\n")
    assert document.line(("camera", "up")) == 2
    assert document.line(("camera", "eye", 5)) == 3
    assert document.line(("camera", "eye", 0, "deep")) == 3
    assert document.line(("nowhere", 1)) == 1


def test_aliases_and_merges_give_the_shared_values_and_their_lines(
    parse: Callable[..., Document],
) -> None:
    document = parse(
        "base: &base {a: 1, b: 2}\n"
        "more: &more\n"
        "  b: 3\n"
        "  c: 4\n"
        "one: *base\n"
        "two:\n"
        "  a: 9\n"
        "  <<: *base\n"
        "three: {<<: [*base, *more]}\n"
        "word: &word text\n"
        "same: *word\n"
    )
    assert document.data["one"] == {"a": 1, "b": 2}
    assert document.data["two"] == {"a": 9, "b": 2}
    assert document.data["three"] == {"a": 1, "b": 2, "c": 4}
    assert document.data["same"] == "text"
    assert document.line(("two", "a")) == 7
    assert document.line(("two", "b")) == 1
    assert document.line(("three", "c")) == 4
    assert document.line(("one", "a")) == 1


def test_a_quoted_word_is_text(parse: Callable[..., Document]) -> None:
    assert parse("a: '1'\nb: \"true\"\nc: |\n  .nan\n'<<': {x: 1}\n").data == {
        "a": "1",
        "b": "true",
        "c": ".nan\n",
        "<<": {"x": 1},
    }


def test_a_byte_order_mark_is_skipped(parse: Callable[..., Document]) -> None:
    assert parse(b"\xef\xbb\xbfa: 1").data == {"a": 1}


@pytest.mark.parametrize(
    ("content", "start", "words"),
    [
        ("", "a.yaml: ", ["empty"]),
        ("# nothing\n", "a.yaml: ", ["empty"]),
        ("---\n...\n", "a.yaml: ", ["empty"]),
        ("\n- 1\n", "a.yaml:2: ", ["a list", "expected a map"]),
        ("word\n", "a.yaml:1: ", ['just "word"', "expected a map"]),
        ("a: 1\n---\nb: 2\n", "a.yaml:2: ", ["second document"]),
        ("a: 1\nb: [1, 2\nc: 3\n", "a.yaml:3: ", ["not valid YAML", "line 2"]),
        ("a:\n\tb: 1\n", "a.yaml:2: ", ["not valid YAML", "not tabs"]),
        ("a: 1\nb: {c: 2,\n  c: 3}\n", "a.yaml:3: b.c: ", ["already given on line 2"]),
        ("a: 1\n<<: {b: 1}\n<<: {c: 1}\n", "a.yaml:3: ", ["already given on line 2"]),
        ("a: [x, !!python/object/apply:os.system [ls]]\n", "a.yaml:1: ", ["tag !!python/object"]),
        ("a: 1\nb: !include x\n", "a.yaml:2: ", ["tag !include", "plain data"]),
        ("a: !!float 1\n", "a.yaml:1: ", ["tag !!float"]),
        ("!!map {a: 1}\n", "a.yaml:1: ", ["tag !!map"]),
        ("a: 1\nb: *c\n", "a.yaml:2: ", ["alias *c has no anchor"]),
        ("a: &a\n - *a\n", "a.yaml:2: ", ["inside its own anchor"]),
        ("a: 1\n<<: 3\n", "a.yaml:2: ", ["<< in the scene is 3", "expected a map"]),
        ("a: 1\n2: 3\n", "a.yaml:2: ", ["key of the scene is 2", "quotes"]),
        ("a: {null: 3}\n", "a.yaml:1: ", ["key of a is null"]),
        ("a: {? [1] : 3}\n", "a.yaml:1: ", ["key of a is a list"]),
        ("? {b: 1}\n: 3\n", "a.yaml:1: ", ["key of the scene is a map"]),
        ("a:\n- x: [1, .nan]\n", "a.yaml:2: a[0].x[1] is .nan: ", ["finite number"]),
        ("a: 1\ntitle: -.inf\n", "a.yaml:2: title is -.inf: ", ["finite number"]),
        ("a: 1e400\n", "a.yaml:1: a is 1e400: ", ["1e150"]),
        (f"a: {'9' * 5000}\n", "a.yaml:1: a is 9999", ["...: expected", "1e150"]),
        (b"a: 1\nb: \xff\n", "a.yaml:2: ", ["not UTF-8", "0xff"]),
        ("a: 1".encode("utf-16")[:-1], "a.yaml:1: ", ["not UTF-16", "save it as UTF-8"]),
        (b"a: 1\nb: \0\n", "a.yaml:2: ", ["not text", "U+0000"]),
        (b"a: \x1b[31m\n", "a.yaml:1: ", ["not text", "U+001B"]),
        ("a: " + "[" * 100 + "]" * 100, "a.yaml:1: ", ["64 levels"]),
        ("a: " + "[" * 100_000, "a.yaml:1: ", ["64 levels"]),
        ("- " * 100_000, "a.yaml:1: ", ["64 levels"]),
    ],
)
def test_what_is_not_a_plain_map_is_refused_by_line(
    parse: Callable[..., Document], content: str | bytes, start: str, words: list[str]
) -> None:
    with pytest.raises(SceneError) as caught:
        parse(content)
    message = str(caught.value)
    assert message.startswith(start)
    for word in words:
        assert word in message
    assert len(message) < 250


def _laughs(joined: str, single: str) -> str:
    """Ten levels, each nine times the one before: 3.5e9 values in 500 bytes."""
    names = "abcdefghij"
    return f"a: &a {single}\n" + "".join(
        f"{name}: &{name} {joined.format(','.join([f'*{before}'] * 9))}\n"
        for before, name in pairwise(names)
    )


@pytest.mark.parametrize(
    ("bomb", "words"),
    [
        (_laughs("[{}]", "[x,x,x,x,x,x,x,x,x]"), "2,000,000 values"),
        (_laughs("{{<<: [{}]}}", "{x: 1}"), "2,000,000 values"),
        (
            "a: &a {" + ",".join(f"k{i}: 1" for i in range(2000)) + "}\n"
            "b: [" + ",".join(["{<<: *a}"] * 1000) + "]\n",
            "2,000,000 values",
        ),
        (
            "a0: &a0 [1]\n" + "".join(f"a{i}: &a{i} [*a{i - 1}]\n" for i in range(1, 1000)),
            "64 levels",
        ),
    ],
    ids=["laughs", "merged laughs", "merges", "deep aliases"],
)
def test_a_bomb_is_refused_within_little_memory(bomb: str, words: str) -> None:
    tracemalloc.start()
    try:
        with pytest.raises(SceneError, match=words):
            parse_document(bomb.encode(), "bomb.yaml")
        peak = tracemalloc.get_traced_memory()[1]
    finally:
        tracemalloc.stop()
    assert peak < 128 * 2**20


def test_many_values_without_aliases_are_refused_too(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(tree, "MOST_VALUES", 100)
    parse_document(b"a: [" + b"1," * 90 + b"]", "a.yaml")
    with pytest.raises(SceneError, match="too many"):
        parse_document(b"a: [" + b"1," * 110 + b"]", "a.yaml")
    # Refused while both lists are still open, and not only where the file breaks off.
    with pytest.raises(SceneError, match="too many"):
        parse_document(b"a: [" + b"1," * 60 + b"[" + b"1," * 60, "a.yaml")


def test_a_file_over_the_limit_is_refused(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(tree, "LARGEST_SCENE", 2**20)
    path = tmp_path / "large.yaml"
    path.write_bytes(b"#" * 2**20)
    with pytest.raises(SceneError, match="empty"):
        read_document(path)
    path.write_bytes(b"#" * (2**20 + 1))
    with pytest.raises(SceneError, match="more than 1,048,576 bytes"):
        read_document(path)


def test_files_that_cannot_be_read_are_named_with_the_reason(tmp_path: Path) -> None:
    (tmp_path / "glass.yaml").write_text("a: 1")
    cases = {
        tmp_path / "glas.yaml": f"no such file; did you mean {tmp_path / 'glass.yaml'}?",
        tmp_path / "missing" / "a.yaml": "no such file; its folder is missing too",
        tmp_path: "is a folder",
        tmp_path / "glass.yaml" / "a.yaml": "",
        tmp_path / "a\0b": "a\\x00b: can't be read",
    }
    for path, reason in cases.items():
        with pytest.raises(SceneError) as caught:
            read_document(path)
        assert reason in str(caught.value)
        assert str(tmp_path) in str(caught.value)


def test_an_error_of_the_operating_system_gives_its_reason(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = tmp_path / "locked.yaml"
    path.write_text("a: 1")

    def refuse(*_: object, **__: object) -> None:
        raise PermissionError(13, "Permission denied")

    monkeypatch.setattr(os, "open", refuse)
    with pytest.raises(SceneError, match="can't be read: Permission denied"):
        read_document(path)


def test_key_paths_are_spelt_as_in_the_file() -> None:
    assert spell(()) == "the scene"
    assert spell(("objects", 2, "transform", 0, "rotate")) == "objects[2].transform[0].rotate"
    assert spell(("materials", "red clay", "color")) == 'materials["red clay"].color'
    assert len(spell(("k" * 10_000,))) < 80


def test_long_values_are_cut() -> None:
    assert show([1, 2.5, "a", None, True]) == '[1, 2.5, "a", null, ...]'
    assert show("x" * 1000) == '"' + "x" * 57 + '..."'
    assert show("a\nb") == '"a\\nb"'
    assert show({}) == "an empty map"
    assert len(show([["y" * 1000] * 1000] * 1000)) < 70


def test_the_nearest_names_are_suggested_or_all_listed() -> None:
    assert suggest("Colour", ["color", "mirror"]) == "did you mean color?"
    assert suggest("xyz", ["color", "mirror"]) == "known are color, mirror"
    assert suggest("x", []) == "there are none"
    assert "did you mean" in suggest("k" * 10_000_000, ["k" * 60])
