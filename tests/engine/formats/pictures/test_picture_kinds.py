"""What a picture says of itself: how it is turned, its primaries and curve, its layers and windows, and odd values."""

import io
import math
import struct
import warnings
from collections.abc import Callable
from pathlib import Path

import numpy as np
import OpenImageIO
import pytest
from numpy.typing import NDArray
from PIL import Image, ImageCms

from course.base.errors import CourseWarning, SceneError
from course.engine.formats.pictures.reading import read_picture
from tests.engine.formats.pictures import picture_files as by_hand

Array = NDArray[np.generic]

# ---------------------------------------------------------------- orientation

UPRIGHT = np.array([[10, 60, 110], [160, 210, 250]], np.uint8)

STORED: dict[int, Callable[[Array], Array]] = {
    # By where the first row and the first column of what is stored are seen (TIFF 6.0, section 8).
    1: lambda u: u,  # top, left
    2: lambda u: u[:, ::-1],  # top, right
    3: lambda u: u[::-1, ::-1],  # bottom, right
    4: lambda u: u[::-1],  # bottom, left
    5: lambda u: u.T,  # left, top
    6: lambda u: u[:, ::-1].T,  # right, top
    7: lambda u: u[::-1, ::-1].T,  # right, bottom
    8: lambda u: u[::-1].T,  # left, bottom
}


def turned_file(kind: str, turned: int) -> bytes:
    # Blocks of 16 pixels, which JPEG keeps apart.
    stored = np.kron(STORED[turned](UPRIGHT), np.ones((16, 16), np.uint8))
    image = Image.fromarray(stored.astype(np.uint16) * 257 if kind == "PNG16" else stored)
    exif = Image.Exif()
    exif[0x0112] = turned
    options = {"WEBP": {"lossless": True}, "JPEG": {"quality": 100}}.get(kind, {})
    file = io.BytesIO()
    image.save(file, kind.removesuffix("16"), exif=exif, **options)
    return file.getvalue()


@pytest.mark.parametrize("turned", STORED)
@pytest.mark.parametrize("kind", ["JPEG", "PNG", "WEBP", "TIFF", "PNG16"])
def test_a_picture_stands_upright(tmp_path: Path, kind: str, turned: int) -> None:
    (tmp_path / "a").write_bytes(turned_file(kind, turned))
    picture = read_picture(tmp_path / "a", codes=True)
    assert picture.shape == (32, 48, 3)
    assert picture.flags.c_contiguous
    np.testing.assert_allclose(picture[8::16, 8::16, 0] * 255, UPRIGHT, atol=2)


# ---------------------------------------------------------------- primaries and curves

AP0 = (0.7347, 0.2653, 0.0, 1.0, 0.0001, -0.077, 0.32168, 0.33767)
P3 = (0.68, 0.32, 0.265, 0.69, 0.15, 0.06, 0.3127, 0.329)
# As the Academy and Apple publish them, white adapted.
AP0_TO_REC709 = [[2.5217, -1.1341, -0.3876], [-0.2765, 1.3727, -0.0962], [-0.0154, -0.1530, 1.1684]]
P3_TO_REC709 = [[1.2249, -0.2249, 0.0], [-0.0420, 1.0420, 0.0], [-0.0197, -0.0786, 1.0983]]


def exr(colour: tuple[float, ...], **more: object) -> bytes:
    planes = {name: np.full((4, 6), x, np.float32) for name, x in zip("RGB", colour, strict=True)}
    return by_hand.exr(planes, **more)  # type: ignore[arg-type]


@pytest.mark.parametrize(("given", "matrix"), [(AP0, AP0_TO_REC709), (P3, P3_TO_REC709)])
@pytest.mark.parametrize("colour", [(0.5, 0.4, 0.3), (0.18, 0.18, 0.18), (0.3, 0.4, 0.35)])
def test_exr_of_other_primaries_becomes_rec_709(
    tmp_path: Path,
    given: tuple[float, ...],
    matrix: list[list[float]],
    colour: tuple[float, ...],
) -> None:
    (tmp_path / "a.exr").write_bytes(exr(colour, chromaticities=given))
    picture = read_picture(tmp_path / "a.exr")
    np.testing.assert_allclose(picture[2, 3], np.array(matrix) @ colour, atol=1e-3)
    # Numbers that are no colours stay what they are.
    assert (read_picture(tmp_path / "a.exr", codes=True) == np.float32(colour)).all()


