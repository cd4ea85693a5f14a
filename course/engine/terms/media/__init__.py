"""What fills space: light is lost and scattered between surfaces."""
