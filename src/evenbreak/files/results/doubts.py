"""Doubtful results: unreadable rows, scores that can't be games, odd dates."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from evenbreak.files.results.statuses import LeftOut
from evenbreak.files.tables.problems import Problems, first_ones, warning
from evenbreak.files.tables.table import TextTable
from evenbreak.ratings.doubtful_scores import doubtful_scores, usual_score
from evenbreak.ratings.results import Results
from evenbreak.words import Parameter, say, say_count

MOST_LISTED = 20
"""How many rows are listed; the others are only counted."""

_SKIP_BAD = Parameter("skip_bad")


def doubtful_score_warnings(results: Results, lines: NDArray[np.int64], source: str) -> list[str]:
    """Return warnings about scores that are unlikely to be games won, which still count."""
    texts = _score_doubts(results, lines, source)
    if not texts:
        return []
    verdict = say_count(
        "such a score counts as games won. Correct it, or leave it out with {skip_bad}.",
        "such scores count as games won. Correct them, or leave them out with {skip_bad}.",
        len(texts),
        skip_bad=_SKIP_BAD,
    )
    more = len(texts) - MOST_LISTED
    if more > 0:
        verdict = say("and {n:,} more such scores; {verdict}", n=more, verdict=verdict)
    return [*texts[:MOST_LISTED], warning(source, None, verdict)]


def _score_doubts(results: Results, lines: NDArray[np.int64], source: str) -> list[str]:
    rows = np.flatnonzero(doubtful_scores(results))
    score = np.maximum(results.score_a, results.score_b)
    usual = usual_score(score[(score > 0) & ~results.given_away]) if len(rows) else 0.0
    return [
        warning(
            source,
            lines[row],
            "{a}-{b} can hardly be games won, because nearly all winners here have {usual:.0f} "
            "or fewer; the numbers may be points",
            a=results.score_a[row],
            b=results.score_b[row],
            usual=usual,
        )
        for row in rows.tolist()
    ]


def without_bad_rows(
    table: TextTable, read: Callable[[TextTable], Results]
) -> tuple[TextTable, list[str], tuple[LeftOut, ...]]:
    """Return a table without unreadable rows or rows without games, and what was left out.

    The rows left out are listed in warnings and one by one, including any that couldn't be split
    into cells. Raises DataError if the whole table has a problem, or no row is left.
    """
    read(table)
    unread = {line for line in table.problems.lines if line > table.header}
    if len(unread) < len(table.problems.lines):
        table.problems.raise_any()
    kept = table.without(unread)
    if not len(kept):
        table.problems.raise_any()
    left = list(table.problems.listed())
    trial = replace(kept, problems=Problems(table.source))
    results = read(trial)
    trial.problems.raise_any()
    doubtful = doubtful_scores(results)
    left += _score_doubts(results, kept.lines, table.source)
    why = dict(reversed(table.problems.by_line))
    why |= dict.fromkeys(kept.lines[doubtful].tolist(), say("scores that can hardly be games"))
    rows = tuple(LeftOut(line, why[line]) for line in sorted(why))
    return kept.without(why), _counted(left, len(rows), table.source), rows


def _counted(problems: Sequence[str], rows: int, source: str) -> list[str]:
    if not rows:
        return []
    count = say_count(
        "{n} row was left out, because of {skip_bad}",
        "{n:,} rows were left out, because of {skip_bad}",
        rows,
        skip_bad=_SKIP_BAD,
    )
    listed = first_ones(
        problems, MOST_LISTED, source, lambda n: say("and {n:,} more problems", n=n)
    )
    return [warning(source, None, count), *listed]


YEARS_APART = 5
"""Dates this many years from all others are doubtful."""

FEW = 0.1
"""The largest share of matches that can be far from all the others."""

MOST_DATES_LISTED = 10
"""How many doubtful dates are listed; the others are only counted."""

_GAP = np.timedelta64(round(365.25 * YEARS_APART), "D")


def date_warnings(
    dates: NDArray[np.datetime64],
    lines: NDArray[np.int64],
    source: str,
    today: np.datetime64 | None = None,
) -> list[str]:
    """Return a warning for each match with a doubtful date (NaT: no date stated).

    The day after `today` isn't in the future yet: it has started in other time zones.

    >>> days = np.array(["2024-09-03", "2204-09-10", "2024-09-17"], dtype="datetime64[D]")
    >>> date_warnings(days, np.array([2, 3, 4]), "r.csv")
    ['r.csv:3: date 2204-09-10 is in the future. Correct it if it was mistyped.']
    """
    today = np.datetime64("today", "D") if today is None else today
    future = dates > today + np.timedelta64(1, "D")
    far, others = _far(dates, ~future & ~np.isnat(dates))
    warnings = [
        warning(
            source,
            lines[row],
            "date {date} is {why}. Correct it if it was mistyped.",
            date=str(dates[row]),
            why=say("in the future") if future[row] else others,
        )
        for row in np.flatnonzero(future | far)
    ]
    return first_ones(
        warnings, MOST_DATES_LISTED, source, lambda n: say("and {n:,} more such dates", n=n)
    )


def _far(
    dates: NDArray[np.datetime64], considered: NDArray[np.bool_]
) -> tuple[NDArray[np.bool_], str]:
    """Return which dates are far from all others, how far, and the range of the others."""
    far = np.zeros(len(dates), dtype=bool)
    days = np.sort(dates[considered])
    if len(days) < 2:
        return far, ""
    starts = np.flatnonzero(np.diff(days) >= _GAP) + 1
    parts = np.split(days, starts)
    most = max(parts, key=len)
    if len(days) - len(most) > max(1, FEW * len(days)) or len(most) == len(days) / 2:
        return far, ""
    far[considered] = (dates[considered] < most[0]) | (dates[considered] > most[-1])
    return far, say(
        "at least {years} years away from all other dates ({first} to {last})",
        years=YEARS_APART,
        first=str(most[0]),
        last=str(most[-1]),
    )
