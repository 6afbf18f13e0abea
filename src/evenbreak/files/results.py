"""From a results file to `Results`, with everything that is wrong in it told at once."""

from __future__ import annotations

import hashlib
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from evenbreak.files.aliases import AliasesFile, read_aliases
from evenbreak.files.problems import quoted
from evenbreak.files.results_columns import (
    INSTEAD,
    OPTIONAL,
    REQUIRED,
    ResultsColumns,
    lacks_columns,
)
from evenbreak.files.similar_names import similar_names
from evenbreak.files.text_table import Table, read_table
from evenbreak.ratings.results import Results

if TYPE_CHECKING:
    from numpy.typing import NDArray

WARNED = 20
"""How many groups of similar names are told; the rest are counted."""


@dataclass(frozen=True, eq=False)
class ResultsFile:
    """What a results file says.

    Parameters
    ----------
    results
        its matches, in the order of the file; players in the order of their names.
    source
        what the file is called in messages.
    warnings
        what a person should look at although the file can be used, a line each.
    similar_names
        groups of names that may mean one player.
    sha256
        fingerprint of the bytes that were read.
    lines
        the line in which each match begins; empty where the matches came from no file.
    """

    results: Results
    source: str
    warnings: tuple[str, ...]
    similar_names: tuple[tuple[str, ...], ...]
    sha256: str
    lines: NDArray[np.int64] = field(default_factory=lambda: np.zeros(0, dtype=np.int64))


def read_results(path: str | Path, *, aliases: str | Path | None = None) -> ResultsFile:
    r"""Read match results from a CSV file; '-' is standard input.

    Encoding, separator and header are read as `evenbreak.files.text_table` says; the
    columns are those of `REQUIRED` and `OPTIONAL`. Names lose blanks around and double
    blanks inside, and are put into Unicode's form NFC. `winner` and `first_break` are
    a, b or the name of one of the two. A forfeit may leave its scores empty; so may a
    match whose racks are given, or of which only the race and the winner are known.

    Parameters
    ----------
    path
        the file.
    aliases
        a file that says which names mean whom (see `evenbreak.files.aliases`).

    Raises
    ------
    DataError
        with every problem of the file, a line each, if there is any; before that with
        those of the file of aliases.

    >>> import tempfile, pathlib
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     path = pathlib.Path(folder) / "results.csv"
    ...     _ = path.write_text("Date;Player A;Player B;Score A;Score B\n2024-09-03;Bo;Ann;5;7\n")
    ...     season = read_results(path)
    >>> season.results.players, season.results.score_b
    (('Ann', 'Bo'), array([7]))
    """
    told = None if aliases is None else read_aliases(aliases)
    table = read_table(path, REQUIRED, OPTIONAL, INSTEAD)
    if not len(table) and not len(table.problems):
        table.problems.add(None, "has no matches below its header; write one line for each")
    columns = ResultsColumns(table, None if told is None else told.means)
    if lacks_columns(table):
        table.problems.raise_any()
    results = columns.checked()
    table.problems.raise_any()
    groups = tuple(similar_names(results.players, _met(results)))
    warnings = [
        *(() if told is None else told.warnings),
        *table.warnings,
        *_repeated_rows(table),
        *columns.merged_names(),
        *_read_as(columns.aliases_met(), table.source, told),
        *_warnings(groups, table.source),
    ]
    sha256 = hashlib.sha256(table.content).hexdigest()
    return ResultsFile(results, table.source, tuple(warnings), groups, sha256, table.lines)


def _read_as(names: list[str], source: str, aliases: AliasesFile | None) -> list[str]:
    """Return a warning that tells which names a file of aliases has changed."""
    if aliases is None or not names:
        return []
    changed = [f"{quoted(name)} as {quoted(aliases.means[name])}" for name in names[:WARNED]]
    more = [f"and {len(names) - WARNED:,} more"] if len(names) > WARNED else []
    return [f"{source}: read as {aliases.source} says: {', '.join([*changed, *more])}"]


def _repeated_rows(table: Table) -> list[str]:
    """Return a warning if whole rows stand in the file again: they may be pasted twice."""
    if "date" not in table:
        return []  # the same two players often play to the same score on another day
    again = np.flatnonzero(table.repeated())
    if not len(again):
        return []
    first, count = int(table.lines[again[0]]), len(again)
    rows = "1 row is" if count == 1 else f"{count:,} rows are"
    return [
        f"{table.source}:{first}: {rows} the same as an earlier one, date included; "
        "all are counted, so delete what was entered twice"
    ]


def _met(results: Results) -> list[tuple[str, str]]:
    """Return the names that played each other, each pair once for either order."""
    pairs = np.unique(np.column_stack([results.player_a, results.player_b]), axis=0)
    return [(results.players[a], results.players[b]) for a, b in pairs.tolist()]


def _warnings(groups: tuple[tuple[str, ...], ...], source: str) -> list[str]:
    told = [
        f"{source}: {', '.join(map(quoted, group[:-1]))} and {quoted(group[-1])} may be one "
        "player; if so, write one name throughout"
        for group in groups[:WARNED]
    ]
    more = len(groups) - WARNED
    return [*told, f"{source}: and {more:,} more groups of similar names"] if more > 0 else told
