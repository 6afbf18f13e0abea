"""A tournament under way: what just happened, what is played next, the odds, when it ends."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from datetime import datetime, timedelta
from typing import Any

import numpy as np

from evenbreak.answers.answer import Answer
from evenbreak.answers.parts import Column, Part, Quantities, Quantity, Table
from evenbreak.answers.tournament import races_words, slot_words
from evenbreak.answers.tournament_odds import share
from evenbreak.answers.wording import count_of
from evenbreak.tournaments.brackets.bracket import Place
from evenbreak.tournaments.brackets.standing import NOBODY
from evenbreak.tournaments.clock.evenings import InPlay
from evenbreak.tournaments.clock.event_pace import Timed
from evenbreak.tournaments.clock.finish import Finish, finish
from evenbreak.tournaments.evening.events import (
    Called,
    Drawn,
    Result,
    as_dict,
)
from evenbreak.tournaments.evening.fold import Evening
from evenbreak.tournaments.evening.moves import free_tables, score_words
from evenbreak.tournaments.odds.races import PairOdds, pair_odds
from evenbreak.tournaments.odds.title import title_odds

_SHOWN = 6  # players whose title odds everybody sees


@dataclass(frozen=True, eq=False)
class Night:
    """A tournament under way, at a moment.

    Parameters
    ----------
    state
        the state of the evening.
    now
        what time it is, such as 2025-03-01T19:30:00.
    """

    state: Evening
    now: str

    @property
    def heading(self) -> str:
        """What is played by whom."""
        state = self.state
        races = races_words(state.races)
        if not state.drawn:
            return f"{count_of(len(state.entrants), 'player')}, not drawn yet\n{races}"
        form = state.bracket.format
        players, played = count_of(len(state.order), "player"), len(state.winners)
        return (
            f"{form[0].upper()}{form[1:]}: {players}, "
            f"{count_of(played, 'match', 'matches')} decided\n{races}"
        )

    def laws(self) -> dict[str, PairOdds]:
        """Who wins each match in how many games, if the ratings are right."""
        state = self.state
        return pair_odds(state.bracket, state.ratings, state.races, scale=state.scale)

    @property
    def start(self) -> datetime:
        """When the first match was called, or else the draw was made."""
        events = self.state.events
        firsts = [e.at for kind in (Called, Drawn) for e in events if isinstance(e.what, kind)]
        return datetime.fromisoformat(min([*firsts[:1], self.now]))

    def minutes(self, at: str) -> float:
        """Return a time in minutes since the start."""
        passed = datetime.fromisoformat(at) - self.start
        return max(0.0, passed.total_seconds() / 60.0)

    def clock(self, minutes: float) -> str:
        """Return minutes since the start as a time of day."""
        return f"{self.start + timedelta(minutes=round(minutes)):%H:%M}"

    def finish(self, laws: Mapping[str, PairOdds]) -> Finish:
        """Return when it ends, given what has been played and what is on the tables."""
        state = self.state
        playing = [InPlay(name, self.minutes(one.at)) for name, one in state.on_tables.items()]
        return finish(
            state.bracket,
            laws,
            tables=state.plan.tables,
            pace=state.plan.discipline,
            results=state.winners,
            played=self._timed(),
            playing=playing,
            now=max([self.minutes(self.now), *(one.started for one in playing)]),
        )

    def _timed(self) -> list[Timed]:
        state, found = self.state, []
        for name, result in state.counted.items():
            call = state.calls.get(name)
            ends = [one.at for one in state.records.get(name, ()) if one.result is result]
            if call is None or not ends or not any(result.score):
                continue
            minutes = self.minutes(ends[0]) - self.minutes(call.at)
            if minutes >= 1.0:  # shorter ones were typed in afterwards
                found.append(Timed(sum(result.score), minutes))
        return found


def night_answer(night: Night, said: Sequence[str] = (), *, source: str = "") -> Answer:
    """Return the state of a tournament: what is played next, the title odds, when it ends.

    Parameters
    ----------
    night
        the tournament.
    said
        what has just happened, a sentence each.
    source
        the name of its file, for the heading.

    >>> from evenbreak.tournaments.evening.events import Entrant, Event, Opened, Plan
    >>> from evenbreak.tournaments.evening.fold import evening
    >>> both = Entrant("Ann", 80.0), Entrant("Bo", 70.0)
    >>> happened = Opened(Plan("single", 5), both), Drawn(("Ann", "Bo"), (0, 1))
    >>> state = evening([Event("2025-03-01T19:30:00", what) for what in happened])
    >>> answer = night_answer(Night(state, "2025-03-01T19:30:00"))
    >>> print(answer.sentences[0])
    Now play F, Ann against Bo, on table 1.
    It ends at about 20:08; 8 times out of 10 between 19:54 and 20:30.
    """
    state = night.state
    heading = f"{source}: {night.heading}" if source else night.heading
    if not state.drawn:
        return _before_the_draw(state, heading, said)
    laws = night.laws()
    odds = title_odds(state.bracket, laws, results=state.winners, rng=np.random.default_rng(0))
    words = list(said)
    parts: list[Part] = []
    to_play = list(state.standing.to_play)
    if to_play:
        found = night.finish(laws)
        tables = _tables(state, found)
        early, middle, late = found.bands
        words.append(_next_words(state, tables))
        words.append(
            f"It ends at about {night.clock(middle)}; 8 times out of 10 between "
            f"{night.clock(early)} and {night.clock(late)}."
        )
        keys = ("finish_p10", "finish_p50", "finish_p90")
        parts += [
            Quantities([Quantity(k, v) for k, v in zip(keys, found.bands, strict=True)]),
            _next_table(night, tables),
        ]
    else:
        first = [state.order[k] for k in np.flatnonzero(odds.title > 0.0).tolist()]
        if len(first) == 1:
            words.append(f"{first[0]} wins the tournament.")
        else:
            words.append(f"First place is tied: {' and '.join(first)}.")
        parts.append(_places(state, odds.p_place, odds.bracket.places))
    if to_play:
        order = np.argsort(-odds.title, kind="stable").tolist()
        rows = [[state.order[k], float(odds.title[k])] for k in order]
        columns = [Column("name", "player", left=True), Column("p_title", "title", share)]
        alive = [row for row in rows if row[1] > 0.0]
        parts += [
            Table("", columns, alive[:_SHOWN], title="Odds of the title"),
        ]
    data = {
        "odds": [
            {"name": name, "p_title": float(p)}
            for name, p in zip(state.order, odds.title, strict=True)
        ],
        "odds_exact": odds.exact,
        "set_aside": [as_dict(one.result) for one in state.aside],
    }
    warnings = [_aside_words(state, one.result) for one in state.aside]
    return Answer(heading, ["\n".join(words), *parts], warnings=warnings, data=data)


def _before_the_draw(state: Evening, heading: str, said: Sequence[str]) -> Answer:
    columns = [Column("name", "player", left=True), Column("rating", "rating")]
    rows = [[entrant.name, entrant.rating] for entrant in state.entrants.values()]
    words = [*said, "Make the draw with: evenbreak tournament draw"]
    return Answer(heading, ["\n".join(words), Table("entrants", columns, rows)])


def _aside_words(state: Evening, result: Result) -> str:
    """Return what is to be done about a match that the wrong players have played."""
    seats = state.standing.seats[result.match]
    if None in seats or NOBODY in seats:
        now = "its players are not known now"
    else:
        now = f"it is now {' against '.join(state.pair(result.match))}"
    return (
        f"{score_words(result)} in {result.match}, but {now}; the result is kept but does not "
        f"count. Play {result.match} again, or undo"
    )


def _tables(state: Evening, found: Finish) -> list[tuple[int | None, str]]:
    """Return the matches on tables, those to call to the free tables, then those that wait."""
    playing: list[tuple[int | None, str]] = sorted(
        (one.call.table, name) for name, one in state.on_tables.items()
    )
    free: list[int | None] = [*free_tables(state)]
    calls = [call.match for call in found.calls()]
    free += [None] * len(calls)
    return [*playing, *zip(free, calls, strict=False)]


def next_calls(night: Night) -> list[tuple[int, str]]:
    """Return which matches to call to which of the free tables."""
    tables = _tables(night.state, night.finish(night.laws()))
    return [(k, name) for k, name in tables if k and name not in night.state.on_tables]


def _next_words(state: Evening, tables: Sequence[tuple[int | None, str]]) -> str:
    ready = [
        f"{name}, {' against '.join(state.pair(name))}, on table {table}"
        for table, name in tables
        if table is not None and name not in state.on_tables
    ]
    if ready:
        return f"Now play {'; '.join(ready)}."
    waiting = sum(table is None for table, _ in tables)
    if waiting:
        return f"All tables are taken; {count_of(waiting, 'match waits', 'matches wait')}."
    return "No match can be called before one of those on the tables ends."


def _next_table(night: Night, tables: Sequence[tuple[int | None, str]]) -> Table:
    state = night.state
    columns = [
        Column("match", "match", left=True),
        Column(("player_a", "player_b"), "between", " - ".join, left=True),
        Column(("race_a", "race_b"), "race", _colon),
        Column("table", "table"),
        Column("state", "", left=True),
    ]
    rows = []
    for table, name in tables:
        pair = state.pair(name)
        if name in state.on_tables:
            words = f"playing since {night.clock(night.minutes(state.on_tables[name].at))}"
        else:
            words = "call" if table else "waits for a table"
        rows.append([name, pair, state.needed(name, pair), table, words])
    return Table("next", columns, rows)


def _colon(score: tuple[int, int]) -> str:
    return f"{score[0]}:{score[1]}"


def _places(state: Evening, p_place: Any, places: Sequence[Place]) -> Table:
    """Return who finished where; tied players share all the places they may get."""
    rows = []
    for k, name in enumerate(state.order):
        possible = [places[j] for j in np.flatnonzero(p_place[k] > 0.0).tolist()]
        if possible:
            shared = Place(possible[0].first, possible[-1].last, possible[0].event)
            rows.append((shared, str(shared), name))
    rows.sort(key=lambda row: (row[0].event, row[0].first, row[0].last))
    columns = [Column("place", "place"), Column("name", "player", left=True)]
    return Table("places", columns, [row[1:] for row in rows])


def bracket_table(state: Evening) -> Table:
    """Return all matches of the bracket, with players, scores and where the players come from."""
    columns = [
        Column("match", "match", left=True),
        Column(("player_a", "player_b"), "between", " - ".join, left=True),
        Column(("score_a", "score_b"), "score", _colon),
        Column("winner", "winner", left=True),
        Column("table", "table"),
    ]
    rows = []
    for match in state.bracket.matches:
        seats = state.standing.seats[match.name]
        if NOBODY in seats:
            continue
        names = tuple(
            slot_words(state.bracket, slot) if seat is None else state.order[seat]
            for slot, seat in zip(match.slots, seats, strict=True)
        )
        result = state.counted.get(match.name)
        score = winner = None
        if result is not None:
            winner = f"{result.winner} (forfeit)" if result.forfeit else result.winner
            games = result.games
            score = None if result.forfeit else (games[names[0]], games[names[1]])
        on_table = state.on_tables.get(match.name)
        table = None if on_table is None else on_table.call.table
        rows.append([match.name, names, score, winner, table])
    return Table("matches", columns, rows)
