"""How a team season may end: title, promotion, relegation, and what tonight changes."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from evenbreak.answers.kit.answer import Answer
from evenbreak.answers.kit.columns import column_of, columns_of, table_by_column
from evenbreak.answers.kit.parts import Part, Table
from evenbreak.answers.kit.wording import count_of, percent
from evenbreak.answers.league.standings import rules_words
from evenbreak.arrays import Ints
from evenbreak.teams.season.chances import SeasonChances
from evenbreak.words import listed

_HOME, _AWAY = 0, 2
_NOTHING = 5e-4  # a change that is not listed


def team_season_answer(
    found: SeasonChances,
    *,
    up: int | None = None,
    down: int | None = None,
    rounds: str = "",
    known: bool = False,
    warnings: Sequence[str] = (),
) -> Answer:
    """Return the chances of each team's final place.

    `up` and `down` are how many teams are promoted and relegated, and `rounds` names the rounds of
    the watched matches; with `known`, strengths are treated as exact.

    >>> from evenbreak.teams import TeamSeason, season_chances
    >>> season = TeamSeason(["Acers", "Bankers", "Caroms"], [[0, 1, 3, 2]], [[0, 2], [1, 2]],
    ...                     [[3, 2], [2, 3]], [[0.5, 0.5], [0.5, 0.5]])
    >>> print(team_season_answer(season_chances(season)).sentences[0])
    The favorite is Acers, with title odds of 58%; next are Caroms (33%) and Bankers (8.3%).
    """
    season = found.season
    table = _table(found, up, down)
    tonight = _tonight(found, up, down, rounds)
    parts: list[Part] = [_in_words(found), table, _to_be_sure(found, up, down)]
    if tonight is not None:
        parts.append(tonight)
    parts.append(_how(found, known=known))
    matches = count_of(len(season.played), "match", "matches")
    return Answer(
        f"{count_of(len(season.teams), 'team')}: {matches} played, {len(season.to_come)} left\n"
        + rules_words(season.rules, sets=True, level="tied teams", last="drawing lots"),
        parts,
        details=[_places(found)],
        data={"exact": found.exact, "seasons": found.seasons, "standard_error": _error(found)},
        warnings=warnings,
        csv=table,
    )


def _in_words(found: SeasonChances) -> str:
    teams, title = found.season.teams, found.p_first(1)
    best, *others = np.argsort(-title, kind="stable")[:3].tolist()
    if title[best] >= 1.0 - 1e-12:
        return f"The title goes to {teams[best]}."
    following = [f"{teams[k]} ({percent(title[k])})" for k in others if title[k] > 0.0]
    text = f"The favorite is {teams[best]}, with title odds of {percent(title[best])}"
    if following:
        text += f"; next {'are' if len(following) > 1 else 'is'} {listed(following)}"
    return f"{text}."


def _table(found: SeasonChances, up: int | None, down: int | None) -> Table:
    season, teams = found.season, len(found.season.teams)
    played = _matches(season.played, teams)
    values: dict[Any, Any] = {
        "team": season.teams,
        "played": played,
        "points": _of_points(season.points),
        "p_title": found.p_first(1),
    }
    if up is not None and up > 1:
        values[column_of("p_up", places=up)] = found.p_first(up)
    if down is not None:
        below = found.p_place[:, teams - down :].sum(axis=1)
        values[column_of("p_down", places=down)] = below
    values["place_mean"] = found.mean_place
    order = sorted(range(teams), key=lambda k: (found.mean_place[k], -season.points[k]))
    return table_by_column("teams", values, order=order)


def _to_be_sure(found: SeasonChances, up: int | None, down: int | None) -> Table:
    """Return the points that guarantee each team's place, whatever the others do."""
    season, teams = found.season, len(found.season.teams)
    columns = columns_of("team points_for_title")
    values = [season.points_to_be_sure(1)]
    if up is not None and up > 1:
        columns.append(column_of("points_for_up", places=up))
        values.append(season.points_to_be_sure(up))
    if down is not None:
        columns.append(column_of("points_to_stay"))
        values.append(season.points_to_be_sure(teams - down))
    shown = [season.teams, *map(_of_points, values)]
    rows = [
        [column[team] for column in shown]
        for team in np.argsort(-season.points, kind="stable").tolist()
    ]
    return Table(
        "to_be_sure",
        columns,
        [row for row in rows if any(value is not None for value in row[1:])],
        title="Points needed to clinch, whatever the others do (blank: the team can't clinch "
        "just by winning its own matches)",
    )


def _of_points(points: Any) -> list[float | int | None]:
    """Return points in one number type: ints if all are whole; None for NaN."""
    kind = int if all(point.is_integer() for point in points[np.isfinite(points)]) else float
    return [None if np.isnan(point) else kind(point) for point in points.tolist()]


def _matches(pairs: Ints, teams: int) -> Ints:
    return np.bincount(pairs[:, :2].ravel(), minlength=teams)


def _tonight(found: SeasonChances, up: int | None, down: int | None, rounds: str) -> Table | None:
    """Return what each watched match changes for both of its teams."""
    season, matches = found.season, found.watched.matches
    if not matches:
        return None
    aims = [(1, "title", False)]
    if up is not None and up > 1:
        aims.append((up, f"the top {up}", False))
    if down is not None:
        aims.append((len(season.teams) - down, f"the bottom {down}", True))
    rows: list[list[Any]] = []
    for row, match in enumerate(matches):
        home, away = season.to_come[match].tolist()
        p_home, _, p_away = found.p_result[row]
        for team, won, lost in ((home, _HOME, _AWAY), (away, _AWAY, _HOME)):
            other = away if team == home else home
            best: tuple[float, list[Any]] | None = None
            for places, words, below in aims:
                p = found.p_if[found.watched.places.index(places)][row, :, team]
                chances = np.clip(1.0 - p if below else p, 0.0, 1.0).round(12)
                moved = abs(chances[won] - chances[lost])
                if np.isnan(moved) or moved < _NOTHING:
                    continue
                if best is None or moved > best[0]:
                    best = moved, [words, float(chances[won]), float(chances[lost])]
            if best is not None:
                p_win = p_home if team == home else p_away
                rows.append([season.teams[team], season.teams[other], float(p_win), *best[1]])
    rows.sort(key=lambda row: -abs(row[4] - row[5]))
    columns = columns_of("team opponent p_win_next at_stake p_if_won p_if_lost")
    title = f"What's at stake in {rounds or 'the next matches'}, biggest swing first"
    return Table("tonight", columns, rows, title=title)


def _places(found: SeasonChances) -> Table:
    teams = len(found.season.teams)
    columns = columns_of("team")
    columns += [column_of("p_in_place", place=k) for k in range(1, teams + 1)]
    rows = [
        [found.season.teams[team], *found.p_place[team].tolist()]
        for team in np.argsort(found.mean_place, kind="stable").tolist()
    ]
    return Table("places", columns, rows, title="The chance of each place")


def _error(found: SeasonChances) -> float:
    """Return the largest standard error of the table's chances."""
    return max(float(found.error(found.p_first(many)).max()) for many in found.watched.places)


def _how(found: SeasonChances, *, known: bool) -> str:
    strengths = (
        "the teams' strengths are treated as exact"
        if known
        else "the chances allow for how uncertain the teams' strengths still are"
    )
    if found.exact:
        return (
            f"All {found.seasons:,} ways the remaining matches can end were counted; {strengths}."
        )
    return (
        f"{found.seasons:,} seasons were simulated; {strengths}. The chances in the table are "
        f"right to within {percent(2.0 * _error(found))}, 19 times in 20."
    )
