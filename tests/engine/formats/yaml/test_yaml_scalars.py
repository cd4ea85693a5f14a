import pytest

from course.engine.formats.yaml.tree import resolve


@pytest.mark.parametrize(
    ("word", "value"),
    [
        ("1e-3", 1e-3),
        ("1E3", 1000.0),
        (".5", 0.5),
        ("-1.", -1.0),
        ("+7", 7),
        ("007", 7),
        ("0x1F", 31),
        ("0o17", 15),
        ("-0.0", 0.0),
        ("0e999", 0.0),
        ("0" * 5000, 0),
        ("true", True),
        ("False", False),
        ("~", None),
        ("", None),
        ("null", None),
        ("yes", "yes"),
        ("No", "No"),
        ("on", "on"),
        ("off", "off"),
        ("1_000", "1_000"),
        ("1:30", "1:30"),
        ("2001-12-14", "2001-12-14"),
        ("nan", "nan"),
        ("inf", "inf"),
        ("e3", "e3"),
        (".", "."),
        ("0x", "0x"),
        ("\u0661", "\u0661"),  # A digit, but not one of YAML's.
    ],
)
def test_words_mean_what_yaml_1_2_says(word: str, value: object) -> None:
    resolved = resolve(word)
    assert resolved == value
    assert type(resolved) is type(value)


@pytest.mark.parametrize("word", [".nan", ".NaN", ".NAN", ".inf", "-.Inf", "+.INF"])
def test_numbers_that_are_not_finite_are_refused(word: str) -> None:
    with pytest.raises(ValueError, match="finite"):
        resolve(word)


@pytest.mark.parametrize(
    "word",
    [
        "1e151",
        "-1e999",
        "1e-151",
        "1e-999",
        "0.00001e-400",
        "9" * 152,
        "9" * 10_000,
        "0x" + "f" * 140,
    ],
)
def test_numbers_that_float64_cannot_square_are_refused(word: str) -> None:
    with pytest.raises(ValueError, match="1e-150 to 1e150"):
        resolve(word)
