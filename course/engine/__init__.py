"""The renderer: from a scene file to a picture."""
