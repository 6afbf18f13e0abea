"""The race for every pair in a league, as a table and as data for the site's script."""

from __future__ import annotations

import math
from collections.abc import Collection, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
import pandas as pd

from evenbreak.answers.league.roster_matchups import OfferedRaces, all_pairs
from evenbreak.arrays import Floats, Ints
from evenbreak.handicaps.charts.chart import Chart
from evenbreak.handicaps.charts.chart_of import EVERY_CHART
from evenbreak.handicaps.charts.gap import Gap, averaging_rule
from evenbreak.handicaps.charts.level_chart import LevelChart, PointsChart
from evenbreak.handicaps.charts.level_skills import LevelSkills
from evenbreak.matches.form import MOST_NODES, normal_rule
from evenbreak.ratings.roster import Roster
from evenbreak.ratings.scale import Scale


@dataclass(frozen=True, eq=False)
class LeagueRaces:
    """How a league sets its races.

    With a chart by skill level, the roster has levels, and `skills` has their strengths. `rule` is
    the chart, or the races from which the fairest is chosen. `form` is the standard deviation of a
    game's log-odds from match to match.
    """

    roster: Roster
    scale: Scale
    rule: OfferedRaces | Chart | LevelChart | PointsChart
    skills: LevelSkills | None = None
    form: float = 0.0

    @property
    def in_words(self) -> str:
        """How a race is determined, in a sentence."""
        if isinstance(self.rule, OfferedRaces):
            if (needs := self.rule.race_to) is None:
                return self.rule.in_words
            return f"Every pair gets the fairest race in which the stronger player goes to {needs}."
        if isinstance(self.rule, Chart) and len(self.rule.rows) == 1:
            return f"Every race is to {self.rule.rows[0].stronger_needs} for both players."
        if isinstance(self.rule, PointsChart):
            return f"The chart {self._chart} sets how many points each skill level needs."
        by = "any two skill levels" if self.skills is not None else "each difference in ratings"
        return f"The chart {self._chart} sets the race for {by}."

    @property
    def _chart(self) -> str:
        name = getattr(self.rule, "name", "")
        return EVERY_CHART.get(name, name)

    @property
    def levels(self) -> dict[str, int]:
        """Everyone's skill level, with a chart by skill level."""
        if isinstance(self.rule, (OfferedRaces, Chart)):
            return {}
        return dict(zip(self.roster.players, self._points.tolist(), strict=True))

    def gap(self, a: Ints, b: Ints) -> Gap | None:
        """Return how far apart pairs of players are, given their places in the roster.

        Return None with a points chart, which doesn't say who wins a game.
        """
        rating = self.roster.rating
        if isinstance(self.rule, PointsChart):
            return None
        if self.skills is not None:
            return self.skills.gap(rating[a], rating[b])
        error = np.nan_to_num(self.roster.standard_error)
        return Gap(rating[a] - rating[b], np.hypot(error[a], error[b]), self.scale, self.form)

    @cached_property
    def frame(self) -> pd.DataFrame:
        """Each pair's race, in list order, stronger player first.

        Its columns are player_a, player_b, race_a, race_b, p_win_a, difference (in points) and
        difference_error. Pairs that no chain of opponents links have no race.
        """
        pairs = all_pairs(self.roster)
        linked = (self._group[pairs] == 0).any(1) | (
            self._group[pairs[:, 0]] == self._group[pairs[:, 1]]
        )
        a, b = pairs[linked].T
        gap = self.gap(a, b)
        if isinstance(self.rule, OfferedRaces) and gap is not None:
            m, n = self.rule.fairest(gap)
        elif isinstance(self.rule, LevelChart):
            m, n = self.rule.races(self._points[a], self._points[b])
        elif isinstance(self.rule, PointsChart):
            needs = dict(zip(self.rule.levels, self.rule.points, strict=True))
            m, n = (np.array([needs[k] for k in self._points[of].tolist()], int) for of in (a, b))
        elif isinstance(self.rule, Chart):
            m, n = self.rule.races(self._points[a] - self._points[b])
        found = pd.DataFrame(
            {
                "race_a": m,
                "race_b": n,
                "p_win_a": gap.win(m, n) if gap else math.nan,
                "difference": gap.difference if gap else math.nan,
                "difference_error": gap.error if gap else math.nan,
            },
            index=np.flatnonzero(linked),
        ).reindex(np.arange(len(pairs)))
        players = np.array(self.roster.players, dtype=object)[pairs].reshape(-1, 2)
        found.insert(0, "player_a", players[:, 0])
        found.insert(1, "player_b", players[:, 1])
        return found.astype({"race_a": "Int64", "race_b": "Int64"})

    @property
    def _points(self) -> Ints:
        return np.floor(self.roster.rating + 0.5).astype(np.int64)

    @property
    def _group(self) -> Ints:
        return np.where(self.roster.games == 0, 0, self.roster.component)

    @cached_property
    def by_pair(self) -> dict[tuple[str, str], tuple[int, int, float]]:
        """The games that two players need, and the first one's chance, for both orders."""
        found = {}
        rows: Any = self.frame.dropna(subset=["race_a"]).itertuples(index=False)
        for one in rows:
            m, n, p = int(one.race_a), int(one.race_b), float(one.p_win_a)
            found[one.player_a, one.player_b] = m, n, p
            found[one.player_b, one.player_a] = n, m, 1.0 - p
        return found

    def for_script(self, without: Collection[str] = ()) -> dict[str, Any]:
        """Return the data that race.js needs, for all but some of the players, by name."""
        roster, error = self.roster, np.nan_to_num(self.roster.standard_error)
        seats = sorted(
            (k for k, name in enumerate(roster.players) if name not in without),
            key=lambda k: roster.players[k].casefold(),
        )
        everyone = self.gap(*all_pairs(roster).T) or Gap([0.0], 0.0, self.scale)
        largest = float(everyone.normal[1].max(initial=0.0))
        scale, rated = everyone.scale, isinstance(self.rule, (OfferedRaces, Chart))
        return {
            "scale": scale.points_per_doubling,
            "form": everyone.form,
            "rule": self._for_script,
            "race": _as_rows(averaging_rule(largest, self._longest, scale)),
            "game": _as_rows(normal_rule(scale.log_odds(largest), 2, MOST_NODES)),
            "players": [
                [
                    roster.players[k],
                    int(self._points[k]),
                    int(self._group[k]),
                    *([_rounded(roster.rating[k]), _rounded(error[k])] if rated else []),
                ]
                for k in seats
            ],
        }

    @property
    def _for_script(self) -> dict[str, Any]:
        if isinstance(self.rule, OfferedRaces):
            games = self.rule.games
            return {"games": list(games)} if games else {"race_to": self.rule.race_to}
        if isinstance(self.rule, Chart):
            return {"rows": [(row.difference_from, *row[2:]) for row in self.rule.rows]}
        if isinstance(self.rule, PointsChart):
            needs = [[mine] * len(self.rule.levels) for mine in self.rule.points]
            return {"levels": list(self.rule.levels), "needs": needs}
        levels = np.array(self.rule.levels)
        pair = levels[:, None], levels[None, :]
        skills = self.skills
        gaps, errors = (skills.difference(*pair), skills.error(*pair)) if skills else ([], [])
        return {
            "levels": levels.tolist(),
            "needs": [*map(list, self.rule.needs)],
            "gaps": [[_rounded(one) for one in row] for row in gaps],
            "errors": [[_rounded(one) for one in row] for row in errors],
        }

    @property
    def _longest(self) -> int:
        return max((m + n for m, n, _ in self.by_pair.values()), default=2) + 1


def _rounded(value: Any) -> float:
    return round(float(value), 6)


def _as_rows(rule: tuple[Floats, Floats]) -> Sequence[tuple[float, float]]:
    return list(zip(*(part.tolist() for part in rule), strict=True))
