"""Whether a league can trust its ratings, in a sentence or two that say what to do."""

from collections.abc import Iterator, Mapping

from evenbreak.answers.kit.wording import listed
from evenbreak.answers.validate_judgement import (
    UNLIKELY,
    VAGUE,
    clearly_off,
    more_or_less,
    points_text,
    scored_of,
    share_of,
    starts_way,
    wrong_chances,
)
from evenbreak.handicaps.charts.fair_scale import LeagueChart
from evenbreak.ratings.calibration import Estimate
from evenbreak.ratings.fit import PRIOR_SD
from evenbreak.ratings.scale import Scale
from evenbreak.ratings.validate import Validation

TOO_SPREAD = 1.5
"""How many times as much as expected scores must vary for chances of matches to be given up."""

PLENTY = 100.0
"""Games a player, on average, from which different strengths would show."""


def verdict(found: Validation, scale: Scale, chart: LeagueChart | None = None) -> str:
    """Return whether the ratings can be trusted, and what to do."""
    slope = scored_of(found, "game").slope
    if found.skill.low <= 0.0 or slope is None:
        return _no_skill(found, slope, scale)
    faults = list(_faults(found, chart))
    wrong = wrong_chances(found.scored, found)
    if wrong:
        more = f" Also, {listed(faults)}." if faults else ""
        return _do_not(found, wrong, scale) + more
    spread = found.dispersion
    if spread is not None and spread.p_value < UNLIKELY:
        times = spread.seen / spread.by_chance
        if times > TOO_SPREAD:
            return f"{_good_and_bad_days(times)} {_corrected(found)}"
    default = _default_is_wrong(found, scale)
    if faults:
        held = f"You can trust the ratings for single games, but {listed(faults)}."
    elif slope.high - slope.low > VAGUE:
        held = "Nothing speaks against the ratings, but there are too few matches to be sure."
    else:
        held = "You can trust these ratings: players win as often as they predict."
    return f"{held} {default}" if default else held


def _no_skill(found: Validation, slope: Estimate | None, scale: Scale) -> str:
    season = found.forecasts.results
    players = {*season.player_a.tolist(), *season.player_b.tolist()}
    games_each = 2.0 * float(found.forecasts.games.sum()) / len(players)
    turned = slope is not None and clearly_off(slope, 0.0) < 0
    plenty = games_each >= PLENTY and found.skill.low <= 0.0 and not turned
    if plenty and found.choice is None:
        return (
            f"With a prior of {points_text(found.prior_sd, scale)} points the ratings predict no "
            "better than a coin; leave --prior out to find the best."
        )
    if plenty:
        return (
            "The ratings predict no better than a coin: these players are too equal for ratings to "
            "separate them."
        )
    if found.skill.high < 0.0:
        return "Do not trust these ratings: for this league they predict worse than a coin."
    return "There are too few matches to say whether these ratings can be trusted."


def _too_sure(wrong: Mapping[str, int]) -> str:
    """Return which favourites win too little or too much.

    >>> _too_sure({"game": -1, "match": -1})
    'favourites win games and matches less often than predicted'
    """
    plural = {"game": "games", "match": "matches"}
    if len(set(wrong.values())) == 1:
        often = more_or_less(next(iter(wrong.values())) > 0)
        return f"favourites win {listed([plural[of] for of in wrong])} {often} often than predicted"
    return "favourites win " + listed(
        [f"{plural[of]} {more_or_less(way > 0)} often than predicted" for of, way in wrong.items()]
    )


def _do_not(found: Validation, wrong: Mapping[str, int], scale: Scale) -> str:
    if found.choice is None:
        size = "smaller" if -1 in wrong.values() else "larger"
        return (
            f"Do not use a prior of {points_text(found.prior_sd, scale)} points: "
            f"{_too_sure(wrong)}. Use a {size} --prior, or leave the option out to find the best."
        )
    even = "even with the best prior"
    if not found.choice.learnt:
        even = "and there are too few results to choose a better prior"
    text = f"Do not take the chances at face value: {_too_sure(wrong)}, {even}."
    return f"{text} {_corrected(found)}"


def _corrected(found: Validation) -> str:
    """Return what the other commands correct where chances are off, and what they do not."""
    if found.form is None or not found.form.established:
        return "No command corrects this."
    return (
        "In the chances of matches and in fair races, report allows for good and bad days, and so "
        "do odds, fair, live and matchups with the ratings that rate writes. The chances of single "
        "games are not corrected."
    )


def _good_and_bad_days(times: float) -> str:
    return (
        f"Do not rely on the chances of whole matches: scores vary {times:.1f} times as much as "
        "expected."
    )


def _default_is_wrong(found: Validation, scale: Scale) -> str:
    """Return what the default prior would do where it is clearly wrong, '' where it is not."""
    wrong = wrong_chances(found.usual, found)
    if not wrong or found.choice is None or found.prior_sd == PRIOR_SD:
        return ""
    use, default = (points_text(sd, scale) for sd in (found.prior_sd, PRIOR_SD))
    return (
        f"All of this is for a prior of {use} points, which rate and report use too if --prior is "
        f"left out. With a prior of {default} points, {_too_sure(wrong)}."
    )


def _faults(found: Validation, chart: LeagueChart | None) -> Iterator[str]:
    """Yield what speaks against the model behind the ratings."""
    spread, runs, first = found.dispersion, found.streaks, found.first_breaks
    if spread is not None and spread.p_value < UNLIKELY:
        yield f"match scores vary {more_or_less(spread.seen > spread.by_chance)} than expected"
    if runs is not None and runs.p_value < UNLIKELY:
        yield (
            "games are won in streaks" if runs.z < 0 else "wins alternate more often than by chance"
        )
    if first is not None and first.p_value < UNLIKELY:
        more = more_or_less(first.won > first.expected)
        yield f"players who break first win {more} often than predicted"
    if found.breaker is not None and (way := clearly_off(found.breaker, 0.0)):
        yield f"the breaker has {'an advantage' if way > 0 else 'a disadvantage'}"
    if found.spots:
        share = share_of(found.spots[-1])
        if way := clearly_off(share, 0.5) or starts_way(found, chart):
            yield f"the handicaps give too {'little' if way > 0 else 'much'}"
        if way := clearly_off(share, found.spots[-1].expected):
            yield f"players who give games win {more_or_less(way > 0)} often than predicted"
