"""Regions: where the solution begins and ends, and which texts are refused."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from course.base.errors import CourseError
from course.school.grading.release.stubs import Region, SolutionError, find_regions


def refusal(text: str) -> str:
    """The message with which a text is refused."""
    with pytest.raises(SolutionError) as caught:
        find_regions(text, "solutions/a.py")
    assert isinstance(caught.value, CourseError)
    return str(caught.value)


def test_a_text_without_markers_has_no_regions() -> None:
    assert find_regions("", "a.py") == []
    assert find_regions("x = 1\n# The solution begins and ends here.\n", "a.py") == []


def test_regions_are_found_with_their_lines_and_indentation() -> None:
    text = (
        "### BEGIN SOLUTION\nx = 1\n### END SOLUTION\n"
        "def f():\n    ### BEGIN SOLUTION\n    ### END SOLUTION  \n"
        "\t### BEGIN SOLUTION\n\n\t### END SOLUTION"
    )
    assert find_regions(text, "a.py") == [
        Region(1, 3, ""),
        Region(5, 6, "    "),
        Region(7, 9, "\t"),
    ]


@pytest.mark.parametrize(
    ("text", "told"),
    [
        ("### END SOLUTION\n", "1: '### END SOLUTION' closes no region"),
        (
            "### BEGIN SOLUTION\n### END SOLUTION\nx = 1\n### END SOLUTION\n",
            "4: '### END SOLUTION' closes no region",
        ),
        ("x = 1\n### BEGIN SOLUTION\nx = 2\n", "2: the region that begins here is never closed"),
        (
            "### BEGIN SOLUTION\nx\n  ### BEGIN SOLUTION\n  ### END SOLUTION\n### END SOLUTION\n",
            "3: a region begins inside the one that line 1 opened",
        ),
        (
            "def f():\n    ### BEGIN SOLUTION\n    return 1\n### END SOLUTION\n",
            "4: '### END SOLUTION' is not indented like its beginning in line 2",
        ),
    ],
)
def test_markers_that_make_no_region_are_refused_by_their_lines(text: str, told: str) -> None:
    assert refusal(text) == f"solutions/a.py:{told}"


@pytest.mark.parametrize(
    "line",
    [
        "# BEGIN SOLUTION",
        "###BEGIN SOLUTION",
        "### begin solution",
        "### BEGIN  SOLUTION",
        "### BEGIN SOLUTION:",
        "### BEGIN_SOLUTION",
        "### BEGIN-SOLUTIONS",
        "### END SOLUTIONS",
        "#### END SOLUTION",
        "x = 1  ### BEGIN SOLUTION",
        "# ### END SOLUTION",
    ],
)
def test_what_is_nearly_a_marker_is_refused(line: str) -> None:
    told = refusal(f"x = 1\n{line}\n")
    assert told.startswith("solutions/a.py:2: ")
    assert line.strip() in told
    assert "'### BEGIN SOLUTION' or '### END SOLUTION', alone on its line" in told


LINES = st.sampled_from(["### BEGIN SOLUTION", "### END SOLUTION", "x = 1", ""])


@given(st.lists(LINES, max_size=12))
def test_markers_are_paired_or_refused(lines: list[str]) -> None:
    markers = [line for line in lines if line.startswith("###")]
    paired = markers == ["### BEGIN SOLUTION", "### END SOLUTION"] * (len(markers) // 2)
    try:
        regions = find_regions("\n".join(lines), "a.py")
    except SolutionError:
        assert not paired
        return
    assert paired
    found = [line for region in regions for line in (region.begin, region.end)]
    assert found == [n for n, line in enumerate(lines, start=1) if line.startswith("###")]
