"""Whether handicaps were fair, what a start is worth, and which chart the races come from."""

from collections.abc import Iterator, Sequence
from typing import Any

from evenbreak.answers.parts import Column, Table
from evenbreak.answers.validate_judgement import (
    clearly_off,
    more_or_less,
    percents,
    scale_way,
    share_of,
    starts_trend,
    starts_way,
    unfair_starts,
)
from evenbreak.answers.wording import count_of, listed, percent, race
from evenbreak.handicaps.charts.fair_scale import LeagueChart
from evenbreak.handicaps.charts.played_chart import PlayedCell, PlayedChart
from evenbreak.ratings.calibration import Estimate
from evenbreak.ratings.handicap_fairness import HandicapFairness
from evenbreak.ratings.scale import Scale
from evenbreak.ratings.starts import Starts, even_start
from evenbreak.ratings.validate import Validation

WIDE = 0.4
"""The width from which the range of a share says nothing about it."""

SURE = 0.1
"""The share of the fair scale that its standard error must be below to confirm a chart."""

MOST_CHANGED = 4
"""Places of a chart that are listed; the others are counted."""


def handicap_remarks(found: Validation, chart: LeagueChart, scale: Scale) -> Iterator[str]:
    """Yield what there is to say about handicaps; nothing where there were none."""
    if not found.spots:
        return
    way = starts_way(found, chart)
    yield _fairness(found, way)
    fair, command = _fair_scale(chart)
    if found.starts is not None:
        yield from _worth(found.starts, way, scale, covered=bool(fair))
    if fair:
        yield fair
    if command:
        yield command
    if chart.nearest is not None:
        yield _nearest(chart.nearest)


def _fairness(found: Validation, by_games: int) -> str:
    every = found.spots[-1]
    won = (
        f"Players who gave games won {every.won:,} of {count_of(every.matches, 'match', 'matches')}"
    )
    figures = (
        f"{won} ({percent(every.share)}; {percents((every.low, every.high))} allowing for luck)"
    )
    off = clearly_off(share_of(every), 0.5)
    if off:
        return f"The handicaps give too {_little(off)}. {figures}; fair is 50%."
    if by_games:
        return (
            f"The handicaps give too {_little(by_games)}, as the games within the matches show. "
            f"{figures}; fair is 50%."
        )
    if every.high - every.low > WIDE:
        unknown = "There are too few handicap matches to say whether the handicaps are fair"
        by_size = _unfair_by_size(found.spots[:-1])
        if by_size:
            return f"{unknown} on average, but not all starts are fair. {by_size} {figures}."
        return f"{unknown}. {figures}."
    if not every.low <= 0.5 <= every.high:
        return (
            f"The handicaps may give too {_little(1 if every.low > 0.5 else -1)}. {figures}; fair "
            "is 50%, just outside that range."
        )
    if by_size := _unfair_by_size(found.spots[:-1]):
        return f"The handicaps look fair on average, but not one by one. {by_size} {figures}."
    way = clearly_off(share_of(every), every.expected)
    if way:
        under = "under" if way > 0 else "over"
        return (
            f"The handicaps look fair. {figures}. The ratings predicted {percent(every.expected)}: "
            f"they {under}rate players who give games, so do not use them to predict handicap "
            "matches."
        )
    return f"The handicaps look fair. {figures}."


def _unfair_by_size(spots: Sequence[HandicapFairness]) -> str:
    """Return which starts are unfair although they are fair on average; '' if none is."""
    if wrong := unfair_starts(spots):
        said = [
            f"a start of {count_of(int(one.spot or 0), 'game')} gives too "
            f"{_little(one.share - 0.5)} (the player who gave it won {one.won:,} of "
            f"{one.matches:,}, {percent(one.share)})"
            for one in wrong
        ]
        words = listed(said)
        return f"{words[0].upper()}{words[1:]}."
    way = starts_trend(spots)
    if not way:
        return ""
    small, large = spots[0], spots[-1]
    return (
        f"The more games are given, the {more_or_less(way > 0)} often the player who gives them "
        f"wins: from {percent(small.share)} with {count_of(int(small.spot or 0), 'game')} to "
        f"{percent(large.share)} with {large.spot}."
    )


def _little(way: float) -> str:
    return "little" if way > 0 else "much"


def _worth(starts: Starts, way: int, scale: Scale, *, covered: bool) -> Iterator[str]:
    """Yield what a class is worth, or else a start where it takes back too little or too much."""
    if starts.a_class is not None:
        yield _class_worth(starts, starts.a_class, way, scale)
    elif way and not covered:
        yield (
            f"Players who give games are {_points(starts.stronger, scale)} stronger than their "
            f"opponents on average, give or take {_error(starts.stronger, scale)}. The games that "
            f"they give take back {scale.points(starts.taken):.0f} points."
        )


