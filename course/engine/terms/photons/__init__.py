"""Photons: light that is followed from the lamps to matte surfaces by way of mirrors and glass."""
