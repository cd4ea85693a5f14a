"""Compiled forms: the fused loop, and the walk down a tree of lights; an extra (``pip install .[fast]``)."""
