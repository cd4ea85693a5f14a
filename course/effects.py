"""The plug-in point: the folder whose functions the renderer calls for each effect.

An ``Effects`` object is made once, passed down to whoever calls a function, and imports a module when the first
function of it is asked for. A scene that doesn't use an effect never imports its module.
"""

from __future__ import annotations

import sys
from collections.abc import Callable
from importlib.util import module_from_spec, spec_from_file_location
from pathlib import Path
from types import ModuleType
from typing import Any

from course.errors import EffectError

MODULES: dict[str, tuple[str, ...]] = {
    "supersampling": ("regular", "random", "jittered", "gaussian_weights", "resolve"),
    "soft_shadows": (
        "light_grid",
        "point_on_rectangle",
        "point_on_sphere",
        "point_in_ball",
        "point_on_facing_disk",
    ),
    "glossy": (
        "orthonormal_basis",
        "jitter_on_plane",
        "jitter_in_ball",
        "sample_phong_lobe",
        "keep_above",
    ),
    "thin_lens": ("point_on_disk", "lens_rays", "image_distance", "circle_of_confusion"),
    "motion_blur": ("shutter_times", "displacement", "to_object_space"),
    "cube_map": ("face_and_uv", "lookup", "lookup_seamless"),
}
"""Each module that the renderer calls and its functions, in the course's order."""

FURTHER: dict[str, tuple[str, ...]] = {
    "sampling": (
        "disk_by_rejection",
        "disk_by_polar",
        "ball_by_rejection",
        "ball_by_polar",
        "sphere_by_polar",
        "xorshift32",
    ),
    "importance_sampling": (
        "uniform_hemisphere",
        "cosine_hemisphere",
        "cosine_hemisphere_pdf",
        "phong_lobe_pdf",
        "estimate",
        "power_heuristic",
    ),
    "blurred_transparency": ("refract", "jitter_refraction", "fresnel"),
    "adaptive_sampling": ("needs_subdivision", "subdivide"),
    "textures": ("rectangle_uv", "sphere_uv", "triangle_uv", "texture_lookup"),
    "bounding_volumes": ("slab_test", "build", "traverse"),
    "quasi_monte_carlo": ("radical_inverse", "halton", "hammersley", "chain"),
    "path_tracing": ("diffuse_bounce", "throughput", "russian_roulette"),
    "radiosity": ("hemicube_form_factors", "gather", "shoot", "needs_split"),
}
"""Modules that are written and checked like those; few scenes call them, or none."""

COURSE = MODULES | FURTHER
"""All modules of the course."""

PROJECT = Path(__file__).resolve().parent.parent


class Effects:
    """The student-facing functions, from one folder of ``NAME.py`` files.

    Parameters
    ----------
    folder : where the modules are; ``solutions`` and ``assignments`` mean the project's own folders. None means the
        solutions where they are, and else the assignments.

    Raises
    ------
    EffectError
        When the folder doesn't exist.
    """

    def __init__(self, folder: str | Path | None = None) -> None:
        if folder is None:
            # A student's copy has no solutions.
            folder = "solutions" if (PROJECT / "solutions").is_dir() else "assignments"
        path = Path(folder)
        if str(folder) in ("solutions", "assignments") and not path.is_dir():
            path = PROJECT / path
        if not path.is_dir():
            raise EffectError(
                f"no folder {path} with effect functions; --effects takes solutions, assignments or a folder"
            )
        self.folder = path
        self._modules: dict[str, ModuleType] = {}

    @property
    def imported(self) -> tuple[str, ...]:
        """Names of the modules that have been needed so far."""
        return tuple(self._modules)

    def function(self, module: str, name: str) -> Callable[..., Any]:
        """One function of a module, importing the module if this is its first.

        Raises
        ------
        EffectError
            When the file or the function is missing or the file can't be imported.
        """
        function = getattr(self._module(module), name, None)
        if not callable(function):
            raise EffectError(f"{self.folder / module}.py has no function {name}")
        return function  # type: ignore[no-any-return]

    def _module(self, name: str) -> ModuleType:
        if name not in self._modules:
            self._modules[name] = _import_file(self.folder / f"{name}.py")
        return self._modules[name]


def _import_file(path: Path) -> ModuleType:
    """Import a file under a name of its own, so that two folders with equal names don't meet."""
    if not path.is_file():
        raise EffectError(f"{path} is missing; the scene needs its functions")
    name = f"course_effects.{path.parent.name}.{path.stem}"
    spec = spec_from_file_location(name, path)
    if spec is None or spec.loader is None:
        raise EffectError(f"{path} can't be imported")
    module = module_from_spec(spec)
    sys.modules[name] = module
    try:
        spec.loader.exec_module(module)
    except Exception as error:
        del sys.modules[name]
        raise EffectError(f"{path} can't be imported: {type(error).__name__}: {error}") from error
    return module
