"""Why two players have their ratings and their race, and what would change them."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np

from evenbreak.answers.kit.answer import Answer
from evenbreak.answers.kit.columns import columns_of, in_files
from evenbreak.answers.kit.parts import Table
from evenbreak.answers.kit.scales import like_scale_words, points_on
from evenbreak.answers.kit.wording import percent
from evenbreak.answers.league.by_level import levels_of
from evenbreak.answers.league.prior import evidence_rows, prior_details, prior_warnings
from evenbreak.answers.league.roster_matchups import OfferedRaces, cannot_be_compared
from evenbreak.answers.league.sheet import as_listed
from evenbreak.files.results.results_file import ResultsFile
from evenbreak.handicaps.charts.chart import Chart
from evenbreak.handicaps.charts.gap import Gap
from evenbreak.handicaps.charts.level_chart import LevelChart
from evenbreak.handicaps.charts.level_skills import LevelSkills, level_skills
from evenbreak.ratings.fitted import Ratings
from evenbreak.ratings.prior import PriorChoice
from evenbreak.ratings.results import Results, who_won
from evenbreak.ratings.roster import Roster
from evenbreak.ratings.scale import Scale
from evenbreak.ratings.sources import rating_sources
from evenbreak.words import FilePath, Sentence, joined, race, say

SOURCES = {
    "prior": say("assumed before"),
    "brought": say("rating from elsewhere"),
    "results": say("these results"),
}
"""What is shown for each source of a rating."""

MOST_LISTED = 10
"""How many of each player's matches are shown; CSV and JSON have all of them."""


def why_answer(
    file: ResultsFile,
    ratings: Ratings,
    pair: tuple[int, int],
    offered: OfferedRaces,
    refit: Refit,
    choice: PriorChoice | None = None,
    chart: Chart | LevelChart | None = None,
    listed: Roster | None = None,
) -> Answer:
    """Return the matches behind two ratings, and how one more match would change them.

    Parameters
    ----------
    pair
        positions in `ratings.players`.
    offered
        the races to choose the fairest from.
    refit
        rates other results the same way.
    choice
        how the prior was chosen, if it was.
    chart
        the league's chart, whose race then comes first, and is used for one more match.
    listed
        the league's list; a chart by skill level uses its levels before those in the results.

    >>> from evenbreak.ratings import Results, fit
    >>> season = Results.from_names(["Ann", "Bo"], ["Bo", "Cy"], [7, 7], [5, 4])
    >>> file = ResultsFile(season, "season.csv", (), (), "")
    >>> answer = why_answer(file, fit(season), (0, 1), OfferedRaces(race_to=7), fit)
    >>> answer.to_dict()["one_more"][0]["score"], answer.to_dict()["matches"][0]["worth"] > 0
    ('7-5', True)
    """
    now = Standing.of(ratings, pair, offered)
    matches = matches_behind(file.results, ratings, pair, refit)
    scale = ratings.scale
    names = ratings.players[pair[0]], ratings.players[pair[1]]
    charted = None if chart is None else _by_chart(file.results, chart, now, pair, ratings, listed)
    played = None if charted is None else charted.race
    more = one_more_match(file.results, ratings, pair, now, offered, refit, played)
    brought, sources = ratings.levels.beginning is not None, [_sources_table(ratings, pair)]
    return Answer(
        say(
            "{a} and {b} in {file}\nRatings on {scale}",
            a=names[0],
            b=names[1],
            file=FilePath(file.source),
            scale=like_scale_words(scale),
        ),
        [
            *([_chart_in_words(charted, names)] if charted else []),
            joined(
                filter(
                    None,
                    [
                        _now_in_words(now, names, scale, charted),
                        "" if charted else _more_in_words(more, now),
                    ],
                )
            ),
            _players_table(ratings, pair),
            *(sources if brought else []),
            *([_more_table(more, now, names, scale, played)] if more else []),
            *(_matches_table(matches, name, scale) for name in names),
            say(
                "Worth: how much lower (or, with a minus, higher) the rating would be without "
                "this match."
            ),
        ],
        details=[*prior_details(ratings, choice), *([] if brought else sources)],
        warnings=[*file.warnings, *file.ties, *prior_warnings(file, ratings, choice)],
        data={
            "player_a": names[0],
            "player_b": names[1],
            "difference": now.ratings[0] - now.ratings[1],
            "difference_error": now.difference_error,
            "race_a": now.race and now.race[0],
            "race_b": now.race and now.race[1],
            "p_win_a": now.p_win,
            **({} if charted is None else charted.data),
            "evidence": evidence_rows(choice),
            "one_more": [
                {
                    "winner": one.winner,
                    "score": one.score,
                    "rating_a": one.then.ratings[0],
                    "rating_b": one.then.ratings[1],
                    "race_a": one.then.race and one.then.race[0],
                    "race_b": one.then.race and one.then.race[1],
                    "p_win_a": one.then.p_win,
                }
                for one in more
            ],
        },
        csv=Table("matches", in_files(MATCH), matches),
    )


