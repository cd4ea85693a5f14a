"""Materials that make light, as far as float32 can carry what becomes of it from bounce to bounce."""

from __future__ import annotations

import math
from collections.abc import Iterable

from course.building.materials import handed_on, returned_share
from course.building.ranges import BRIGHTEST
from course.core.environment import ConstantEnvironment, CubeEnvironment
from course.extras.world import FullWorld
from course.formats.yaml.loading import Loaded


def check_growth(loaded: Loaded, used: Iterable[str], world: FullWorld) -> None:
    """Check what a ray may carry after all its bounces.

    Parameters
    ----------
    used : names of the objects' materials

    Raises
    ------
    SceneError
        It is more than float32 holds; names the material that makes most light.
    """
    scene = loaded.description
    integrator = scene.integrator
    share = returned_share if integrator.type == "path" else handed_on
    shares = {name: float(share(scene.materials[name]).max()) for name in used}
    worst = max(shares, key=lambda name: shares[name], default=None)
    if worst is None or shares[worst] <= 1:
        return
    # By logarithms: the power itself may overflow even here.
    room = math.log(BRIGHTEST / max(1.0, _brightest(world)))
    growth = math.log(shares[worst])
    if integrator.max_depth * growth < room:
        return
    digits = integrator.max_depth * growth / math.log(10)
    raise loaded.document.error(
        ("materials", worst),
        f"returns {shares[worst]:.3g} times the light that it gets, 10^{digits:.0f} times after the"
        f" {integrator.max_depth} bounces of integrator.max_depth: expected a material that makes less light, or a"
        f" max_depth of at most {math.ceil(room / growth) - 1}",
    )


def _brightest(world: FullWorld) -> float:
    """The largest radiance, or irradiance at the size of the scene, of whatever shines."""
    sky = world.environment
    assert isinstance(sky, ConstantEnvironment | CubeEnvironment)
    colors = (
        world.ambient,
        world.materials.emission,
        sky.faces if isinstance(sky, CubeEnvironment) else sky.color,
        *(light.color for light in world.lights),
    )
    return max(float(color.max()) for color in colors)
