"""Sections 1 to 4 of the source text, regenerated: their numbers and figures."""