def test_exr_of_rec_709_stays_bit_for_bit(tmp_path: Path) -> None:
    given = (0.64, 0.33, 0.3, 0.6, 0.15, 0.06, 0.3127, 0.329)
    (tmp_path / "a.exr").write_bytes(exr((0.1, 0.2, 0.7), chromaticities=given))
    assert (read_picture(tmp_path / "a.exr") == np.float32((0.1, 0.2, 0.7))).all()


def test_colours_beyond_rec_709_are_told(tmp_path: Path) -> None:
    (tmp_path / "a.exr").write_bytes(exr((0, 1, 0), chromaticities=AP0))
    with pytest.warns(
        CourseWarning, match="pixels that are negative: 24, down to -1.13 in column 0, row 0"
    ):
        picture = read_picture(tmp_path / "a.exr")
    np.testing.assert_allclose(picture[0, 0], [0, 1.3727, 0], atol=1e-3)


@pytest.mark.parametrize("given", [(0.0,) * 8, (0.3, 0.3, 0.4, 0.4, 0.5, 0.5, 0.3, 0.3)])
def test_chromaticities_that_are_none_are_told(tmp_path: Path, given: tuple[float, ...]) -> None:
    (tmp_path / "a.exr").write_bytes(exr((0.1, 0.2, 0.7), chromaticities=given))
    with pytest.warns(CourseWarning, match="its chromaticities aren't heeded"):
        assert (read_picture(tmp_path / "a.exr") == np.float32((0.1, 0.2, 0.7))).all()


def test_primaries_of_a_radiance_file(tmp_path: Path) -> None:
    codes = np.tile(np.array([128, 64, 32, 129]), (4, 8, 1))  # 1, 0.5, 0.25
    line = "PRIMARIES= " + " ".join(map(str, P3)) + "\n"
    (tmp_path / "a.hdr").write_bytes(by_hand.radiance(codes, header=line))
    picture = read_picture(tmp_path / "a.hdr")
    np.testing.assert_allclose(picture[1, 2], np.array(P3_TO_REC709) @ [1, 0.5, 0.25], atol=1e-3)


GREY = np.arange(256).reshape(16, 16, 1).repeat(3, axis=2)


def chrm(xy: tuple[float, ...]) -> bytes:
    return struct.pack(">8I", *(round(x * 100_000) for x in (*xy[6:], *xy[:6])))


def srgb(x: NDArray[np.float64]) -> NDArray[np.float64]:
    return np.where(x <= 0.04045, x / 12.92, ((x + 0.055) / 1.055) ** 2.4)


def bt709(x: NDArray[np.float64]) -> NDArray[np.float64]:
    return np.where(x < 0.081, x / 4.5, ((x + 0.099) / 1.099) ** (1 / 0.45))


CURVES = {
    "gAMA of linear": ({"gAMA": struct.pack(">I", 100_000)}, lambda x: x),
    "gAMA of 1.8": ({"gAMA": struct.pack(">I", 55_556)}, lambda x: x ** (100_000 / 55_556)),
    "gAMA beside sRGB": ({"gAMA": struct.pack(">I", 45_455)}, srgb),
    "sRGB before gAMA": ({"sRGB": b"\0", "gAMA": struct.pack(">I", 100_000)}, srgb),
    "cICP of linear": ({"cICP": bytes((1, 8, 0, 1)), "sRGB": b"\0"}, lambda x: x),
    "cICP of sRGB": ({"cICP": bytes((1, 13, 0, 1)), "gAMA": struct.pack(">I", 100_000)}, srgb),
    "cICP of BT.709": ({"cICP": bytes((1, 1, 0, 1))}, bt709),
    "grey of other primaries": ({"cHRM": chrm(P3)}, srgb),
    "cICP of P3, grey": ({"cICP": bytes((12, 13, 0, 1))}, srgb),
}


