"""What the parts of a sample cost, in camera rays that meet nothing.

Adaptive sampling puts fewer samples where each costs more (``course.rendering.allocation``). Seconds would be what
counts, but they differ from run to run, and pictures mustn't.
"""

HIT = 1.0
"""Finding out about a hit, and shading without lights."""

SHADOW_RAY = 1.5
"""A point on a light, and the ray towards it."""

SKY_RAY = 8.0
"""A direction of the environment, its radiance, and the ray there."""

FURTHER_RAY = 5.0
"""A ray on its way after a hit: they go anywhere, and camera rays go together."""
