"""A season in progress: matches played, upcoming matches, and their possible results."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike

from evenbreak.arrays import Floats, Ints, array_values
from evenbreak.checks import column, floats, names, whole_numbers
from evenbreak.errors import InputError
from evenbreak.league.tables.ladder import Record
from evenbreak.league.tables.rules import Outcomes, TableRules

MOST_TEAMS = 200


@array_values
@dataclass(frozen=True, eq=False, init=False)
class TeamSeason:
    """Season in progress.

    Parameters
    ----------
    teams
        each once.
    played
        the matches played, one per row: home, away (positions in `teams`), sets won by each.
    to_come
        the remaining matches, one per row: home, away.
    scores
        the scores that an upcoming match can have, one per row: sets of the home and of the away
        team.
    chances
        P(each of these scores) for each upcoming match, shape (layers, matches, scores): a layer
        for each possible set of strengths, all equally likely; one layer if they are known.
    rules
        the rules of the table.
    head_start
        points that each team has in addition to its matches, such as a deduction.

    Raises
    ------
    InputError
        if a match has an unknown team, or the same team twice, or the chances do not add up to 1.
    """

    teams: tuple[str, ...]
    played: Ints
    to_come: Ints
    scores: Ints
    chances: Floats
    rules: TableRules
    head_start: Floats

    def __init__(
        self,
        teams: Sequence[str],
        played: ArrayLike,
        to_come: ArrayLike,
        scores: ArrayLike,
        chances: ArrayLike,
        *,
        rules: TableRules | None = None,
        head_start: ArrayLike | None = None,
    ) -> None:
        known = names(teams, "teams")
        if not 2 <= len(known) <= MOST_TEAMS:
            raise InputError(
                "a table must have 2 to {most_teams} teams; there are {n_known}",
                n_known=len(known),
                most_teams=MOST_TEAMS,
            )
        done = _rows(played, "played", 4, len(known))
        left = _rows(to_come, "to_come", 2, len(known))
        ends = _rows(scores, "scores", 2, None)
        law = floats(chances, "chances", low=0.0, high=1.0)
        if law.ndim == 2:
            law = law[None]
        if law.ndim != 3 or law.shape[1:] != (len(left), len(ends)):
            raise InputError(
                "{chances} must have shape (layers, {n_left} matches, {n_ends} scores); "
                "its shape is {law_shape}",
                law_shape=law.shape,
                n_left=len(left),
                n_ends=len(ends),
            )
        if law.size and np.abs(law.sum(axis=2) - 1.0).max() > 1e-9:
            raise InputError("the chances of a match's scores must add up to 1")
        start = np.zeros(len(known)) if head_start is None else head_start
        for name, value in {
            "teams": known,
            "played": done,
            "to_come": left,
            "scores": ends,
            "chances": law,
            "rules": rules or TableRules(),
            "head_start": column(start, "head_start", len(known), "teams"),
        }.items():
            object.__setattr__(self, name, value)

    @cached_property
    def points_of_scores(self) -> Floats:
        """The home and the away team's points for each of `scores`, shape (scores, 2)."""
        return self.rules.points_of(Outcomes(self.scores))

    @cached_property
    def points(self) -> Floats:
        """Each team's current points."""
        found = self.head_start.copy()
        np.add.at(found, self.played[:, :2], self.rules.points_of(Outcomes(self.played[:, 2:])))
        return found

    def record(self, ends: Ints) -> Record:
        """Return the input of its ladder, given the score of each upcoming match in each ending.

        Parameters
        ----------
        ends
            positions in `scores`, shape (matches, endings).
        """
        return Record(
            len(self.teams),
            self.rules,
            self.played[:, :2],
            Outcomes(self.played[:, 2:]),
            self.head_start,
            to_come=self.to_come,
            kinds=Outcomes(self.scores),
            ends=ends,
        )

    @cached_property
    def most_points(self) -> Floats:
        """Each team's points if it gets as many as possible from the remaining matches."""
        best = self.points_of_scores.max(axis=0) if len(self.scores) else np.zeros(2)
        found = self.points.copy()
        np.add.at(found, self.to_come[:, 0], best[0])
        np.add.at(found, self.to_come[:, 1], best[1])
        return found

    def points_to_be_sure(self, places: int) -> Floats:
        """Return the additional points that guarantee each team one of the top places.

        With that many more points, at most `places` - 1 other teams can still equal it, no matter
        what else happens; 0 if the place is already certain. It is NaN if the remaining matches do
        not give that many. Teams that play each other cannot all reach their maximum, so fewer
        points may be enough.
        """
        found = np.full(len(self.teams), np.nan)
        for team, now in enumerate(self.points):
            others = np.sort(np.delete(self.most_points, team))[::-1]
            if places > len(others):
                found[team] = 0.0
                continue
            step = _step(self.points_of_scores, self.head_start)
            needed = max(0.0, others[places - 1] + step - now)
            best = float(self.most_points[team])
            if now + needed <= best + 1e-9:
                found[team] = needed
            elif best > now and (self._most_if_beaten(team) >= best - 1e-9).sum() < places:
                found[team] = best - now  # all that is left, and that takes points from the others
        return found

    def _most_if_beaten(self, team: int) -> Floats:
        """Return each other team's maximum points if a team wins all its remaining matches."""
        found = self.most_points.copy()
        if not len(self.scores):
            return np.delete(found, team)
        best = self.points_of_scores.max(axis=0)
        at_home, away = self.points_of_scores.argmax(axis=0)
        lost = self.points_of_scores[at_home, 1], self.points_of_scores[away, 0]
        for home, guest in self.to_come:
            if home == team:
                found[guest] += lost[0] - best[1]
            elif guest == team:
                found[home] += lost[1] - best[0]
        return np.delete(found, team)


def _step(points: Floats, start: Floats) -> float:
    """Return the smallest difference between two sums of points: 1, or less if there are halves."""
    values = np.concatenate([points.ravel(), start])
    for step in (1.0, 0.5, 0.25, 0.1):
        if np.allclose(values / step, np.round(values / step)):
            return step
    return 0.01


def _rows(given: ArrayLike, name: str, wide: int, teams: int | None) -> Ints:
    rows = np.asarray(given)
    if rows.size == 0:
        return np.zeros((0, wide), dtype=np.int64)
    found = whole_numbers(rows, name, at_least=0)
    if found.ndim != 2 or found.shape[1] != wide:
        raise InputError(
            "{name} must have {wide} columns; its shape is {found_shape}",
            name=name,
            found_shape=found.shape,
            wide=wide,
        )
    if teams is not None:
        if found[:, :2].max() >= teams:
            raise InputError(
                "{name} has team {max}, but there are {teams} teams",
                name=name,
                max=found[:, :2].max(),
                teams=teams,
            )
        if (found[:, 0] == found[:, 1]).any():
            row = int((found[:, 0] == found[:, 1]).argmax())
            raise InputError("{name}[{row}] has a team that plays itself", name=name, row=row)
    return np.asarray(found, dtype=np.int64)
