"""`course compare`: exit codes, files and what is told."""

import json
import re
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from course.engine.formats.pictures.files import save
from tests.cli.conftest import Run


@pytest.fixture(autouse=True)
def pictures(tmp_path: Path) -> None:
    """The pictures a and b of one mean, bright 5% brighter, small of another size; as EXR and PNG."""
    y, x = np.mgrid[:64, :80]
    truth = np.stack([0.3 + 0.2 * np.sin(x / k) * np.cos(y / 13) for k in (7, 9, 11)])
    for seed, (name, factor) in enumerate({"a": 1, "b": 1, "bright": 1.05}.items()):
        noise = np.random.default_rng(seed).standard_normal(truth.shape)
        picture = (factor * truth + 0.02 * noise).clip(0).astype(np.float32)
        for suffix in (".exr", ".png"):
            save(tmp_path / f"{name}{suffix}", picture)
    save(tmp_path / "small.exr", picture[:, :48, :64])


@pytest.mark.parametrize(
    "names", [("a.exr", "b.exr"), ("a.png", "b.png"), ("a.exr", "b.png"), ("a.png", "b.exr")]
)
def test_the_same_but_for_noise(run: Run, names: tuple[str, str]) -> None:
    result = run("compare", *names)
    assert result.exit_code == 0
    assert "no difference but noise (p-value >= 0.0001)" in result.stdout
    eight = "as 8 bits show them" in result.stdout
    assert eight == any(name.endswith("png") for name in names)


@pytest.mark.parametrize(
    "names", [("a.exr", "bright.exr"), ("a.png", "bright.png"), ("a.exr", "bright.png")]
)
def test_a_brighter_picture_is_different(run: Run, names: tuple[str, str]) -> None:
    result = run("compare", *names)
    assert result.exit_code == 1
    assert "different (p-value < 0.0001)" in result.stdout


def test_jpegs_can_be_compared(run: Run, tmp_path: Path) -> None:
    for name in ("a", "b"):
        with Image.open(tmp_path / f"{name}.png") as image:
            image.save(tmp_path / f"{name}.jpg", quality=95)
    assert run("compare", "a.jpg", "b.jpg").exit_code == 0


def test_the_significance_decides(run: Run) -> None:
    run("compare", "a.exr", "bright.exr", "--json", "found.json")
    p = json.loads(Path("found.json").read_text("utf-8"))["p_value"]
    assert 0 < p < 1e-3
    assert run("compare", "a.exr", "bright.exr", "--significance", str(1.01 * p)).exit_code == 1
    assert run("compare", "a.exr", "bright.exr", "--significance", str(0.99 * p)).exit_code == 0


def test_everything_is_told_as_json(run: Run, tmp_path: Path) -> None:
    run("compare", "a.exr", "bright.exr", "--json", "found.json")
    told = json.loads((tmp_path / "found.json").read_text("utf-8"))
    assert (told["a"], told["b"], told["different"]) == ("a.exr", "bright.exr", True)
    assert told["p_value"] < told["significance"] == 1e-4
    assert told["mean_difference"] == pytest.approx([-0.015] * 3, abs=0.003)
    assert {"rmse", "differing", "largest", "clipped", "coded"} <= told.keys()
    assert [one["p_value"] for one in told["tests"]] == sorted(
        one["p_value"] for one in told["tests"]
    )
    assert told["seen"] == [{"text": "A is darker by 4.8%", "place": None}]


def test_the_difference_is_a_picture(run: Run, tmp_path: Path) -> None:
    assert run("compare", "a.exr", "b.exr", "--difference", "d.png").exit_code == 0
    with Image.open(tmp_path / "d.png") as image:
        assert image.width == 180
        assert image.height > 64


@pytest.mark.parametrize(
    ("arguments", "told"),
    [
        (("a.exr", "no.exr"), "no.exr: no such file"),
        (
            ("a.exr", "small.exr"),
            "a.exr, small.exr: pictures of 80 x 64 and 64 x 48 pixels can't be compared",
        ),
        (("a.exr", "b.exr", "--difference", "d.exr"), "--difference d.exr: colours"),
        (("a.exr", "b.exr", "--difference", "b.exr"), "--difference"),
        (("a.exr", "b.exr", "--json", "no/d.json"), "no"),
    ],
)
def test_trouble_is_one_line_and_exit_code_2(
    run: Run, arguments: tuple[str, ...], told: str
) -> None:
    result = run("compare", *arguments)
    assert result.exit_code == 2
    assert result.stdout == ""
    assert result.stderr.startswith("error: ")
    assert told in result.stderr
    assert len(result.stderr.splitlines()) == 1


def test_a_few_pixels_in_equal_pictures_are_pointed_out(run: Run, tmp_path: Path) -> None:
    """Two pixels may be noise, even where nothing else is."""
    plain = np.full((3, 64, 96), 0.25, np.float32)
    other = plain.copy()
    other[:, 33, 45:47] += np.float32(0.3)
    other[1, 33, 45] += np.float32(0.1)
    save(tmp_path / "plain.exr", plain)
    save(tmp_path / "other.exr", other)
    result = run("compare", "other.exr", "plain.exr")
    assert "but only 0.03% of the pixels differ" in result.stdout
    assert "most by +0.4 at column 45, row 33" in result.stdout
    assert "but only" not in run("compare", "a.exr", "b.exr").stdout


def test_what_was_seen_is_told_framed_and_written(run: Run, tmp_path: Path) -> None:
    """The first row of pixels below a place of 16 x 16 has the frame's green."""
    rng = np.random.default_rng(4)
    pictures = [0.3 + 0.01 * rng.standard_normal((3, 96, 128)).astype(np.float32) for _ in range(2)]
    pictures[0][:, 32:48, 64:80] *= 1.1
    for name, picture in zip(("one", "other"), pictures, strict=True):
        save(tmp_path / f"{name}.exr", picture)
    run("compare", "one.exr", "other.exr", "--difference", "plain.png", "--significance", "1e-300")
    result = run("compare", "one.exr", "other.exr", "--difference", "d.png", "--json", "d.json")
    assert result.exit_code == 1
    assert re.search(
        r"A is brighter by (9\.\d|10|11)% in 16 x 16 pixels at \(64, 32\)", result.stdout
    )
    told = json.loads((tmp_path / "d.json").read_text("utf-8"))
    assert told["seen"][0]["place"] == {"left": 64, "top": 32, "width": 16, "height": 16}
    with Image.open(tmp_path / "d.png") as framed, Image.open(tmp_path / "plain.png") as plain:
        left = (framed.width - 128) // 2
        assert framed.getpixel((left + 63, 40)) == framed.getpixel((left + 80, 40)) == (0, 140, 0)
        assert framed.getpixel((left + 70, 40)) == plain.getpixel((left + 70, 40))
        assert framed.height > plain.height, "words stand below"
