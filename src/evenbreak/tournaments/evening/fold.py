"""An evening's state, obtained by folding its events.

A result counts if its two players are the ones in the match. So if a correction sends someone else
to a later match, that match's result no longer counts but is kept, and counts again if the
correction is undone.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Any

import numpy as np

from evenbreak.errors import InputError
from evenbreak.evenings.log import TakenBack
from evenbreak.ratings.scale import Scale, scale_of
from evenbreak.tournaments.brackets.bracket import Bracket, Group
from evenbreak.tournaments.brackets.groups import final_of_groups
from evenbreak.tournaments.brackets.knockout import FINALS
from evenbreak.tournaments.brackets.numbering import match_numbers
from evenbreak.tournaments.brackets.standing import Standing, ranked, standing
from evenbreak.tournaments.evening.chip_night import ChipNight, chip_night
from evenbreak.tournaments.evening.events import (
    Called,
    CalledBack,
    Changed,
    Drawn,
    Entrant,
    Event,
    Opened,
    Plan,
    Ranked,
    Result,
    Scored,
    Waits,
    score_words,
)
from evenbreak.tournaments.evening.history import read
from evenbreak.tournaments.evening.matches import (
    LiveScore,
    Matches,
    OnTable,
    Pairing,
    Played,
)
from evenbreak.tournaments.evening.plan import (
    bracket_now,
    bracket_of,
    changed,
    groups_of,
    races_of,
    table_changes,
    table_places,
    whole_bracket,
)
from evenbreak.tournaments.evening.players import People
from evenbreak.tournaments.odds.races import Races, games_needed
from evenbreak.words import Command, Sentence, say

ELIMINATIONS = ("double", "single", "pods", "consolation")


@dataclass(frozen=True, eq=False)
class Evening:
    """An evening's state.

    `order` and `lines` are the draw: players in seed order, and on first-round lines. `records` are
    all of each match's results that haven't been undone, in the order they came in; `calls` and
    `scores` are the last for each match and its players. `entries` has the number of the entry that
    brought each player in, and their place in it: a rename keeps both; `former` maps old names to
    current ones. `registered` players want to play and haven't been accepted yet, with the rating
    they state. `waits` has the reasons why matches wait. `numbers` are the numbers of `events` in
    the file, from 1; `undone` has those taken back, last one last, and `log` has all entries.
    `elsewhere` are the tables taken by the night's other events (`beside`), and `event` is the
    number of this one.
    """

    plan: Plan
    entrants: Mapping[str, Entrant]
    order: tuple[str, ...]
    lines: tuple[int | None, ...] | None
    records: Mapping[str, tuple[Played, ...]]
    dropped: tuple[str, ...]
    calls: Mapping[Pairing, OnTable]
    scores: Mapping[Pairing, LiveScore]
    ties: Mapping[str, Ranked]
    later: Mapping[str, tuple[str | None, ...]]
    events: tuple[Event, ...]
    numbers: tuple[int, ...]
    entries: Mapping[str, tuple[int, int]] = field(default_factory=dict)
    former: Mapping[str, str] = field(default_factory=dict)
    arrived: frozenset[str] = frozenset()
    paid: frozenset[str] = frozenset()
    registered: Mapping[str, float | None] = field(default_factory=dict)
    waits: Mapping[Pairing, Waits] = field(default_factory=dict)
    undone: Mapping[int, TakenBack[Event]] = field(default_factory=dict)
    log: tuple[Event, ...] = ()
    elsewhere: Mapping[int, tuple[str, ...]] = field(default_factory=dict)
    beside: tuple[Evening, ...] = ()
    event: int = 1

    @property
    def drawn(self) -> bool:
        """Whether the draw has been made."""
        return bool(self.order)

    @cached_property
    def bracket(self) -> Bracket:
        """The bracket; raises InputError before the draw."""
        if not self.order:
            raise InputError(
                "the draw hasn't been made yet; to make it: {draw}",
                draw=Command("tournament draw"),
            )
        if self.plan.form == "chips":
            return self.chip_night.bracket
        return bracket_now(self._drawn_up, self.plan, self.later)

    @cached_property
    def whole(self) -> Bracket:
        """The bracket with a stand-in for anything drawn later in the evening."""
        if self.plan.form == "chips":
            return self.bracket
        return whole_bracket(self._drawn_up, self.plan, self.later)

    @cached_property
    def chip_night(self) -> ChipNight:
        """Who is at which table in a chip tournament, who is waiting, and everyone's chips."""
        return chip_night(self.events)

    @cached_property
    def _drawn_up(self) -> Bracket:
        return bracket_of(self.plan, self.order, self.lines)

    @cached_property
    def match_numbers(self) -> dict[str, int]:
        """Each match's number; matches added by a late entry come last, because sheets are out."""
        drawn = next((e.what for e in self.events if isinstance(e.what, Drawn)), None)
        first = None
        if drawn and self.lines is not None and len(drawn.order) < len(self.order):
            first = match_numbers(
                bracket_of(self.plan, self.order[: len(drawn.order)], drawn.lines)
            )
        return match_numbers(self.whole, first)

    def number_of(self, match: str) -> int:
        """Return a match's number as people see it; 0 for a match that isn't in the bracket."""
        return self.match_numbers.get(match, 0) if self.order else 0

    def match_words(self, match: str) -> Sentence | str:
        """Return what people call a match, such as 'match 12'."""
        number = self.number_of(match)
        if not number:
            return match
        if self.plan.form == "chips":
            return say("rack {n}", n=number)
        return say("match {n}", n=number)

    @property
    def scale(self) -> Scale:
        """The ratings' scale."""
        return scale_of(self.plan.scale)

    @property
    def races(self) -> Races:
        """The races."""
        return races_of(self.plan)

    @cached_property
    def ratings(self) -> np.ndarray[Any, np.dtype[np.float64]]:
        """The ratings in seed order."""
        return np.array([self.entrants[name].rating for name in self.order])

    @cached_property
    def unrated(self) -> frozenset[str]:
        """Players who entered without a rating; no one if no one has a rating."""
        plan = self.plan
        new = plan.starter, plan.starter_error
        found = {
            one.name
            for one in self.entrants.values()
            if one.provisional and one.standard_error and (one.rating, one.standard_error) == new
        }
        return frozenset(found if len(found) < len(self.entrants) else ())

    @cached_property
    def counted(self) -> dict[str, Result]:
        """Each decided match's result, including forfeits by players who went home."""
        return self._settled[0]

    @cached_property
    def standing(self) -> Standing:
        """Who is in which match, and what can be played now."""
        return self._settled[1]

    @property
    def winners(self) -> dict[str, str]:
        """Who moved on from each decided match as its winner."""
        return {name: result.winner for name, result in self.counted.items()}

    @property
    def results(self) -> dict[str, str | tuple[str, ...]]:
        """The same, plus the final order of each group whose ties were broken."""
        return self._settled[2]

    @cached_property
    def aside(self) -> tuple[Played, ...]:
        """Matches that were played by players who no longer belong in them."""
        return tuple(
            played[-1] for name, played in self.records.items() if name not in self.counted
        )

    @cached_property
    def on_tables(self) -> dict[str, OnTable]:
        """The matches in play: a call can take a match or a player away from a table."""
        if self.plan.form == "chips":
            return {
                one.name: OnTable(Called(one.name, one.table, one.players), one.since)
                for one in self.chip_night.playing
            }
        called = {n: one for (n, who), one in self.calls.items() if self.sitting(n) == who}
        last = {one.call.table: name for name, one in called.items()}
        found, taken = dict[str, OnTable](), set[str]()
        for name, one in reversed(called.items()):
            there = last[one.call.table] == name and name in self.standing.to_play
            if there and taken.isdisjoint(one.call.players):
                found[name] = one
                taken.update(one.call.players)
        return dict(reversed(found.items()))

    @cached_property
    def live(self) -> dict[str, LiveScore]:
        """The scores of the matches in play."""
        return {
            name: one
            for (name, players), one in self.scores.items()
            if name in self.standing.to_play and self.sitting(name) == players
        }

    @property
    def free_tables(self) -> list[int]:
        """The tables in use on which no one is playing, except those assigned by hand only."""
        return [table for table in self._unused if table not in self.plan.reserved]

    @property
    def kept_tables(self) -> list[int]:
        """The tables assigned by hand only on which no one is playing."""
        return sorted({*self.plan.reserved} & {*self._unused})

    @property
    def _unused(self) -> list[int]:
        taken = {*self.elsewhere, *(one.call.table for one in self.on_tables.values())}
        return sorted({*range(1, self.plan.tables + 1)} - taken)

    @property
    def waiting_for(self) -> dict[str, Waits]:
        """The reasons why playable matches wait."""
        return {
            name: one
            for (name, players), one in self.waits.items()
            if name in self.standing.to_play and self.sitting(name) == players
        }

    @property
    def payers(self) -> int:
        """How many players the pot comes from: those marked as paid, if anyone is."""
        return len(self.paid) or len(self.entrants)

    def sitting(self, match: str) -> frozenset[str]:
        """Return the players who are known to be in a match."""
        seats = self.standing.seats.get(match, ())
        return frozenset(self.order[k] for k in seats if k is not None and k >= 0)

    def then(self, *events: Event) -> Evening:
        """Return the state after more events; this state and others from it don't change."""
        after = evening([*self.log, *events])
        if self.event > 1:
            house = min((self, *self.beside), key=lambda one: one.event)
            after = replace(after.at_tables_of(house), plan=after.plan.at_tables_of(self.plan))
        return replace(after, elsewhere=self.elsewhere, beside=self.beside, event=self.event)

    def at_tables_of(self, house: Evening) -> Evening:
        """Return the state with another event's tables, including later changes to them."""
        calls = dict(self.calls)
        for at, places in table_changes(house.events):
            for pairing, one in list(calls.items()):
                called = (e.at for e in self.events if e.what == one.call)
                if at <= max(called, default=one.at):
                    continue
                if table := places.get(one.call.table):
                    calls[pairing] = one._replace(call=replace(one.call, table=table))
                else:
                    del calls[pairing]
        return replace(self, plan=self.plan.at_tables_of(house.plan), calls=calls)

    def pair(self, match: str) -> tuple[str, str]:
        """Return the players in a match that is or was playable."""
        one, other = (self.order[k] for k in self.standing.seats[match] if k is not None)
        return one, other

    def needed(self, match: str, players: tuple[str, str]) -> tuple[int, int]:
        """Return the games that each of the two players needs, or needed, in a match."""
        if self.plan.form == "chips":
            return 1, 1  # a rack
        for played in reversed(self.records.get(match, ())):
            result = played.result
            if result.race is not None and set(result.players) == set(players):
                each = dict(zip(result.players, result.race, strict=True))
                return each[players[0]], each[players[1]]
        one, other = (self.entrants[name].rating for name in players)
        race = self.races.of(self.bracket.match(match))
        m, n = games_needed(np.array([one - other]), race, self.scale)
        return int(m[0]), int(n[0])

    def result_words(self, result: Result) -> Sentence:
        """Return a result in words, including the players' targets if they differ."""
        return score_words(result, self.uneven_race(result))

    def uneven_race(self, result: Result) -> tuple[int, int] | None:
        """Return the games each player needed in a result; None if both needed the same."""
        known = self.drawn and result.match in self.bracket.by_name
        if not known or not self.entrants.keys() >= {*result.players}:
            return None
        needs = self.needed(result.match, result.players)
        return needs if needs[0] != needs[1] else None

    @cached_property
    def _settled(self) -> tuple[dict[str, Result], Standing, dict[str, str | tuple[str, ...]]]:
        counted: dict[str, Result] = {}
        while True:
            results: dict[str, str | tuple[str, ...]] = {
                n: one.winner for n, one in counted.items()
            }
            now = standing(self.bracket, results)
            for _ in ("groups", "the runners-up of them"):
                broken = {n: one.order for n, one in self.ties.items() if _breaks_ties(now, one)}
                if broken.keys() - results.keys():
                    results |= broken
                    now = standing(self.bracket, results)
            found = {}
            for name in now.to_play:
                one, other = now.seats[name]
                pair = self.order[one or 0], self.order[other or 0]
                result = self._result(name, pair)
                if result is not None:
                    found[name] = result
            if not found:
                return counted, now, results
            counted |= found

    def _result(self, match: str, pair: tuple[str, str]) -> Result | None:
        for played in reversed(self.records.get(match, ())):
            if set(played.result.players) == set(pair):
                return played.result
        gone = [name for name in self.dropped if name in pair]
        if not gone:
            return None
        return Result(match, pair, (0, 0), pair[gone[-1] == pair[0]], forfeit=True)


