"""The files that a scene names: meshes, and pictures of its environment and of its objects' textures and normals."""

from collections.abc import Callable
from pathlib import Path, PurePosixPath

from msgspec.structs import replace

from course.engine.formats.yaml import description as d


def with_files(scene: d.SceneDescription, change: Callable[[str], str]) -> d.SceneDescription:
    """The scene with other names of its files; ``change`` is called with every name, though not once for each."""
    objects = tuple(
        replace(thing, file=change(thing.file)) if isinstance(thing, d.MeshFile) else thing
        for thing in scene.objects
    )
    materials = dict(scene.materials)
    for name in dict.fromkeys(thing.material for thing in objects):
        if (texture := materials[name].texture) is not None:
            texture = replace(texture, image=change(texture.image))
            materials[name] = replace(materials[name], texture=texture)
        if (shine := materials[name].specular_texture) is not None:
            shine = replace(shine, image=change(shine.image))
            materials[name] = replace(materials[name], specular_texture=shine)
        if (normals := materials[name].normal_map) is not None:
            normals = replace(normals, image=change(normals.image))
            materials[name] = replace(materials[name], normal_map=normals)
        if (bump := materials[name].bump) is not None and bump.image is not None:
            materials[name] = replace(materials[name], bump=replace(bump, image=change(bump.image)))
    environment = scene.environment
    match environment:
        case d.LatLongEnvironment() | d.BackdropEnvironment():
            environment = replace(environment, image=change(environment.image))
        case d.CubeEnvironment(faces=faces, cross=cross):
            environment = replace(
                environment,
                faces=faces and tuple(map(change, faces)),
                cross=cross and change(cross),
            )
    media = tuple(
        replace(medium, grid=change(medium.grid)) if medium.grid else medium
        for medium in scene.media
    )
    return replace(
        scene, objects=objects, materials=materials, environment=environment, media=media
    )


def named_files(scene: d.SceneDescription, folder: Path) -> list[str]:
    """Every file that a scene in that folder names, as it names them, each once; and those beside its glTF files."""
    names: dict[str, None] = {}

    def note(name: str) -> str:
        names[name] = None
        return name

    with_files(scene, note)
    for name in [name for name in names if name.lower().endswith((".glb", ".gltf"))]:
        # Its readers are many; most scenes need none of them for this.
        from course.engine.formats.meshes.gltf import files_beside

        for other in files_beside(folder / name):
            note((PurePosixPath(name).parent / other).as_posix())
    return list(names)
