"""Every scene file that comes with the course: it loads, and shows the effect that it is named for.

Each module but radiosity has a pair of scenes, scenes/NAME.yaml and scenes/before/NAME.yaml. The pair differs in
nothing but the effect, so that whoever compares the two pictures sees the effect and nothing else.
"""

import json
import re
import shutil
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from typing import NamedTuple

import numpy as np
import pytest
import yaml

from course import render
from course.cli.tables import summary_sections
from course.engine.formats.meshes.files import read_mesh
from course.engine.formats.pictures.reading import read_picture
from course.engine.functions.effects import Alone
from course.engine.functions.modules import COURSE, MODULES
from course.engine.render.summary import summarize
from course.engine.scene.building.further import KEYS
from course.engine.scene.scene import load_variant
from tests.coarser import coarser
from tests.once import Once

SCENES = Path(__file__).parent.parent / "scenes"
ALL = sorted(SCENES.rglob("*.yaml"))
GALLERY = sorted((SCENES / "gallery").glob("*.yaml"))
EVERYTHING = SCENES / "gallery" / "everything.yaml"

# Which keys may differ between a scene and its twin without the effect.
MAY_DIFFER = {
    "supersampling": r"sampler\.(type|samples)",
    "soft_shadows": r"lights\.0\.(type|radius|(center|position)\.[012])",
    "glossy": r"materials\.[^.]+\.gloss(\..*)?",
    "thin_lens": r"camera\.lens(\..*)?",
    "motion_blur": r"objects\.\d+\.motion(\..*)?",
    "cube_map": r"environment\.(type|cross|radiance\.[012])",
    "sampling": r"(camera\.lens|lights\.[012])\.samples|sampler\.type",
    "importance_sampling": r"environment\.sampling",
    "multiple_importance": r"integrator\.gloss_sampling",
    "environment_light": r"environment\.sampling",
    "microfacets": r"materials\.[^.]+\.(conductor\.roughness|dielectric\.(roughness|distribution))",
    "blurred_transparency": r"materials\.(pane|amber)\.dielectric\.roughness",
    "adaptive_sampling": r"film\.subdivision\..*|sampler\.samples",
    "textures": r"materials\.(floor|globe|vase)\.(color|texture)\..*",
    "bounding_volumes": r"acceleration\..*",
    "quasi_monte_carlo": r"sampler\.type",
    "blue_noise": r"sampler\.type",
    "many_lights": r"integrator\.light_sampling",
    "denoising": r"film\.denoise\..*",
    "film": r"film\.(tone\..*|gamut|dither)",
    "path_tracing": r"integrator\.type",
}


def key_of(module: str) -> str:
    """The key of the scene that asks for a term of its own."""
    scene = yaml.safe_load((SCENES / f"{module}.yaml").read_text(encoding="utf-8"))
    (key,) = scene.keys() & set(KEYS)
    return str(key)


OF_A_KEY = tuple(name for name in COURSE if name not in (*MAY_DIFFER, "radiosity"))
MAY_DIFFER |= {name: rf"{key_of(name)}\..*" for name in OF_A_KEY}

# What the scenes of further modules call; the six core ones choose among theirs, and a key asks for what it needs.
CALLS = {
    "sampling": "ball_by_polar ball_by_rejection disk_by_polar sphere_by_polar xorshift32",
    "importance_sampling": "cosine_hemisphere cosine_hemisphere_pdf",
    "multiple_importance": "cone_density heuristic_weights",
    "environment_light": "cumulate density sample_direction texel_weights",
    "microfacets": "fresnel_complex sample_visible_normal smith_g1 smith_g2",
    "blurred_transparency": "fresnel jitter_refraction refract",
    "adaptive_sampling": "needs_subdivision subdivide",
    "textures": "rectangle_uv sphere_uv texture_lookup triangle_uv",
    "bounding_volumes": "build traverse",
    "quasi_monte_carlo": "chain hammersley",
    "denoising": "critical_value degrees_of_freedom pair_weights squared_bias weighted_mean welch_t",
    "blue_noise": "shuffled_z_order",
    "film": "convert_gamut encode_srgb photographic quantize",
    "many_lights": "light_tree power_choice tree_choice",
    "path_tracing": "diffuse_bounce russian_roulette throughput",
}


class Shown(NamedTuple):
    """What is known of a scene and of a small picture of it: to load it takes most of the time.

    Of meshes that are made here, with few segments but in ``EVERYTHING``.
    """

    brightest: float
    spread: float
    called: list[str]
    """The student functions that the picture calls."""
    needed: list[str]
    """Those that the scene has asked for."""
    imported: list[str]
    said: str
    """What `course info` says."""
    triangles: int
    pieces: int
    """Triangles more, where large ones are cut."""
    reach: float


