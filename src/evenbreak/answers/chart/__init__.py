"""Handicap charts: listed, shown, audited, designed."""
