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

    def stopped(self, path: Indices, points: Floats32, throughput: Floats32) -> None:
        """Rays ``path`` (n,) end at points (3, n) between surfaces, with this throughput (3, n)."""

    def sought(
        self, path: Indices, light: str, ways: tuple[Any, Any], ends: tuple[Any, Any], value: Any
    ) -> None:
        """Rays ``path`` (n,) have asked a light by its name, "" for the environment, from places between surfaces.

        ``ways`` : where shadow rays start and where they go, (3, n) each
        ``ends`` : what blocks them, (n,) triangles or -1, and how far away in lengths of their ways, or else the limit
        ``value`` : radiance (3, n) that they bring, before the throughput of rays at their ends
        """

    def asks(self, direct: Any, light: Any, path: Indices | None) -> None:
        """Hits of rays ``path`` (n,), those that were met last or some of them, will ask a light."""

    def faced(self, direct: Any, hits: Any, sample: Any, candidates: Any | None) -> None:
        """Which of them will send a shadow ray: ``Candidates``, or None."""

    def shadowed(self, direct: Any, light: Any, hits: Any, candidates: Any, free: Mask) -> None:
        """Which ways (k,) are free; the candidates have the irradiance that arrives."""

    def bounces(self, path: Indices | None) -> None:
        """Paths (m,) will ask for directions off diffuse surfaces; None: all hits will ask what they carry on."""
