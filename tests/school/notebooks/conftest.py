"""References of checks that are made once for all processes of a run."""

from tests.school.grading.lent import lent_references, references_file, usual_references

__all__ = ["lent_references", "references_file", "usual_references"]
