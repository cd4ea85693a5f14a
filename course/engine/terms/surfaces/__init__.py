"""Surfaces with textures and relief, and the structures that find them."""
