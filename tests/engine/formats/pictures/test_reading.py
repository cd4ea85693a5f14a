"""Pictures are read as linear light: every value against the formula of its format, every defect refused in one line.

The files are written by hand (picture_files.py), so that the library that reads them is not judged by itself.
"""

import io
import math
import re
import struct
import warnings
import zlib
from collections.abc import Callable, Iterator
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray
from PIL import Image

from course.base.errors import CourseWarning, SceneError
from course.base.inputs import InputLimit
from course.engine.formats.pictures.files import save
from course.engine.formats.pictures.reading import read_picture
from tests.engine.formats.pictures import picture_files as by_hand

Array = NDArray[np.float64]
Read = Callable[[str, bytes], NDArray[np.float32]]


@pytest.fixture
def read(tmp_path: Path) -> Read:
    """Write a file of that name and read it."""

    def _read(name: str, content: bytes) -> NDArray[np.float32]:
        (tmp_path / name).write_bytes(content)
        picture = read_picture(tmp_path / name)
        assert picture.dtype == np.float32
        assert picture.ndim == 3
        assert picture.shape[2] == 3
        return picture

    return _read


@pytest.fixture
def refusal(tmp_path: Path, capfd: pytest.CaptureFixture[str]) -> Callable[[str, bytes], str]:
    """What is said of a file that can't be read: one line that names it, and nothing printed besides."""

    def _refusal(name: str, content: bytes) -> str:
        path = tmp_path / name
        path.write_bytes(content)
        with pytest.raises(SceneError) as caught:
            read_picture(path)
        message = str(caught.value)
        assert message.startswith(f"{path}: ")
        assert "\n" not in message
        assert capfd.readouterr() == ("", "")
        return message.removeprefix(f"{path}: ")

    return _refusal


def srgb(code: int, white: int) -> np.float32:
    """IEC 61966-2-1, one value in double precision."""
    x = code / white
    return np.float32(x / 12.92 if x <= 0.04045 else math.pow((x + 0.055) / 1.055, 2.4))


def linear(codes: NDArray[np.integer], white: int) -> NDArray[np.float32]:
    values = [srgb(int(code), white) for code in codes.ravel()]
    return np.array(values, np.float32).reshape(codes.shape)


def same_but_for_rounding(a: NDArray[np.float32], b: NDArray[np.float32]) -> None:
    # Two ways to take a power in double precision may round differently to single precision: by one unit.
    np.testing.assert_array_max_ulp(a, b, maxulp=1)


def codes(channels: int, bits: int, seed: int = 0) -> NDArray[np.integer]:
    """(6, 8, channels) random codes, the darkest and the brightest among them."""
    every = np.random.default_rng(seed).integers(0, 1 << bits, (6, 8, channels))
    every[0, 0], every[0, 1] = 0, (1 << bits) - 1
    return every


# ---------------------------------------------------------------- PNG and JPEG


def test_every_code_of_8_bits_is_decoded_by_the_srgb_formula(read: Read) -> None:
    every = np.arange(256).reshape(16, 16, 1)
    picture = read("a.png", by_hand.png(np.repeat(every, 3, axis=2)))
    same_but_for_rounding(picture, np.repeat(linear(every, 255), 3, axis=2))
    assert picture[0, 0].tolist() == [0, 0, 0]
    assert picture[15, 15].tolist() == [1, 1, 1]
    # Near the join of the line and the power, at code 10.3, and at the middle.
    assert picture[0, 10, 0] == pytest.approx(10 / 255 / 12.92, rel=1e-6)
    assert picture[8, 0, 0] == pytest.approx(0.21586, abs=1e-5)


@pytest.mark.filterwarnings("ignore:.*its alpha is left out")
@pytest.mark.parametrize("channels", [1, 2, 3, 4])
@pytest.mark.parametrize("bits", [8, 16])
def test_png_of_any_channels_and_depth(read: Read, channels: int, bits: int) -> None:
    given = codes(channels, bits)
    shown = given[..., :1].repeat(3, axis=2) if channels < 3 else given[..., :3]
    # Colours don't depend on alpha, not even where it is 0.
    assert channels % 2 or (given[0, 0, -1] == 0 and given[1:, :, -1].any())
    if channels % 2 == 0:
        given[0, 1, -1] = 0
    picture = read("a.png", by_hand.png(given, bits))
    same_but_for_rounding(picture, linear(shown, (1 << bits) - 1))


