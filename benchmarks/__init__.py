"""Measurements: what the engine costs, printed as a table and written as JSON."""
