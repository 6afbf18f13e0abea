"""What a cap and the order of nomination do to a team league."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import cache, cached_property
from typing import Any

import numpy as np

from evenbreak.answers.answer import Answer
from evenbreak.answers.parts import Column, Part, Quantities, Quantity, Table
from evenbreak.answers.scale_words import scale_words
from evenbreak.answers.team_meeting import race_words
from evenbreak.answers.wording import chance, count_of, percent
from evenbreak.arrays import Floats
from evenbreak.errors import InputError
from evenbreak.handicaps.charts.race_of_pair import Race
from evenbreak.ratings.roster import Roster
from evenbreak.ratings.scale import Scale
from evenbreak.teams.league_rules import against_all, first_edges, league_nights
from evenbreak.teams.order import BOTH, NAMED, order_of
from evenbreak.teams.set_laws import set_laws
from evenbreak.teams.squad import Squad, line_ups

_IN_WORDS = {
    "alternate": "in turn, A in set 1",
    "home": "always A",
    "blind": "both at once, unseen",
    "winner": "the winner of the last set, A in set 1",
    "loser": "the loser of the last set, A in set 1",
}
_SMALL = 5e-4  # a chance that differs by less is the same


@dataclass(frozen=True, eq=False)
class LeagueRules:
    """The teams of a league and its rules.

    Parameters
    ----------
    rosters
        each team's players, with a rating for everybody.
    squads
        the same with the caps of the league.
    levels
        each team's skill levels; NaN where none are stated.
    race, scale
        what is played in each set, and the scale of the ratings.
    sets, order
        how many sets a night has, and who names first.
    """

    rosters: Mapping[str, Roster]
    squads: Mapping[str, Squad]
    levels: Mapping[str, Floats]
    race: Race
    scale: Scale
    sets: int
    order: str

    @property
    def capped(self) -> bool:
        """Whether the league has a cap."""
        return any(squad.caps for squad in self.squads.values())

    def nights(self, order: str, *, capped: bool = True) -> Floats:
        """Return each team's chance against each other, as `league_nights`."""
        every = list(self.squads.values())
        used = every if capped else [Squad(one.names, (), one.times) for one in every]
        return league_nights(used, self._law, sets=self.sets, order=order)

    @cached_property
    def _law(self) -> Callable[[int, int], Floats]:
        rosters = list(self.rosters.values())

        @cache
        def law(i: int, j: int) -> Floats:
            return set_laws(rosters[i], rosters[j], self.race, scale=self.scale)

        return law

    def check(self) -> None:
        """Refuse teams that cannot fill a night within the caps."""
        for team, squad in self.squads.items():
            try:
                line_ups(squad, (1,) * self.sets)
            except InputError as error:
                raise InputError(f"{team}: {error}") from None


def team_rules_answer(
    rules: LeagueRules, *, source: str = "", warnings: Sequence[str] = ()
) -> Answer:
    """Return what a cap and the order of nomination do to a team league.

    Parameters
    ----------
    rules
        the teams and the rules.
    source
        the name of the file, for the heading.
    warnings
        about the question.

    >>> from evenbreak.ratings import SCALES
    >>> rosters = {
    ...     "Racks": Roster(["Ann", "Bo", "Cy"], [640, 560, 450]),
    ...     "Cues": Roster(["Di", "Ed", "Flo"], [540, 530, 500]),
    ... }
    >>> squads = {team: Squad(one.players) for team, one in rosters.items()}
    >>> levels = {team: np.full(3, np.nan) for team in rosters}
    >>> rules = LeagueRules(rosters, squads, levels, 5, SCALES["fargo"], 2, "AB")
    >>> answer = team_rules_answer(rules)
    >>> print(answer.sentences[0])
    In the order AB, naming first in set 1 costs 0.9 points of winning chance on average; between \
two teams of yours at most 0.9.
    """
    rules.check()
    nights = rules.nights(rules.order)
    parts: list[Part] = [_order_words(rules.order, nights)]
    teams = list(rules.rosters)
    if rules.capped:
        free = rules.nights(rules.order, capped=False)
        parts += [_cap_words(teams, against_all(free), against_all(nights))]
        table = _teams_table(rules, against_all(nights), against_all(free))
    else:
        table = _teams_table(rules, against_all(nights), None)
    parts += [_quantities(nights), table, _orders_table(rules, nights)]
    heading = (
        f"{count_of(len(teams), 'team')}{f' in {source}' if source else ''}, "
        f"{count_of(rules.sets, 'set')} a night, {race_words(rules.race)}\nRatings "
        f"{scale_words(rules.scale)}"
    )
    return Answer(heading, parts, warnings=warnings, csv=table)


