"""Whether a validated season's handicaps are fair: head starts, the scale, a chart that fits."""

from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np
from scipy.special import ndtri

from evenbreak.answers.columns.shown import percent_interval
from evenbreak.answers.kit.columns import columns_of
from evenbreak.answers.kit.parts import Table
from evenbreak.answers.kit.wording import count_of, percent
from evenbreak.handicaps.charts.fair_scale import LeagueChart
from evenbreak.ratings.estimates import Estimate
from evenbreak.ratings.scale import Scale, scale_of
from evenbreak.ratings.validation.calibration import Of, Scored
from evenbreak.ratings.validation.starts import StartGroup, Starts, even_start
from evenbreak.ratings.validation.validate import (
    HandicapFairness,
    RaceLengths,
    Validation,
    mostly_even,
)
from evenbreak.words import listed, race

UNLIKELY = 0.01
"""A p-value below which chance is ruled out; it is small because several tests are run."""

NEAR = 0.1
"""How far off head starts may be: a chart's hardest race covers all larger differences too."""

VAGUE = 0.5
"""If the slope's interval is wider than this, it says too little."""


def clearly_off(estimate: Estimate, right: float, *, tests: int = 1) -> int:
    """Return 1 or -1 if an estimate is clearly above or below the right value, else 0.

    With more such tests, it must be farther off.

    >>> clearly_off(Estimate(0.5, 0.4, 0.6), 1.0), clearly_off(Estimate(0.9, 0.8, 1.0), 1.0)
    (-1, 0)
    """
    above, far = estimate.errors_above(right), ndtri(1.0 - UNLIKELY / (2.0 * tests))
    return int(above > far) - int(above < -far)


def scored_of(found: Validation, of: Of) -> Scored:
    """Return how good one type of prediction was."""
    return next(row for row in found.scored if (row.of, row.how) == (of, "integrated"))


def wrong_chances(scored: tuple[Scored, ...], found: Validation) -> dict[str, int]:
    """Return the predictions that are clearly off: -1 too extreme, 1 too cautious."""
    # A fair handicap leaves matches without favorites, whatever the ratings say.
    judged = ("game", "match") if mostly_even(found.forecasts) else ("game",)
    off = {
        row.of: clearly_off(row.slope, 1.0)
        for row in scored
        if row.how == "integrated" and row.of in judged and row.slope is not None
    }
    return {of: way for of, way in off.items() if way}


def share_of(spot: HandicapFairness) -> Estimate:
    """Return the share of handicap races won by the player who gave games."""
    return Estimate(spot.share, spot.low, spot.high)


def span_of(half: RaceLengths) -> str:
    """Return the race lengths for grouping similar races.

    >>> span_of(RaceLengths(6, 9, 10, 5, 0.5, 0.2, 0.8, 0.6))
    '6 to 9'
    """
    return " to ".join(dict.fromkeys((str(half.shortest), str(half.longest))))


def unfair_starts(spots: Sequence[HandicapFairness]) -> list[HandicapFairness]:
    """Return the head starts that are clearly unfair on their own, grouped by games given.

    >>> from evenbreak.ratings.estimates import wilson
    >>> fair, unfair = (HandicapFairness(k, 200, w, w / 200, *wilson(w / 200, 200), 0.5)
    ...                 for k, w in ((1, 96), (2, 130)))
    >>> [one.spot for one in unfair_starts([fair, unfair])]
    [2]
    """
    return [one for one in spots if clearly_off(share_of(one), 0.5, tests=len(spots))]