@pytest.mark.parametrize("bits", [8, 16])
@pytest.mark.parametrize(("chunks", "curve"), CURVES.values(), ids=CURVES.keys())
def test_png_codes_mean_what_its_chunks_say(
    tmp_path: Path,
    chunks: dict[str, bytes],
    curve: Callable[[NDArray[np.float64]], NDArray[np.float64]],
    bits: int,
) -> None:
    codes = GREY * (257 if bits == 16 else 1)
    (tmp_path / "a.png").write_bytes(by_hand.png(codes, bits, more=chunks))
    picture = read_picture(tmp_path / "a.png")
    np.testing.assert_allclose(picture, curve(GREY / 255.0), rtol=2e-6, atol=1e-6)
    shares = read_picture(tmp_path / "a.png", codes=True)
    np.testing.assert_allclose(shares, GREY / 255.0, rtol=1e-6)


@pytest.mark.parametrize("chunks", [{"cHRM": chrm(P3)}, {"cICP": bytes((12, 13, 0, 1))}])
def test_png_of_p3_becomes_rec_709(tmp_path: Path, chunks: dict[str, bytes]) -> None:
    codes = np.tile(np.array([200, 150, 100]), (4, 4, 1))
    (tmp_path / "a.png").write_bytes(by_hand.png(codes, more=chunks))
    expected = np.array(P3_TO_REC709) @ srgb(np.array([200, 150, 100]) / 255)
    np.testing.assert_allclose(read_picture(tmp_path / "a.png")[0, 0], expected, atol=1e-3)
    codes[0, 0] = 255, 0, 0
    (tmp_path / "a.png").write_bytes(by_hand.png(codes, more=chunks))
    with pytest.warns(CourseWarning, match="pixels of colours that sRGB hasn't: 1"):
        assert read_picture(tmp_path / "a.png")[0, 0].tolist() == [1, 0, 0]


@pytest.mark.parametrize(
    ("content", "told"),
    [
        (bytes((9, 16, 0, 1)), "its codes are PQ, transfer 16 of cICP; save it as sRGB, or EXR"),
        (bytes((9, 18, 0, 1)), "HLG, transfer 18"),
        (bytes((1, 13, 1, 1)), "its colours are 1 13 1 1 of cICP"),
        (bytes((1, 13, 0, 0)), "its colours are 1 13 0 0 of cICP"),
        (bytes((77, 13, 0, 1)), "its colours are 77 13 0 1 of cICP"),
        (b"abc", "its cICP is corrupt"),
    ],
)
def test_png_codings_that_are_not_known_are_refused(
    tmp_path: Path, content: bytes, told: str
) -> None:
    (tmp_path / "a.png").write_bytes(by_hand.png(GREY, more={"cICP": content}))
    with pytest.raises(SceneError, match=told):
        read_picture(tmp_path / "a.png")


@pytest.mark.parametrize("kind", ["JPEG", "PNG", "WEBP", "TIFF"])
def test_a_profile_of_srgb_changes_nothing(tmp_path: Path, kind: str) -> None:
    profile = ImageCms.ImageCmsProfile(ImageCms.createProfile("sRGB")).tobytes()
    image = Image.new("RGB", (8, 8), (200, 120, 40))
    files = []
    for more in ({}, {"icc_profile": profile}):
        image.save(tmp_path / "a", kind, **more)
        files.append(read_picture(tmp_path / "a"))
    np.testing.assert_array_equal(*files)


def test_a_profile_that_cannot_be_followed_is_told(tmp_path: Path) -> None:
    image = Image.new("RGB", (8, 8), (200, 120, 40))
    image.save(tmp_path / "a.png", icc_profile=b"no profile at all")
    with pytest.warns(CourseWarning, match="its ICC profile isn't heeded, and colours taken for"):
        read_picture(tmp_path / "a.png")


