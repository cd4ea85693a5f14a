"""Notebooks: the modules that their cells hold."""
