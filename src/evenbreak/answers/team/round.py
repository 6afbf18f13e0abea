"""A round between two teams: who wins it, and the head start that makes it even."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import cache, cached_property
from typing import Any

import numpy as np

from evenbreak.answers.kit.answer import Answer
from evenbreak.answers.kit.columns import column_of, columns_of, quantities_of
from evenbreak.answers.kit.parts import Part, Quantities, Table
from evenbreak.answers.kit.scales import scale_words
from evenbreak.answers.kit.wording import count_of, percent
from evenbreak.answers.team.lineup import race_words
from evenbreak.answers.team.strengths import level_words, strengths_words
from evenbreak.arrays import Floats
from evenbreak.errors import InputError
from evenbreak.handicaps.charts.level_skills import LevelSkills
from evenbreak.handicaps.systems.team_handicap import team_handicap
from evenbreak.ratings.roster import Roster
from evenbreak.ratings.scale import Scale
from evenbreak.teams.night import BOTH, NAMED, order_of
from evenbreak.teams.pairs import SetRace
from evenbreak.teams.round_law import Outcome, RoundLaw, known_starts
from evenbreak.teams.set_laws import Count, set_laws
from evenbreak.teams.solve import against_all, first_edges, league_nights
from evenbreak.teams.squad import Squad, line_ups


def team_round_answer(
    teams: tuple[Roster, Roster],
    law: RoundLaw,
    *,
    played: str,
    scale: Scale,
    strengths: str = "",
    rests_on: str | None = None,
    games: int | None = None,
    unit: str = "game",
    everybody: bool = False,
    names: tuple[str, str] = ("team 1", "team 2"),
    warnings: Sequence[str] = (),
) -> Answer:
    """Return who wins a round, and the head start that makes it even.

    `law` is the distribution of the first team's lead. With `games`, the number per match if a
    match is single games, CSI's method is compared. `unit` is game, point or set.

    >>> from evenbreak.ratings import SCALES
    >>> from evenbreak.teams import round_law
    >>> us, them = Roster(["Ann"], [500]), Roster(["Bo"], [600])
    >>> law = round_law(us, them, games=2)
    >>> asked = {"played": "2 games", "scale": SCALES["fargo"], "games": 2}
    >>> print(team_round_answer((us, them), law, **asked).sentences[0])
    Without a head start, team 1 wins the round 11% of the time, loses it 44% of the time, and \
ties it 44% of the time.
    With a head start of 1 game for team 1, the round is closest to even: they win it 56% of the \
