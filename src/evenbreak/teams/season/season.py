"""A season under way: the matches played, those to come, and what each of them can bring."""

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
    """A season under way.

    Parameters
    ----------
    teams
        each once.
    played
        the matches played, one per row: home, away (positions in `teams`), sets won by each.
    to_come
        the remaining matches, one per row: home, away.
    scores
        the scores that an upcoming match can have, one per row: sets of home and of away.
    chances
        P(each of these scores) for each upcoming match, shape (layers, matches, scores): a layer
        for each of the strengths that are possible, all equally likely; one if they are known.
    rules
        how the table is kept.
    head_start
        points that each team has besides its matches, such as a deduction.

    Raises
    ------
    InputError
        if a match names no team, or one team twice; or the chances do not add up to 1.
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
        """The points of home and away for each of `scores`, shape (scores, 2)."""
        return self.rules.points_of(Outcomes(self.scores))

    @cached_property
    def points(self) -> Floats:
        """The points of each team now."""
        found = self.head_start.copy()
        np.add.at(found, self.played[:, :2], self.rules.points_of(Outcomes(self.played[:, 2:])))
        return found

    def record(self, ends: Ints) -> Record:
        """Return what its ladder reads, with the score of each upcoming match in each ending.

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
        """The points that each team has if it gets all it can in the remaining matches."""
        best = self.points_of_scores.max(axis=0) if len(self.scores) else np.zeros(2)
        found = self.points.copy()
        np.add.at(found, self.to_come[:, 0], best[0])
        np.add.at(found, self.to_come[:, 1], best[1])
        return found

    def points_to_be_sure(self, places: int) -> Floats:
        """Return the points that make each team sure of one of the first places.

        With so many points more, at most `places` - 1 other teams can still have as many, whatever
        else happens; 0 if that is so already. It is NaN where the remaining matches do not give so
        many. Teams that play each other cannot all have their most, so fewer may do.
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
        """Return the most points of each other team if a team wins all its remaining matches."""
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
    """Return the smallest difference of two sums of points: 1, or less where there are halves."""
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
