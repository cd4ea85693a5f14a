"""A scene, ready to be rendered as often and in as many ways as one likes; and how it is to be rendered."""

import os
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path

from course.base.errors import CourseError, EffectError, SceneError
from course.base.inputs import shown
from course.engine.core import scene as core
from course.engine.formats.pictures.display import SRGB, Display
from course.engine.formats.yaml.description import DenoiseDescription, SubdivisionDescription
from course.engine.formats.yaml.loading import Loaded, load_description
from course.engine.formats.yaml.overriding import Overrides
from course.engine.functions.effects import PROJECT, Effects
from course.engine.functions.given import Given, GivenEffects
from course.engine.functions.modules import meant
from course.engine.scene.building.world import Compiled, compile_scene

Subdivision = SubdivisionDescription
"""The file's settings for dividing pixels."""


Denoising = DenoiseDescription
"""The file's settings for a denoised preview."""


@dataclass(frozen=True)
class SceneSettings(core.Settings):
    """Render settings of a scene.

    Attributes
    ----------
    error : the root-mean-square error [radiance] at which sampling ends; None samples all pixels alike
    display : how a PNG shows the picture
    subdivision : rays through the corners of cells, which are divided by contrast; None takes samples in pixels
    denoise : a PNG shows means over neighbours; None shows the picture as rendered
    shafts : whether compiled loops leave out shadow rays whose answer a shaft tells
    """

    error: float | None = None
    display: Display = SRGB
    subdivision: Subdivision | None = None
    denoise: Denoising | None = None
    shafts: bool = False


@dataclass(frozen=True)
class Scene:
    """A checked and compiled scene file, bound to the functions that render its effects.

    Attributes
    ----------
    loaded : the description, and where each of its values stands
    compiled : the world that rays meet
    effects : the student functions
    """

    loaded: Loaded
    compiled: Compiled
    effects: Effects

    @property
    def path(self) -> Path:
        """The scene file."""
        return self.loaded.path

    @property
    def title(self) -> str:
        """Description of the picture from the file, or the file's name."""
        return self.loaded.description.title or self.loaded.path.stem

    @property
    def settings(self) -> SceneSettings:
        """Render settings of the file."""
        return settings_of(self.loaded)


def settings_of(loaded: Loaded) -> SceneSettings:
    """Render settings of a scene file."""
    scene = loaded.description
    return SceneSettings(
        width=scene.film.width,
        height=scene.film.height,
        sampler=scene.sampler.type,
        samples=scene.sampler.samples,
        seed=scene.seed,
        max_depth=scene.integrator.max_depth,
        cutoff=scene.integrator.cutoff,
        error=scene.film.error,
        display=Display(scene.film.white, scene.film.encoding),
        subdivision=scene.film.subdivision,
        denoise=scene.film.denoise,
    )


Described = Callable[[SceneSettings], None]
"""Called with the settings of a scene that is being loaded."""


def load_scene(
    path: str | Path,
    effects: str | Path | Effects | Given | None = None,
    described: Described = lambda _settings: None,
) -> Scene:
    """Read, check and compile a scene file.

    Parameters
    ----------
    path : the YAML file; or the name of one of the course's scenes, such as "soft_shadows" or "before/soft_shadows"
    effects : whose functions to call: "mine", "solutions", "assignments", or a folder of modules; or functions
        themselves by their names, as in ``{"point_on_sphere": point_on_sphere}``, with the others as by None. None
        means "mine" in a folder made by `course start`, and the solutions elsewhere, where they are.
    described : called when the file has been read and checked, before meshes are read

    Raises
    ------
    SceneError
        The file, or a mesh it names, can't be rendered; the message names file, line and key path.
    EffectError
        The folder of functions or one of its modules is missing, or the course has no function of a name.
    """
    return load_variant(path, None, effects, described)


def load_variant(
    path: str | Path,
    overrides: Overrides | None = None,
    effects: str | Path | Effects | Given | None = None,
    described: Described = lambda _settings: None,
) -> Scene:
    """`load_scene`, with other values at some key paths, such as ``{("lights", 0, "samples"): "ball"}``.

    Raises SceneError, EffectError as `load_scene` does, and for an override of something that isn't there.
    """
    bound = effects_of(effects)
    loaded = load_description(scene_file(path), overrides)
    described(settings_of(loaded))
    return Scene(loaded, compile_scene(loaded, bound), bound)


def check_scene(scene: object, function: str) -> None:
    """Raise CourseError for what is no loaded scene.

    ``function``: that was handed it
    """
    if isinstance(scene, Scene):
        return
    if isinstance(scene, str | Path):
        how = f"{function}(load_scene({str(scene)!r}))"
        raise CourseError(f"{function} takes a scene that is loaded, not its name: {how}")
    raise CourseError(
        f"{function} takes a scene, as load_scene gives it, not {type(scene).__name__}"
    )


def scene_file(given: str | Path) -> Path:
    """The file that is meant: itself, or the course's scene of that name, as one's own folder has it or the project.

    Raises SceneError: it is a name, and no scene has it.
    """
    path = Path(given)
    # A name that is too long for a file isn't there either.
    if path.suffix or path.is_absolute() or os.path.exists(path):  # noqa: PTH110
        return path
    # A notebook is run in the folder assignments.
    above = Path("..") if Path.cwd().name == "assignments" else Path()
    folders = [folder / "scenes" for folder in (Path(), above, PROJECT)]
    tried = (folder / f"{path}.yaml" for folder in folders)
    if (found := next((one for one in tried if os.path.isfile(one)), None)) is not None:  # noqa: PTH113
        return found
    names = {
        one.relative_to(folder).with_suffix("").as_posix()
        for folder in folders
        for one in (*folder.glob("*.yaml"), *folder.glob("before/*.yaml"))
    }
    near = meant(str(given), sorted(names))
    raise SceneError(
        f"{shown(path)}: no such file, and the course has no scene of that name"
        + (f"; did you mean {near}?" if near else "; scenes/README.md lists its scenes")
    )


def effects_of(given: str | Path | Effects | Given | None) -> Effects:
    """The functions that are meant; see ``load_scene``."""
    if isinstance(given, Effects):
        return given
    if isinstance(given, Mapping):
        return GivenEffects(given)
    if given is None or isinstance(given, str | Path):
        return Effects(given)
    raise EffectError(
        f"effects is {type(given).__name__}; expected a folder, or functions by their names"
    )