@pytest.mark.parametrize("channels", [1, 3])
def test_every_code_of_16_bits_is_decoded_by_the_srgb_formula(read: Read, channels: int) -> None:
    # 257 of them fall on each code of 8 bits, and three between the two values that are given for the join.
    every = np.arange(65536).reshape(256, 256, 1).repeat(channels, axis=2)
    picture = read("a.png", by_hand.png(every, 16))
    expected = linear(every[..., 0], 65535)
    same_but_for_rounding(picture, expected[..., None].repeat(3, axis=2))
    assert (np.diff(picture[..., 0].ravel()) > 0).all()


@pytest.mark.parametrize("plain", [False, True])
@pytest.mark.parametrize("white", [255, 1000, 4095, 65535])
@pytest.mark.parametrize("channels", [1, 3])
def test_pgm_and_ppm_of_any_largest_code(
    read: Read, channels: int, white: int, plain: bool
) -> None:
    """Netpbm's pgm(5) and ppm(5): a code is a share of the largest; those of 1000 are rounded to 16 bits."""
    given = np.random.default_rng(4).integers(0, white + 1, (6, 8, channels))
    given[0, 0], given[0, 1] = 0, white
    picture = read("a.ppm", by_hand.netpbm(given, white, plain))
    shown = np.broadcast_to(given, (6, 8, 3))
    expected = linear(np.rint(shown / white * 65535).astype(int), 65535)
    np.testing.assert_allclose(picture, expected, rtol=1e-4, atol=3e-6)
    assert picture[0, 1].tolist() == [1, 1, 1]


@pytest.mark.parametrize("bits", [8, 16])
def test_codes_are_shares_of_the_largest_without_a_curve(tmp_path: Path, bits: int) -> None:
    (tmp_path / "a.png").write_bytes(by_hand.png(codes(3, bits), bits))
    picture = read_picture(tmp_path / "a.png", codes=True)
    np.testing.assert_array_equal(picture, (codes(3, bits) / ((1 << bits) - 1)).astype(np.float32))


def test_png_of_a_palette_and_of_one_bit(read: Read) -> None:
    palette = np.array([[255, 0, 10], [7, 200, 30], [0, 0, 0], [90, 90, 90]])
    entries = np.random.default_rng(1).integers(0, 4, (5, 7, 1))
    picture = read("a.png", by_hand.png(entries, palette=palette))
    same_but_for_rounding(picture, linear(palette[entries[..., 0]], 255))
    bits = np.random.default_rng(2).random((5, 7)) < 0.5
    file = io.BytesIO()
    Image.fromarray(bits).save(file, "PNG")
    assert (read("b.png", file.getvalue()) == bits[..., None]).all()


@pytest.mark.parametrize("name", ["a.jpg", "a.JPEG"])
def test_jpeg_is_decoded_from_srgb(read: Read, name: str) -> None:
    color = (200, 120, 40)
    for image, expected in (
        (Image.new("RGB", (16, 8), color), color),
        (Image.new("L", (16, 8), 77), (77, 77, 77)),
    ):
        file = io.BytesIO()
        image.save(file, "JPEG", quality=100, subsampling=0)
        picture = read(name, file.getvalue())
        assert picture.shape == (8, 16, 3)
        # One colour all over only suffers the rounding of its transform, a code or two.
        low, high = (linear(np.array(expected) + by, 255) for by in (-2, 2))
        assert ((picture >= low) & (picture <= high)).all()


def test_a_format_is_told_by_what_is_in_the_file_not_by_its_suffix(read: Read) -> None:
    given = codes(3, 8)
    same_but_for_rounding(read("a.jpg", by_hand.png(given)), linear(given, 255))


