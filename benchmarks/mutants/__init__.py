"""The kill matrix: what becomes of known submissions, right and wrong, and of right functions by other habits."""
