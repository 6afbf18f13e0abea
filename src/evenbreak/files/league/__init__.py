"""The file of a league, `league.toml`: what it holds, and the files that it names."""

from __future__ import annotations

from pathlib import Path

LEAGUE_TOML = "league.toml"
"""What the file is called."""


def is_league(path: str | Path) -> bool:
    """Return whether a path is that of a league's file, by its name.

    >>> is_league("club/league.toml"), is_league("season.csv")
    (True, False)
    """
    return Path(path).suffix == ".toml"


def find_league(folder: str | Path = ".") -> Path | None:
    """Return the league's file in a folder; None if it has none.

    The folders above are not looked at: a file far away would change an answer unseen.
    """
    path = Path(folder) / LEAGUE_TOML
    return path if path.is_file() else None