def starts_trend(spots: Sequence[HandicapFairness]) -> int:
    """Return 1 if players clearly win more often when giving more games, -1 if less often, else 0.

    >>> from evenbreak.ratings.estimates import wilson
    >>> spots = [HandicapFairness(k, 200, w, w / 200, *wilson(w / 200, 200), 0.5)
    ...          for k, w in ((1, 84), (2, 100), (3, 118))]
    >>> starts_trend(spots), starts_trend(spots[:1])
    (1, 0)
    """
    if len(spots) < 2:
        return 0
    games, matches, won = (
        np.array([getattr(one, name) for one in spots], dtype=float)
        for name in ("spot", "matches", "won")
    )
    share = won.sum() / matches.sum()
    far = games - (games @ matches) / matches.sum()
    spread = share * (1.0 - share) * (matches @ far**2)
    z = far @ (won - matches * share) / np.sqrt(spread) if spread > 0.0 else 0.0
    return int(np.sign(z)) if abs(z) > ndtri(1.0 - UNLIKELY / 2.0) else 0


def starts_way(found: Validation, chart: LeagueChart | None = None) -> int:
    """Return 1 if head starts clearly take back too little, -1 if too much, else 0.

    If ratings are known, the fitted scale decides. If the matches clearly say the opposite, the
    result is also 0.
    """
    way = 0
    if chart is not None and chart.scale is not None:
        way = scale_way(chart)
    elif found.starts is not None:
        share = found.starts.share
        way = int(clearly_off(share, 1.0 + NEAR) > 0) - int(clearly_off(share, 1.0 - NEAR) < 0)
    by_matches = clearly_off(share_of(found.spots[-1]), 0.5) if found.spots else 0
    return 0 if way == -by_matches else way


def scale_way(chart: LeagueChart) -> int:
    """Return 1 if clearly fewer points double the odds than the races assume, -1 if more."""
    if chart.scale is None:
        return 0
    # What a chart that is not known assumes is read off its races.
    near = 0.0 if chart.nearest is not None else NEAR / 2.0
    points, assumed = chart.scale.points, chart.scale.assumed
    fewer = clearly_off(points, assumed * (1.0 - near)) < 0
    return int(fewer) - int(clearly_off(points, assumed * (1.0 + near)) > 0)


def points_text(prior_sd: float, scale: Scale) -> str:
    """Return a prior's standard deviation in points."""
    return f"{prior_sd * scale.points_per_log_odds:.3g}"


def more_or_less(more: bool) -> str:
    """Return 'more' or 'less'."""
    return "more" if more else "less"


WIDE = 0.4
"""If the range of a proportion is at least this wide, it says nothing."""

SURE = 0.1
"""To confirm a chart, the standard error must be below this share of the fair scale."""

MOST_SIZES = 4
"""How many sizes of head start are listed."""


def handicap_remarks(found: Validation, chart: LeagueChart, scale: Scale) -> Iterator[str]:
    """Yield what there is to say about handicaps; nothing if there were none."""
    if not found.spots:
        return
    way = starts_way(found, chart)
    fair, command = _fair_scale(chart)
    # Beside what a chart assumes, points are those of the chart.
    own = scale if not fair or chart.scale is None else scale_of(chart.scale.assumed)
    yield _fairness(found, way, own)
    if found.starts is not None and found.starts.a_class is not None:
        yield _class_worth(found.starts, found.starts.a_class, way, scale)
    if fair:
        yield fair
    if command:
        yield command


def _fairness(found: Validation, by_games: int, scale: Scale) -> str:
    every = found.spots[-1]
    won = (
        f"Players who gave games won {every.won:,} of {count_of(every.matches, 'match', 'matches')}"
    )
    luck = percent_interval((every.low, every.high))
    figures = f"{won} ({percent(every.share)}; {luck} allowing for luck)"
    by_size = _unfair_by_size(found, scale)
    off = clearly_off(share_of(every), 0.5)
    if off or by_games:
        way = off or by_games
        shown = "" if off else ", as the games within the matches show"
        against = _against(found.starts, way, scale) or by_size
        return " ".join(
            [
                f"The handicaps give too {_little(way)}{shown}. {figures}; fair is 50%.",
                *([against] if against else []),
            ]
        )
    if every.high - every.low > WIDE:
        unknown = "There are too few handicap matches to say whether the handicaps are fair"
        return (
            f"{by_size} {unknown} on average. {figures}." if by_size else f"{unknown}. {figures}."
        )
    if not every.low <= 0.5 <= every.high:
        doubt = (
            f"The handicaps may give too {_little(1 if every.low > 0.5 else -1)}. {figures}; fair "
            "is 50%, just outside that range."
        )
        return f"{by_size} {doubt}" if by_size else doubt
    if by_size:
        fair = f"{figures[0].lower()}{figures[1:]}"
        return f"{by_size} Taken together, the head starts are fair: {fair}."
    way = clearly_off(share_of(every), every.expected)
    if way:
        under = "under" if way > 0 else "over"
        return (
            f"The handicaps look fair. {figures}. The ratings predicted {percent(every.expected)}: "
            f"they {under}rate players who give games, so do not use them to predict handicap "
            "matches."
        )
    return f"The handicaps look fair. {figures}."