time and lose it 44% of the time; there are no ties.
    """
    fair, plain = law.fair_start, law.with_start(0)
    words = [f"Without a head start, {names[0]} {_in_words(plain, 'wins', 'loses', 'ties')}."]
    if fair:
        ahead = law.with_start(fair)
        seen = ahead if fair > 0 else Outcome(ahead.lose, ahead.tie, ahead.win)
        they = _in_words(seen, "win", "lose", "tie").replace(" the round", " it", 1)
        words.append(
            f"With a head start of {count_of(abs(fair), unit)} for {names[fair < 0]}, the round is "
            f"closest to even: they {they}."
        )
    else:
        words.append(f"No head start of a whole number of {unit}s brings the round closer to even.")
    parts: list[Part] = ["\n".join(words)]
    csi: int | None = None
    if games is not None:
        csi, said = _csi(teams, law, games, everybody, scale, names)
        parts.append(said)
    rows = [
        (start, *law.with_start(start))
        for start in known_starts(law, *([] if csi is None else [csi]))
    ]
    columns = columns_of(
        "start_1 p_win_1 p_tie p_lose_1",
        show={"start_1": lambda start: _start_words(start, names)},
        a=names[0],
        b=names[1],
    )
    data = quantities_of(
        {"mean_lead_1": law.mean, "fair_start_1": fair, "csi_start_1": csi}, a=names[0]
    )
    return Answer(
        f"{count_of(len(teams[0]), 'player')} against {len(teams[1])}, {played}\n"
        f"{strengths or f'Ratings {scale_words(scale)}'}",
        [
            *parts,
            Quantities(data),
            Table("starts", columns, rows, title="What a head start does"),
            *filter(None, [rests_on]),
        ],
        warnings=warnings,
    )


def _start_words(start: int, names: tuple[str, str]) -> str:
    return f"{abs(start)} for {names[start < 0]}" if start else "none"


def _in_words(seen: Outcome, win: str, lose: str, tie: str) -> str:
    won = f"{win} the round {percent(seen.win)} of the time"
    if not seen.tie:
        return f"{won} and {lose} it {percent(seen.lose)} of the time; there are no ties"
    lost = f"{lose} it {percent(seen.lose)} of the time"
    return f"{won}, {lost}, and {tie} it {percent(seen.tie)} of the time"


def _csi(
    teams: tuple[Roster, Roster],
    law: RoundLaw,
    games: int,
    everybody: bool,
    scale: Scale,
    names: tuple[str, str],
) -> tuple[int, str]:
    """Return the head start in games under CSI's way of rounding, and what it gives away."""
    one, other = (float(roster.rating.mean()) for roster in teams)
    pairs = len(teams[0]) * (len(teams[1]) if everybody else 1)
    found = team_handicap(
        one, other, match_ups=pairs, games=games, points_won=1.0, points_lost=0.0, scale=scale
    )
    start = found.points if found.to_team == 1 else -found.points
    weaker, times = names[law.mean > 0], f", then multiplied by {games}" if games > 1 else ""
    text = (
        f"CSI's formula (from the two averages, one game per match, rounded down{times}) gives "
        f"{count_of(found.points, 'game')}"
    )
    if found.points:
        text += f" to {names[(found.to_team or 1) - 1]}"
    if found.given_away > 0.005:
        text += (
            f". A head start of {found.even_points:.2f} would even out the averages, so rounding "
            f"costs {weaker} {percent(found.given_away)} of it"
        )
    seen = law.with_start(start)
    return (
        start,
        f"{text}. With CSI's head start, {names[0]} {_in_words(seen, 'wins', 'loses', 'ties')}.",
    )


_IN_WORDS = {
    "alternate": "in turn, A in set 1",
    "home": "always A",
    "blind": "both at once, blind",
    "winner": "the winner of the last set, A in set 1",
    "loser": "the loser of the last set, A in set 1",
}
_SMALL = 5e-4  # a chance that differs by less is the same


@dataclass(frozen=True, eq=False)
class LeagueRules:
    """A league's teams and its rules.

    Everyone in `rosters` has a rating; `squads` are the same with the league's caps; levels not
    stated are NaN in `levels`; `skills` are the strengths of levels, if the chances come from
    those.
    """

    rosters: Mapping[str, Roster]
    squads: Mapping[str, Squad]
    levels: Mapping[str, Floats]
    race: SetRace
    scale: Scale
    sets: int
    order: str
    form: float = 0.0
    skills: LevelSkills | None = None
    count: Count = "sets"

    @property
    def capped(self) -> bool:
        """Whether the league has a cap."""
        return any(squad.caps for squad in self.squads.values())

    def nights(self, order: str, *, capped: bool = True) -> Floats:
        """Return each team's chance against each other team, as `league_nights`."""
        every = list(self.squads.values())
        used = every if capped else [Squad(one.names, (), one.times) for one in every]
        return league_nights(used, self._law, sets=self.sets, order=order)

    @cached_property
    def _law(self) -> Callable[[int, int], Floats]:
        rosters = list(self.rosters.values())

        @cache
        def law(i: int, j: int) -> Floats:
            return set_laws(
                rosters[i],
                rosters[j],
                self.race,
                scale=self.scale,
                count=self.count,
                form=self.form,
                levels=self.skills,
            )

        return law

    def check(self) -> None:
        """Reject teams that can't fill a night within the caps."""
        for team, squad in self.squads.items():
            try:
                line_ups(squad, (1,) * self.sets)
            except InputError as error:
                raise InputError("{team}: {error}", team=team, error=error) from None


