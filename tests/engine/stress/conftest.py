"""`pytest tests/engine/stress --hypothesis-profile=stress` tries many more examples."""

from hypothesis import settings

settings.register_profile("stress", max_examples=2000)