def _unfair_by_size(found: Validation, scale: Scale) -> str:
    """Return which head starts are unfair on their own; '' if none are."""
    spots = found.spots[:-1]
    if wrong := unfair_starts(spots):
        text = " ".join(_unfair(one, found.starts, scale) for one in wrong)
        if wrong[-1] is spots[-1] and wrong[-1].share > 0.5:
            text += " No head start is larger, so players who are farther apart get this one too."
        return text
    way = starts_trend(spots)
    if not way:
        return ""
    small, large = spots[0], spots[-1]
    return (
        f"The more games a player gives, the {more_or_less(way > 0)} often that player wins: "
        f"{percent(small.share)} of the time when giving {count_of(int(small.spot or 0), 'game')}, "
        f"and {percent(large.share)} when giving {large.spot}."
    )


def _unfair(one: HandicapFairness, starts: Starts | None, scale: Scale) -> str:
    """Return that one size of head start is unfair, and what it should take back if known."""
    way = 1 if one.share > 0.5 else -1
    games = int(one.spot or 0)
    should = "".join(
        f" It makes up for {scale.points(group.taken):.0f} points, but should make up for "
        f"{scale.points(group.stronger.value):z.0f}."
        for group in _by_games(starts)
        if group.apart == games and (group.stronger.value - group.taken) * way > 0.0
    )
    return (
        f"A head start of {count_of(games, 'game')} gives too {_little(way)}: the player who "
        f"gave it won {one.won:,} of {one.matches:,} ({percent(one.share)}).{should}"
    )


def _by_games(starts: Starts | None) -> tuple[StartGroup, ...]:
    """Return the head starts by games given; none if they are known by class."""
    return () if starts is None or starts.classes else starts.groups


def _little(way: float) -> str:
    return "little" if way > 0 else "much"


def _against(starts: Starts | None, way: int, scale: Scale) -> str:
    """Return what head starts take back and what they should; '' if the games don't show it."""
    if starts is None or (starts.stronger.value - starts.taken) * way <= 0.0:
        return ""
    text = (
        f"On average, they make up for {scale.points(starts.taken):.0f} points, but should make "
        f"up for {scale.points(starts.stronger.value):.0f} ± {_error(starts.stronger, scale)}"
    )
    groups = _by_games(starts)
    sizes = [
        f"{count_of(group.apart, 'game')} {'makes' if group.apart == 1 else 'make'} up for "
        f"{scale.points(group.taken):.0f} points instead of "
        f"{scale.points(group.stronger.value):z.0f}"
        for group in groups
        if clearly_off(group.stronger, group.taken, tests=len(groups)) == way
    ]
    more = len(sizes) - MOST_SIZES
    rest = f"{count_of(more, 'larger head start')} {'is' if more == 1 else 'are'} off the same way"
    shown = sizes[:MOST_SIZES] + ([rest] if more > 0 else [])
    return f"{text}; by size, {listed(shown)}." if shown else f"{text}."


