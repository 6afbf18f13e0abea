"""The races offered to players, and the fairest of them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import pandas as pd
from numpy.typing import ArrayLike, NDArray

from evenbreak.answers.kit.wording import count_of
from evenbreak.arrays import Floats, Ints
from evenbreak.errors import InputError
from evenbreak.files.lists.roster import RosterFile
from evenbreak.files.tables.problems import Problems, quoted
from evenbreak.handicaps.charts.chart import Chart
from evenbreak.handicaps.charts.gap import MOST_DOUBLINGS, Gap
from evenbreak.handicaps.charts.level_chart import LevelChart, PointsChart
from evenbreak.handicaps.charts.level_skills import LevelSkills
from evenbreak.matches.evening import Length
from evenbreak.matches.minutes import match_minutes
from evenbreak.matches.pace import Pace
from evenbreak.ratings.roster import Roster
from evenbreak.ratings.scale import Scale
from evenbreak.words import Parameter, say


@dataclass(frozen=True)
class OfferedRaces:
    """The races on offer, limited by their longest match or by the stronger player's target.

    Parameters
    ----------
    games
        the races m:n with games[0] <= m + n - 1 <= games[1].
    race_to
        instead: the races in which the stronger player needs this many games.

    Raises
    ------
    InputError
        if both are given, or neither.

    >>> OfferedRaces(race_to=7).in_words
    'The fairest races in which the stronger player needs 7 games.'
    """

    games: tuple[int, int] | None = None
    race_to: int | None = None

    def __post_init__(self) -> None:
        if (self.games is None) == (self.race_to is None):
            raise InputError(
                "games is {games!r} and race_to is {race_to!r}. Give exactly one of them.",
                games=self.games,
                race_to=self.race_to,
            )

    def fairest(self, gap: Gap) -> tuple[Ints, Ints]:
        """Return (m, n), the most nearly even races for each pair."""
        return gap.fair_races(games=self.games, race_to=self.race_to)

    @property
    def in_words(self) -> str:
        """The races on offer, in a sentence."""
        if self.games is None:
            needs = count_of(self.race_to or 0, "game")
            return f"The fairest races in which the stronger player needs {needs}."
        low, high = self.games
        span = f"{low:,} to " if low < high else ""
        text = f"The fairest races that last {span}{count_of(high, 'game')} at most"
        return f"{text}; each pair gets the one closest to even." if low < high else f"{text}."


FAIR_WITHIN = 0.1
"""How far from 1/2 the chance in a fair race may be."""

NOT_LINKED = "no race: no chain of opponents links the two"
"""The note on a pair whose ratings can't be compared."""


def unfair(chances: Any) -> Any:
    """Return whether each of some chances is further from 1/2 than `FAIR_WITHIN`.

    >>> unfair(np.array([0.35, 0.55]))
    array([ True, False])
    """
    return np.abs(chances - 0.5) > FAIR_WITHIN


def all_pairs(roster: Roster) -> Ints:
    """Return all pairs as places in the roster, stronger player first.

    Pairs are in the order of the ratings list, provisional ratings last; equal ratings keep the
    roster's order.

    >>> all_pairs(Roster(["Ann", "Bo", "Cy"], [70, 92, 81])).tolist()
    [[1, 2], [1, 0], [2, 0]]
    """
    return pairs_of(roster, roster.strongest_first())


def pairs_of(roster: Roster, order: ArrayLike) -> Ints:
    """Return all pairs of some players, who are given in a list's order.

    The stronger player in each pair comes first, and pairs are ordered by their first players.

    >>> club = Roster(["Ann", "Bo", "Cy"], [70, 92, 99], games=[400, 300, 5])
    >>> pairs_of(club, club.strongest_first()).tolist()
    [[1, 0], [2, 1], [2, 0]]
    """
    places = np.asarray(order, dtype=np.int64)
    rows = np.column_stack(np.triu_indices(len(places), 1))
    weaker = roster.rating[places[rows[:, 0]]] < roster.rating[places[rows[:, 1]]]
    rows[weaker] = rows[weaker, ::-1]
    return places[rows[np.lexsort((rows[:, 1], rows[:, 0]))]]


