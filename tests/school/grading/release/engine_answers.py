"""What a student gets for copying the engine's own functions: adapters around text that the student's archive holds."""

import ast
from dataclasses import dataclass
from pathlib import Path

PROJECT = Path(__file__).parents[4]

_HEAD = """\
from __future__ import annotations
import numpy as np
Floats = Floats32 = Indices = np.ndarray
"""


@dataclass(frozen=True)
class Answer:
    """A function of a module, answered by the engine.

    Attributes
    ----------
    file, names : where the engine has it, and what of it is copied
    adapter : the lines that a student writes
    """

    file: str
    names: tuple[str, ...]
    adapter: str


ANSWERS = {
    "glossy.orthonormal_basis": Answer(
        "course/engine/terms/scattering/hemisphere.py",
        ("turned",),
        """
def orthonormal_basis(w):
    zero, one = np.zeros_like(w[0]), np.ones_like(w[0])
    return turned(w, one, zero, zero), turned(w, zero, one, zero)
""",
    ),
    "glossy.keep_above": Answer(
        "course/engine/core/vectors.py",
        ("dot", "reflect"),
        """
def keep_above(direction, normal):
    return np.where(dot(direction, normal) < 0, reflect(direction, normal), direction)
""",
    ),
    "microfacets.fresnel_complex": Answer(
        "course/engine/terms/scattering/conductors.py",
        ("conductor_reflectance",),
        """
def fresnel_complex(cos, n, k):
    index = (np.asarray(part, float)[:, None] for part in (n, k))
    return conductor_reflectance(cos.astype(float), *index).astype(cos.dtype)
""",
    ),
    "blurred_transparency.refract": Answer(
        "course/engine/core/fresnel_refraction.py",
        ("fresnel_and_cos_t", "refract"),
        """
bent = refract
def refract(direction, normal, eta):
    cos_i = -(direction * normal).sum(axis=0)
    eta = np.full_like(cos_i, eta)
    reflectance, cos_t = fresnel_and_cos_t(cos_i, eta)
    total = cos_t == 0
    mirrored = direction + 2 * cos_i * normal
    return np.where(total, mirrored, bent(direction, normal, cos_i, cos_t, eta)), total
""",
    ),
    "blurred_transparency.fresnel": Answer(
        "course/engine/core/fresnel_refraction.py",
        ("fresnel_and_cos_t",),
        """
def fresnel(cos_i, eta):
    return fresnel_and_cos_t(cos_i, np.full_like(cos_i, eta))[0]
""",
    ),
    "importance_sampling.cosine_hemisphere": Answer(
        "course/engine/terms/scattering/hemisphere.py",
        ("cosine_directions", "turned"),
        """
def cosine_hemisphere(u):
    return cosine_directions(np.zeros((3, u.shape[1]), u.dtype) + np.array([[0], [0], [1]], u.dtype), u)
""",
    ),
    "importance_sampling.uniform_hemisphere": Answer(
        "course/engine/terms/scattering/hemisphere.py",
        ("cone_directions", "turned"),
        """
def uniform_hemisphere(u):
    axis = np.zeros((3, u.shape[1]), u.dtype) + np.array([[0], [0], [1]], u.dtype)
    return cone_directions(axis, np.ones_like(u[0]), u)[0]
""",
    ),
    "path_tracing.diffuse_bounce": Answer(
        "course/engine/terms/scattering/hemisphere.py",
        ("cosine_directions", "turned"),
        """
def diffuse_bounce(normal, u):
    return cosine_directions(normal, u)
""",
    ),
    "sampling.sphere_by_polar": Answer(
        "course/engine/terms/scattering/hemisphere.py",
        ("cone_directions", "turned"),
        """
def sphere_by_polar(u):
    axis = np.zeros((3, u.shape[1]), u.dtype) + np.array([[0], [0], [1]], u.dtype)
    return cone_directions(axis, np.full_like(u[0], 2), u)[0]
""",
    ),
    "soft_shadows.point_on_sphere": Answer(
        "course/engine/terms/scattering/hemisphere.py",
        ("cone_directions", "turned"),
        """
def point_on_sphere(center, radius, u):
    axis = np.zeros((3, u.shape[1]), u.dtype) + np.array([[0], [0], [1]], u.dtype)
    way = cone_directions(axis, np.full_like(u[0], 2), u)[0]
    return center.astype(u.dtype)[:, None] + u.dtype.type(radius) * way
""",
    ),
    "cube_map.face_and_uv": Answer(
        "course/engine/terms/environments/sampling.py",
        ("FRAMES",),
        """
def face_and_uv(direction):
    face = (FRAMES[:, 0] @ direction).argmax(axis=0)
    middle, right, down = np.einsum("in,nki->kn", direction, FRAMES[face]).astype(direction.dtype)
    return face, (right / middle + 1) / 2, (down / middle + 1) / 2
""",
    ),
    "textures.texture_lookup": Answer(
        "course/engine/terms/environments/cube_faces.py",
        ("_bilinear",),
        """
def texture_lookup(image, uv):
    height, width = image.shape[:2]
    place = uv[0] * width - 0.5, (1 - uv[1]) % 1 * height - 0.5
    return np.stack([*_bilinear(image.reshape(-1, 3).T, (height, width), *place)]).astype(uv.dtype)
""",
    ),
    "film.encode_srgb": Answer(
        "course/engine/formats/pictures/display.py",
        ("_curve",),
        """
def encode_srgb(linear):
    return _curve(linear).astype(linear.dtype)
""",
    ),
}
"""Function -> how the engine answers it, in whole or nearly."""