@pytest.mark.parametrize(("space", "told"), [(65535, True), (2, True), (1, False), (None, False)])
def test_colours_that_exif_says_are_others_are_told(
    tmp_path: Path, space: int | None, told: bool
) -> None:
    exif = Image.Exif()
    exif.get_ifd(0x8769).update({} if space is None else {0xA001: space})
    Image.new("RGB", (8, 8), (200, 120, 40)).save(tmp_path / "a.jpg", exif=exif)
    with warnings.catch_warnings(record=True) as said:
        warnings.simplefilter("always")
        read_picture(tmp_path / "a.jpg")
        read_picture(tmp_path / "a.jpg", codes=True)
    assert ["aren't sRGB's by its Exif data" in str(each.message) for each in said] == [True] * told


def alpha_of(kind: str, opaque: bool) -> bytes:
    """A picture of 6 x 4 pixels of which one is half transparent, or whose alpha is 1 everywhere."""
    codes = np.tile(np.array([200, 120, 40, 255], np.uint8), (4, 6, 1))
    codes[2, 3] = 200, 120, 41, 255 if opaque else 128
    if kind == "a colour":
        return by_hand.png(
            codes[..., :3], more={"tRNS": struct.pack(">3H", 200, 120, 50 - 9 * (not opaque))}
        )
    if kind == "a palette":
        palette = np.array([(1, 2, 3), (4, 5, 6), (7, 8, 9)])
        # Of its three entries the last, which is transparent, has a pixel or none.
        places = np.zeros((4, 6, 1), np.uint8)
        places[2, 3] = 1 if opaque else 2
        return by_hand.png(places, palette=palette, more={"tRNS": bytes((255, 255, 0))})
    if kind == "grey":
        return by_hand.png(codes[..., 2:])
    if kind == "16 bits":
        return by_hand.png(codes.astype(int) * 257, 16)
    file = io.BytesIO()
    Image.fromarray(codes).save(file, kind, **({"lossless": True} if kind == "WEBP" else {}))
    return file.getvalue()


@pytest.mark.parametrize("opaque", [False, True])
@pytest.mark.parametrize(
    "kind", ["PNG", "WEBP", "TIFF", "TGA", "grey", "16 bits", "a palette", "a colour"]
)
def test_alpha_is_told_where_it_is_not_one(tmp_path: Path, kind: str, opaque: bool) -> None:
    (tmp_path / "a").write_bytes(alpha_of(kind, opaque))
    with warnings.catch_warnings(record=True) as said:
        warnings.simplefilter("always")
        read_picture(tmp_path / "a")
    assert len(said) == (not opaque)
    assert opaque or "its alpha is left out: all of it is opaque" in str(said[0].message)


@pytest.mark.parametrize("magic", [b"II*\0", b"MM\0*", b"II+\0"])
def test_a_tiff_that_is_not_read_is_not_called_another_file(tmp_path: Path, magic: bytes) -> None:
    (tmp_path / "a.tif").write_bytes(magic + bytes(60))
    with pytest.raises(SceneError, match="it is a TIFF, but not of whole numbers of 8 or 16 bits"):
        read_picture(tmp_path / "a.tif")


# ---------------------------------------------------------------- odd values


@pytest.mark.parametrize("dtype", [np.float32, np.float16])
def test_infinite_and_negative_values_are_mended_with_one_warning(
    tmp_path: Path, dtype: type
) -> None:
    picture = np.ones((5, 9, 3), dtype)
    picture[3, 7, 1] = picture[3, 8] = np.inf
    picture[2, 4, 2], picture[0, 0, 0] = -0.5, -1e-4
    (tmp_path / "a.exr").write_bytes(by_hand.exr_rgb(picture))
    with warnings.catch_warnings(record=True) as said:
        warnings.simplefilter("always")
        found = read_picture(tmp_path / "a.exr")
    assert len(said) == 1
    assert str(said[0].message).split(": ", 1)[1] == (
        "pixels that are infinite: 2, taken for 65504; pixels that are negative: 2, down to -0.5 in column 4, row 2,"
        " taken for 0"
    )
    expected = np.where(np.isinf(picture), 65504, np.maximum(picture, 0)).astype(np.float32)
    assert (found == expected).all()


