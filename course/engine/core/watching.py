"""What may listen while rays are followed: nothing is asked of it but what rays it is told of are called."""

from typing import Any, Protocol

from course.engine.core.types import Floats32, Indices, Mask


class Watcher(Protocol):
    """Listens. None listens to a render; ``course.engine.recording`` listens to some pixels of one.

    Rays, hits and stages are those of the core; what is told is to be copied, for it is computed on.
    """

    def begins(self, rays: Any, depth: int) -> Any:
        """Rays of a depth; returns them with the numbers in ``path`` that stages hand on in the place of the paths."""

    def missed(self, rays: Any, which: Mask) -> None:
        """Some of these rays, (n,) bool, will ask the environment."""

    def found(self, rays: Any, met: Mask) -> None:
        """Some of these rays, (n,) bool, have met triangles, whose points and colours will be asked."""

    def met(self, path: Indices, hits: Any, throughput: Floats32 | None) -> None:
        """Hits of rays ``path`` (n,) and their throughput (3, n), None for 1."""

    def asks(self, direct: Any, light: Any, path: Indices | None) -> None:
        """Hits of rays ``path`` (n,), those that were met last or some of them, will ask a light."""

    def faced(self, direct: Any, hits: Any, sample: Any, candidates: Any | None) -> None:
        """Which of them will send a shadow ray: ``Candidates``, or None."""

    def shadowed(self, direct: Any, light: Any, hits: Any, candidates: Any, free: Mask) -> None:
        """Which ways (k,) are free; the candidates have the irradiance that arrives."""

    def bounces(self, path: Indices | None) -> None:
        """Paths (m,) will ask for directions off diffuse surfaces; None: all hits will ask what they carry on."""
