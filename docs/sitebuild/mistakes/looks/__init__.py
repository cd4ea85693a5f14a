"""How the functions of each module are looked at."""
