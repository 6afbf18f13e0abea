"""Rows of a results file that cannot be read, and scores that can hardly be games won."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from evenbreak.files.problems import Problems
from evenbreak.files.text_table import TextTable
from evenbreak.ratings.doubtful_scores import doubtful_scores, usual_score
from evenbreak.ratings.results import Results

if TYPE_CHECKING:
    from numpy.typing import NDArray

MOST_LISTED = 20
"""How many rows are listed; the rest are counted."""


def doubtful_score_warnings(results: Results, lines: NDArray[np.int64], source: str) -> list[str]:
    """Return warnings of the scores that can hardly be games won, which count all the same."""
    texts = _score_doubts(results, lines, source)
    if not texts:
        return []
    more = len(texts) - MOST_LISTED
    end = f"and {more:,} more such scores; " if more > 0 else ""
    scores = "such a score counts" if len(texts) == 1 else "such scores count"
    remedy = "correct them, or leave them out with --skip-bad"
    return [*texts[:MOST_LISTED], f"{source}: {end}{scores} as games won; {remedy}"]


def _score_doubts(results: Results, lines: NDArray[np.int64], source: str) -> list[str]:
    rows = np.flatnonzero(doubtful_scores(results))
    score = np.maximum(results.score_a, results.score_b)
    usual = usual_score(score[(score > 0) & ~results.given_away]) if len(rows) else 0.0
    return [
        f"{source}:{lines[row]}: {results.score_a[row]}-{results.score_b[row]} can hardly be games "
        f"won, as nearly all winners here have {usual:.0f} or fewer; they may be points"
        for row in rows.tolist()
    ]


def without_bad_rows(
    table: TextTable, read: Callable[[TextTable], Results]
) -> tuple[TextTable, list[str], int]:
    """Return a table without rows that cannot be read or hold no games, and what was left out.

    What was left out is listed and counted, with the rows that were not cut into cells.

    Parameters
    ----------
    table
        the rows of the file.
    read
        reads them; what it cannot read, it adds to the table's problems.

    Raises
    ------
    DataError
        with all problems if they are not those of single rows, or no row is left.
    """
    read(table)
    unread = {line for line in table.problems.lines if line > table.header}
    if len(unread) < len(table.problems.lines):
        table.problems.raise_any()
    kept = table.without(unread)
    if not len(kept):
        table.problems.raise_any()
    found = list(table.problems.listed())
    trial = replace(kept, problems=Problems(table.source))
    results = read(trial)
    trial.problems.raise_any()
    doubtful = doubtful_scores(results)
    found += _score_doubts(results, kept.lines, table.source)
    left_out = {*unread, *kept.lines[doubtful].tolist()}
    return kept.without(left_out), _counted(found, len(left_out), table.source), len(left_out)


def _counted(found: Sequence[str], rows: int, source: str) -> list[str]:
    if not rows:
        return []
    many = "1 row is" if rows == 1 else f"{rows:,} rows are"
    listed = list(found[:MOST_LISTED])
    more = len(found) - len(listed)
    end = [f"{source}: and {more:,} more problems"] if more else []
    return [f"{source}: {many} left out, as --skip-bad asks", *listed, *end]
