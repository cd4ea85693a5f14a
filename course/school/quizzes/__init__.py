"""Questions about known mistakes, and files of them that learning platforms read."""
