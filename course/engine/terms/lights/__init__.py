"""Lights of further kinds, and the choice among many."""
