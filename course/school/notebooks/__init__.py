"""Notebooks of the course: made from the stubs, and checked where they are run."""
