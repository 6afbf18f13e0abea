"""Whom to put up now: the value of each pick from a point in the night on."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from typing import Any, NamedTuple

import numpy as np

from evenbreak.arrays import Floats, Ints, own_arrays
from evenbreak.checks import one_of, whole
from evenbreak.errors import InputError
from evenbreak.ratings.roster import Roster
from evenbreak.teams.matrix_games import matrix_game
from evenbreak.teams.night import BOTH, LOSER, OURS, THEIRS, WINNER, TeamNight
from evenbreak.teams.solve import SolvedNight, names_first, pair_values, solved
from evenbreak.teams.squad import Counts, LineUps, Squad


@own_arrays
@dataclass(frozen=True)
class Point:
    """A point in a night: an upcoming nomination.

    Parameters
    ----------
    used_ours, used_theirs
        who has been put up, in any order, once per set played (a pair for doubles).
    lead
        our lead: sets, games or points, as the night is counted.
    last_won
        whether we won the last set; needed if the winner or the loser names first.
    named
        whom the team that names first in the next set has named; () if no one yet.
    in_play
        the distributions of the matches in `used` that are still being played, shape
        (2, 2 reach + 1), as in `TeamNight.laws`. Their result is not yet in `lead`.
    """

    used_ours: tuple[str, ...] = ()
    used_theirs: tuple[str, ...] = ()
    lead: int = 0
    last_won: bool | None = None
    named: tuple[str, ...] = ()
    in_play: tuple[Floats, ...] = field(default=(), compare=False)


class Option(NamedTuple):
    """One pick.

    Parameters
    ----------
    names
        one player, or the pair of a doubles set.
    worth
        the night's value to us if this pick is made and everything else is played as well as
        possible; see `SolvedNight`.
    answer
        the other team's best reply, by name; () if none is left.
    mix
        how often to pick it if both teams name at once; otherwise, 1 for the best pick and 0 for
        the others.
    """

    names: tuple[str, ...]
    worth: float
    answer: tuple[str, ...]
    mix: float


class Advice(NamedTuple):
    """Value of each pick, for the team that names now.

    Parameters
    ----------
    worth
        the night's value to us at this point.
    ours
        whether it is our pick (or both teams').
    blind
        whether both teams name at once.
    options
        the picks of the team that names, best for that team first.
    set_number
        the set, counted from 1.
    """

    worth: float
    ours: bool
    blind: bool
    options: tuple[Option, ...]
    set_number: int

    @property
    def best(self) -> Option:
        """The best pick."""
        return self.options[0]


def advice(solution: SolvedNight, point: Point | None = None) -> Advice:
    """Return the value of each pick at a point in a night.

    Parameters
    ----------
    point
        None: before the first nomination.

    Raises
    ------
    InputError
        if the night cannot reach this point, or is over.

    Notes
    -----
    With matches in play, the current pick is chosen for the average over their possible results;
    they are assumed to be over before the next nomination.

    >>> from evenbreak.teams import Squad, TeamNight, solved
    >>> law = np.zeros((2, 2, 2, 3))
    >>> law[..., 0, 2] = [[0.5, 0.8], [0.4, 0.7]]
    >>> law[..., 1, 0] = 1.0 - law[..., 0, 2]
    >>> night = TeamNight(Squad(("Ann", "Bo")), Squad(("Cy", "Di")), law, sets=1, order="B")
    >>> [(option.names, option.worth) for option in advice(solved(night)).options]
    [(('Cy',), 0.5), (('Di',), 0.8)]
    >>> advice(solved(night), Point(named=("Di",))).best.names
    ('Ann',)
    """
    point = point or Point()
    night = solution.night
    k, a, b = _states(night, point)
    if k == night.sets:
        raise InputError("all {k} sets have been named; there's no one left to put up", k=k)
    games, letter = _games(solution, point, k, a, b)
    mine, others = night.our_line_ups, night.their_line_ups
    rows = np.flatnonzero(mine.after[k][a] >= 0)
    columns = np.flatnonzero(others.after[k][b] >= 0)
    games = games[np.ix_(rows, columns)]
    our_names = [_names(night.ours, mine, k, i) for i in rows]
    their_names = [_names(night.theirs, others, k, j) for j in columns]
    if letter == BOTH:
        return _mixed(games, our_names, their_names, k, point)
    if letter == OURS:
        return _turns(games, our_names, their_names, k, point.named, ours_first=True)
    return _turns(games.T, their_names, our_names, k, point.named, ours_first=False)


def worth_at(solution: SolvedNight, point: Point) -> float:
    """Return the value of the night at a point, even if no one can be named there.

    This happens once every set has its players, and while a set is in play whose winner or loser
    names first in the next one. Raises InputError if the night can't reach this point.

    >>> from evenbreak.teams import Squad, TeamNight, solved
    >>> law = np.zeros((1, 1, 2, 3))
    >>> law[0, 0, 0, 2], law[0, 0, 1, 0] = 0.6, 0.4
    >>> night = TeamNight(Squad(("Ann",)), Squad(("Cy",)), [law])
    >>> worth_at(solved(night), Point(("Ann",), ("Cy",), in_play=(law[0, 0],)))
    0.6
    """
    k, a, b = _states(solution.night, point)
    values, reach = solution.values[k][a, b], solution.night.reach
    if k < solution.night.sets and (len(values) == 1 or point.last_won is not None):
        return advice(solution, point).worth
    found = 0.0
    *earlier, last = point.in_play or (np.array([[1.0], [0.0]]),)
    for won, after in enumerate(values):
        kept = last if len(values) == 1 else np.where(np.arange(2)[:, None] == won, last, 0.0)
        chances, leads = leads_of(replace(point, in_play=(*earlier, kept)), reach, k)
        found += float(chances @ after[leads + k * reach])
    return found


def _mixed(
    games: Floats,
    ours: list[tuple[str, ...]],
    theirs: list[tuple[str, ...]],
    k: int,
    point: Point,
) -> Advice:
    if point.named:
        raise InputError("named is given, but both teams name at once in this set. Leave it out.")
    solution = matrix_game(games)
    worth = games @ solution.columns
    options = [
        Option(name, float(p), theirs[int(games[i].argmin())], float(solution.rows[i]))
        for i, (name, p) in enumerate(zip(ours, worth, strict=True))
    ]
    ranked = sorted(options, key=lambda option: (-round(option.worth, 9), -option.mix))
    return Advice(float(solution.value), True, True, tuple(ranked), k + 1)


def _turns(
    games: Floats,
    first: list[tuple[str, ...]],
    second: list[tuple[str, ...]],
    k: int,
    named: tuple[str, ...],
    *,
    ours_first: bool,
) -> Advice:
    """Return the advice for one team in turn; `games` has the first team's picks as rows."""
    sign = 1.0 if ours_first else -1.0
    if named:
        wanted = tuple(sorted(named))
        found = [i for i, names in enumerate(first) if tuple(sorted(names)) == wanted]
        if not found:
            raise InputError(
                "{named} can't be named now: the team naming first has used them up, a cap "
                "rules them out, or they aren't in its squad",
                named=" and ".join(named),
            )
        values = games[found[0]]
        order = np.argsort(sign * values, kind="stable")
        options = [
            Option(second[j], float(values[j]), (), float(n == 0)) for n, j in enumerate(order)
        ]
        return Advice(options[0].worth, not ours_first, False, tuple(options), k + 1)
    reply = (sign * games).argmin(axis=1)
    values = games[np.arange(len(first)), reply]
    order = np.argsort(-sign * values, kind="stable")
    options = [
        Option(first[i], float(values[i]), second[reply[i]], float(n == 0))
        for n, i in enumerate(order)
    ]
    return Advice(options[0].worth, ours_first, False, tuple(options), k + 1)


def _names(squad: Squad, line_ups: LineUps, k: int, pick: Any) -> tuple[str, ...]:
    return tuple(squad.names[player] for player in line_ups.picks[k][pick])


def _states(night: TeamNight, point: Point) -> tuple[int, int, int]:
    """Return the upcoming set, and the states of both squads."""
    played = [0]
    for size in night.sizes:
        played.append(played[-1] + size)
    for used in (point.used_ours, point.used_theirs):
        if len(used) not in played:
            raise InputError(
                "{used} can't be the players used so far: they don't fill whole sets",
                used=", ".join(used),
            )
    k = played.index(len(point.used_ours))
    if len(point.used_theirs) != len(point.used_ours):
        raise InputError(
            "players used: {n_used_ours} of ours and {n_used_theirs} of theirs. Give "
            "both sides of every set played.",
            n_used_ours=len(point.used_ours),
            n_used_theirs=len(point.used_theirs),
        )
    over = k - len(point.in_play)
    if over < 0:
        raise InputError(
            "{n_in_play} matches are in play, but only {k} sets have been named",
            n_in_play=len(point.in_play),
            k=k,
        )
    whole(abs(point.lead), "lead")
    if point.lead not in night.leads_after(over):
        raise InputError(
            "the players used show that {over} set{what} ended, so a lead of {lead} isn't possible",
            lead=point.lead,
            over=over,
            what="s" * (over != 1),
        )
    return (
        k,
        _state(night.ours, night.our_line_ups, k, point.used_ours),
        _state(night.theirs, night.their_line_ups, k, point.used_theirs),
    )


def _state(squad: Squad, line_ups: LineUps, k: int, used: Sequence[str]) -> int:
    counts = [0] * len(squad.names)
    for name in used:
        counts[squad.place(name)] += 1
    wanted: Counts = tuple(counts)
    try:
        return line_ups.used[k].index(wanted)
    except ValueError:
        raise InputError(
            "{used} can't be the players used so far: one plays too often, or the lineup can no "
            "longer stay within its caps",
            used=", ".join(used),
        ) from None


def _games(solution: SolvedNight, point: Point, k: int, a: int, b: int) -> tuple[Floats, str]:
    """Return the value of each pair of picks, NaN if not allowed, and who names first."""
    night = solution.night
    letter = night.order[k]
    if letter in (WINNER, LOSER):
        letter = names_first(letter, _last_won(point, letter))
    one_of(letter, "order", (OURS, THEIRS, BOTH))
    mine, others = night.our_line_ups.after[k][a], night.their_line_ups.after[k][b]
    chances, leads = leads_of(point, night.reach, k)
    games = np.full((len(mine), len(others)), np.nan)
    for i in np.flatnonzero(mine >= 0):
        for j in np.flatnonzero(others >= 0):
            after = solution.values[k + 1][mine[i], others[j]][None, None]
            values = pair_values(night, k, after, int(i), int(j))[0, 0]
            games[i, j] = chances @ values[leads + k * night.reach]
    return games, letter


def _last_won(point: Point, letter: str) -> bool:
    if point.last_won is None:
        who = "winner" if letter == WINNER else "loser"
        raise InputError("the {who} of the last set names first. Enter who won that set.", who=who)
    return point.last_won


def leads_of(point: Point, reach: int, k: int) -> tuple[Floats, Ints]:
    """Return the chances of the leads that the matches in play may give, with `k` sets named.

    A set can change the lead by at most `reach`.
    """
    chances = np.ones(1)
    for law in point.in_play:
        own = np.asarray(law, dtype=float).sum(axis=0)
        pad = reach - len(own) // 2
        chances = np.convolve(chances, np.pad(own, pad))
    half = len(chances) // 2
    leads = point.lead + np.arange(-half, half + 1)
    kept = np.abs(leads) <= k * reach
    return chances[kept], leads[kept]


# How far the best pick depends on ratings that may be off.


Laws = Callable[[Floats, Floats], Sequence[Floats]]
"""A function from our players' skills and theirs to the distributions of all sets."""


def best_by_skills(
    night: TeamNight,
    laws: Laws,
    ours: Roster,
    theirs: Roster,
    point: Point | None = None,
    *,
    draws: int = 100,
    rng: np.random.Generator,
) -> dict[tuple[str, ...], float]:
    """Return how often each pick would be best, given the uncertainty of the ratings.

    Parameters
    ----------
    laws
        function from both squads' skills to the sets' distributions, in the form for `TeamNight`.
    ours, theirs
        ratings with standard errors; a rating without one is treated as exact.
    point
        None: before the first nomination.
    draws
        number of draws of the skills. Each draw is solved as if everyone knew them.

    Returns
    -------
    dict
        the share of draws in which each pick is best for the team that names now.

    >>> from evenbreak.teams import Squad, set_laws
    >>> us = Roster(["Ann", "Bo"], [600, 560], [0, 0])
    >>> them = Roster(["Cy", "Di"], [580, 570], [30, 30])
    >>> def laws(mine, others):
    ...     return [set_laws(us, them, 5, skills=(mine, others))]
    >>> night = TeamNight(Squad(us.players), Squad(them.players), laws(us.rating, them.rating))
    >>> best_by_skills(night, laws, us, them, rng=np.random.default_rng(1))
    {('Ann',): 1.0}
    """
    found: dict[tuple[str, ...], int] = {}
    for _ in range(whole(draws, "draws", at_least=1)):
        skills = (
            each.rating + np.nan_to_num(each.standard_error) * rng.standard_normal(len(each))
            for each in (ours, theirs)
        )
        best = advice(solved(night.with_laws(laws(*skills))), point).best.names
        found[best] = found.get(best, 0) + 1
    return {names: count / draws for names, count in sorted(found.items(), key=lambda one: -one[1])}