def evening(events: Iterable[Event]) -> Evening:
    """Return the state after events; raise InputError if they aren't an evening's."""
    log = tuple(events)
    history = read(log)
    kept = list(history.kept.values())
    first = kept[0].what if kept else None
    if not isinstance(first, Opened):
        raise InputError("the first entry doesn't start a tournament")
    plan, people, matches = first.plan, People(first.entrants), Matches()
    for event in (_as_named_now(event, plan, people.order) for event in kept[1:]):
        in_pairs = plan.form == "swiss" and bool(matches.later)
        people.take(event.what, in_pairs=in_pairs)
        if isinstance(event.what, Changed):
            bracket = bracket_of(plan, *people.drawn_up) if people.order else None
            before, plan = plan, changed(plan, event.what, bracket, matches.begun)
            matches.move(table_places(before, plan))
        else:
            matches.take(event, in_pairs=in_pairs)
    order, lines = people.drawn_up
    return Evening(
        plan,
        people.entrants,
        order,
        lines,
        {name: tuple(played) for name, played in matches.records.items()},
        tuple(people.dropped),
        matches.calls,
        matches.scores,
        matches.ties,
        matches.later,
        tuple(kept),
        tuple(history.kept),
        history.entries,
        history.former,
        frozenset(people.arrived & people.entrants.keys()),
        frozenset(people.paid & people.entrants.keys()),
        people.registered,
        matches.waits,
        history.undone,
        log,
    )