def check_roster(
    file: RosterFile, roster: Roster, chart: Any, scale: Scale, playing: ArrayLike | None = None
) -> None:
    """Reject ratings that aren't levels in the chart, and standard errors that are too large.

    `playing` are the places of the players in the pairs, with repeats allowed; None: everyone.
    DataError has one line per player.
    """
    most = MOST_DOUBLINGS * scale.points_per_doubling / 2.0
    plays = np.full(len(roster), playing is None)
    if playing is not None:
        plays[np.asarray(playing, dtype=np.int64).ravel()] = True
    problems = Problems(file.source)
    problems.add_rows(
        file.lines,
        np.flatnonzero(plays & (roster.standard_error > most)),
        lambda place: say(
            "{column} {error:g} is too large to say anything about a player. Write at most "
            "{most:g} points, or check {scale}.",
            column="quasi_error" if place in file.by_quasi else "standard_error",
            error=roster.standard_error[place],
            most=most,
            scale=Parameter("scale"),
        ),
    )
    if isinstance(chart, LevelChart | PointsChart):
        levels = ", ".join(map(str, chart.levels))
        problems.add_rows(
            file.lines,
            np.flatnonzero(plays & ~np.isin(roster.level, chart.levels)),
            lambda place: say(
                "{player} has {level}; the chart {chart} has the levels {levels}",
                player=quoted(roster.players[place]),
                level=say(
                    "no skill level (new players can get one with {starter})",
                    starter=Parameter("starter"),
                )
                if np.isnan(roster.level[place])
                else say("skill level {level:g}", level=roster.level[place]),
                chart=chart.name,
                levels=levels,
            ),
        )
    problems.raise_any()


@dataclass(frozen=True, eq=False)
class Races:
    """Each pair's race, who wins it and how long it lasts.

    `p_win` is P(A wins | the ratings and their errors), `plug_in` P(A wins | the ratings are
    right); `mean` and `p90` are the mean length and the games within which 90% of such races end;
    `minutes` has both in minutes, if there is a pace, and `lengths` has the distribution of each
    race's length.
    """

    m: Ints
    n: Ints
    p_win: Floats
    plug_in: Floats
    mean: Floats
    p90: Ints
    lengths: Sequence[Length]
    minutes: tuple[Floats, Floats] | None

    @classmethod
    def of(cls, gap: Gap, m: Ints, n: Ints, pace: Pace | None = None) -> Races:
        """Return the pairs' m:n races."""
        mean, p90 = np.zeros(len(m)), np.zeros(len(m), dtype=np.int64)
        minutes = np.zeros((2, len(m)))
        lengths: list[Length] = [Length([], [])] * len(m)
        for race in np.unique(np.column_stack([m, n]), axis=0).tolist():
            of_race = np.flatnonzero((m == race[0]) & (n == race[1]))
            length = gap[of_race].length(*race)
            ninety: Any = length.quantile(0.9)
            mean[of_race], p90[of_race] = length.mean, ninety
            if pace is not None:
                timed = match_minutes(length.games, length.probability, pace)
                minutes[:, of_race] = timed.mean, timed.quantile(0.9)
            for place, chances in zip(of_race.tolist(), length.probability, strict=True):
                lengths[place] = Length(length.games, chances)
        return cls(
            m,
            n,
            gap.win(m, n),
            gap.taken_as_right.win(m, n),
            mean,
            p90,
            lengths,
            None if pace is None else (minutes[0], minutes[1]),
        )


@dataclass(frozen=True, eq=False)
class RosterMatchups:
    """Races for pairs of players.

    `frame` is described by `roster_matchups`. Length distributions leave out pairs not `linked` by
    a chain of opponents, and are None for races that weren't requested.
    """

    frame: pd.DataFrame
    chart_lengths: Sequence[Length] | None
    best_lengths: Sequence[Length] | None
    linked: NDArray[np.bool_]

    def __repr__(self) -> str:
        return f"<RosterMatchups of {len(self.frame):,} pairs>"