def test_32_bits_a_channel_are_not_taken_for_codes(refusal: Callable[[str, bytes], str]) -> None:
    for values in (np.ones((4, 8), np.float32), np.ones((4, 8), np.int32)):
        file = io.BytesIO()
        Image.fromarray(values).save(file, "TIFF")
        assert "its values are no codes of 8 or 16 bits" in refusal("a.tif", file.getvalue())


def test_nothing_is_said_of_what_can_be_read_all_the_same(
    read: Read, monkeypatch: pytest.MonkeyPatch
) -> None:
    # Pillow warns of very large pictures. 48 pixels are not, but for this limit.
    monkeypatch.setattr(Image, "MAX_IMAGE_PIXELS", 40)
    with warnings.catch_warnings(record=True) as said:
        warnings.simplefilter("always")
        assert read("a.png", by_hand.png(codes(3, 8))).shape == (6, 8, 3)
    assert not said


# ---------------------------------------------------------------- EXR and HDR


def values(seed: int = 0) -> NDArray[np.float32]:
    """(5, 9, 3) numbers of all sizes, the largest and the smallest among them."""
    rng = np.random.default_rng(seed)
    picture = np.exp(rng.normal(0, 20, (5, 9, 3))).astype(np.float32)
    info = np.finfo(np.float32)
    picture[0, 0] = info.max, info.tiny, info.smallest_subnormal
    picture[0, 1] = 0
    return picture


def test_exr_holds_its_values_bit_for_bit(read: Read) -> None:
    picture = values()
    assert (read("a.exr", by_hand.exr_rgb(picture)) == picture).all()
    assert (read("a.EXR", by_hand.exr_rgb(picture)) == picture).all()
    half = np.random.default_rng(3).random((5, 9, 3)).astype(np.float16)
    half[0, 0] = 65504, 6e-8, 0
    assert (read("b.exr", by_hand.exr_rgb(half)) == half.astype(np.float32)).all()


def test_exr_as_the_renderer_writes_it_is_read_back_bit_for_bit(tmp_path: Path) -> None:
    # The second one is large and smooth enough that a compression with losses would save something.
    smooth = np.outer(np.linspace(0.1, 3, 80), np.linspace(0.1, 3, 90)).astype(np.float32)
    for picture in (values(), np.stack((smooth, smooth**2, np.sqrt(smooth)), axis=-1)):
        save(tmp_path / "a.exr", np.moveaxis(picture, -1, 0))
        assert (read_picture(tmp_path / "a.exr") == picture).all()


def test_exr_channels_are_found_by_their_names(read: Read) -> None:
    rgb = np.moveaxis(values(), -1, 0)
    planes = dict(zip("RGB", np.ascontiguousarray(rgb), strict=True))
    other = np.full((5, 9), -7, np.float32)
    layered = read("a.exr", by_hand.exr(planes | {"A": other, "Z": other, "side.R": other}))
    assert (layered == values()).all()
    grey = read("b.exr", by_hand.exr({"Y": planes["R"], "A": other}))
    assert (grey == values()[..., :1]).all()
    # A half among floats keeps the floats what they are.
    mixed = read("c.exr", by_hand.exr(planes | {"A": other.astype(np.float16)}))
    assert (mixed == values()).all()


@pytest.mark.parametrize(
    ("names", "told"),
    [
        (("p", "q", "s"), "it has the channels p, q, s, not R, G and B, or Y"),
        (("R", "G"), "it has the channels R, G, not"),
        (("left.R", "left.G"), "left.R, left.G, not"),
        (("Y", "RY", "BY"), "not R, G and B, or Y"),
    ],
)
def test_exr_without_colours_tells_its_channels(
    refusal: Callable[[str, bytes], str], names: tuple[str, ...], told: str
) -> None:
    plane = np.ones((5, 9), np.float32)
    assert told in refusal("a.exr", by_hand.exr(dict.fromkeys(names, plane)))


def test_exr_of_whole_numbers_is_refused(refusal: Callable[[str, bytes], str]) -> None:
    plane = np.ones((5, 9), np.uint32)
    told = refusal("a.exr", by_hand.exr(dict.fromkeys("RGB", plane)))
    assert "its values are uint, not half or float" in told


