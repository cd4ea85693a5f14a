"""Paths of light, followed from surface to surface."""