def roster_matchups(
    roster: Roster,
    pairs: Ints,
    *,
    scale: Scale,
    chart: Chart | LevelChart | None = None,
    levels: LevelSkills | None = None,
    offered: OfferedRaces | None = None,
    pace: Pace | None = None,
    form: float = 0.0,
) -> RosterMatchups:
    """Return races for pairs (places in the roster, shape (k, 2)), with chances and lengths.

    In the frame, chances are averaged over the errors of the two ratings; a plug-in chance treats
    the ratings as exact, as does everything for a player without a standard error. Unfairness is
    the chance's distance from 1/2. `form` is the standard deviation of a game's log-odds from match
    to match. Ratings are rounded to whole points for looking them up in a chart, and a chart by
    skill level is looked up with the levels. Raises InputError if neither a chart nor races are
    offered, a player has no rating, or the chart lacks a level.
    """
    if chart is None and offered is None:
        raise InputError("chart and offered are missing. Give at least one of them.")
    if levels is None and np.isnan(roster.rating).any():
        raise InputError(
            "roster has players without a rating. Fill the ratings in with with_starters."
        )
    a, b = pairs[:, 0], pairs[:, 1]
    linked = _linked(roster, a, b)
    a, b = a[linked], b[linked]
    errors, stated = np.nan_to_num(roster.standard_error), ~np.isnan(roster.standard_error)
    if levels is None:
        gap = Gap(roster.rating[a] - roster.rating[b], np.hypot(errors[a], errors[b]), scale, form)
    else:
        of_pair = roster.level[a], roster.level[b]
        gap = levels.gap(*of_pair, form)
        stated = np.full(len(roster), levels.is_known)
    columns: dict[str, Any] = {
        "difference": gap.difference,
        "difference_error": np.where(stated[a] | stated[b], gap.error, np.nan),
        "p_game_a": gap.p_game,
        "p_game_a_plug_in": scale.win_probability(gap.difference),
    }
    by_chart = best = None
    if chart is not None:
        by_chart = Races.of(gap, *_by_chart(chart, roster, a, b), pace)
        columns |= _columns("chart_", by_chart)
    if offered is not None:
        best = Races.of(gap, *offered.fairest(gap), pace)
        columns |= _columns("", best)
    everyone = {
        "player_a": [roster.players[k] for k in pairs[:, 0].tolist()],
        "player_b": [roster.players[k] for k in pairs[:, 1].tolist()],
    }
    rows = np.flatnonzero(linked)
    frame = pd.DataFrame(columns, index=rows).reindex(np.arange(len(pairs)))
    whole = [name for name in columns if name.endswith(("race_a", "race_b", "games_p90"))]
    frame = frame.astype(dict.fromkeys(whole, "Int64"))
    frame = pd.concat([pd.DataFrame(everyone, dtype=object), frame], axis=1)
    frame["note"] = _notes(roster, pairs, linked, best)
    return RosterMatchups(
        frame, by_chart.lengths if by_chart else None, best.lengths if best else None, linked
    )


def _linked(roster: Roster, a: Ints, b: Ints) -> NDArray[np.bool_]:
    """Return which pairs can be compared; a new player's starter rating is always comparable."""
    group = np.where(roster.games == 0, 0, roster.component)
    linked: NDArray[np.bool_] = (group[a] == group[b]) | (group[a] == 0) | (group[b] == 0)
    return linked


def cannot_be_compared(roster: Roster, a: int, b: int) -> bool:
    """Return whether two players on a list aren't linked by a chain of opponents."""
    return not _linked(roster, np.array([a]), np.array([b]))[0]


def _by_chart(chart: Chart | LevelChart, roster: Roster, a: Ints, b: Ints) -> tuple[Ints, Ints]:
    if isinstance(chart, LevelChart):
        return chart.races(roster.level[a], roster.level[b])
    points = _whole(roster.rating)
    return chart.races(points[a] - points[b])


def _whole(rating: Floats) -> Floats:
    """Return ratings in whole points, halves upwards."""
    rounded: Floats = np.floor(rating + 0.5)
    return rounded


def _columns(prefix: str, races: Races) -> dict[str, Any]:
    columns: dict[str, Any] = {
        "race_a": races.m,
        "race_b": races.n,
        "p_win_a": races.p_win,
        "p_win_a_plug_in": races.plug_in,
    }
    if prefix:
        columns["unfairness"] = np.abs(races.p_win - 0.5)
    columns |= {"mean_games": races.mean, "games_p90": races.p90}
    if races.minutes is not None:
        columns |= dict(zip(("mean_minutes", "minutes_p90"), races.minutes, strict=True))
    return {prefix + name: values for name, values in columns.items()}


def _notes(roster: Roster, pairs: Ints, linked: NDArray[np.bool_], best: Races | None) -> list[str]:
    """Return the note on each pair: no link, no fair race, or who is new."""
    notes: list[list[str]] = [[] for _ in pairs]
    for row in np.flatnonzero(~linked).tolist():
        notes[row].append(NOT_LINKED)
    if best is not None:
        chances = np.full(len(pairs), 0.5)
        chances[linked] = best.p_win
        for row in np.flatnonzero(unfair(chances)).tolist():
            notes[row].append(f"no allowed race is fair: the closest gives A {chances[row]:.2f}")
    new = roster.games == 0
    for row in np.flatnonzero(new[pairs].any(axis=1)).tolist():
        a, b = new[pairs[row]]
        notes[row].append("A and B are new" if a and b else f"{'A' if a else 'B'} is new")
    return ["; ".join(note) for note in notes]