RETYPED = {
    "soft_shadows.point_on_rectangle": ("_sample", "course/engine/loops/lamp_kernels.py"),
    "soft_shadows.point_in_ball": ("_sample", "course/engine/loops/lamp_kernels.py"),
    "soft_shadows.point_on_facing_disk": ("_on_facing_disk", "course/engine/loops/lamp_kernels.py"),
    "thin_lens.point_on_disk": ("_through_lens", "course/engine/loops/number_kernels.py"),
    "thin_lens.lens_rays": ("_through_lens", "course/engine/loops/number_kernels.py"),
    "glossy.jitter_on_plane": ("_jitter", "course/engine/loops/bounce_kernels.py"),
    "glossy.jitter_in_ball": ("_jitter", "course/engine/loops/bounce_kernels.py"),
    "glossy.sample_phong_lobe": ("_jitter", "course/engine/loops/bounce_kernels.py"),
    "cube_map.lookup": ("look_up", "course/engine/loops/cube_kernels.py"),
    "cube_map.lookup_seamless": ("across", "course/engine/loops/cube_kernels.py"),
    "many_lights.importance": ("_importance", "course/engine/loops/light_tree_kernels.py"),
    "many_lights.tree_choice": ("walk", "course/engine/loops/light_tree_kernels.py"),
    "many_lights.tree_probability": ("walk", "course/engine/loops/light_tree_kernels.py"),
    "bounding_volumes.slab_test": ("_enters", "course/engine/casters/batches.py"),
    "bounding_volumes.build": ("build", "course/engine/casters/build_kernels.py"),
    "bounding_volumes.traverse": ("_walk", "course/engine/casters/cast_kernels.py"),
    "supersampling.gaussian_weights": ("_weights", "course/school/studio/engine.py"),
    "supersampling.resolve": ("_mean", "course/school/studio/engine.py"),
}
"""Function -> name and file of a form of it, to be written anew for arrays: most handle sixteen rays in turn."""


def copied(answer: Answer) -> str:
    """A module made of the engine's text and the adapter."""
    text = (PROJECT / answer.file).read_text(encoding="utf-8")
    found = {}
    for node in ast.parse(text).body:
        if isinstance(node, ast.FunctionDef):
            found[node.name] = ast.get_source_segment(text, node)
        elif isinstance(node, ast.Assign) and isinstance(node.targets[0], ast.Name):
            found[node.targets[0].id] = ast.get_source_segment(text, node)
    parts = [found[name] or "" for name in answer.names]
    return "\n\n".join([_HEAD, *parts, answer.adapter])
