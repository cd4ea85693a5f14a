"""Stages that replace the core's: the lectures' further subjects, and the conventions of other renderers."""