def mantissas_and_exponents(width: int = 64) -> NDArray[np.integer]:
    """(4, width, 4) codes; the second row is one run, the third is black."""
    rng = np.random.default_rng(4)
    every = rng.integers(0, 256, (4, width, 4))
    every[..., 3] = rng.integers(90, 160, (4, width))
    every[0, :4] = (255, 255, 255, 254), (1, 0, 0, 20), (128, 0, 255, 128), (0, 0, 0, 0)
    every[1] = every[1, 0]
    every[2] = 0
    return every


@pytest.mark.parametrize("run_lengths", [True, False])
@pytest.mark.parametrize("width", [8, 64, 300])
def test_hdr_is_mantissa_times_two_to_the_exponent(
    read: Read, width: int, run_lengths: bool
) -> None:
    given = mantissas_and_exponents(width)
    picture = read("a.hdr", by_hand.radiance(given, run_lengths=run_lengths))
    expected = by_hand.radiance_values(given)
    assert expected.max() > 1e37
    # The mantissa of 8 bits fits, so nothing is rounded, but numbers below the smallest normal one may be 0.
    off = np.abs(picture - expected)
    assert off[expected >= np.finfo(np.float32).tiny].max() == 0
    assert off.max() <= np.finfo(np.float32).tiny
    assert picture[0, 2].tolist() == [0.5, 0, 255 / 256]


@pytest.mark.parametrize(
    "options",
    [
        {"magic": "#?RGBE"},
        {"header": "# Made by hand\nSOFTWARE=none\nEXPOSURE=          1.0000000000000\n"},
        # Indented, it is told of another picture, from which this one was made.
        {"header": "\tEXPOSURE=77\n# EXPOSURE=9\n"},
    ],
)
def test_hdr_headers_that_change_nothing(read: Read, options: dict[str, str]) -> None:
    given = mantissas_and_exponents()
    given[0, 1] = 0
    picture = read("a.HDR", by_hand.radiance(given, **options))
    assert (picture == by_hand.radiance_values(given)).all()


@pytest.mark.parametrize(
    ("header", "divisor"),
    [
        # Ward: radiance is the value over all of them multiplied together.
        ("EXPOSURE=2.0\nEXPOSURE=  4\n", (8, 8, 8)),
        ("COLORCORR= 2 1 .5\nEXPOSURE=2\n", (4, 2, 1)),
    ],
)
def test_hdr_of_another_exposure_is_divided_by_it(
    tmp_path: Path, header: str, divisor: tuple[float, ...]
) -> None:
    given = np.tile(np.array([128, 64, 32, 132]), (4, 8, 1))  # 8, 4, 2
    (tmp_path / "a.hdr").write_bytes(by_hand.radiance(given, header=header))
    with pytest.warns(CourseWarning, match="its values are divided by its EXPOSURE and COLORCORR"):
        picture = read_picture(tmp_path / "a.hdr")
    assert (picture == np.array((8, 4, 2)) / divisor).all()
    assert (read_picture(tmp_path / "a.hdr", codes=True) == (8, 4, 2)).all()


@pytest.mark.parametrize("line", ["EXPOSURE=0", "EXPOSURE=bright", "COLORCORR=1 2", "PRIMARIES=1"])
def test_hdr_lines_without_their_numbers_are_refused(
    refusal: Callable[[str, bytes], str], line: str
) -> None:
    told = refusal("a.hdr", by_hand.radiance(mantissas_and_exponents(), header=f"{line}\n"))
    assert f"its {line.partition('=')[0]} is b'" in told


SIZES = "-Y 6 +X 9, -Y 6 -X 9, +Y 6 -X 9, +Y 6 +X 9, +X 9 -Y 6, -X 9 -Y 6, -X 9 +Y 6, +X 9 +Y 6"


