"""How many examples the Hypothesis tests of this folder try, and with which seeds: always the same."""

from hypothesis import HealthCheck, Phase, settings

from tests.lengths import LONG


def examples(short: int, long: int) -> settings:
    """Settings for a test that tries so many examples in `make test` and in `make stress`.

    Only the latter looks for the simplest example that fails, which may take minutes.
    """
    return settings(
        max_examples=long if LONG else short,
        phases=[Phase.generate, Phase.shrink] if LONG else [Phase.generate],
        deadline=None,
        derandomize=True,
        database=None,
        suppress_health_check=list(HealthCheck),
    )
