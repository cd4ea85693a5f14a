"""Did you mean? Names that come near a word that isn't known, or that other programs have for the same thing."""

from collections.abc import Iterable
from difflib import get_close_matches
from typing import Final

from course.engine.formats.yaml.document import LONGEST, PLAIN_KEY, show

_MOVED = "transform: [{translate: [0, 1, 0]}]"
_TURNED = "transform: [{rotate: {axis: [0, 1, 0], degrees: 90}}]"
_SCALED = "transform: [{scale: 2}]"
_EMITTED = ("radiance", "intensity", "irradiance")
SYNONYMS: Final[dict[str, tuple[str, ...]]] = {
    "fov": ("vertical_fov",),
    "fovy": ("vertical_fov",),
    "field_of_view": ("vertical_fov",),
    "target": ("look_at",),
    "direction": ("look_at",),
    "pos": ("eye", "position", "center", "corner", _MOVED),
    "position": ("eye", "center", "corner", _MOVED),
    "location": ("eye", "position", "center", "corner", _MOVED),
    "center": ("position", "corner", _MOVED),
    "translate": (_MOVED,),
    "translation": (_MOVED, "translate"),
    "rotate": (_TURNED,),
    "rotation": (_TURNED, "rotate"),
    "scale": (_SCALED,),
    "color": _EMITTED,
    "power": _EMITTED,
    "brightness": _EMITTED,
    "strength": _EMITTED,
    "emission": _EMITTED,
    "radiance": ("irradiance", "intensity", "emission"),
    "emissive": ("emission",),
    "intensity": ("irradiance", "radiance"),
    "type": ("shape",),
    "shape": ("type",),
    "size": ("radius", "width", "depth", "height"),
    "path": ("file",),
    "albedo": ("color",),
    "shininess": ("exponent",),
    "reflectivity": ("mirror",),
    "ior": ("refraction_index", "dielectric: {refraction_index: 1.5}"),
    "background": ("environment",),
    "resolution": ("width", "height"),
    "spp": ("samples",),
    "depth": ("max_depth",),
}
"""Other programs' names of keys: the keys here, each perhaps with a value as an example."""


def suggest(word: object, known: Iterable[str]) -> str:
    """`did you mean look_at?`, or all that is known where nothing comes near."""
    names = list(known)
    # Comparing is quadratic in the length of the word, which the file decides.
    folded = str(word)[:LONGEST].lower()
    lower: dict[str, str] = {name[:LONGEST].lower(): name for name in names}
    near = [lower[name] for name in get_close_matches(folded, lower, n=2, cutoff=0.6)]
    if near:
        return f"did you mean {' or '.join(map(_name, near))}?"
    if not names:
        return "there are none"
    listed = ", ".join(map(_name, names[:30]))
    return f"known are {listed}{', ...' if len(names) > 30 else ''}"


def _name(name: str) -> str:
    return name if PLAIN_KEY.fullmatch(name) and len(name) <= LONGEST else show(name)


def meant_by(word: object, known: Iterable[str]) -> list[str]:
    """List those known keys that other programs call by this word, written as to be used."""
    names = set(known)
    return [use for use in SYNONYMS.get(str(word).lower(), ()) if use.partition(":")[0] in names]