def _as_named_now(event: Event, plan: Plan, order: Sequence[str]) -> Event:
    """Return an event with current match names.

    The final after six or more groups used to be called F, like the sixth group.
    """
    what = event.what
    if plan.form != "groups" or not isinstance(what, Called | CalledBack | Scored | Result):
        return event
    if what.match == FINALS[0]:
        last = final_of_groups(groups_of(plan, len(order)))
        return replace(event, what=replace(what, match=last))
    return event


def tied_ranks(now: Standing, group: Group) -> list[int]:
    """Return how many players are ahead of each member of a completed group."""
    winners = [now.winners[name] for name in group.matches]
    return ranked(group.members, group.pairs, winners)


def _breaks_ties(now: Standing, tie: Ranked) -> bool:
    """Return whether a group's results allow a final order."""
    if now.bracket.runners_up and tie.group == now.bracket.runners_up.name:
        share = {now.bracket.players[player]: share for _, player, share in now.runners_up}
        shares = [share.get(name, 0) for name in tie.order]
        is_all = len(share) == len(now.bracket.groups) and sorted(share) == sorted(tie.order)
        return is_all and shares == sorted(shares, reverse=True)
    for group in now.bracket.groups:
        names = [now.bracket.players[k] for k in group.members]
        if group.name != tie.group or not all(name in now.winners for name in group.matches):
            continue
        if sorted(names) == sorted(tie.order):
            ahead = dict(zip(names, tied_ranks(now, group), strict=True))
            ranks = [ahead[name] for name in tie.order]
            return ranks == sorted(ranks)
    return False
