"""Render a scene: passes over tiles on threads, into a picture with its receipt."""