@pytest.mark.parametrize("size", SIZES.split(", "))
def test_hdr_pixels_lie_where_its_axes_say(read: Read, size: str) -> None:
    slow, rows, fast, columns = size.split()
    stored = np.zeros((int(rows), int(columns), 4), int)
    for i, j in np.ndindex(stored.shape[:2]):
        place = dict(zip((slow, fast), (i, j), strict=True))
        # Y runs upwards.
        x = place["+X"] if "+X" in place else 8 - place["-X"]
        y = place["-Y"] if "-Y" in place else 5 - place["+Y"]
        stored[i, j] = 128 + x, 128 + y, 128, 136
    picture = read("a.hdr", by_hand.radiance(stored, run_lengths=False, size=size))
    assert picture.shape == (6, 9, 3)
    assert (picture[..., 0] == 128 + np.arange(9)).all()
    assert (picture[..., 1] == 128 + np.arange(6)[:, None]).all()


def test_hdr_in_other_primaries_is_refused(refusal: Callable[[str, bytes], str]) -> None:
    told = refusal("a.hdr", by_hand.radiance(mantissas_and_exponents(), kind="32-bit_rle_xyze"))
    assert "its colours are XYZ (FORMAT=32-bit_rle_xyze); convert it to RGB" in told


# ---------------------------------------------------------------- what can't be read


def good_files() -> dict[str, bytes]:
    """One of each kind."""
    jpeg = io.BytesIO()
    Image.fromarray(codes(3, 8).astype(np.uint8)).save(jpeg, "JPEG")
    return {
        "8.png": by_hand.png(codes(3, 8)),
        "16.png": by_hand.png(codes(3, 16), 16),
        "grey16.png": by_hand.png(codes(1, 16), 16),
        "a.jpg": jpeg.getvalue(),
        "a.exr": by_hand.exr_rgb(np.ones((5, 9, 3), np.float32)),
        "a.hdr": by_hand.radiance(mantissas_and_exponents()),
        "flat.hdr": by_hand.radiance(mantissas_and_exponents(), run_lengths=False),
    }


@pytest.mark.parametrize("name", good_files())
def test_a_file_cut_anywhere_is_refused_without_a_word_elsewhere(
    refusal: Callable[[str, bytes], str], name: str
) -> None:
    content = good_files()[name]
    # The end of a PNG is two check sums of its data and a mark of 12 bytes, which need not be there.
    needed = len(content) - (21 if name.endswith("png") else 1)
    for length in np.linspace(0, needed, 40).astype(int):
        told = refusal(name, content[:length])
        assert told.startswith("not a picture that can be read: ")
        assert len(told.split(": ", 1)[1].split()) > 2, "and why"


def with_wrong_bytes(content: bytes) -> Iterator[bytes]:
    """Every byte turned over, and a few at random turned into others."""
    for place in range(min(len(content), 700)):
        yield content[:place] + bytes((content[place] ^ 255,)) + content[place + 1 :]
    rng = np.random.default_rng(5)
    for _ in range(200):
        broken = bytearray(content)
        for place in rng.integers(0, len(content), rng.integers(1, 5)):
            broken[place] = rng.integers(256)
        yield bytes(broken)


@pytest.mark.filterwarnings("ignore::course.base.errors.CourseWarning")
@pytest.mark.parametrize("name", good_files())
def test_a_file_with_wrong_bytes_is_read_or_refused_without_a_word_elsewhere(
    tmp_path: Path, capfd: pytest.CaptureFixture[str], name: str
) -> None:
    path = tmp_path / name
    refused = []
    for content in with_wrong_bytes(good_files()[name]):
        path.write_bytes(content)
        try:
            picture = read_picture(path)
            assert np.isfinite(picture).all()
            assert (picture >= 0).all()
        except SceneError as error:
            refused.append(str(error))
    assert refused
    assert all(re.fullmatch(f"{re.escape(str(path))}: .+", told) for told in refused)
    assert not any("codec" in told for told in refused), "Python's own trouble with the message"
    assert capfd.readouterr() == ("", "")