def test_what_is_infinite_is_no_less_than_the_rest(tmp_path: Path) -> None:
    picture = np.full((5, 9, 3), 1e6, np.float32)
    picture[0, 0] = np.inf
    (tmp_path / "a.exr").write_bytes(by_hand.exr_rgb(picture))
    with pytest.warns(CourseWarning, match="pixels that are infinite: 1, taken for 1e.06"):
        assert (read_picture(tmp_path / "a.exr") == 1e6).all()


# ---------------------------------------------------------------- layers, parts, windows


def planes(prefix: str, value: float) -> dict[str, Array]:
    values = {"R": value, "G": value / 2, "B": value / 4}
    return {f"{prefix}{name}": np.full((4, 6), x, np.float32) for name, x in values.items()}


def colour(picture: NDArray[np.float32]) -> float:
    assert (picture == picture[0, 0]).all()
    assert (picture[0, 0] * [1, 2, 4] == picture[0, 0, 0]).all()
    return float(picture[0, 0, 0])


DEPTH = {"ViewLayer.Depth.Z": np.ones((4, 6), np.float32)}


@pytest.mark.parametrize(
    ("channels", "layer", "value"),
    [
        (planes("ViewLayer.Combined.", 1), None, 1),
        (planes("ViewLayer.Combined.", 1) | DEPTH, None, 1),
        (
            planes("ViewLayer.Combined.", 1) | planes("ViewLayer.DiffCol.", 2),
            "ViewLayer.DiffCol",
            2,
        ),
        (planes("", 3) | planes("side.", 2), None, 3),
        (planes("", 3) | planes("side.", 2), "side", 2),
        ({k.lower(): v for k, v in planes("Combined.", 1).items()}, None, 1),
        (dict(zip(("red", "green", "blue"), planes("", 1).values(), strict=True)), None, 1),
        ({"a.R": np.ones((4, 6), np.float32)} | planes("b.", 2), None, 2),
    ],
)
def test_the_layer_is_the_one_of_a_name_or_the_only_one(
    tmp_path: Path, channels: dict[str, Array], layer: str | None, value: float
) -> None:
    (tmp_path / "a.exr").write_bytes(by_hand.exr(channels))
    assert colour(read_picture(tmp_path / "a.exr", layer=layer)) == value


def test_several_layers_or_a_wrong_name_are_told(tmp_path: Path) -> None:
    (tmp_path / "a.exr").write_bytes(by_hand.exr(planes("a.", 1) | planes("b.c.", 2)))
    with pytest.raises(SceneError, match=r"it has the layers a, b\.c: name one of them by layer"):
        read_picture(tmp_path / "a.exr")
    with pytest.raises(SceneError, match=r"it has no layer 'c'; it has a, b\.c"):
        read_picture(tmp_path / "a.exr", layer="c")
    (tmp_path / "a.png").write_bytes(by_hand.png(GREY))
    with pytest.raises(SceneError, match="it has no layer 'c'; only an EXR file has layers"):
        read_picture(tmp_path / "a.png", layer="c")


def vectors(prefix: str) -> dict[str, Array]:
    return {f"{prefix}{axis}": np.full((4, 6), 9, np.float32) for axis in "XYZ"}


@pytest.mark.parametrize(
    ("channels", "told"),
    [
        (vectors(""), "channels X, Y, Z, not R, G and B, or Y; save colours as R, G and B"),
        (vectors("ViewLayer.Normal."), r"channels ViewLayer\.Normal\.X, .*, not R, G and B"),
        ({"R": np.ones((4, 6), np.float32)}, "channels R, not R, G and B, or Y; .* grey as Y"),
    ],
)
def test_what_has_no_colours_is_refused_with_a_remedy(
    tmp_path: Path, channels: dict[str, Array], told: str
) -> None:
    (tmp_path / "a.exr").write_bytes(by_hand.exr(channels))
    with pytest.raises(SceneError, match=told):
        read_picture(tmp_path / "a.exr")