def _points(change: float) -> str:
    return f"{100.0 * abs(change):.1f} points of winning chance"


def _order_words(order: str, nights: Floats) -> str:
    if BOTH in order and set(order) == {BOTH}:
        return "Both captains name at once in every set, so nobody has the advantage of the toss."
    edges = first_edges(nights)
    mean, widest = float(np.nanmean(edges)), float(np.nanmax(np.abs(edges)))
    if widest < _SMALL:
        return f"In the order {order} it makes no difference who names first."
    if abs(mean) < _SMALL:
        return (
            f"In the order {order} it makes no difference on average who names first in set 1; "
            f"between two teams of yours up to {_points(widest)}."
        )
    return (
        f"In the order {order}, naming first in set 1 {'gains' if mean > 0 else 'costs'} "
        f"{_points(mean)} on average; between two teams of yours at most {100.0 * widest:.1f}."
    )


def _cap_words(teams: Sequence[str], free: Floats, capped: Floats) -> str:
    change = capped - free
    most, least = int(change.argmax()), int(change.argmin())
    if np.abs(change).max() < _SMALL:
        return "The cap changes nothing: the best line-ups keep it anyway."
    said = (
        f"With the cap the teams win between {percent(float(capped.min()))} and "
        f"{percent(float(capped.max()))} of their nights, without it between "
        f"{percent(float(free.min()))} and {percent(float(free.max()))}. It helps {teams[most]} "
        f"most (+{_points(change[most])})"
    )
    return f"{said} and costs {teams[least]} most ({_points(change[least])})."


def _quantities(nights: Floats) -> Quantities:
    edges = first_edges(nights)
    return Quantities(
        [
            Quantity("first_edge_mean", float(np.nanmean(edges))),
            Quantity("first_edge_most", float(np.nanmax(np.abs(edges)))),
        ]
    )


def _teams_table(rules: LeagueRules, capped: Floats, free: Floats | None) -> Table:
    columns = [
        Column("team", "team", left=True),
        Column("players", "players"),
        Column("rating_mean", "mean\nrating", lambda rating: f"{rating:.0f}"),
        Column("level_sum", f"levels of the\nhighest {rules.sets}"),
        Column("p_win_free", "wins without\nthe cap", chance),
        Column("p_win", "wins with\nthe cap" if free is not None else "wins", chance),
        Column("cap_worth", "the cap\nchanges", lambda change: f"{100.0 * change:+.1f}%"),
    ]
    rows: list[list[Any]] = []
    for k, (team, roster) in enumerate(rules.rosters.items()):
        levels = np.sort(rules.levels[team])[::-1][: rules.sets]
        total = None if np.isnan(levels).any() else float(levels.sum())
        before = None if free is None else float(free[k])
        worth = None if before is None else float(capped[k]) - before
        mean = float(roster.rating.mean())
        rows.append([team, len(roster), mean, total, before, float(capped[k]), worth])
    rows.sort(key=lambda row: -row[5] if row[6] is None else row[6])
    if free is None:
        columns[4], columns[6] = Column("p_win_free"), Column("cap_worth")
    if all(row[3] is None for row in rows):
        columns[3] = Column("level_sum")
    title = "Each team against all others"
    return Table("teams", columns, rows, title=title)


def _orders_table(rules: LeagueRules, nights: Floats) -> Table:
    """Return what naming first is worth in each order, blind apart: there nobody is first."""
    rows = []
    named = {order_of(name, rules.sets): name for name in NAMED if name != "blind"}
    for order in dict.fromkeys([rules.order, *named]):
        edges = first_edges(nights if order == rules.order else rules.nights(order))
        meaning = _IN_WORDS.get(named.get(order, ""), "your league's")
        rows.append([order, meaning, np.nanmean(edges), np.nanmax(np.abs(edges))])
    columns = [
        Column("order", "order", left=True),
        Column("meaning", "who names first", left=True),
        Column("edge_mean", "worth to A,\non average", lambda edge: f"{100.0 * edge:+.1f}%"),
        Column("edge_most", "between two\nteams, at most", lambda edge: f"{100.0 * edge:.1f}%"),
    ]
    return Table("orders", columns, rows, title="What naming first is worth")
