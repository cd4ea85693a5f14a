import os
import subprocess
import sys
from collections.abc import Callable, Iterator
from typing import Any

import msgspec
import numpy as np
import pytest
from msgspec import inspect

from course.engine.formats.yaml import description
from course.engine.formats.yaml.description import (
    MeshFile,
    RectangleLight,
    SceneDescription,
    Sphere,
    rgb,
)
from course.engine.formats.yaml.loading import Loaded


def test_everything_in_the_file_arrives_in_the_description(
    good: str, load: Callable[[str], Loaded]
) -> None:
    loaded = load(good)

    def arrives(given: Any, found: Any) -> bool:
        if isinstance(given, dict):
            return all(arrives(value, found[key]) for key, value in given.items())
        if isinstance(given, list):
            return all(map(arrives, given, found)) and len(given) == len(found)
        return bool(given == found)

    assert arrives(loaded.document.data, msgspec.to_builtins(loaded.description))
    kinds = [type(thing) for thing in (loaded.description.lights[3], *loaded.description.objects)]
    assert (kinds[0], kinds[3], kinds[-1]) == (RectangleLight, Sphere, MeshFile)


def test_a_camera_alone_gives_the_documented_defaults(load: Callable[[str], Loaded]) -> None:
    scene = load("camera: {eye: [0, 0, 1], look_at: [0, 0, 0]}").description
    assert (scene.camera.up, scene.camera.vertical_fov) == ((0.0, 1.0, 0.0), 40.0)
    assert (scene.film.width, scene.film.height, scene.film.filter) == (640, 480, "box")
    assert scene.film.sigma == 1 / 6
    assert (scene.sampler.type, scene.sampler.samples) == ("sobol", 16)
    assert (scene.integrator.max_depth, scene.integrator.cutoff) == (5, 1 / 512)
    assert scene.environment.radiance == 0.0
    assert (scene.seed, scene.materials, scene.lights, scene.objects) == (0, {}, (), ())


@pytest.mark.parametrize("color", [0.5, (0.5, 0.5, 0.5)])
def test_a_number_is_a_grey_colour(color: float | tuple[float, ...]) -> None:
    channels = rgb(color)
    assert channels.shape == (3,)
    assert channels.dtype == np.float64
    assert channels.tolist() == [0.5, 0.5, 0.5]
    channels[0] = 1.0  # Its own memory, not a broadcast view.
    assert channels.tolist() == [1.0, 0.5, 0.5]


def test_every_key_of_the_format_is_described() -> None:
    for kind in _types(inspect.type_info(SceneDescription)):
        if isinstance(kind, inspect.StructType):
            for field in kind.fields:
                extra = getattr(field.type, "extra_json_schema", None) or {}
                assert extra.get("description"), f"{kind.cls.__name__}.{field.name}"


def test_every_length_and_radiometric_quantity_has_its_unit() -> None:
    units = {
        (kind.cls, field.name): (field.type.extra_json_schema or {}).get("x-unit")
        for kind in _types(inspect.type_info(SceneDescription))
        if isinstance(kind, inspect.StructType)
        for field in kind.fields
        if isinstance(field.type, inspect.Metadata)
    }
    by_name = {
        "radius": "world unit",
        "position": "world unit",
        "intensity": "W/sr",
        "radiance": "W/(m^2 sr)",
        "irradiance": "W/m^2",
        "vertical_fov": "degree",
        "degrees": "degree",
        "absorption": "1/world unit",
    }
    for name, unit in by_name.items():
        found = {each for (_, field), each in units.items() if field == name}
        assert found == {unit}, name


def test_no_union_joins_a_bounded_number_and_a_tuple_of_fixed_length() -> None:
    """Such a union makes msgspec 0.22 read freed memory when the garbage collector runs."""
    for kind in _types(inspect.type_info(SceneDescription)):
        if isinstance(kind, inspect.UnionType):
            numbers = [each for each in kind.types if isinstance(each, inspect.FloatType)]
            bounded = any(each.ge is not None or each.gt is not None for each in numbers)
            fixed = any(isinstance(each, inspect.TupleType) for each in kind.types)
            assert not (bounded and fixed), kind


def test_the_format_survives_a_collection_of_garbage_at_every_step() -> None:
    code = (
        "import gc, msgspec\n"
        "from course.engine.formats.yaml.description import SceneDescription\n"
        "gc.set_threshold(1)\n"
        "try:\n    msgspec.convert({}, SceneDescription)\n"
        "except msgspec.ValidationError:\n    gc.collect(); raise SystemExit(0)\n"
        "raise SystemExit(1)\n"
    )
    environment = {**os.environ, "PYTHONMALLOC": "debug"}
    assert (
        subprocess.run([sys.executable, "-c", code], env=environment, check=False).returncode == 0
    )


def test_structs_are_frozen_and_refuse_unknown_keys() -> None:
    with pytest.raises(AttributeError):
        Sphere(material="red").radius = 2.0  # type: ignore[misc]
    with pytest.raises(TypeError):
        Sphere("red")  # type: ignore[call-arg]
    with pytest.raises(msgspec.ValidationError, match="unknown"):
        msgspec.convert({"colour": 1}, description.MaterialDescription)


def _types(kind: Any) -> Iterator[inspect.Type]:
    """All types in a type, itself included."""
    yield kind
    for child in (
        *([kind.type] if isinstance(kind, inspect.Metadata) else ()),
        *([field.type for field in kind.fields] if isinstance(kind, inspect.StructType) else ()),
        *(kind.types if isinstance(kind, inspect.UnionType) else ()),
        *(kind.item_types if isinstance(kind, inspect.TupleType) else ()),
        *([kind.item_type] if isinstance(kind, inspect.VarTupleType) else ()),
        *([kind.value_type] if isinstance(kind, inspect.DictType) else ()),
    ):
        yield from _types(child)