@pytest.fixture(scope="session")
def rendered(once: Once) -> Callable[[Path], Shown]:
    """Have each scene loaded by one process of this run, for all of them."""

    def shown(path: Path) -> Shown:
        def make(file: Path) -> None:
            file.write_text(json.dumps(_rendered(path)), encoding="utf-8")

        kept = once(f"{'-'.join(path.relative_to(SCENES).parts)}.json", make)
        return Shown(*json.loads(kept.read_text(encoding="utf-8")))

    return shown


def _rendered(path: Path) -> Shown:
    samples = yaml.safe_load(path.read_text(encoding="utf-8")).get("sampler", {}).get("samples", 16)
    # Of the largest scene all triangles are made.
    scene = load_variant(path, {} if path == EVERYTHING else coarser(path))
    picture = render(scene, size=(16, 12), spp=1 if samples == 1 else 4)
    world = scene.compiled
    said = str(summary_sections(summarize(scene)))
    seen = float(picture.linear.max()), float(picture.linear.std())
    needed = [need.function for need in scene.compiled.needs]
    functions = picture.receipt.effects["called"], needed, list(scene.effects.imported)
    of_world = sum(world.triangles), world.pieces, world.frame.reach
    return Shown(*seen, *functions, said, *of_world)


def modules(functions: list[str]) -> set[str]:
    return {function.partition(".")[0] for function in functions}


def leaves(value, path=()):
    """Every value of a document by its path; lists and maps are no values of their own."""
    if isinstance(value, dict | list) and value:
        items = value.items() if isinstance(value, dict) else enumerate(value)
        return {
            key: leaf
            for name, child in items
            for key, leaf in leaves(child, (*path, str(name))).items()
        }
    return {".".join(path): value}


def document(path: Path) -> dict[str, object]:
    """Every value of a scene; files as seen from the folder of the scenes."""
    found = leaves(yaml.safe_load(path.read_text(encoding="utf-8")))
    return {k: v.removeprefix("../") if isinstance(v, str) else v for k, v in found.items()}


@pytest.mark.parametrize("path", ALL, ids=lambda path: str(path.relative_to(SCENES)))
def test_every_scene_renders_to_something_that_is_not_black_and_can_be_described(rendered, path):
    shown = rendered(path)
    assert shown.brightest > 0.05
    assert shown.spread > 0.01
    assert "triangles" in shown.said
    assert "supersampling" in shown.said
    if path.parent == SCENES:
        # Their sizes are ordinary: nothing is cut, and the origin is not put near something small.
        assert (shown.pieces, shown.reach) == (0, 1)


def test_every_module_has_a_pair_of_scenes_but_for_radiosity():
    assert set(MAY_DIFFER) == set(COURSE) - {"radiosity"}
    for name in MAY_DIFFER:
        assert (SCENES / f"{name}.yaml").is_file()
        assert (SCENES / "before" / f"{name}.yaml").is_file()


@pytest.mark.parametrize("name", MAY_DIFFER)
def test_a_modules_scene_calls_it_and_its_twin_does_not(rendered, name):
    after, before = (rendered(SCENES / folder / f"{name}.yaml") for folder in ("", "before"))
    mine = sorted(each for each in after.called if each.startswith(f"{name}."))
    if name in MODULES:
        assert mine
    elif name in OF_A_KEY:
        assert mine
        assert mine == sorted({each for each in after.needed if each.startswith(f"{name}.")})
    else:
        assert mine == [f"{name}.{function}" for function in CALLS[name].split()]
    # Of importance_sampling the twin takes uniform directions.
    if name != "importance_sampling":
        assert name not in modules(before.called) | {*before.imported}


@pytest.mark.parametrize("name", MAY_DIFFER)
def test_a_scene_and_its_twin_differ_in_nothing_but_the_effect(name):
    after, before = document(SCENES / f"{name}.yaml"), document(SCENES / "before" / f"{name}.yaml")
    differing = {
        key
        for key in after.keys() | before.keys()
        if key not in after or key not in before or after[key] != before[key]
    }
    assert differing, "the twins are the same"
    assert {key for key in differing if not re.fullmatch(MAY_DIFFER[name], key)} == set()


def test_the_lamp_without_a_size_stands_in_the_middle_of_the_one_with_a_size():
    after, before = (
        yaml.safe_load((SCENES / folder / "soft_shadows.yaml").read_text(encoding="utf-8"))
        for folder in ("", "before")
    )
    assert before["lights"][0]["position"] == after["lights"][0]["center"]