def test_vectors_beside_colours_are_no_layer_of_these(tmp_path: Path) -> None:
    both = planes("Combined.", 2) | vectors("Normal.")
    (tmp_path / "a.exr").write_bytes(by_hand.exr(both))
    assert colour(read_picture(tmp_path / "a.exr")) == 2
    with pytest.raises(
        SceneError, match=r"its layer 'Normal' has the channels Normal\.X, .*, not R"
    ):
        read_picture(tmp_path / "a.exr", layer="Normal")


@pytest.mark.parametrize("beside", [{}, {"Z": np.full((4, 6), 7, np.float32)}])
def test_a_luminance_is_grey_with_a_depth_or_without(
    tmp_path: Path, beside: dict[str, Array]
) -> None:
    (tmp_path / "a.exr").write_bytes(by_hand.exr({"Y": np.full((4, 6), 3, np.float32)} | beside))
    assert (read_picture(tmp_path / "a.exr") == 3).all()


def parts(path: Path, *listed: tuple[str, tuple[str, ...], float]) -> None:
    """An EXR file of several parts: the name of each, its channels, and the first one's value."""
    specs = []
    for name, channels, _ in listed:
        spec = OpenImageIO.ImageSpec(6, 4, len(channels), "float")
        spec.channelnames = channels
        spec.attribute("oiio:subimagename", name)
        specs.append(spec)
    file = OpenImageIO.ImageOutput.create("openexr")
    assert file.open(str(path), specs)
    for number, (_, channels, value) in enumerate(listed):
        if number:
            assert file.open(str(path), specs[number], "AppendSubimage")
        rows = np.empty((4, 6, len(channels)), np.float32)
        rows[:] = [value / 2**k for k in range(len(channels))]
        assert file.write_image(rows)
    assert file.close()


def test_colours_in_the_second_part_are_found(tmp_path: Path) -> None:
    path = tmp_path / "a.exr"
    parts(path, ("depth", ("Z",), 9), ("beauty", ("R", "G", "B"), 2))
    assert colour(read_picture(path)) == 2


def test_parts_have_names(tmp_path: Path) -> None:
    path = tmp_path / "a.exr"
    parts(path, ("left", ("R", "G", "B"), 1), ("right", ("R", "G", "B"), 2))
    assert colour(read_picture(path, layer="right")) == 2
    with pytest.warns(CourseWarning, match=r"several pictures \(left, right\), and the first is"):
        assert colour(read_picture(path)) == 1


@pytest.mark.parametrize("shift", [(2, 1), (-2, -1), (0, 0), (3, -2)])
def test_a_data_window_lies_where_it_belongs(tmp_path: Path, shift: tuple[int, int]) -> None:
    rows = np.random.default_rng(1).random((4, 6, 3)).astype(np.float32)
    channels = {name: rows[..., k].copy() for k, name in enumerate("RGB")}
    (tmp_path / "a.exr").write_bytes(by_hand.exr(channels, shift, shown=(7, 5)))
    picture = read_picture(tmp_path / "a.exr")
    assert picture.shape == (5, 7, 3)
    for y in range(5):
        for x in range(7):
            column, row = x - shift[0], y - shift[1]
            inside = 0 <= column < 6 and 0 <= row < 4
            assert (picture[y, x] == (rows[row, column] if inside else 0)).all()


def test_windows_that_do_not_meet_and_huge_ones_are_refused(tmp_path: Path) -> None:
    path = tmp_path / "a.exr"
    path.write_bytes(by_hand.exr(planes("", 1), (50, 50)))
    with pytest.raises(SceneError, match="its data window lies outside of its display window"):
        read_picture(path)
    path.write_bytes(by_hand.exr(planes("", 1), shown=(1 << 20, 1 << 20)))
    with pytest.raises(SceneError, match="1048576 x 1048576 are more than 134,217,728 pixels"):
        read_picture(path)


