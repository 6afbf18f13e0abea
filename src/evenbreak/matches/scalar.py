"""Odds of one match in plain numbers, without numpy: what the command line needs."""

from __future__ import annotations

from evenbreak.matches.race_law import RaceLaw, race_law

__all__ = ["RaceLaw", "race_law"]
