"""Numbers at the ticks of small plots."""

from matplotlib.ticker import ScalarFormatter


class TickNumbers(ScalarFormatter):
    """Plain numbers, with their power of ten at the axis' end if they are large or small.

    That power alone is set as mathematics, which Matplotlib reads by a grammar: for each number that would take an
    eighth of a plot's time.
    """

    def __init__(self) -> None:
        super().__init__(useOffset=False, useMathText=True)
        self.set_powerlimits((-3, 4))

    def __call__(self, x: float, pos: int | None = None) -> str:
        """Return the number beside a tick."""
        return super().__call__(x, pos).removeprefix(r"$\mathdefault{").removesuffix("}$")
