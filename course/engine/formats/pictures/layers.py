"""Which channels of which part of a picture of many hold its colours: an EXR may have layers, and parts."""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from OpenImageIO import ImageInput, ImageSpec

MOST_NAMES = 12
"""That a message lists."""

MOST_PARTS = 1000

COLOURS = "not R, G and B, or Y; save colours as R, G and B, linear, and grey as Y"
"""What is told where there are none, such as in XYZ, which is colours of another kind, or a vector."""


@dataclass(frozen=True)
class Layer:
    """Red, green and blue, or grey.

    Attributes
    ----------
    part : its number, from 0
    names : by which it can be asked for; the first is the one that is told
    channels : the numbers of its channels, three or one
    """

    part: int
    names: tuple[str, ...]
    channels: tuple[int, ...]


def choose(file: "ImageInput", wanted: str | None) -> tuple[Layer, "ImageSpec", list[str]]:
    """Return the layer of that name, or else the one that there is, with its part's header and what is to be told.

    Without a name, channels R, G, B or Y without a layer come first. Raises ValueError: there is none, or several.
    """
    specs = list(_parts(file))
    layers = [layer for part, spec in enumerate(specs) for layer in _layers(part, spec)]
    if not layers:
        names = [name for spec in specs for name in spec.channelnames]
        raise ValueError(f"it has the channels {_listed(names)}, {COLOURS}")
    told = _listed([layer.names[0] or "the one without a name" for layer in layers])
    if wanted is not None:
        found = [layer for layer in layers if wanted in layer.names]
        if not found:
            names = [name for spec in specs for name in spec.channelnames]
            own = [name for name in names if name.rpartition(".")[0] == wanted]
            if own:
                raise ValueError(f"its layer {wanted!r} has the channels {_listed(own)}, {COLOURS}")
            raise ValueError(f"it has no layer {wanted!r}; it has {told}")
        return found[0], specs[found[0].part], []
    plain = [layer for layer in layers if "" in layer.names]
    if not plain and len(layers) > 1:
        raise ValueError(f"it has the layers {told}: name one of them by layer")
    chosen = (plain or layers)[0]
    notes = [f"it has several pictures ({told}), and the first is taken; layer names another"]
    return chosen, specs[chosen.part], notes if len(plain) > 1 else []


def _parts(file: "ImageInput") -> Iterator["ImageSpec"]:
    for part in range(MOST_PARTS):
        if part and not file.seek_subimage(part, 0):
            # What was tried is no error of the file.
            file.geterror()
            return
        yield file.spec()


def _layers(part: int, spec: "ImageSpec") -> Iterator[Layer]:
    of: dict[str, dict[str, int]] = {}
    for number, name in enumerate(spec.channelnames):
        layer, _, channel = name.rpartition(".")
        of.setdefault(layer, {}).setdefault(channel.upper(), number)
    own = spec.get_string_attribute("oiio:subimagename") or spec.get_string_attribute("name")
    for layer, channels in of.items():
        if not {"RY", "BY", "X"}.isdisjoint(channels):
            # Y is a luminance for colours then, or the middle of X, Y and Z.
            channels.pop("Y", None)
        for wanted in (("R", "G", "B"), ("RED", "GREEN", "BLUE"), ("Y",)):
            if set(wanted) <= set(channels):
                both = f"{own}.{layer}" if own and layer else own or layer
                names = dict.fromkeys(
                    name for name in (layer or own, both, layer, own) if name or not layer
                )
                found = tuple(channels[each] for each in wanted)
                yield Layer(part, tuple(names), found)
                break


def _listed(names: list[str]) -> str:
    more = f" and {len(names) - MOST_NAMES} more" if len(names) > MOST_NAMES else ""
    return ", ".join(name[:60] for name in names[:MOST_NAMES]) + more