def _now_in_words(
    now: Standing, names: tuple[str, str], scale: Scale, charted: ByChart | None
) -> str:
    a, b = names
    points, (first, second) = points_on(scale), now.ratings
    rated = {"first": points(first), "second": points(second)}
    if now.race is None or now.p_win is None or now.difference_error is None:
        return say(
            "{a} is rated {first} and {b} is rated {second}. No chain of opponents links the "
            "two, so they can't be compared.",
            a=a,
            b=b,
            **rated,
        )
    apart = {"gap": points(abs(first - second)), "error": points(now.difference_error)}
    fair = {"race": race(now.race), "p": percent(now.p_win)}
    if charted is not None and charted.stated is not None:
        return say(
            "By their own results, {a} is rated {first} and {b} is rated {second}: {gap} points "
            "apart, ± {error}. In that case, {a} would win the {played} race {played_p} of the "
            "time, and the race closest to even would be {race} ({p}).",
            a=a,
            b=b,
            **rated,
            **apart,
            **fair,
            played=race(charted.race),
            played_p=percent(charted.p_rated),
        )
    return say(
        "{a} is rated {first} and {b} is rated {second}: {gap} points apart, ± {error}. Their "
        "fairest race is {race}, and {a} wins it {p} of the time.",
        a=a,
        b=b,
        **rated,
        **apart,
        **fair,
    )


class ByChart(NamedTuple):
    """The race that a chart sets for two players, by their levels or their ratings.

    `p_win` and `p_rated` are P(a wins) according to what the chart reads, and according to the
    ratings (NaN without any).
    """

    chart: str
    race: tuple[int, int]
    p_win: float
    p_rated: float
    stated: tuple[float, float, LevelSkills] | None = None

    @property
    def data(self) -> dict[str, Any]:
        """The race, for JSON."""
        a, b = self.race
        return {"chart_race_a": a, "chart_race_b": b, "chart_p_win_a": self.p_win}


def _by_chart(
    results: Results,
    chart: Chart | LevelChart,
    now: Standing,
    pair: tuple[int, int],
    ratings: Ratings,
    listed: Roster | None,
) -> ByChart | None:
    """Return the race, using the list's or the results' levels, or else the ratings."""
    a, b = now.ratings
    error = now.difference_error
    gap = None if error is None else Gap(a - b, error, ratings.scale, ratings.match_form)
    if isinstance(chart, LevelChart):
        names = [ratings.players[k] for k in pair]
        first, second = levels_of(names, listed, results).tolist()
        if first not in chart.levels or second not in chart.levels:
            return None
        needs, skills = chart.race(int(first), int(second)), level_skills(chart, results)
        rated = math.nan if gap is None else float(gap.win(*needs))
        p_win = float(skills.gap(first, second).win(*needs))
        return ByChart(chart.name, needs, p_win, rated, (first, second, skills))
    if gap is None:
        return None
    needs = chart.race(math.floor(a + 0.5) - math.floor(b + 0.5))
    p_win = float(gap.win(*needs))
    return ByChart(chart.name, needs, p_win, p_win)


def _chart_in_words(charted: ByChart, names: tuple[str, str]) -> Sentence:
    words: dict[str, Any] = {
        "chart": charted.chart,
        "a": names[0],
        "race": race(charted.race),
        "p": percent(charted.p_win),
    }
    if charted.stated is None:
        return say("In {chart}, their race is {race}, and {a} wins it {p} of the time.", **words)
    x, y, skills = charted.stated
    return say(
        "{a} is a skill level {x:.0f} and {b} is a {y:.0f}. In {chart}, their race is {race}, "
        "and {a} wins it {p} of the time. {why}",
        **words,
        b=names[1],
        x=x,
        y=y,
        why=skills.why,
    )


