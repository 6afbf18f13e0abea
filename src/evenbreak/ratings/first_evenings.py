"""Strength of the field on each player's first evening, judged by the players already known.

A newcomer to a strong tournament is likely to be stronger than a newcomer to a beginners' evening.
Matches with the same event and the same division belong together, if the file names two or more of
either; all other matches of a date count as one event. The event's field is the players on each of
its evenings so far who had played on an earlier date; its strength is the mean of their skills,
drawn toward the mean of the others if the field is small.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy import sparse

from evenbreak.arrays import Bools, Floats, Ints
from evenbreak.ratings.results import Results

DRAWN = 1.0
"""How many players of average strength are added to each field."""

_BEFORE, _NEVER = np.datetime64("0000-01-01", "D"), np.datetime64("9999-12-31", "D")


class FirstEvenings:
    """Fields on the evenings when players were first seen.

    Matches at 0-0 on or after the last day of play are upcoming; other 0-0 matches, forfeits and
    matches without a date are ignored. `known` players are known before the first match.
    """

    def __init__(self, results: Results, known: Bools | None = None) -> None:
        self._players = players = max(len(results.players), 1)
        rows = _rows_with_a_day(results)
        self._row_date = np.full(len(results), np.datetime64("NaT", "D"))
        if results.date is not None:
            self._row_date[rows] = results.date[rows]
        self._last = _BEFORE
        date, ends = self._row_date[rows], (results.player_a[rows], results.player_b[rows])
        evening, self._date, event = _evenings(results, rows, date)
        # Sorted rather than hashed, as np.unique would, which takes ten times as long.
        pairs = np.sort(np.tile(evening, 2) * players + np.concatenate(ends))
        of_evening, who = np.divmod(pairs[np.diff(pairs, prepend=-1) > 0], players)
        played = np.full(players, _NEVER)
        first = np.full(players, len(self._date))
        # Evenings are in the order of their dates.
        np.minimum.at(first, who, of_evening)
        counted = results.counted[rows]
        for side in ends:
            np.minimum.at(played, side[counted], date[counted])
        there = played[who] < self._date[of_evening]
        if known is not None:
            there |= known[who]
            first[known] = len(self._date)
        seat = np.ones(there.sum()), (of_evening[there], who[there])
        self._seats = sparse.csr_array(seat, shape=(len(self._date), players))
        self._by_event = np.argsort(event, kind="stable")
        sorted_events = event[self._by_event]
        self._begins = np.searchsorted(sorted_events, sorted_events)
        size = self._so_far(np.bincount(of_evening[there], minlength=len(self._date)))
        new = np.flatnonzero(np.append(size, 0.0)[first] > 0.0)
        self._new = new[np.argsort(first[new], kind="stable")]
        self._first = first[self._new]
        self._size = size[self._first]

    def see(self, rows: Any) -> None:
        """Move the season on to the last date of the given matches, all of them known."""
        self._last = np.fmax.reduce(self._row_date[rows], initial=self._last)

    def strength(self, skill: Floats) -> Floats:
        """Return how far each player's first field was above the mean of such fields.

        The mean is over all newcomers so far. The result is 0 for players who were there from the
        start, and for those who met no known player.
        """
        above = np.zeros(len(skill))
        here = slice(int(np.searchsorted(self._date[self._first], self._last, side="right")))
        size, first = self._size[here], self._first[here]
        if len(size):
            field = self._so_far(self._seats @ skill)[first] / size
            weight = size / (size + DRAWN)
            above[self._new[here]] = weight * (field - weight @ field / weight.sum())
        return above

    def __bool__(self) -> bool:
        """Return whether newcomers came to at least two different fields."""
        return len(np.unique(self._first)) > 1

    def _so_far(self, of_evening: NDArray[Any]) -> Floats:
        """Return the cumulative sum over an event's evenings."""
        sums = np.append(0.0, np.cumsum(of_evening[self._by_event]))
        found = np.empty(len(of_evening))
        found[self._by_event] = sums[1:] - sums[self._begins]
        return found


def _rows_with_a_day(results: Results) -> Ints:
    """Return the matches that show who was where on which day."""
    if results.date is None:
        return np.zeros(0, dtype=np.int64)
    dated = ~np.isnat(results.date)
    counted = results.counted & dated
    last = results.date[counted].max() if counted.any() else _BEFORE
    coming = dated & ~results.given_away & (results.date >= last)
    return np.flatnonzero(counted | coming)


def _evenings(
    results: Results, rows: Ints, date: NDArray[np.datetime64]
) -> tuple[Ints, NDArray[np.datetime64], Ints]:
    """Return the evening of each match, and the date and event of each evening.

    Evenings are numbered in the order of their dates.
    """
    day = np.unique(date, return_inverse=True)[1]
    event = np.zeros(len(rows), dtype=np.int64)
    for column in (results.event, results.division):
        if column is not None:
            texts = column[rows].tolist()
            numbers = {text: number for number, text in enumerate(dict.fromkeys(["", *texts]))}
            event = event * len(numbers) + np.array(
                [numbers[text] for text in texts], dtype=np.int64
            )
    if (event == event[:1]).all():
        event[:] = 0
    unnamed = event == 0
    event[unnamed] = -1 - day[unnamed]
    names, event = np.unique(event, return_inverse=True)
    _, first, evening = np.unique(
        day * max(len(names), 1) + event, return_index=True, return_inverse=True
    )
    return evening.astype(np.int64), date[first], event[first]
