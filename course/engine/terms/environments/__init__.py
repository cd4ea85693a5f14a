"""Surroundings: what they show, and the light that they send."""
