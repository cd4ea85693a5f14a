"""Of a test's combinations those are left out whose parts others have."""

from itertools import product

import pytest

from tests.lengths import covering, without_combinations
from tests.processes import python

TEXT = """
import pytest

fixture = pytest.fixture(params=["i", "j"])(lambda request: request.param)

@pytest.mark.fewer
@pytest.mark.parametrize("size", [1, 2, 3])
@pytest.mark.parametrize(("name", "error"), [("a", 0.5), ("b", 0.5), ("c", 0.5), ("d", 0.5)])
def test_two(name, error, size): ...

@pytest.mark.fewer
@pytest.mark.parametrize("size", [1, 2, 3])
@pytest.mark.parametrize("name", ["a", "b", "c", "d"])
def test_three(fixture, name, size): ...

@pytest.mark.parametrize("size", [1, 2])
@pytest.mark.parametrize("name", ["a", "b"])
def test_whole(name, size): ...

@pytest.mark.fewer
def test_alone(): ...
"""


@pytest.fixture(scope="module")
def collected(tmp_path_factory: pytest.TempPathFactory) -> list[pytest.Item]:
    file = tmp_path_factory.mktemp("lengths") / "test_few.py"
    file.write_text(TEXT, encoding="utf-8")
    settings = file.with_name("pytest.ini")
    settings.write_text("[pytest]", encoding="utf-8")

    class Kept:
        items: list[pytest.Item]

        def pytest_configure(self, config: pytest.Config) -> None:
            config.addinivalue_line("markers", "fewer: as here")

        def pytest_collection_finish(self, session: pytest.Session) -> None:
            self.items = session.items

    kept = Kept()
    options = ["-q", "--collect-only", "-p", "no:cacheprovider", "-c", str(settings)]
    assert pytest.main([*options, str(file)], [kept]) == 0
    return kept.items


def tried(collected: list[pytest.Item], test: str) -> list[list[str]]:
    return [
        item.name.partition("[")[2].rstrip("]").split("-")
        for item in without_combinations(collected)
        if item.name.partition("[")[0] == test
    ]


def test_of_two_lists_each_value_is_tried(collected: list[pytest.Item]) -> None:
    found = tried(collected, "test_two")
    assert len(found) == 4
    assert {name for name, *_ in found} == {*"abcd"}
    assert {size for *_, size in found} == {*"123"}


def test_of_more_lists_each_pair_of_values_is_tried(collected: list[pytest.Item]) -> None:
    found = tried(collected, "test_three")
    assert 12 <= len(found) < 18
    for first, second in ((0, 1), (0, 2), (1, 2)):
        values = {one[first] for one in found}, {one[second] for one in found}
        assert {(one[first], one[second]) for one in found} == {*product(*values)}


def test_all_else_is_tried_whole_and_in_its_order(collected: list[pytest.Item]) -> None:
    assert len(tried(collected, "test_whole")) == 4
    assert len(tried(collected, "test_alone")) == 1
    left = without_combinations(collected)
    assert left == [item for item in collected if item in left]
    assert without_combinations(left) == left


def test_the_long_run_tries_all_combinations() -> None:
    file = "tests/engine/terms/lights/test_weights.py"
    asked = ("--collect-only", "-q", "-p", "no:cacheprovider", "--hypothesis-profile=stress", file)
    found = python("-m", "pytest", *asked).stdout
    # Of 147 a third is tried otherwise.
    assert found.count("test_lamps_in_lobes_are_as_bright_as_quadrature_says[") == 147


def test_what_covers_has_all_that_there_is() -> None:
    wanted = [frozenset(pair) for pair in ("ab", "bc", "ac", "d")]
    assert covering(wanted) == [0, 1, 3]
    assert covering([]) == []
