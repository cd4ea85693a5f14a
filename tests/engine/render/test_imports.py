"""A small scene pays for nothing that it doesn't use: what its process imports."""

import json
import os
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

from tests.processes import python

ROOT = Path(__file__).parents[3]
THIS_CHECKOUT = {**os.environ, "PYTHONPATH": str(ROOT)}
NEVER = {"skimage", "scipy", "trimesh", "psutil", "rich", "networkx", "hypothesis"}
"""Too heavy, and of no use for a scene of named shapes."""

OTHER_MODES = {
    *(
        "course.engine.render.adaptive.rounds",
        "course.engine.render.adaptive.allocation",
        "course.engine.render.adaptive.audit",
    ),
    *("course.engine.render.adaptive.schedule", "course.engine.render.adaptive.film"),
    *(
        "course.engine.render.adaptive.subdivision",
        "course.engine.render.adaptive.corners",
        "course.engine.render.cluster.executor",
    ),
}
"""Ways to render that this scene doesn't ask for."""

BOX: dict[str, Any] = {
    "camera": {"eye": [1, 2, 4], "look_at": [0, 0, 0]},
    "film": {"width": 64, "height": 64},
    "materials": {"grey": {}},
    "lights": [{"type": "point", "position": [2, 4, 3], "intensity": 50}],
    "objects": [{"shape": "box", "material": "grey"}],
}


OF_A_KEY = {
    *(
        "course.engine.terms.lights.spot_light",
        "course.engine.terms.surfaces.normal_maps",
        "course.engine.terms.surfaces.perlin",
    ),
    *("course.engine.terms.samplers.blue_noise", "course.engine.terms.denoising"),
}
"""What one key of a scene asks for."""


def imported(folder: Path, scene: str, *options: str) -> set[str]:
    """Every module that `python -m course render` of a scene file imports, by its full name."""
    line = ("-X", "importtime", "-m", "course", "render", scene, *options)
    done = python(*line, folder=folder)
    lines = [line for line in done.stderr.splitlines() if line.startswith("import time:")]
    return {line.rpartition("|")[2].strip() for line in lines}


def roots(modules: set[str]) -> set[str]:
    return {name.partition(".")[0] for name in modules}


def test_one_box_imports_no_heavy_library_and_no_module_of_effects_it_does_not_call(
    tmp_path: Path,
) -> None:
    (tmp_path / "box.yaml").write_text(json.dumps(BOX), encoding="utf-8")
    modules = imported(tmp_path, "box.yaml")
    assert (tmp_path / "box.png").exists()
    assert {"numpy", "embreex", "course"} <= roots(modules), "the list is the right one"
    assert not roots(modules) & NEVER
    assert "course.engine.core.schedule" in modules
    assert not modules & OTHER_MODES
    # No random number is drawn, no mesh read, no EXR written.
    assert not modules & {
        "numpy.random",
        "course.engine.formats.meshes.files",
        "OpenImageIO",
        "jsonschema",
    }


@pytest.mark.parametrize("name", ["textures", "soft_shadows"])
def test_what_a_key_asks_for_is_imported_for_scenes_that_have_it(tmp_path: Path, name: str) -> None:
    scene = str(ROOT / "scenes" / f"{name}.yaml")
    modules = imported(tmp_path, scene, "--spp", "1", "--size", "8x8")
    assert "course.engine.core.schedule" in modules
    assert not modules & OF_A_KEY


@pytest.mark.parametrize(
    ("change", "options", "effects"),
    [
        ({}, ("--spp", "1"), set()),
        (
            {"lights": [{"type": "sphere", "center": [2, 4, 3], "radius": 1, "intensity": 9}]},
            (),
            {"supersampling", "soft_shadows"},
        ),
    ],
)
def test_a_module_of_effects_is_imported_when_the_scene_calls_it(
    tmp_path: Path, change: dict[str, Any], options: tuple[str, ...], effects: set[str]
) -> None:
    (tmp_path / "box.yaml").write_text(json.dumps(BOX | change), encoding="utf-8")
    code = (
        "import json, sys\n"
        "from course.cli.main import commands\n"
        "commands(sys.argv[1:], standalone_mode=False)\n"
        "json.dump([n for n in sys.modules if n.startswith('course_effects')], open('m.json', 'w'))\n"
    )
    arguments = ["render", "box.yaml", *options]
    command = [sys.executable, "-c", code, *arguments]
    subprocess.run(command, cwd=tmp_path, env=THIS_CHECKOUT, check=True)
    names = json.loads((tmp_path / "m.json").read_text())
    assert {name.rpartition(".")[2] for name in names} == effects