def _class_worth(starts: Starts, a_class: Estimate, way: int, scale: Scale) -> str:
    one, many = ("level", "levels") if starts.numbered else ("class", "classes")
    worth = f"{one} is worth {scale.points(a_class.value):z.0f} ± {_error(a_class, scale)} points"
    if not clearly_off(a_class, 0.0):
        return f"The {many} make no clear difference: one {worth}."
    chance = percent(float(scale.win_probability(scale.points(a_class.value))))
    text = f"A {worth}: players win {chance} of their games against players one {one} below."
    next_to = next((group for group in starts.groups if group.apart == 1), None)
    if next_to is None:
        return text
    needs, gets = next_to.race
    text += (
        f" The races between neighboring {many}, most often {race(next_to.race)}, make up for "
        f"{scale.points(next_to.taken):.0f} points"
    )
    better = even_start(needs, a_class.value)
    if way and even_start(needs, next_to.taken) == gets != better:
        return f"{text}; {race((needs, better))} would be closer to even."
    return f"{text}."


def _points(estimate: Estimate, scale: Scale) -> str:
    return f"{scale.points(estimate.value):z.0f} points"


def _error(estimate: Estimate, scale: Scale) -> str:
    return f"{scale.points(estimate.standard_error):.1f}"


def _fair_scale(chart: LeagueChart) -> tuple[str, str]:
    """Return how many points double the odds, and the command that designs such a chart; or ''."""
    fair = chart.scale
    if fair is None:
        return "", ""
    points = fair.points
    error = points.standard_error
    if not scale_way(chart):
        agrees = points.low <= fair.assumed <= points.high
        if error > SURE * points.value or not agrees:
            return "", ""
        return (
            f"The races assume that {fair.assumed:.3g} points double the odds of winning a game. "
            f"The results agree: they suggest {points.value:.1f} ± {error:.1f}."
        ), ""
    low, high = fair.games
    return (
        f"{points.value:.1f} ± {error:.1f} points double the odds of winning a game in this "
        f"league; the races assume {fair.assumed:.3g}. This command makes a chart that fits:",
        f"evenbreak chart design --games {low}..{high} --least {race(fair.least)} "
        f"--scale {points.value:.1f}",
    )


def starts_table(starts: Starts, scale: Scale) -> Table:
    """Return what head starts take back, by difference in class or by games given."""

    def stronger(one: Estimate) -> str:
        value, low, high = (scale.points(part) for part in one)
        return f"{value:z.0f}  {low:z.0f} to {high:z.0f}"

    def taken(games: float) -> str:
        return f"{scale.points(games):z.0f}"

    apart = "classes_apart" if starts.classes else "games_apart"
    columns = columns_of(
        f"{apart} matches race_played points_stronger taken",
        show={"points_stronger": stronger, "taken": taken},
    )
    value, low, high = starts.share
    title = (
        "How far apart the players are according to the results, and how many points the races "
        f"make up for. Taken together, the results suggest that players differ by "
        f"{value:.2f} times what the races make up for ({low:.2f} to {high:.2f}):"
    )
    return Table("", columns, list(starts.groups), title)


def handicap_rows(found: Validation, chart: LeagueChart) -> Iterator[tuple[Any, ...]]:
    """Yield a row for files for each figure about head starts, the scale and the chart."""
    starts, fair, nearest = found.starts, chart.scale, chart.nearest
    if starts is not None:
        yield ("start", "game", "share", starts.matches, 1.0, *starts.share, None)
        yield ("start", "game", "all", starts.matches, starts.taken, *starts.stronger, None)
        if starts.a_class is not None:
            yield ("start", "game", "class", starts.matches, None, *starts.a_class, None)
        by = "classes" if starts.classes else "games"
        for one in starts.groups:
            yield (
                "start",
                "game",
                f"{one.apart} {by}",
                one.matches,
                one.taken,
                *one.stronger,
                None,
            )
    if fair is not None:
        yield ("fair_scale", "game", "points", fair.matches, fair.assumed, *fair.points, None)
    if nearest is not None:
        share = nearest.agree / nearest.matches
        yield ("chart", "match", nearest.name, nearest.matches, 1.0, share, None, None, None)