def team_rules_answer(
    rules: LeagueRules, *, source: str = "", warnings: Sequence[str] = ()
) -> Answer:
    """Return the effect of a cap and the order of nomination on a team league.

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
    In the order AB, putting up first in set 1 costs 0.9 percentage points on average, \
and at most 0.9 between any two of your teams.
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
    rests_on = level_words(rules.race, rules.skills)
    parts += [_quantities(nights), table, _orders_table(rules, nights), *filter(None, [rests_on])]
    heading = (
        f"{count_of(len(teams), 'team')}{f' in {source}' if source else ''}, "
        f"{count_of(rules.sets, 'set')} a night, {race_words(rules.race)}\n"
        f"{strengths_words(rules.race, rules.skills, rules.scale)}"
    )
    return Answer(heading, parts, warnings=warnings, csv=table)


def _points(change: float) -> str:
    return f"{100.0 * abs(change):.1f} percentage points"


def _order_words(order: str, nights: Floats) -> str:
    if BOTH in order and set(order) == {BOTH}:
        return (
            "In every set both captains name their players at the same time, so winning the "
            "toss is no advantage."
        )
    edges = first_edges(nights)
    mean, widest = float(np.nanmean(edges)), float(np.nanmax(np.abs(edges)))
    if widest < _SMALL:
        return f"In the order {order}, it makes no difference who puts up first."
    if abs(mean) < _SMALL:
        return (
            f"In the order {order}, it makes no difference on average who puts up first in set 1; "
            f"between two of your teams it can matter by up to {_points(widest)}."
        )
    return (
        f"In the order {order}, putting up first in set 1 {'gains' if mean > 0 else 'costs'} "
        f"{_points(mean)} on average, and at most {100.0 * widest:.1f} between any two of "
        f"your teams."
    )


def _cap_words(teams: Sequence[str], free: Floats, capped: Floats) -> str:
    change = capped - free
    most, least = int(change.argmax()), int(change.argmin())
    if np.abs(change).max() < _SMALL:
        return "The cap changes nothing: the best lineups stay under it anyway."
    said = (
        f"With the cap the teams win between {percent(float(capped.min()))} and "
        f"{percent(float(capped.max()))} of their nights, and without it between "
        f"{percent(float(free.min()))} and {percent(float(free.max()))}. It helps {teams[most]} "
        f"most (+{_points(change[most])})"
    )
    return f"{said} and costs {teams[least]} most ({_points(change[least])})."


def _quantities(nights: Floats) -> Quantities:
    edges = first_edges(nights)
    return Quantities(
        quantities_of(
            {
                "first_edge_mean": float(np.nanmean(edges)),
                "first_edge_most": float(np.nanmax(np.abs(edges))),
            }
        )
    )


def _teams_table(rules: LeagueRules, capped: Floats, free: Floats | None) -> Table:
    columns = [
        *columns_of("team players rating_mean level_sum p_win_free", sets=rules.sets),
        column_of("p_win_team" if free is None else "p_win_capped"),
        *columns_of("cap_worth"),
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
        columns[4], columns[6] = columns_of("-p_win_free -cap_worth")
    if all(row[3] is None for row in rows):
        columns[3] = column_of("-level_sum")
    title = "Each team against all others"
    return Table("teams", columns, rows, title=title)


def _orders_table(rules: LeagueRules, nights: Floats) -> Table:
    """Return the value of naming first in each order except blind, where no one is first."""
    rows = []
    named = {order_of(name, rules.sets): name for name in NAMED if name != "blind"}
    for order in dict.fromkeys([rules.order, *named]):
        edges = first_edges(nights if order == rules.order else rules.nights(order))
        meaning = _IN_WORDS.get(named.get(order, ""), "your league's")
        rows.append([order, meaning, np.nanmean(edges), np.nanmax(np.abs(edges))])
    columns = columns_of("order names_first edge_mean edge_most")
    return Table("orders", columns, rows, title="What putting up first is worth")
