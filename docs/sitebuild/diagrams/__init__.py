"""The figures of the modules' pages, drawn when the site is built: one file of figures for each module.

Lengths, points and directions in them are computed, most by the course's own reference functions.
"""
