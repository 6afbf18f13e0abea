"""What was written for printing: the cards, and everyone's first match."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

from evenbreak.answers.kit.answer import Answer
from evenbreak.answers.kit.columns import column_of, columns_of
from evenbreak.answers.kit.parts import Table
from evenbreak.answers.kit.wording import count_of
from evenbreak.answers.tournament.tournament import pair_words, races_words
from evenbreak.errors import InputError
from evenbreak.files.store.tournament import TITLES, event_rows
from evenbreak.tournaments.brackets.bracket import Source
from evenbreak.tournaments.brackets.standing import NOBODY
from evenbreak.tournaments.evening.events import Event
from evenbreak.tournaments.evening.fold import Evening
from evenbreak.tournaments.evening.matches import played_matches
from evenbreak.tournaments.evening.moves import known_match
from evenbreak.words import Sentence, say


def printed_answer(state: Evening, title: str, written: str) -> Answer:
    """Return what was written, by name, with the draw list: who plays first and where."""
    show = {"table": state.plan.table_name}
    columns = columns_of("seed name first_match between table", show=show)
    rows = [
        [one.seed, one.name, one.match, " - ".join(one.pair), one.table]
        for one in first_matches(state)
    ]
    return Answer(title, [written, Table("draw", columns, rows)])


class First(NamedTuple):
    """A player's first match: its number, its players, and the table if it has been called."""

    seed: int
    name: str
    match: int | None
    pair: tuple[str, ...]
    table: int | None


def first_matches(state: Evening) -> list[First]:
    """Return each player's first match, in seed order."""
    now = state.standing
    first: dict[str, str] = {}
    for match in state.bracket.matches:
        for seat in now.seats[match.name]:
            if seat is not None and seat != NOBODY:
                first.setdefault(state.order[seat], match.name)
    found = []
    for seed, name in enumerate(state.order, start=1):
        where = first.get(name)
        pair = () if where is None else pair_words(now, where, state.match_numbers)
        called = None if where is None else state.on_tables.get(where)
        number = None if where is None else state.number_of(where)
        found.append(First(seed, name, number, pair, called.call.table if called else None))
    return found


@dataclass(frozen=True)
class Card:
    """A score card; `table` is '' until the match is called."""

    number: int
    where: Sentence | str
    names: tuple[str, str]
    needs: tuple[int, int]
    table: str
    onward: Sentence | str


def score_cards(state: Evening, match: str | None = None) -> list[Card]:
    """Return the cards for all open matches with known players, or for one match.

    Raises InputError before the draw, or if there is no such match.

    >>> from evenbreak.tournaments.evening.events import Drawn, Entrant, Event, Opened, Plan
    >>> from evenbreak.tournaments.evening.fold import evening
    >>> names = ("Ann", "Bo", "Cy")
    >>> begun = Opened(Plan("single", 5), tuple(Entrant(name, 80.0) for name in names))
    >>> happened = begun, Drawn(names, (0, None, 1, 2))
    >>> (card,) = score_cards(evening([Event("2025-03-01T19:30:00", what) for what in happened]))
    >>> card.number, card.names, card.needs, card.onward
    (1, ('Bo', 'Cy'), (5, 5), 'Winner to match 2, loser out.')
    """
    found = known_match(state, match) if match is not None else None
    if found is not None and found not in state.standing.to_play:
        raise InputError(
            "{match} isn't ready to be played. Print its card once it is.",
            match=state.match_words(found),
        )
    names = [found] if found is not None else list(state.standing.to_play)
    return [_card(state, name) for name in names]


def _card(state: Evening, name: str) -> Card:
    match, pair = state.bracket.match(name), state.pair(name)
    side = {
        "winners": say("winners’ side, round {n}", n=match.round),
        "losers": say("losers’ side, round {n}", n=match.round),
        "final": say("final"),
        "second final": say("second final"),
        "third place": say("third place"),
        "knock-out": say("knockout, round {n}", n=match.round),
    }.get(match.side) or say("{part}, round {n}", part=match.side, n=match.round)
    table = state.on_tables.get(name)
    return Card(
        state.number_of(name),
        side,
        pair,
        state.needed(name, pair),
        "" if table is None else state.plan.table_name(table.call.table),
        onward_words(state, name),
    )


def paper_words(state: Evening, live: str = "") -> tuple[str, str, str | None]:
    """Return the text around a printed bracket: what is played, when it was printed, who won."""
    form = str(state.bracket.format)
    many = f"{len(state.order)} players, {form}. {races_words(state.races)}"
    played = f"After {count_of(len(state.counted), 'match', 'matches')}." if state.counted else ""
    pen = "The small number is the race. Write the score over it."
    finals = [m for m in state.bracket.matches if m.side in ("final", "second final")]
    over = not state.standing.to_play and finals
    won = [state.counted[m.name].winner for m in finals if over and m.name in state.counted]
    return many, " ".join(filter(None, (played, pen, live))), won[-1] if won else ""


def onward_words(state: Evening, name: str) -> Sentence | str:
    """Return where a match's winner and loser go, such as 'Winner to match 33'."""
    match = state.bracket.match(name)
    to = {
        slot.outcome: state.number_of(one.name)
        for one in reversed(state.bracket.matches)
        for slot in one.slots
        if isinstance(slot, Source) and slot.match == name
    }
    won, lost = to.get("winner"), to.get("loser")
    if match.side in ("final", "second final"):
        again = say("If the losers’-side winner wins: match {n}.", n=won) if won else ""
        return again if match.side == "final" else ""
    if won and lost:
        return say("Winner to match {won}, loser to match {lost}.", won=won, lost=lost)
    if won:
        return say("Winner to match {won}, loser out.", won=won)
    if lost:
        return say("Winner goes on, loser to match {lost}.", lost=lost)
    return ""


def tournament_matches_answer(state: Evening, event: str) -> Answer:
    """Return all matches played, including those that no longer count in the bracket."""
    columns = columns_of("date event match pair score_pair race_pair winner forfeit")
    rows = []
    for result, at in sorted(played_matches(state.records), key=lambda one: one.at):
        score = None if result.forfeit else result.score
        needs = state.needed(result.match, result.players)
        ended = score is None or (score[0] == needs[0]) != (score[1] == needs[1])
        race = needs if ended else None  # a match that was imported may have had head starts
        winner: str | None = result.loser if result.stands else result.winner
        if result.ended and score and 2 * result.games[str(winner)] <= sum(score):
            winner = None  # on time or by concession: the games count, as ratings go by them
        rows.append(
            [
                at[:10],
                event,
                state.number_of(result.match) or result.match,
                result.players,
                score,
                race,
                winner,
                result.forfeit,
            ]
        )
    table = Table("matches", columns, rows)
    forfeits = sum(bool(row[-1]) for row in rows)
    said = f"{count_of(len(rows) - forfeits, 'match was', 'matches were')} played"
    said += f", {forfeits:,} forfeited." if forfeits else "."
    return Answer(event, [said, table], csv=table)


def tournament_events_answer(events: Sequence[Event], name: str) -> Answer:
    """Return all events in order, including those that were undone."""
    columns = [column_of("event_title", title=title) for title in TITLES]
    table = Table("events", columns, [list(row) for row in event_rows(events)])
    return Answer(name, [f"{count_of(len(events), 'event')}.", table], csv=table)
