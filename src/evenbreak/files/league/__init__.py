"""A league's file, `league.toml`: its content, and the files it names."""

from __future__ import annotations

from pathlib import Path

LEAGUE_TOML = "league.toml"
"""The file's name."""


def is_league(path: str | Path) -> bool:
    """Return whether a path is a league's file, judging by its name.

    >>> is_league("club/league.toml"), is_league("season.csv")
    (True, False)
    """
    return Path(path).suffix == ".toml"


def find_league(folder: str | Path = ".") -> Path | None:
    """Return the league's file in a folder, or None if there is none.

    Parent folders aren't searched: a faraway file could change an answer without anyone noticing.
    """
    path = Path(folder) / LEAGUE_TOML
    return path if path.is_file() else None