def _more_in_words(more: Sequence[OneMore], now: Standing) -> str:
    changes = [
        say(
            "If {winner} wins their next match {score}, the race becomes {race}.",
            winner=one.winner,
            score=one.score,
            race=race(one.then.race),
        )
        for one in more
        if one.then.race is not None and one.then.race != now.race
    ]
    if more and not changes:
        return say("The race stays the same whoever wins their next match.")
    return joined(changes)


def _players_table(ratings: Ratings, pair: tuple[int, int]) -> Table:
    points = points_on(ratings.scale)
    columns = columns_of(
        "player rating standard_error games won lost",
        show={"rating": points, "standard_error": points},
    )
    rows = [
        (
            ratings.players[k],
            float(ratings.rating[k]),
            float(ratings.standard_error[k]),
            *(int(getattr(ratings, name)[k]) for name in ("games", "won", "lost")),
        )
        for k in pair
    ]
    return Table("players", columns, rows)


def _sources_table(ratings: Ratings, pair: tuple[int, int]) -> Table:
    """Return the sources of each rating."""
    points = points_on(ratings.scale)
    columns = columns_of(
        "player rating_source rating_alone standard_error weight",
        show={
            "rating_source": SOURCES.__getitem__,
            "rating_alone": points,
            "standard_error": points,
        },
    )
    rows = [
        (ratings.players[player], *source)
        for player in pair
        for source in rating_sources(ratings, player)
    ]
    title = say("What the ratings are made of: each is the weighted average of its sources.")
    return Table("sources", columns, rows, title)


def _more_table(
    more: Sequence[OneMore],
    now: Standing,
    names: tuple[str, str],
    scale: Scale,
    played: tuple[int, int] | None,
) -> Table:
    a, b = names
    change = points_on(scale, "+")
    columns = columns_of(
        "one_match change_a change_b fair_race wins_a",
        show={"change_a": change, "change_b": change},
        a="\n".join(a.split()),
        b="\n".join(b.split()),
    )
    rows = [
        (
            say("{winner} wins {score}", winner=one.winner, score=one.score),
            one.then.ratings[0] - now.ratings[0],
            one.then.ratings[1] - now.ratings[1],
            one.then.race,
            one.then.p_win,
        )
        for one in more
    ]
    title = say("What one more match between the two, at their fair race, would change:")
    if played is not None:
        title = say(
            "What one more match between the two, at {race}, would change in these ratings:",
            race=race(played),
        )
    return Table("", columns, rows, title)


def _matches_table(matches: Sequence[tuple[Any, ...]], name: str, scale: Scale) -> Table:
    own = [match for match in matches if match[0] == name]
    most = sorted(own, key=lambda match: -abs(match[-1]))[:MOST_LISTED]
    dated = any(match[1] for match in own)
    columns = columns_of(
        f"{'date' if dated else '-date'} opponent opponent_rating result score worth",
        show={"opponent_rating": points_on(scale), "worth": points_on(scale, "+")},
    )
    rows = [
        (day, who, rated, result, score, worth) for _, day, who, rated, score, result, worth in most
    ]
    if len(own) > len(most):
        which = say("the {n} of {all} that matter most", n=len(most), all=len(own))
    else:
        which = say("all") if own else say("none yet")
    title = say("The matches behind {player}'s rating: {which}.", player=name, which=which)
    return Table("", columns, rows, title)


Refit = Callable[[Results], Ratings]
"""Rates other results the same way."""


@dataclass(frozen=True)
class Standing:
    """Two ratings, and the fairest race between the players; no race if they can't be compared."""

    ratings: tuple[float, float]
    difference_error: float | None
    race: tuple[int, int] | None
    p_win: float | None

    @classmethod
    def of(cls, ratings: Ratings, pair: tuple[int, int], offered: OfferedRaces) -> Standing:
        """Return two players' current ratings and race (positions in `ratings.players`)."""
        both = float(ratings.rating[pair[0]]), float(ratings.rating[pair[1]])
        listed = as_listed(ratings)
        if cannot_be_compared(listed, *pair):
            return cls(both, None, None, None)
        turned = listed.rating[pair[0]] < listed.rating[pair[1]]
        seats = list(pair[::-1] if turned else pair)  # the stronger one first, as in lists
        points, errors = listed.rating[seats], listed.standard_error[seats]
        gap = Gap(points[:1] - points[1:], np.hypot(*errors), ratings.scale, ratings.match_form)
        m, n = offered.fairest(gap)
        needs, p_win = (int(m[0]), int(n[0])), float(gap.win(m, n)[0])
        if turned:
            needs, p_win = needs[::-1], 1.0 - p_win
        return cls(both, float(gap.error[0]), needs, p_win)


