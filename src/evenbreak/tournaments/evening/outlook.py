"""An evening's outlook at one moment: the odds, the finish time, what would change it.

Tonight's games say something about the players, and tonight's matches say something about the pace:
both are used in predicting the remaining matches.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from datetime import datetime
from functools import cached_property
from typing import NamedTuple

import numpy as np

from evenbreak.arrays import Floats
from evenbreak.errors import InputError
from evenbreak.matches.pace import Pace, Turnover
from evenbreak.tournaments.chips.play import rack_chances
from evenbreak.tournaments.clock.evenings import InPlay
from evenbreak.tournaments.clock.event_pace import QUICKEST, Timed, event_pace, learned_pace
from evenbreak.tournaments.clock.finish import Call, Finish, finish
from evenbreak.tournaments.clock.shared_tables import SharedTables
from evenbreak.tournaments.evening.chip_outlook import (
    chip_minutes,
    chip_odds,
    drawn_racks,
    drawn_skills,
)
from evenbreak.tournaments.evening.events import Called, Drawn, Result, Scored
from evenbreak.tournaments.evening.fold import Evening
from evenbreak.tournaments.evening.later_draws import stage_to_draw
from evenbreak.tournaments.evening.matches import played_matches
from evenbreak.tournaments.evening.plan import pairings, swiss_of
from evenbreak.tournaments.evening.skills import Games, skills_before, skills_tonight
from evenbreak.tournaments.odds.draws import redraw_odds, swiss_odds
from evenbreak.tournaments.odds.leverage import Leverage, leverages
from evenbreak.tournaments.odds.races import (
    PairOdds,
    Races,
    chances_given,
    from_score,
    pair_odds,
    race_chance,
)
from evenbreak.tournaments.odds.title import PlaceOdds, title_odds
from evenbreak.tournaments.odds.uncertain import (
    UncertainOdds,
    drawn_chances,
    drawn_ratings,
    over_ratings,
    title_bands,
)

_REDRAWS = 6  # of the qualifiers, if there are more ways than 24
_SWISSES = 600  # are played out
_RATINGS = 200  # draws of the ratings among them
_TAIL = 1.2816  # standard errors from the middle: the tenth and the ninetieth percentile


class _InScore(NamedTuple):
    """A match in play: its players by position, and the games that each needs and has won."""

    match: str
    seats: tuple[int, int]
    needs: tuple[int, int]
    score: tuple[int, int]


@dataclass(frozen=True, eq=False)
class Outlook:
    """A tournament in progress, after its draw, at one moment.

    `walkovers` is the chance that a match not yet started is a walkover, for either player. Times
    are counted from `origin`, by default the night's first match.
    """

    state: Evening
    now: str
    walkovers: float = 0.0
    origin: datetime | None = None

    @cached_property
    def start(self) -> datetime:
        """When the night's first match was called, or else when the draw was made."""
        if self.origin is not None:
            return self.origin
        each = [self.state.events, *(one.events for one in self.state.beside)]
        firsts = [
            [e.at for kind in (Called, Drawn) for e in events if isinstance(e.what, kind)][:1]
            for events in each
        ]
        return datetime.fromisoformat(min([at for ats in firsts for at in ats] + [self.now]))

    @property
    def pace(self) -> Pace:
        """The pace here, before any of tonight's matches."""
        plan = self.state.plan
        return event_pace(plan.discipline, plan.earlier)

    def minutes(self, at: str) -> float:
        """Return a time in minutes since the start."""
        passed = datetime.fromisoformat(at) - self.start
        return max(0.0, passed.total_seconds() / 60.0)

    @cached_property
    def laws(self) -> dict[str, PairOdds]:
        """Who wins each match and in how many games, from its score on, with exact ratings."""
        return self.laws_of(self.state.races)

    def laws_of(self, races: Races) -> dict[str, PairOdds]:
        """Return the same with different races in matches that haven't started."""
        state = self.state
        laws = self._pair_odds(races)
        begun = {**state.on_tables, **state.live}
        if races is not state.races and begun:
            usual = self._pair_odds(state.races)
            laws |= {name: usual[name] for name in begun}
        if state.dropped:
            made = {id(law): self._without_dropped(law) for law in laws.values()}
            laws = {name: made[id(law)] for name, law in laws.items()}
        for name, seats, needs, score in self._in_score:
            one, other = seats
            p = float(state.scale.win_probability(state.ratings[one] - state.ratings[other]))
            laws[name] = from_score(laws[name], seats, needs, score, p, state.plan.match_form)
        return laws

    def _pair_odds(self, races: Races) -> dict[str, PairOdds]:
        state = self.state
        form = state.plan.match_form
        return pair_odds(state.whole, state.ratings, races, scale=state.scale, form=form)

    def _without_dropped(self, law: PairOdds) -> PairOdds:
        """Return the odds for a match in which players who have dropped out lose without a game."""
        ends = law.ends.copy()
        for name in self.state.dropped:
            gone = self.state.order.index(name)
            ends[gone] = ends[:, gone] = 0.0
            ends[:, gone, 0] = 1.0
        return PairOdds(ends)

    @property
    def scores(self) -> dict[str, tuple[int, int]]:
        """The scores of the matches in play, the first player's games first."""
        return {name: score for name, _, _, score in self._in_score}

    @cached_property
    def _in_score(self) -> list[_InScore]:
        """The matches in play whose score is known."""
        state, found = self.state, []
        for name, live in state.live.items():
            pair, seats = state.pair(name), self._seats(name)
            games = dict(zip(live.what.players, live.what.score, strict=True))
            score = games[pair[0]], games[pair[1]]
            found.append(_InScore(name, seats, state.needed(name, pair), score))
        return found

    @cached_property
    def as_if_sure(self) -> PlaceOdds:
        """The odds from here on, with ratings treated as exact."""
        state = self.state
        rng = np.random.default_rng(0)
        chances = self.chances(state.ratings)
        if state.plan.form == "swiss":
            return self._swiss_odds(chances)
        if state.plan.form == "chips":
            return chip_odds(state, rack_chances(state.ratings, scale=state.scale))
        if stage_to_draw(state) is not None:
            return self._redraw_odds()
        return title_odds(state.bracket, chances, results=state.results, rng=rng)

    @cached_property
    def odds(self) -> PlaceOdds:
        """The odds from here on, averaged over the uncertainty of the ratings."""
        if not self._is_open:
            return self.as_if_sure
        state = self.state
        if state.plan.form == "chips":
            return chip_odds(state, drawn_racks(state, self._drawn))
        if state.plan.form == "swiss":
            return self._swiss_odds(drawn_chances(state.whole, self.chances, self._drawn))
        if stage_to_draw(state) is not None:
            return self.as_if_sure
        return self._over_ratings.averaged

    @property
    def _is_open(self) -> bool:
        """Whether anything is left to play between players whose ratings may be off."""
        to_come = bool(self.state.standing.to_play) or stage_to_draw(self.state) is not None
        return to_come and bool(self.errors.any())

    @cached_property
    def _drawn(self) -> Floats:
        """Draws of the skills, one per row, if the rest of the evening is simulated."""
        if self.state.plan.form == "chips":
            return drawn_skills(*self.skills)
        return drawn_ratings(*self.skills, _RATINGS // 2, np.random.default_rng(0))

    @cached_property
    def skills(self) -> tuple[Floats, Floats]:
        """The players' skills, given tonight's games: the mean and the covariance."""
        state = self.state
        unrated = np.array([name in state.unrated for name in state.order])
        prior = skills_before(state.ratings, self.errors, unrated)
        return skills_tonight(*prior, self.games, state.scale, state.plan.match_form)

    @cached_property
    def _over_ratings(self) -> UncertainOdds:
        state = self.state
        return over_ratings(state.bracket, self.chances, *self.skills, results=state.results)

    @cached_property
    def bands(self) -> dict[str, tuple[float, float]]:
        """Each unrated player's title odds if they are weak, or strong.

        See `UncertainOdds.bands`. If qualifiers are still to be drawn, all unrated players are
        weak, or strong, together.
        """
        state = self.state
        if not (state.unrated and self._is_open):
            return {}
        if state.plan.form in ("swiss", "chips"):
            by_draw = self.odds.by_draw
            assert by_draw is not None  # noqa: S101  the ratings were drawn
            found = title_bands(by_draw, self._drawn)
        elif stage_to_draw(state) is not None:
            found = np.stack([self._redraw_odds(tail).title for tail in (-_TAIL, _TAIL)], axis=1)
        else:
            found = self._over_ratings.bands
        every = zip(state.order, found.tolist(), strict=True)
        return {name: (low, high) for name, (low, high) in every if name in state.unrated}

    def _redraw_odds(self, tail: float = 0.0) -> PlaceOdds:
        """Return the odds if unrated players are this many standard errors better."""
        state = self.state
        mean, covariance = self.skills if tail else (state.ratings, np.zeros((1, 1)))
        new = np.array([name in state.unrated for name in state.order])
        skills = mean + tail * new * np.sqrt(np.diag(covariance))
        return redraw_odds(
            state.whole, self.chances(skills), results=state.results, samples=_REDRAWS
        )

    def _swiss_odds(self, chances: Mapping[str, Floats]) -> PlaceOdds:
        state = self.state
        win = chances[state.whole.matches[-1].name].copy()
        for name in {*self.state.on_tables, *self.state.live}:
            one, other = self._seats(name)
            win[one, other], win[other, one] = (
                chances[name][pair] for pair in ((one, other), (other, one))
            )
        event = swiss_of(state.plan, state.order)
        rounds, gone = pairings(state.later, state.counted), state.dropped
        return swiss_odds(event, win, played=rounds, without=gone, runs=_SWISSES)

    @cached_property
    def errors(self) -> Floats:
        """The uncertainty about the ratings, in seed order."""
        return np.array([self.state.entrants[name].standard_error for name in self.state.order])

    @cached_property
    def chances(self) -> Callable[[Floats], dict[str, Floats]]:
        """The matches' chances from here on, given the players' skills."""
        state, walkovers, in_score = self.state, self.walkovers, self._in_score
        form = state.plan.match_form
        usual = chances_given(state.whole, state.ratings, state.races, scale=state.scale, form=form)

        gone = [state.order.index(name) for name in state.dropped]
        begun = [(name, *self._seats(name)) for name in state.on_tables]

        def chances(skills: Floats) -> dict[str, Floats]:
            played = tables = usual(skills)
            # The matches that have begun share a table, in which each has a pair of its own.
            shared: dict[int, Floats] = {}

            def settle(name: str, one: int, other: int, won: float) -> None:
                table = tables[name]
                if id(table) not in shared:
                    mine = shared[id(table)] = table.copy()
                    shared[id(mine)] = mine
                tables[name] = shared[id(table)]
                tables[name][one, other], tables[name][other, one] = won, 1.0 - won

            if walkovers:
                either = 0.5 * walkovers
                made = {id(t): either + (1.0 - walkovers) * t for t in played.values()}
                tables = {name: made[id(table)] for name, table in played.items()}
            if gone:
                made = {id(table): table.copy() for table in tables.values()}
                for table in made.values():
                    for seat in gone:
                        table[seat], table[:, seat], table[seat, seat] = 0.0, 1.0, 0.5
                tables = {name: made[id(table)] for name, table in tables.items()}
            if walkovers:
                for name, one, other in begun:
                    settle(name, one, other, float(played[name][one, other]))
            for name, (one, other), needs, score in in_score:
                gap = state.scale.log_odds(skills[one] - skills[other])
                settle(name, one, other, float(race_chance(gap, needs, form, score)))
            return tables

        return chances

    def _seats(self, match: str) -> tuple[int, int]:
        one, other = self.state.pair(match)
        return self.state.order.index(one), self.state.order.index(other)

    @property
    def games(self) -> list[Games]:
        """Tonight's games, including those in matches still in play."""
        state = self.state
        everything: list[Result | Scored] = [one.what for one in state.live.values()]
        everything += [
            one.result for one in played_matches(state.records) if not one.result.forfeit
        ]
        seat = state.order.index
        return [
            Games(seat(what.players[0]), seat(what.players[1]), *what.score) for what in everything
        ]

    def leverages(self, payouts: Sequence[float] | None = None) -> list[Leverage]:
        """Return what each remaining match changes; nothing if the bracket is too large.

        That is the title odds, or with `payouts` for first place, second, ..., the prizes.
        """
        state = self.state
        if stage_to_draw(state) is not None or state.plan.form in ("swiss", "chips"):
            return []
        win = self.chances(state.ratings)
        try:
            return leverages(state.bracket, win, payouts=payouts, results=state.results)
        except InputError:
            return []

    @cached_property
    def as_things_are(self) -> Finish:
        """When it ends if nothing changes, and the suggested matches are called now."""
        if self._shared is None:
            return self.uncalled.after_calls(self.to_call)
        called = [(k, name) for _, k, name in self._to_call]
        return self._shared.after_calls(called)[self._part]

    @cached_property
    def uncalled(self) -> Finish:
        """When it ends if it has the tables to itself and nothing is called now."""
        return self.finish()

    @cached_property
    def _events(self) -> list[Evening]:
        """The night's events that have been drawn, in order; they share the tables."""
        every = sorted((self.state, *self.state.beside), key=lambda one: one.event)
        return [one for one in every if one.drawn and one.plan.form != "chips"]

    @property
    def _part(self) -> int:
        return self._events.index(self.state)

    @cached_property
    def _shared(self) -> SharedTables | None:
        """The night on its tables, if there are several events."""
        if self.state.plan.form == "chips" or len(self._events) < 2:
            return None
        parts = [
            self.uncalled
            if one is self.state
            else replace(self, state=one, origin=self.start).uncalled
            for one in self._events
        ]
        return SharedTables(tuple(parts), self.state.plan.tables)

    @cached_property
    def _queue(self) -> list[tuple[int, Call]]:
        """The night's callable matches, each with its event, best first."""
        free = max(1, len(self.state.free_tables))
        every = (
            [(0, call) for call in self.uncalled.calls(free)]
            if self._shared is None
            else self._shared.calls(free)
        )
        brackets = [one.bracket for one in self._events]
        grouped = [{n for group in one.groups for n in group.matches} for one in brackets]
        found = [(k, one) for k, one in every if one.match in brackets[k].by_name]
        found.sort(
            key=lambda one: (
                brackets[one[0]].match(one[1].match).round if one[1].match in grouped[one[0]] else 0
            )
        )
        return [(k, one) for k, one in found if one.match in self._events[k].standing.to_play]

    @property
    def queue(self) -> list[tuple[int, str]]:
        """The night's callable matches, each with its event, best first."""
        return [(self._events[k].event, call.match) for k, call in self._queue]

    @property
    def calls(self) -> list[Call]:
        """The callable matches, best first; in groups, round by round."""
        return [call for k, call in self._queue if k == self._part]

    @cached_property
    def _to_call(self) -> list[tuple[int, int, str]]:
        """The free tables, each with the event and the match to call to it now."""
        states = self._events
        playing = [one.call.players for state in states for one in state.on_tables.values()]
        busy, found = {player for pair in playing for player in pair}, []
        free = iter(self.state.free_tables)
        for k, call in self._queue:
            pair = set(states[k].pair(call.match))
            if pair & busy or call.match in states[k].waiting_for:
                continue
            if (table := next(free, None)) is None:
                break
            busy |= pair
            found.append((table, k, call.match))
        return found

    @property
    def tables_to_call(self) -> dict[str, int]:
        """The matches to call now if their players are free, each with its table."""
        return {name: table for table, k, name in self._to_call if k == self._part}

    @property
    def to_call(self) -> tuple[str, ...]:
        """The matches to call now, one per free table, if their players are free."""
        return tuple(self.tables_to_call)

    def finish(
        self,
        *,
        laws: Mapping[str, PairOdds] | None = None,
        tables: int | None = None,
        pace: Pace | str | None = None,
        turnover: Turnover | None = None,
    ) -> Finish:
        """Return when it ends, given what has been played and what is on the tables."""
        state = self.state
        playing = [self._in_play(name, one.at) for name, one in state.on_tables.items()]
        return finish(
            state.whole,
            self.laws if laws is None else laws,
            tables=state.plan.tables if tables is None else tables,
            pace=self.pace if pace is None else pace,
            turnover=turnover,
            results=state.results,
            played=self.timed,
            playing=playing,
            now=max([self.minutes(self.now), *(one.scored or one.started for one in playing)]),
            seed=state.event - 1,
        )

    def chip_finishes(
        self, *, tables: int | None = None, turnover: Turnover | None = None
    ) -> Floats:
        """Return when a chip tournament ends on each of many evenings, as `finish` does."""
        win = rack_chances(self.state.ratings, scale=self.state.scale)
        pace = learned_pace(self.pace, self.timed)
        later = chip_minutes(self.state, win, pace, tables=tables, turnover=turnover)
        return self.minutes(self.now) + later

    def _in_play(self, name: str, at: str) -> InPlay:
        live = self.state.live.get(name)
        if live is None or live.at < at or not any(live.what.score):
            return InPlay(name, self.minutes(at))
        return InPlay(name, self.minutes(at), sum(live.what.score), self.minutes(live.at))

    @property
    def timed(self) -> list[Timed]:
        """The games and minutes of tonight's called and finished matches."""
        state, found = self.state, []
        chips = state.plan.form == "chips"
        for name, result in state.counted.items():
            call = state.calls.get((name, frozenset(result.players)))
            began = state.chip_night.racks[name].since if chips else call and call.at
            pair = result.players
            ends = [one.at for one in state.records.get(name, ()) if one.result.players == pair]
            if began is None or not ends or not any(result.score):
                continue
            one = Timed(sum(result.score), self.minutes(ends[0]) - self.minutes(began))
            if one.minutes >= QUICKEST * one.games:
                found.append(one)
        return found
