"""Compiled forms of the renderer's stages: Numba's loops and packets of rays, an extra (``pip install .[fast]``).

Each stage does what the one does whose place it takes, in the same order and so to the same bits. ``stages.compiled``
puts them in place, once for a render; nothing else knows of them.
"""