def _class_worth(starts: Starts, a_class: Estimate, way: int, scale: Scale) -> str:
    one, many = ("level", "levels") if starts.numbered else ("class", "classes")
    worth = f"{one} is worth {_points(a_class, scale)}, give or take {_error(a_class, scale)}"
    if not clearly_off(a_class, 0.0):
        return f"The {many} make no clear difference: a {worth}."
    chance = percent(float(scale.win_probability(scale.points(a_class.value))))
    text = f"A {worth}: players win {chance} of their games against those of the {one} below."
    next_to = next((group for group in starts.groups if group.apart == 1), None)
    if next_to is None:
        return text
    needs, gets = next_to.race
    text += (
        f" The races between neighbouring {many}, most often {race(next_to.race)}, take back "
        f"{scale.points(next_to.taken):.0f} points"
    )
    better = even_start(needs, a_class.value)
    if way and even_start(needs, next_to.taken) == gets != better:
        return f"{text}; {race((needs, better))} would be nearer to even."
    return f"{text}."


def _points(estimate: Estimate, scale: Scale) -> str:
    return f"{scale.points(estimate.value):z.0f} points"


def _error(estimate: Estimate, scale: Scale) -> str:
    return f"{scale.points(estimate.high - estimate.low) / 3.92:.1f}"


def _fair_scale(chart: LeagueChart) -> tuple[str, str]:
    """Return how many points double the odds, and what designs a chart for them; '' for none."""
    fair = chart.scale
    if fair is None:
        return "", ""
    points = fair.points
    error = (points.high - points.low) / 3.92
    if not scale_way(chart):
        agrees = points.low <= fair.assumed <= points.high
        if error > SURE * points.value or not agrees:
            return "", ""
        return (
            f"The chart takes {fair.assumed:.3g} points to double the odds of winning a game. The "
            f"results agree: they say {points.value:.1f}, give or take {error:.1f}."
        ), ""
    low, high = fair.games
    return (
        f"{points.value:.1f} points double the odds of winning a game in this league, give or take "
        f"{error:.1f}; the chart assumes {fair.assumed:.3g}. This makes a chart that fits:",
        f"evenbreak chart design --games {low}..{high} --least {race(fair.least)} "
        f"--scale {points.value:.1f}",
    )


def _nearest(found: PlayedChart) -> str:
    """Return which known chart the races come from."""
    others = found.matches - found.agree - sum(cell.matches for cell in found.changed)
    slips = ""
    if others > 0:
        slips = f" Other races were played in {count_of(others, 'match', 'matches')}."
    if found.same:
        return f"The races are those of the chart {found.title} ({found.name}).{slips}"
    if found.by == "race" and not any(cell.played for cell in found.changed):
        never = [race(cell.chart) for cell in found.changed if cell.chart is not None]
        return (
            f"All races are in the chart {found.title} ({found.name}); its {listed(never)} "
            f"{'was' if len(never) == 1 else 'were'} never played."
        )
    if found.by == "race":
        return f"The races are nearest to the chart {found.title} ({found.name}). {_races(found)}"
    places = count_of(len(found.changed), "place")
    return (
        f"The races are those of the chart {found.title} ({found.name}) but for {places}: "
        f"{listed(_some(found.changed))}.{slips}"
    )


def _some(changed: tuple[PlayedCell, ...]) -> list[str]:
    shown = [
        f"{race(cell.played)} instead of {race(cell.chart)} at {cell.where}"
        for cell in changed[:MOST_CHANGED]
        if cell.played is not None and cell.chart is not None
    ]
    more = len(changed) - MOST_CHANGED
    return shown + ([f"{more:,} more"] if more > 0 else [])


def _races(found: PlayedChart) -> str:
    never = [race(cell.chart) for cell in found.changed if cell.chart is not None]
    own = [
        f"{race(cell.played)} ({count_of(cell.matches, 'match', 'matches')})"
        for cell in found.changed
        if cell.played is not None
    ]
    said = [f"never plays {listed(never, 'or')}"] if never else []
    said += [f"plays {listed(own)}, which the chart does not have"] if own else []
    return f"The league {listed(said)}."


def starts_table(starts: Starts, scale: Scale) -> Table:
    """Return what starts take back, by classes apart or games given."""

    def stronger(one: Estimate) -> str:
        value, low, high = (scale.points(part) for part in one)
        return f"{value:z.0f}  {low:z.0f} to {high:z.0f}"

    columns = [
        Column("apart", "classes\napart" if starts.classes else "games\ngiven"),
        Column("matches", "matches"),
        Column("race", "most\nplayed", race),
        Column("stronger", "points stronger,\n95% interval", stronger),
        Column("taken", "taken\nback", lambda one: f"{scale.points(one):z.0f}"),
    ]
    value, low, high = starts.share
    title = (
        "By how many points the player who should give games is stronger, and how many the races "
        f"take back. Players differ by {value:.2f} times as much as races take back ({low:.2f} to "
        f"{high:.2f}):"
    )
    return Table("", columns, list(starts.groups), title)


def handicap_rows(found: Validation, chart: LeagueChart) -> Iterator[tuple[Any, ...]]:
    """Yield a row for files for each figure about starts, the scale and the chart."""
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