def test_the_twin_of_the_cube_map_has_its_mean_colour():
    after, before = (
        yaml.safe_load((SCENES / folder / "cube_map.yaml").read_text(encoding="utf-8"))
        for folder in ("", "before")
    )
    cross = read_picture(SCENES / after["environment"]["cross"])
    size = cross.shape[0] // 3
    cells = [(0, 1), (1, 0), (1, 1), (1, 2), (1, 3), (2, 1)]
    faces = [cross[r * size : (r + 1) * size, c * size : (c + 1) * size] for r, c in cells]
    mean = sum(face.mean(axis=(0, 1)) for face in faces) / 6
    assert before["environment"]["radiance"] == pytest.approx(list(mean), abs=0.006)


def test_the_gallery_shows_every_effect(rendered):
    assert len(GALLERY) >= 7
    shown = set().union(*(modules(rendered(path).called) for path in GALLERY))
    assert shown >= set(BRINGS)


HOMAGE = SCENES / "gallery" / "1984.yaml"
BRINGS = (*MODULES, "textures", "film")
"""Modules of which each brings an effect into the picture after 1984."""


def codes(modules, folder):
    """A small picture after 1984 by students who have written some modules, and nothing else."""
    for module in modules:
        shutil.copy(SCENES.parent / "solutions" / f"{module}.py", folder)
    # Its room is coarser here, for it is made anew for each of them.
    scene = load_variant(HOMAGE, {("environment", "size"): 48}, Alone(folder))
    picture = render(scene, size=(64, 36), spp=4)
    return picture.settings.display.codes(picture.shown).astype(int), picture.receipt.effects


def test_1984_begins_without_effects_and_each_module_brings_one(rendered, tmp_path):
    # The numbers are the same in all of these pictures: a module without an effect would change no code.
    plain, told = codes((), tmp_path)
    assert told["yours"] == []
    assert modules(told["called"]) == set(BRINGS) == modules(rendered(HOMAGE).called)
    for module in BRINGS:
        folder = tmp_path / module
        folder.mkdir()
        changed, told = codes((module,), folder)
        assert modules(told["yours"]) == {module}
        assert abs(changed - plain).max() > 8, module


def test_1984_has_five_balls_two_in_motion_several_lamps_and_a_number_on_each():
    scene = yaml.safe_load(HOMAGE.read_text(encoding="utf-8"))
    balls = [each for each in scene["objects"] if each["shape"] == "sphere"]
    assert sorted(ball["name"] for ball in balls) == ["1", "3", "4", "8", "9"]
    assert [ball["name"] for ball in balls if "motion" in ball] == ["4", "3"]
    for ball in balls:
        image = scene["materials"][ball["material"]]["texture"]["image"]
        assert image == f"../billiards/ball_{ball['name']}.png"
        # They lie on the cloth, and none in another.
        *_, last = ball["transform"]
        assert last["translate"][1] == ball.get("radius", 1.0)
    places = np.array([ball["transform"][-1]["translate"] for ball in balls])
    apart = np.linalg.norm(places[:, None] - places, axis=-1)
    assert apart[np.triu_indices(5, 1)].min() > 2
    towards = [np.cross(lamp["edge_u"], lamp["edge_v"]) for lamp in scene["lights"]]
    assert len(towards) == 3
    for lamp, way in zip(scene["lights"], towards, strict=True):
        assert np.dot(way, lamp["corner"]) < 0, "it shines away from the table"


def test_everything_has_every_effect_at_once_on_many_triangles(rendered):
    shown = rendered(EVERYTHING)
    assert modules(shown.called) == set(MODULES)
    assert shown.triangles > 200_000


@pytest.mark.parametrize(
    ("maker", "made"),
    [
        ("environments/make_environments", "sky.exr studio.exr clear_sky.exr valley.png"),
        ("textures/make_materials", "wood.webp boards.webp felt.webp"),
        ("billiards/make_balls", "ball_1.png ball_3.png ball_4.png ball_8.png ball_9.png"),
        ("billiards/make_room", "room.exr"),
        ("tumbler/make_tumbler", "glass.ply water.ply water_in_glass.ply"),
    ],
)
def test_pictures_are_what_their_script_paints(tmp_path, maker, made):
    original = SCENES / f"{maker}.py"
    folder, script = original.parent, tmp_path / original.name
    script.write_text(original.read_text(encoding="utf-8"), encoding="utf-8")
    subprocess.run([sys.executable, script], cwd=SCENES.parent, check=True, timeout=120)
    painted = {path.name for path in tmp_path.iterdir()} - {script.name}
    assert painted == set(made.split())
    for name in painted:
        assert (folder / name).stat().st_size < 300_000
        if name.endswith(".ply"):
            made, kept = (read_mesh(place / name).vertices for place in (tmp_path, folder))
            np.testing.assert_allclose(made, kept, atol=1e-6)
            continue
        # A code of 8 bits or a bit of a half may fall the other way on another machine, where WebP spreads it, too.
        difference = abs(read_picture(folder / name) - read_picture(tmp_path / name))
        assert difference.max() <= (0.05 if name.endswith(".webp") else 0.01)
