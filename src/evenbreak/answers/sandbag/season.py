"""A season checked for sandbagging: its races, and the events in which someone may dump."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from evenbreak.answers.kit.wording import count_of
from evenbreak.errors import InputError
from evenbreak.files.results.results_file import ResultsFile
from evenbreak.ratings.results import Results
from evenbreak.ratings.validation.walk_forward import even_races
from evenbreak.words import Parameter, say

MOST_TRIED = 20
"""The most events tried: each takes as long as a check without events."""


def with_even_races(season: ResultsFile) -> tuple[ResultsFile, list[str]]:
    """Return a season with a race for every match, and a warning if some weren't stated.

    A match that states neither a race nor a winner is read as an even race to the winner's games,
    unless one of these matches was drawn (see `even_races`).

    >>> plain = Results.from_names(["Ann"], ["Bo"], [7], [5])
    >>> raced, warnings = with_even_races(ResultsFile(plain, "r.csv", (), (), ""))
    >>> raced.results.races, len(warnings)
    ((array([7]), array([7])), 1)
    """
    results = season.results
    winner = np.zeros(len(results)) if results.winner is None else results.winner
    unknown = results.counted & (results.races[0] == 0) & (winner == 0)
    if not unknown.any():
        return season, []
    made = even_races(results.select(unknown))[:2]
    race_a, race_b = (race.copy() for race in results.races)
    race_a[unknown], race_b[unknown] = made
    changed = int((race_a != results.races[0]).sum())
    if not changed:
        return season, []
    warning = say(
        "{source}: no race is given for {many}, so each is read as an even race to the winner's "
        "number of games; if a chart set the races, name it with {chart}",
        source=season.source,
        many=count_of(changed, "match", "matches"),
        chart=Parameter("chart"),
    )
    return replace(season, results=replace(results, race_a=race_a, race_b=race_b)), [warning]


def events_marked(results: Results, events: Sequence[str]) -> NDArray[np.bool_]:
    """Return which matches belong to these events; raise InputError for an unknown event."""
    column = results.event
    known = sorted({str(event) for event in (() if column is None else column) if event})
    for event in events:
        if event not in known:
            names = ", ".join(known[:10]) or "none: the file has no event column"
            raise InputError(f"the results have no event {event!r}. Give one of these: {names}.")
    return np.isin(np.asarray(column, dtype=str), list(events))


def events_to_try(results: Results) -> dict[str, NDArray[np.bool_]]:
    """Return each event's matches, starting with the event that has the most.

    There is nothing to try if all matches belong to one event; at most `MOST_TRIED` events are
    tried.

    >>> events = ["cup", "league", "league"]
    >>> night = Results.from_names(["A"] * 3, ["B"] * 3, [5] * 3, [4] * 3, event=events)
    >>> {name: rows.tolist() for name, rows in events_to_try(night).items()}
    {'league': [False, True, True], 'cup': [True, False, False]}
    """
    if results.event is None:
        return {}
    column = np.asarray(results.event, dtype=str)
    names, matches = np.unique(column[column != ""], return_counts=True)
    order = sorted(zip(names.tolist(), matches.tolist(), strict=True), key=lambda one: -one[1])
    found = {name: column == name for name, _ in order[:MOST_TRIED]}
    return {} if any(rows.all() for rows in found.values()) else found
