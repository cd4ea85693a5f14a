"""Whatever a scene file holds, loading ends in a description or in a SceneError."""

import copy
import json
from pathlib import Path

import jsonschema
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from course.base.errors import SceneError
from course.engine.formats.yaml.loading import load_description
from course.engine.formats.yaml.schema import json_schema
from course.engine.formats.yaml.tree import parse_document
from tests.changed_trees import change

VALIDATOR = jsonschema.Draft202012Validator(json_schema())
FUZZ = settings(
    max_examples=100,
    deadline=None,
    derandomize=True,
    suppress_health_check=[HealthCheck.function_scoped_fixture],
)

WORDS = ["material", "shape", "type", "box", "sphere", "radiance", "scale", "color", "<step>", "<<"]
SCALARS = (
    st.none()
    | st.booleans()
    | st.integers(-(10**6), 10**6)
    | st.integers(0, 10**400)
    | st.floats(allow_nan=False, allow_infinity=False)
    | st.sampled_from(WORDS)
    | st.text(max_size=8)
)
VALUES = st.recursive(
    SCALARS,
    lambda inner: (
        st.lists(inner, max_size=4)
        | st.dictionaries(st.sampled_from(WORDS) | st.text(max_size=5), inner, max_size=3)
    ),
    max_leaves=6,
)
MARKS = ["[", "]", "{", "}", ":", ", ", "- ", "&a ", "*a", "<<: ", "!", "\n", "  ", "'", '"', "\t"]
BITS = st.sampled_from([*MARKS, ".nan", "1e999", "\0", "#", "---\n", "? ", "|", "%"]) | st.text(
    max_size=4
)


@FUZZ
@given(data=st.data())
def test_a_scene_with_changed_values_loads_or_is_refused(
    data: st.DataObject, good: str, tmp_path: Path
) -> None:
    tree = copy.deepcopy(parse_document(good.encode(), "good.yaml").data)
    for _ in range(data.draw(st.integers(1, 3), label="changes")):
        change(tree, data, VALUES, WORDS)
    # JSON is YAML, but for characters that YAML refuses as such.
    _load_or_refuse(json.dumps(tree, ensure_ascii=True).encode(), tmp_path)


@FUZZ
@given(data=st.data())
def test_a_scene_with_changed_text_loads_or_is_refused(
    data: st.DataObject, good: str, tmp_path: Path
) -> None:
    text = good
    for _ in range(data.draw(st.integers(1, 4), label="changes")):
        start = data.draw(st.integers(0, len(text)))
        end = data.draw(st.integers(start, min(start + 12, len(text))))
        text = text[:start] + data.draw(BITS) + text[end:]
    _load_or_refuse(text.encode("utf-8", "replace"), tmp_path)


@FUZZ
@given(content=st.binary(max_size=60))
def test_bytes_load_or_are_refused(content: bytes, tmp_path: Path) -> None:
    _load_or_refuse(content, tmp_path)


def test_the_fuzz_can_load(good: str, tmp_path: Path) -> None:
    assert _load_or_refuse(good.encode(), tmp_path)


def _load_or_refuse(content: bytes, folder: Path) -> bool:
    """Load a file; check what holds for every file, loaded or refused."""
    path = folder / "fuzz.yaml"
    path.write_bytes(content)
    try:
        loaded = load_description(path)
    except SceneError as error:
        message = str(error)
        assert message.startswith(str(path))
        assert message.removeprefix(str(path)).isprintable()
        # The words are those of the course, never msgspec's.
        assert "`" not in message.removeprefix(str(path)).split(" is ")[0]
        assert "Expected" not in message
        return False
    VALIDATOR.validate(loaded.document.data)
    return True


@pytest.fixture(autouse=True)
def _no_leftovers(tmp_path: Path) -> None:
    assert not list(tmp_path.iterdir())
