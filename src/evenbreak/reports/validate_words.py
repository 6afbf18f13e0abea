"""What a validated season says, in words: whether the model holds, and what it misses."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import TYPE_CHECKING

from evenbreak.ratings.calibration import Estimate
from evenbreak.ratings.fit import PRIOR_SD
from evenbreak.ratings.results import FORMATS

if TYPE_CHECKING:
    from evenbreak.ratings.scale import Scale
    from evenbreak.ratings.spots import SpotFairness
    from evenbreak.ratings.validate import Scored, Validation
    from evenbreak.ratings.within_matches import Dispersion, Streaks

__all__ = ["findings", "verdict"]

ODD = 0.01
"""A p-value below which chance is not blamed; several tests are looked at at once."""

VAGUE = 0.5
"""An interval of the slope that is wider says too little."""

FAR = 0.25
"""How far from 1 a slope must surely be for the model to be given up."""


def verdict(found: Validation) -> str:
    """Return in one sentence whether the model holds for the league."""
    slope = _row(found, "game", "integrated").slope
    if found.skill.high < 0.0:
        return "The ratings predict worse than a coin: do not trust them for this league."
    if found.skill.low <= 0.0 or slope is None:
        return "There are too few matches to tell whether the model holds for this league."
    if slope.high < 1.0 - FAR or slope.low > 1.0 + FAR:
        return "The model does not hold for this league: its chances are far off."
    if misses(found):
        return "The model holds on the whole; what it misses is told below."
    if slope.high - slope.low > VAGUE:
        return "Nothing speaks against the model, but the matches are few."
    return "The model holds for this league."


def misses(found: Validation) -> bool:
    """Return whether anything speaks against the model, each test with p < `ODD`."""
    tests = [found.dispersion, found.streaks, found.first_breaks]
    odd = any(test is not None and test.p_value < ODD for test in tests)
    # A handicap that works leaves matches no favourites, whatever the ratings say.
    judged = ["game"] if found.spots else ["game", "match"]
    slopes = [row.slope for row in found.scored if row.how == "integrated" and row.of in judged]
    sloped = any(slope is not None and _off(slope, 1.0) != 0 for slope in slopes)
    tilted = bool(found.spots) and _off(_share(found.spots[-1]), 0.5) != 0
    advantages = (found.side, found.breaker)
    ahead = any(one is not None and _off(one, 0.0) != 0 for one in advantages)
    return odd or sloped or tilted or ahead


def findings(found: Validation, scale: Scale) -> Iterator[str]:
    """Yield what was found, a paragraph each."""
    yield _skill(found)
    yield _slope(found)
    yield from _matches(found)
    yield _prior(found, scale)
    yield _integrated(found)
    if found.dispersion is not None:
        yield _dispersion(found.dispersion, _winner_breaks(found), bool(found.spots))
    if found.streaks is not None:
        yield _streaks(found.streaks)
    yield from _advantages(found)
    if found.spots:
        yield _spots(found)


def _skill(found: Validation) -> str:
    told = _row(found, "game", "integrated")
    new = int(found.forecasts.new.sum())
    newcomers = f" In {new:,} of the matches one of the two had not played before." if new else ""
    if found.skill.low <= 0.0:
        return (
            f"Whether the ratings know more than a coin cannot be told: log-loss a game "
            f"{told.log_loss.value:.4f}, a coin 0.6931.{newcomers}"
        )
    return (
        f"The ratings know more than a coin: log-loss a game {told.log_loss.value:.4f} "
        f"({told.log_loss.low:.4f} to {told.log_loss.high:.4f}), a coin 0.6931.{newcomers}"
    )


def _slope(found: Validation) -> str:
    slope = _row(found, "game", "integrated").slope
    if slope is None:
        return (
            "Whether chances are right cannot be told: there were no favourites, or they won all."
        )
    told = f"(slope {slope.value:.2f}, {slope.low:.2f} to {slope.high:.2f}; 1 is right)"
    off = _off(slope, 1.0)
    if off < 0:
        return f"Chances of games are too sure of themselves: the truth is nearer to even {told}."
    if off > 0:
        return f"Chances of games are too timid: the truth is further from even {told}."
    if slope.high - slope.low > VAGUE:
        return f"Chances of games may be right, but the matches are too few to tell {told}."
    return f"Chances of games can be taken as they are told {told}."


def _prior(found: Validation, scale: Scale) -> str:
    points = f"{found.prior_sd * scale.points_per_log_odds:.3g} points on the scale {scale.name}"
    log_odds = f"{found.prior_sd:.2g} in log-odds"
    if len(found.priors) == 1:
        return f"The prior's standard deviation was given: {points}, {log_odds}."
    if found.prior_sd in (found.priors[0][0], found.priors[-1][0]):
        return (
            f"Which prior to use cannot be told: the last that was tried, {points} ({log_odds}), "
            "predicts best."
        )
    best = _row(found, "game", "integrated")
    usual = PRIOR_SD * scale.points_per_log_odds
    cost = dict(found.priors)[PRIOR_SD] - best.log_loss.value
    return (
        f"The prior to use has a standard deviation of {points} ({log_odds}): give it to "
        f"evenbreak rate as --prior. The {usual:.3g} points that are used unless another is "
        f"given cost {cost:.4f} more log-loss a game. Had the prior been chosen as the season "
        f"went, log-loss would have been {best.as_it_went:.4f}."
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
    row = _row(found, "match", "integrated")
    told = f"log-loss {row.log_loss.value:.4f} a match, a coin 0.6931"
    if row.slope is not None:
        told += f"; slope {row.slope.value:.2f}, {row.slope.low:.2f} to {row.slope.high:.2f}"
    if row.log_loss.low > math.log(2.0) or (row.slope is not None and row.slope.high < 0.5):
        yield (
            f"Chances of matches are of no use here ({told}). Where a handicap makes every race "
            "even, who is told to be the favourite is the noise of the ratings."
        )
    elif row.slope is None:
        yield f"Whether chances of matches are right cannot be told ({told})."
    elif not _off(row.slope, 1.0):
        few = row.slope.high - row.slope.low > VAGUE
        yield f"Chances of matches {'may be right, but are few' if few else 'are right'} ({told})."
    else:
        wrong = "too sure" if row.slope.value < 1.0 else "too timid"
        yield f"Chances of matches are {wrong} ({told})."


def _winner_breaks(found: Validation) -> bool:
    """Return whether any race was played with winner breaks, as far as the file tells."""
    breaks = found.forecasts.results.break_format
    return breaks is not None and bool((breaks == FORMATS.index("winner")).any())


def _dispersion(test: Dispersion, winner_breaks: bool, handicaps: bool) -> str:
    told = (
        f"{test.seen:.2f} times as spread as those of known strengths, and the model, which "
        f"knows how unsure it is, says {test.by_chance:.2f} (p {_p(test.p_value)})"
    )
    if test.p_value >= ODD:
        return f"Scores are spread as the model says: {told}."
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
        if _off(found.side, 0.0):
            text += (
                " Where that is the home player, it is the home advantage; elsewhere the order of "
                "the columns is not by chance."
            )
        yield text


def _advantage(estimate: Estimate, what: str, who: str) -> str:
    p, low, high = (1.0 / (1.0 + math.exp(-b)) for b in estimate)
    sure = ("is no sure advantage", "is an advantage", "is a disadvantage")[_off(estimate, 0.0)]
    return f"{what} {sure}: {who} wins {p:.3f} of even games, {low:.3f} to {high:.3f}."


def _spots(found: Validation) -> str:
    every = found.spots[-1]
    told = (
        f"the player with the longer race won {every.won:,} of {every.matches:,} handicap "
        f"matches, {every.share:.3f} ({every.low:.3f} to {every.high:.3f}); these ratings say "
        f"{every.expected:.3f}"
    )
    off = _off(_share(every), 0.5)
    if off > 0:
        return f"The chart gives too little: {told}."
    if off < 0:
        return f"The chart gives too much: {told}."
    return f"Nothing speaks against the chart: {told}."


def _row(found: Validation, of: str, how: str) -> Scored:
    return next(row for row in found.scored if (row.of, row.how) == (of, how))


def _off(estimate: Estimate, right: float) -> int:
    """Return 1 or -1 where an estimate is surely above or below what is right, p < `ODD`."""
    # The interval is of 95 %, that is 1.96 standard errors each way; 2.58 leave out 1 %.
    far = (estimate.high - estimate.low) / 2.0 * 2.576 / 1.960
    middle = (estimate.high + estimate.low) / 2.0
    return int(middle - far > right) - int(middle + far < right)


def _share(spot: SpotFairness) -> Estimate:
    return Estimate(spot.share, spot.low, spot.high)


def _p(value: float) -> str:
    return f"{value:.2g}" if value >= 1e-4 else "below 0.0001"
