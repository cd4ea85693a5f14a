"""How materials scatter light."""
