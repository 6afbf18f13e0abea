"""What a validated season says, in words: a paragraph for each thing that was looked at."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import TYPE_CHECKING

from evenbreak.answers.validate_verdict import (
    ODD,
    VAGUE,
    at_the_edge,
    more_or_less,
    points_text,
    share_of,
    surely_off,
    told_of,
    wrong_chances,
)
from evenbreak.ratings.calibration import Estimate
from evenbreak.ratings.fit import PRIOR_SD
from evenbreak.ratings.results import FORMATS

if TYPE_CHECKING:
    from evenbreak.ratings.scale import Scale
    from evenbreak.ratings.validate import Validation
    from evenbreak.ratings.within_matches import Dispersion, Streaks

DOUBT = 0.05
"""A p-value below which a test is not called passed either."""


def findings(found: Validation, scale: Scale) -> Iterator[str]:
    """Yield what was found, a paragraph each."""
    yield _skill(found)
    yield _slope(found)
    yield from _matches(found)
    yield _prior(found, scale)
    yield from _usual(found, scale)
    yield _integrated(found)
    if found.dispersion is not None:
        yield _dispersion(found.dispersion, _winner_breaks(found), bool(found.spots))
    if found.streaks is not None:
        yield _streaks(found.streaks)
    yield from _advantages(found)
    if found.spots:
        yield _spots(found)


def _skill(found: Validation) -> str:
    told = told_of(found, "game", "integrated")
    new = int(found.forecasts.new.sum())
    newcomers = f" In {new:,} of the matches one of the two had not played before." if new else ""
    if found.skill.low <= 0.0:
        return (
            f"Nothing shows that the ratings know more than a coin: log-loss a game "
            f"{told.log_loss.value:.4f}, a coin 0.6931.{newcomers}"
        )
    return (
        f"The ratings know more than a coin: log-loss a game {told.log_loss.value:.4f} "
        f"({told.log_loss.low:.4f} to {told.log_loss.high:.4f}), a coin 0.6931.{newcomers}"
    )


def _slope(found: Validation) -> str:
    slope = told_of(found, "game", "integrated").slope
    if slope is None:
        return (
            "Whether chances of games are right cannot be told: there were too few favourites, or "
            "they won all."
        )
    told = f"(slope {slope.value:.2f}, {slope.low:.2f} to {slope.high:.2f}; 1 is right)"
    off = surely_off(slope, 1.0)
    if off < 0:
        return f"Chances of games are too sure of themselves: the truth is nearer to even {told}."
    if off > 0:
        return f"Chances of games are too timid: the truth is further from even {told}."
    if slope.high - slope.low > VAGUE:
        return f"Chances of games may be right, but the matches are too few to tell {told}."
    return f"Chances of games can be taken as they are told {told}."


def _prior(found: Validation, scale: Scale) -> str:
    points = f"{points_text(found.prior_sd, scale)} points on the scale {scale.name}"
    log_odds = f"{found.prior_sd:.2g} in log-odds"
    if len(found.priors) == 1:
        return f"The prior's standard deviation was given: {points}, {log_odds}."
    if found.skill.low <= 0.0:
        return (
            "Which prior to use cannot be told, since nothing shows that the ratings know "
            f"anything; the best was {points} ({log_odds})."
        )
    if at_the_edge(found.prior_sd, found):
        return (
            f"Which prior to use cannot be told: the last that was tried, {points} ({log_odds}), "
            "predicts best."
        )
    best = told_of(found, "game", "integrated")
    cost = dict(found.priors)[PRIOR_SD] - best.log_loss.value
    return (
        f"The prior to use has a standard deviation of {points} ({log_odds}): give it to "
        f"rate and report as --prior. The {points_text(PRIOR_SD, scale)} points that they use "
        f"unless told otherwise cost {cost:.4f} more log-loss a game. Had the prior been chosen as "
        f"the season went, log-loss would have been {best.as_it_went:.4f}."
    )


def _usual(found: Validation, scale: Scale) -> Iterator[str]:
    """Yield how chances are with the usual prior, and whether matches have a best one."""
    told = []
    wrong = wrong_chances(found.usual, found)
    for row in found.usual:
        if row.slope is not None and not (row.of == "match" and found.spots):
            many = "games" if row.of == "game" else "matches"
            slope = f"slope {row.slope.value:.2f}, {row.slope.low:.2f} to {row.slope.high:.2f}"
            how = wrong.get(row.of, "not surely wrong")
            told.append(f"chances of {many} are {how} ({slope})")
    if told:
        yield (
            f"As rate and report give them unless told otherwise, with a prior of "
            f"{points_text(PRIOR_SD, scale)} points, {', '.join(told)}."
        )
    if len(found.priors) > 1 and "match" in found.gain and not found.spots:
        best = told_of(found, "match", "integrated").prior_sd
        if at_the_edge(best, found):
            yield (
                "Which prior suits matches cannot be told: the last that was tried, "
                f"{points_text(best, scale)} points, predicts them best."
            )


def _integrated(found: Validation) -> str:
    # Under handicaps chances of matches are mostly noise, so games are judged by.
    of = "match" if "match" in found.gain and not found.spots else "game"
    gain = found.gain[of]
    told = f"({gain.value:+z.4f} of log-loss a {of}, {gain.low:+z.4f} to {gain.high:+z.4f})"
    if gain.low > 0.0:
        return f"Integrating the uncertainty of ratings out predicts better {told}."
    if gain.high < 0.0:
        return f"Integrating the uncertainty of ratings out predicts worse {told}."
    own = ", each with its own best prior," if len(found.priors) > 1 else ""
    return (
        f"Ratings as they stand and with their uncertainty integrated out{own} predict alike "
        f"{told}."
    )


def _matches(found: Validation) -> Iterator[str]:
    """Yield whether chances of matches are right, where there are races."""
    if "match" not in found.gain:
        return
    row = told_of(found, "match", "integrated")
    told = f"log-loss {row.log_loss.value:.4f} a match, a coin 0.6931"
    if row.slope is not None:
        told += f"; slope {row.slope.value:.2f}, {row.slope.low:.2f} to {row.slope.high:.2f}"
    useless = row.log_loss.low > math.log(2.0) or (row.slope is not None and row.slope.high < 0.5)
    if useless and found.spots:
        yield (
            f"Chances of matches are of no use here ({told}). Where a handicap makes every race "
            "even, who is told to be the favourite is the noise of the ratings."
        )
    elif row.slope is None:
        yield f"Whether chances of matches are right cannot be told ({told})."
    elif not surely_off(row.slope, 1.0):
        few = row.slope.high - row.slope.low > VAGUE
        yield f"Chances of matches {'may be right, but are few' if few else 'are right'} ({told})."
    else:
        wrong = "too sure" if row.slope.value < 1.0 else "too timid"
        # The verdict does not go by them then.
        text = (
            " Where a handicap makes races nearly even, that is no fault of the model: who is told "
            "to be the favourite is mostly the noise of the ratings."
        )
        yield f"Chances of matches are {wrong} ({told}).{text if found.spots else ''}"


def _winner_breaks(found: Validation) -> bool:
    """Return whether any race was played with winner breaks, as far as the file tells."""
    breaks = found.forecasts.results.break_format
    return breaks is not None and bool((breaks == FORMATS.index("winner")).any())


def _dispersion(test: Dispersion, winner_breaks: bool, handicaps: bool) -> str:
    told = (
        f"{test.seen:.2f} times as spread as those of known strengths, and the model, which "
        f"knows how unsure it is, says {test.by_chance:.2f} (p {_p(test.p_value)})"
    )
    if test.p_value >= DOUBT:
        return f"Nothing speaks against the spread of scores: they are {told}."
    if test.p_value >= ODD:
        more = more_or_less(test.seen > test.by_chance)
        return f"Scores may be {more} spread than the model says, which is not sure: {told}."
    if test.seen > test.by_chance:
        other = ", or the break is worth much and the winner breaks" if winner_breaks else ""
        other += ", or the handicaps know more of the players than these ratings" * handicaps
        return (
            f"Scores are more spread than the model says: {told}. Players have good and bad "
            f"days, or ratings lag behind{other}; chances of long races are then too sure."
        )
    return f"Scores are closer together than the model says: {told}."


def _streaks(test: Streaks) -> str:
    told = (
        f"{test.runs:,} runs in the racks of {test.matches:,} matches, {test.expected:,.0f} "
        f"expected in any order (p {_p(test.p_value)})"
    )
    if test.p_value >= ODD:
        return f"Racks come in no streaks: {told}."
    if test.z < 0:
        return f"Racks come in streaks: {told}. Winner breaks make such streaks too."
    return f"Racks alternate more than by chance: {told}. Alternate breaks do that."


def _advantages(found: Validation) -> Iterator[str]:
    test = found.first_breaks
    if test is not None:
        told = (
            f"{test.won:,} of {test.matches:,} matches, {test.expected:,.1f} expected "
            f"(p {_p(test.p_value)})"
        )
        if test.p_value >= ODD:
            sign = "no sure sign of an advantage"
        else:
            sign = "an advantage" if test.won > test.expected else "a disadvantage"
        yield f"Who broke first won {told}: {sign}."
    if found.breaker is not None:
        yield _advantage(found.breaker, "The break", "the breaker")
    if found.side is not None:
        text = _advantage(found.side, "Standing in the first column", "player_a")
        if surely_off(found.side, 0.0):
            text += (
                " Where that is the home player, it is the home advantage; elsewhere the order of "
                "the columns is not by chance."
            )
        yield text


def _advantage(estimate: Estimate, what: str, who: str) -> str:
    p, low, high = (1.0 / (1.0 + math.exp(-b)) for b in estimate)
    sure = ("is no sure advantage", "is an advantage", "is a disadvantage")[
        surely_off(estimate, 0.0)
    ]
    return f"{what} {sure}: {who} wins {p:.3f} of even games, {low:.3f} to {high:.3f}."


def _spots(found: Validation) -> str:
    every = found.spots[-1]
    told = (
        f"the player with the longer race won {every.won:,} of {every.matches:,} handicap "
        f"matches, {every.share:.3f} ({every.low:.3f} to {every.high:.3f}); these ratings say "
        f"{every.expected:.3f}"
    )
    off = surely_off(share_of(every), 0.5)
    if off > 0:
        return f"The chart gives too little: {told}."
    if off < 0:
        return f"The chart gives too much: {told}."
    way = surely_off(share_of(every), every.expected)
    if way:
        little = "little" if way > 0 else "much"
        return (
            f"The chart may be right, but the ratings do not know it: {told}. They think too "
            f"{little} of those who give games; do not take chances of handicap matches from them."
        )
    return f"Nothing speaks against the chart: {told}."


def _p(value: float) -> str:
    return f"{value:.2g}" if value >= 1e-4 else "below 0.0001"
