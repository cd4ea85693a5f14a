"""Russian roulette: paths that carry little end by chance, and those that survive carry more (`path_tracing`)."""

from course.engine.core.types import Floats32, Functions, Mask


def survivors(
    path_tracing: Functions | None, throughput: Floats32, u: Floats32 | None
) -> tuple[Mask, Floats32]:
    """Mask (n,) of the paths that survive, and the throughput (3, n) of all paths.

    Parameters
    ----------
    path_tracing : functions of the module; None where nothing is diffuse, and then every path with light goes on
    throughput : (3, n) float32
    u : (n,) float32 in [0, 1); None where roulette isn't played
    """
    if u is not None and path_tracing is not None:
        survives, after = path_tracing.russian_roulette(throughput, u)
        return survives, after
    return throughput.max(axis=0) > 0, throughput
