"""Cameras with what only some scenes have."""
