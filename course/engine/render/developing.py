"""How a PNG shows a picture by the functions of `film`: exposure, gamut, tone mapping, encoding, dithering.

A scene that asks for none of them is shown by ``Display`` alone, and costs nothing more.
"""

from dataclasses import dataclass, replace
from types import SimpleNamespace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from course.engine.core.types import Floats32
from course.engine.formats.pictures.display import BRIGHTEST, ROUNDING, Display, over_white
from course.engine.functions.effects import Bound
from course.engine.render.binding import developed_by
from course.engine.render.not_written import lines_named
from course.engine.scene.scene import Scene, SceneSettings

_WHITE = (0.3127, 0.3290)
GAMUTS = {
    "srgb": ((0.64, 0.33), (0.30, 0.60), (0.15, 0.06), _WHITE),
    "display_p3": ((0.680, 0.320), (0.265, 0.690), (0.150, 0.060), _WHITE),
    "rec2020": ((0.708, 0.292), (0.170, 0.797), (0.131, 0.046), _WHITE),
}
"""Chromaticities x and y of red, green, blue and white: IEC 61966-2-1, SMPTE EG 432-1, ITU-R BT.2020."""


def developing(scene: Scene, settings: SceneSettings, bound: Bound) -> Display:
    """The display of a scene's pictures; functions that it calls are noted down, and tried on one black pixel.

    Raises EffectError, FunctionError and what `lines_named` makes readable: a function is not written, or wrong.
    """
    asked = developed_by(scene)
    if not asked:
        return settings.display
    functions = {name: bound.function("film", name, ("film", key)) for name, key in asked.items()}
    develop = Development(scene, bound, settings.seed, functions)
    # Before the render, for after it a picture would be lost.
    develop(np.zeros((3, 1, 1), np.float32))
    return replace(settings.display, develop=develop)


@dataclass(frozen=True)
class Development:
    """From linear RGB (3, H, W) float32 to codes (H, W, 3) uint8.

    Attributes
    ----------
    scene, bound : what asks for the functions, for messages
    seed : of the dithering
    functions : those of `film` that are called, by their names
    """

    scene: Scene
    bound: Bound
    seed: int
    functions: dict[str, Any]

    def __call__(self, linear: Floats32) -> NDArray[np.uint8]:
        """The codes; errors name the line of the scene."""
        with lines_named(self.scene, self.bound):
            pixels = np.ascontiguousarray(linear.reshape(3, -1), np.float32)
            codes = self._codes(self._shown(pixels))
        return np.ascontiguousarray(codes.T.astype(np.uint8).reshape(*linear.shape[1:], 3))

    def _shown(self, colors: Floats32) -> Floats32:
        """Linear RGB of the screen; white is 1."""
        description, film = self.scene.loaded.description.film, SimpleNamespace(**self.functions)
        colors = np.clip(over_white(colors, description.white), -BRIGHTEST, BRIGHTEST)
        if "expose" in self.functions:
            colors = film.expose(colors, description.exposure)
        if "convert_gamut" in self.functions:
            source, target = (np.array(GAMUTS[name]).T for name in (description.gamut, "srgb"))
            colors = film.convert_gamut(colors, source, target)
        if (tone := description.tone) is not None:
            colors = np.maximum(colors, 0)
            colors = film.photographic(colors, tone.key, tone.burn, tone.saturation)
        return colors

    def _codes(self, colors: Floats32) -> NDArray[Any]:
        """Codes of them: by the curve or a power, and to the nearest code or dithered."""
        description, film = self.scene.loaded.description.film, SimpleNamespace(**self.functions)
        if "encode_srgb" in self.functions:
            encoded = film.encode_srgb(colors)
        else:
            gamma = description.tone.gamma if description.tone else None
            # Of less, what isn't white is black already.
            power = 1 / max(gamma or 1, 1e-30)
            encoded = np.clip(colors, 0, 1) ** np.float32(power)
        if "quantize" in self.functions:
            u = np.random.default_rng(self.seed).random(encoded.shape, np.float32)
            return np.asarray(film.quantize(encoded, u))
        if description.encoding == "linear":
            return np.asarray(np.minimum(encoded.astype(np.float64) * (255 * (1 + ROUNDING)), 255))
        return np.asarray(np.floor(255 * encoded.astype(np.float64) + 0.5))