@pytest.mark.parametrize("samples", [1, 2])
def test_deep_pictures_are_refused(tmp_path: Path, samples: int) -> None:
    """Read as others, they have zeros where several colours lie one behind the other."""
    names = ("R", "G", "B", "A")
    spec = OpenImageIO.ImageSpec(6, 4, 4, "half")
    spec.channelnames, spec.deep = names, True
    deep = OpenImageIO.DeepData()
    deep.init(24, 4, ["half"] * 4, list(names))
    for pixel in range(24):
        deep.set_samples(pixel, samples)
        for number in range(samples):
            for channel in range(4):
                deep.set_deep_value(pixel, channel, number, 0.5)
    file = OpenImageIO.ImageOutput.create("openexr")
    assert file.open(str(tmp_path / "a.exr"), spec)
    assert file.write_deep_image(deep)
    assert file.close()
    with pytest.raises(SceneError, match=r"a.exr: .*it is deep, .* flatten it where"):
        read_picture(tmp_path / "a.exr")


def test_of_cubes_no_face_is_taken_for_the_whole_sky(tmp_path: Path) -> None:
    """Their display window is the first of six faces."""
    rows = {name: np.random.default_rng(1).random((24, 4)).astype(np.float32) for name in "RGB"}
    path = tmp_path / "a.exr"
    path.write_bytes(by_hand.exr(rows, shown=(4, 4), envmap=1))
    with pytest.raises(SceneError, match=r"a.exr: .*it is a cube map, of six .* by longitude and"):
        read_picture(path)
    path.write_bytes(by_hand.exr(rows, envmap=0))
    assert (read_picture(path) == np.stack(list(rows.values()), axis=-1)).all()


def test_films_are_told(tmp_path: Path) -> None:
    frames = [Image.new("L", (8, 8), k * 100) for k in range(3)]
    frames[0].save(tmp_path / "a.gif", save_all=True, append_images=frames[1:])
    with pytest.warns(CourseWarning, match="it has 3 pictures, and the first is taken"):
        assert read_picture(tmp_path / "a.gif").max() == 0


def test_a_profile_of_phones_is_followed(tmp_path: Path) -> None:
    """A matrix profile of P3 with gamma 1, made by hand (ICC.1:2010): its XYZ are those of D50."""
    # Columns of P3 in XYZ of D50, as Apple's profile has them.
    columns = {"rXYZ": (0.51512, 0.2412, -0.00105), "gXYZ": (0.29198, 0.69225, 0.04189)}
    columns |= {"bXYZ": (0.1571, 0.06657, 0.78407), "wtpt": (0.96420, 1.0, 0.82491)}

    def fixed(x: float) -> bytes:
        return struct.pack(">i", round(x * 65536))

    text = b"Display P3, linear"
    described = b"desc" + bytes(4) + struct.pack(">I", len(text) + 1) + text + bytes(1 + 78)
    tags = {name: b"XYZ " + bytes(4) + b"".join(map(fixed, xyz)) for name, xyz in columns.items()}
    tags |= {f"{c}TRC": b"curv" + bytes(8) for c in "rgb"}
    tags |= {"desc": described, "cprt": b"text" + bytes(4) + b"none\0"}
    table, content = struct.pack(">I", len(tags)), b""
    first = 128 + 4 + 12 * len(tags)
    for name, data in tags.items():
        data += b"\0" * (-len(data) % 4)
        table += name.encode() + struct.pack(">II", first + len(content), len(data))
        content += data
    body = table + content
    head = struct.pack(
        ">I4s4s4s4s4s12s4s",
        128 + len(body),
        bytes(4),
        b"\2\x40\0\0",
        b"mntr",
        b"RGB ",
        b"XYZ ",
        bytes(12),
        b"acsp",
    )
    head += bytes(28) + fixed(0.9642) + fixed(1) + fixed(0.82491)
    profile = head.ljust(128, b"\0") + body
    Image.new("RGB", (8, 8), (128, 77, 51)).save(tmp_path / "a.png", icc_profile=profile)
    found = read_picture(tmp_path / "a.png")[4, 4]
    expected = np.array(P3_TO_REC709) @ (np.array([128, 77, 51]) / 255)
    # A code of 8 bits near here is worth 0.007 at most.
    np.testing.assert_allclose(found, expected, atol=0.007)
    assert math.isclose(expected[0], 0.547, abs_tol=0.001)
