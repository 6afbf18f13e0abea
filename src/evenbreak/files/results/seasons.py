"""A league's consecutive seasons: several results files, or those named in the league's file."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

from evenbreak.files.league.league_file import is_league, read_league
from evenbreak.files.league.sources import league_results
from evenbreak.files.results.aliases import read_aliases
from evenbreak.files.results.results_file import ResultsFile, in_a_row, read_results, refuse_unfound


def read_seasons(paths: Sequence[str | Path], **reading: Any) -> ResultsFile:
    r"""Read several results files, treating each player's seasons as one career.

    Titles in `columns` apply to the files that have them. A league's file, `league.toml`, may
    replace a results file: it names files, their column titles and aliases.

    Names that differ only in case or spacing belong to one player, spelled as in the first file.

    Parameters
    ----------
    paths
        in any order: matches are ordered by date.
    reading
        as for `read_results`.

    Raises
    ------
    InputError
        if two of the files have the same content.
    DataError
        as `read_results` does.

    >>> import tempfile, pathlib
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     last, this = (pathlib.Path(folder) / name for name in ("last.csv", "this.csv"))
    ...     _ = last.write_text("player_a,player_b,score_a,score_b\nAnn,Bo,7,5\n")
    ...     _ = this.write_text("player_a,player_b,score_a,score_b\nBO,Cy,7,2\n")
    ...     read_seasons([last, this]).results.players
    ('Ann', 'Bo', 'Cy')
    """
    several = {"maybe": len(paths) > 1, **reading}
    files = [
        _of_league(path, **reading) if is_league(path) else read_results(path, **several)
        for path in paths
    ]
    if not any(map(is_league, paths)):
        refuse_unfound(reading.get("columns") or {}, paths, files)
    return in_a_row(files)


def _of_league(
    path: str | Path, *, aliases: str | Path | None = None, skip_bad: bool = False, **reading: Any
) -> ResultsFile:
    """Return a league's results as one file; arguments here override the league's own."""
    league = read_league(path, quickly=True)
    known = None if aliases is None else read_aliases(aliases)
    return league_results(league, aliases=known, skip_bad=skip_bad, **reading).file
