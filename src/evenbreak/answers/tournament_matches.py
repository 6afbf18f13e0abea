"""The matches of a tournament as they were played, for the ratings."""

from __future__ import annotations

from collections.abc import Sequence

from evenbreak.answers.answer import Answer
from evenbreak.answers.parts import Column, Table
from evenbreak.answers.wording import count_of
from evenbreak.files.store.tournament import TITLES, event_rows
from evenbreak.tournaments.evening.events import Event
from evenbreak.tournaments.evening.fold import Evening
from evenbreak.tournaments.evening.outlook import played_matches


def tournament_matches_answer(state: Evening, event: str) -> Answer:
    """Return all matches that were played, those that no longer count in the bracket among them.

    Parameters
    ----------
    state
        the tournament.
    event
        its name.

    >>> from evenbreak.tournaments.evening.events import Drawn, Entrant, Event, Opened, Plan, Result
    >>> from evenbreak.tournaments.evening.fold import evening
    >>> begun = Opened(Plan("single", 5), (Entrant("Ann", 80.0), Entrant("Bo", 70.0)))
    >>> happened = begun, Drawn(("Ann", "Bo"), (0, 1)), Result("F", ("Ann", "Bo"), (5, 3), "Ann")
    >>> state = evening([Event("2025-03-01T19:30:00", what) for what in happened])
    >>> tournament_matches_answer(state, "tonight").to_frame().loc[0, ["player_a", "score_b"]]
    player_a    Ann
    score_b       3
    Name: 0, dtype: object
    """
    columns = [
        Column("date", "date", left=True),
        Column("event"),
        Column("match", "match", left=True),
        Column(("player_a", "player_b"), "between", " - ".join, left=True),
        Column(("score_a", "score_b"), "score", lambda score: f"{score[0]}:{score[1]}"),
        Column(("race_a", "race_b"), "race", lambda race: f"{race[0]}:{race[1]}"),
        Column("winner", "winner", left=True),
        Column("forfeit", "forfeit", lambda yes: "yes" if yes else "", left=True),
    ]
    rows = []
    for result, at in sorted(played_matches(state), key=lambda one: one.at):
        score = None if result.forfeit else result.score
        needs = state.needed(result.match, result.players)
        ended = score is None or (score[0] == needs[0]) != (score[1] == needs[1])
        race = needs if ended else None  # a match that was imported may have had head starts
        rows.append(
            [
                at[:10],
                event,
                result.match,
                result.players,
                score,
                race,
                result.loser if result.stands else result.winner,
                result.forfeit,
            ]
        )
    table = Table("matches", columns, rows)
    forfeits = sum(bool(row[-1]) for row in rows)
    said = f"{count_of(len(rows) - forfeits, 'match was', 'matches were')} played"
    said += f", {forfeits:,} forfeited." if forfeits else "."
    return Answer(event, [said, table], csv=table)


def tournament_events_answer(events: Sequence[Event], name: str) -> Answer:
    """Return all that happened, in its order; what was undone is there too.

    Parameters
    ----------
    events
        the events.
    name
        the tournament's name.
    """
    columns = [Column(title, title, left=True) for title in TITLES]
    table = Table("events", columns, [list(row) for row in event_rows(events)])
    return Answer(name, [f"{count_of(len(events), 'event')}.", table], csv=table)
