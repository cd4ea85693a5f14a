"""The way into a film: the passes of a tile in their order, whichever was rendered first.

Sums of floating-point numbers depend on their order, and a picture mustn't depend on which thread was first.
"""

from __future__ import annotations

import threading

from course.core.types import Floats32
from course.imaging.film import AnyFilm
from course.rendering.passes import Work

_Rendered = tuple[Work, Floats32, Floats32 | float]


class InOrder:
    """Hands work on to a film, the passes of a tile in their order even if a later one comes first.

    A pass of a tile is in the film when all its parts are, which may come in any order.

    Any number of threads may add at once; different tiles enter the film side by side.

    Attributes
    ----------
    done, done_first : tiles, or parts of them, that the film has taken in, and how many of them in the first pass
    """

    def __init__(self, film: AnyFilm) -> None:
        self._film = film
        self._lock = threading.Lock()
        self._next: dict[int, int] = {}
        self._missing: dict[int, int] = {}
        self._early: dict[tuple[int, int], list[_Rendered]] = {}
        self._adding: set[int] = set()
        self.done = 0
        self.done_first = 0

    def add(self, work: Work, pixels: Floats32, weight: Floats32 | float) -> None:
        """Take in a piece of work, and whatever has waited for it."""
        tile = work.tile.number
        with self._lock:
            self._early.setdefault((tile, work.order), []).append((work, pixels, weight))
            # Somebody who is adding to this tile now will see this piece when done with the one before.
            if tile in self._adding:
                return
            self._adding.add(tile)
        while True:
            with self._lock:
                order = self._next.get(tile, 0)
                ready = self._early.get((tile, order))
                if not ready:
                    self._adding.discard(tile)
                    return
                item, pixels, weight = ready.pop()
            self._film.add(item.tile, pixels, weight, item.first + item.samples, item.whole)
            size = item.tile.size
            with self._lock:
                self.done += 1
                self.done_first += item.order == 0
                missing = self._missing.pop(tile, item.pixels or size) - size
                if missing:
                    self._missing[tile] = missing
                else:
                    del self._early[tile, order]
                    self._next[tile] = order + 1