@pytest.mark.parametrize("bits", [8, 16])
@pytest.mark.parametrize("stream", [b"", b"\0" * 100, b"x\x9c" + b"\xff" * 100])
def test_a_png_of_no_compressed_data_is_refused(
    refusal: Callable[[str, bytes], str], bits: int, stream: bytes
) -> None:
    # All its check sums are right.
    content = by_hand.png(codes(3, bits), bits, stream=stream)
    assert "not a picture that can be read: " in refusal("a.png", content)


@pytest.mark.parametrize("suffix", [".png", ".jpg", ".exr", ".hdr", ".tga", ""])
def test_what_is_no_picture_at_all(refusal: Callable[[str, bytes], str], suffix: str) -> None:
    for content in (b"", b"\0", b"not a picture\n" * 50, bytes(range(256)) * 4):
        assert "not a picture that can be read: " in refusal(f"a{suffix}", content)


@pytest.mark.parametrize("suffix", [".exr", ".hdr"])
def test_codes_are_not_taken_for_radiance(
    refusal: Callable[[str, bytes], str], suffix: str
) -> None:
    for bits in (8, 16):
        told = refusal(f"a{suffix}", by_hand.png(codes(3, bits), bits))
        assert "it begins neither as EXR nor as HDR" in told


@pytest.mark.parametrize("name", ["a.png", "a.exr", "a.hdr"])
def test_a_missing_file_or_a_folder_is_told(tmp_path: Path, name: str) -> None:
    path = tmp_path / name
    with pytest.raises(SceneError, match=f"^{re.escape(str(path))}: no such file$"):
        read_picture(path)
    path.mkdir()
    with pytest.raises(SceneError, match=f"^{re.escape(str(path))}: is a folder: expected a pic"):
        read_picture(path)


@pytest.mark.parametrize("value", [math.nan, -math.inf])
@pytest.mark.parametrize("dtype", [np.float32, np.float16])
def test_a_value_that_light_cannot_have_is_told_with_its_place(
    refusal: Callable[[str, bytes], str], value: float, dtype: type
) -> None:
    picture = np.ones((5, 9, 3), dtype)
    picture[3, 7, 1] = picture[4, 0, 0] = value
    told = refusal("a.exr", by_hand.exr_rgb(picture))
    assert told.startswith("the pixel in column 7, row 3 is not a number, or less than any: mend")


def test_a_png_header_that_is_too_long_is_refused_in_silence(
    refusal: Callable[[str, bytes], str],
) -> None:
    # Pillow reads the 13 bytes that it needs, and its check sum is right; libpng prints that it is too long.
    right = by_hand.png(codes(3, 16), 16)
    header = b"IHDR" + right[16:29] + b"\0"
    longer = struct.pack(">I", 14) + header + struct.pack(">I", zlib.crc32(header))
    assert "its header is corrupt" in refusal("a.png", right[:8] + longer + right[33:])


@pytest.mark.parametrize("name", ["8.png", "16.png", "a.jpg", "a.exr", "a.hdr"])
def test_more_pixels_than_are_allowed_are_refused_before_they_are_read(
    tmp_path: Path, name: str
) -> None:
    path = tmp_path / name
    path.write_bytes(good_files()[name])
    height, width = read_picture(path).shape[:2]
    told = f"{width} x {height} are more than {width * height - 1} pixels; limits.pixels in the sc"
    with pytest.raises(SceneError, match=told):
        read_picture(path, pixels=InputLimit(width * height - 1, "limits.pixels"))
    read_picture(path, pixels=InputLimit(width * height))


def test_pixels_are_bounded_by_the_scene_and_not_by_pillow(
    read: Read, monkeypatch: pytest.MonkeyPatch
) -> None:
    # Pillow refuses twice as many as this.
    monkeypatch.setattr(Image, "MAX_IMAGE_PIXELS", 20)
    # One picture of 48 pixels is read in strips of whole rows, which are smaller than that.
    monkeypatch.setattr("course.engine.formats.pictures.mending.STRIP", 8)
    assert read("a.png", by_hand.png(codes(3, 8))).shape == (6, 8, 3)
    assert Image.MAX_IMAGE_PIXELS == 20