@dataclass(frozen=True)
class OneMore:
    """One more match between the two: the result, and the ratings and race after it."""

    winner: str
    score: str
    then: Standing


def one_more_match(
    results: Results,
    ratings: Ratings,
    pair: tuple[int, int],
    now: Standing,
    offered: OfferedRaces,
    refit: Refit,
    played: tuple[int, int] | None = None,
) -> list[OneMore]:
    """Return what changes if either wins by the likeliest score in their fair race, or `played`."""
    if now.race is None:
        return []
    p = ratings.scale.win_probability(now.ratings[0] - now.ratings[1])
    day = ratings.as_of
    if day is None and results.date is not None:
        day = np.fmax.reduce(results.date[results.counted])
    found = []
    for winner in (0, 1):
        needs, other = (played or now.race)[winner], (played or now.race)[1 - winner]
        score = (needs, _likeliest_loss(needs, other, 1.0 - p if winner == 0 else p))
        a_first = score if winner == 0 else score[::-1]
        dates = None if day is None or results.date is None else np.array([day])
        match = Results(results.players, *np.array([[*pair, *a_first]]).T, date=dates)
        then = refit(results.joined(match))
        found.append(
            OneMore(
                ratings.players[pair[winner]],
                f"{score[0]}-{score[1]}",
                Standing.of(then, pair, offered),
            )
        )
    return found


def _likeliest_loss(needs: int, other: int, p_loser: float) -> int:
    """Return the loser's likeliest games when the winner gets the last of `needs`.

    >>> _likeliest_loss(7, 7, 0.5), _likeliest_loss(7, 5, 0.2)
    (6, 1)
    """
    return max(range(other), key=lambda k: math.comb(needs - 1 + k, k) * p_loser**k + k * 1e-12)


MATCH = ("player", "date", "opponent", "opponent_rating", "score", "result", "worth")
"""A match's columns: the player comes first, and the score is from their side."""


def matches_behind(
    results: Results, ratings: Ratings, pair: tuple[int, int], refit: Refit
) -> list[tuple[Any, ...]]:
    """Return both players' matches that count, each with its effect on the rating."""
    counts = results.counted
    if ratings.as_of is not None and results.date is not None:
        counts = counts & (results.date <= ratings.as_of)
    here = np.isin(results.player_a, pair) | np.isin(results.player_b, pair)
    winner = who_won(results)
    if results.winner is not None:
        winner = np.where(results.winner > 0, results.winner, winner)
    rows = []
    for row in np.flatnonzero(counts & here).tolist():
        without = refit(results.select(np.arange(len(results)) != row)).rating
        for player in pair:
            if player in (results.player_a[row], results.player_b[row]):
                worth = float(ratings.rating[player] - without[player])
                match = _match(results, ratings, row, player, int(winner[row]))
                rows.append((pair.index(player), row, match, worth))
    rows.sort(key=lambda one: one[:2])
    return [(*match, worth) for _, _, match, worth in rows]


def _match(
    results: Results, ratings: Ratings, row: int, player: int, winner: int
) -> tuple[Any, ...]:
    first = int(results.player_a[row]) == player
    opponent = int((results.player_b if first else results.player_a)[row])
    own, other = int(results.score_a[row]), int(results.score_b[row])
    if not first:
        own, other = other, own
    scored = results.unscored is None or not results.unscored[row]
    result = "level" if not winner else "won" if winner == (1 if first else 2) else "lost"
    day = None if results.date is None or np.isnat(results.date[row]) else str(results.date[row])
    return (
        ratings.players[player],
        day,
        ratings.players[opponent],
        float(ratings.rating[opponent]),
        f"{own}-{other}" if scored else None,
        result,
    )
