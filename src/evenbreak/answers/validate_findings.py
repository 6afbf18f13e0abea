"""The statistics of a validated season, a paragraph for each question that was asked."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import TYPE_CHECKING

from evenbreak.answers.validate_judgement import (
    UNLIKELY,
    VAGUE,
    at_the_edge,
    clearly_off,
    more_or_less,
    points_text,
    scored_of,
    winner_breaks,
    wrong_chances,
)
from evenbreak.answers.wording import count_of, listed
from evenbreak.ratings.fit import PRIOR_SD

if TYPE_CHECKING:
    from evenbreak.ratings.calibration import Estimate
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
    yield from _default(found, scale)
    yield _integrated(found)
    if found.dispersion is not None:
        yield _dispersion(found.dispersion)
    if found.streaks is not None:
        yield _streaks(found.streaks)
    yield from _advantages(found)


def _skill(found: Validation) -> str:
    loss = scored_of(found, "game").log_loss
    new = int(found.forecasts.new.sum())
    newcomers = (
        f" In {count_of(new, 'match', 'matches')} one of the two had not played before."
        if new
        else ""
    )
    if found.skill.low <= 0.0:
        return (
            f"Nothing shows that the ratings beat a coin: log-loss {loss.value:.4f} a game, a coin "
            f"0.6931.{newcomers}"
        )
    return (
        f"The ratings beat a coin: log-loss {loss.value:.4f} ({loss.low:.4f} to {loss.high:.4f}) a "
        f"game, a coin 0.6931.{newcomers}"
    )


def _slope(found: Validation) -> str:
    slope = scored_of(found, "game").slope
    if slope is None:
        return (
            "There is no telling whether the chances of games are right: there were too few "
            "favourites, or they won everything."
        )
    figures = f"(slope {_slope_text(slope)}; 1 is right)"
    off = clearly_off(slope, 1.0)
    if off < 0:
        return f"Chances of games are too extreme: the truth is closer to even {figures}."
    if off > 0:
        return f"Chances of games are too cautious: the truth is further from even {figures}."
    if slope.high - slope.low > VAGUE:
        return f"Chances of games may be right, but there are too few matches to tell {figures}."
    return f"Chances of games mean what they say {figures}."


def _matches(found: Validation) -> Iterator[str]:
    """Yield whether chances of matches are right, where there are races."""
    if "match" not in found.gain:
        return
    row = scored_of(found, "match")
    figures = f"log-loss {row.log_loss.value:.4f} a match, a coin 0.6931"
    if row.slope is not None:
        figures += f"; slope {_slope_text(row.slope)}"
    useless = row.log_loss.low > math.log(2.0) or (row.slope is not None and row.slope.high < 0.5)
    if useless and found.spots:
        yield (
            f"Chances of matches are of no use here ({figures}). Where handicaps make every match "
            "nearly even, the ratings' favourite is picked by their noise."
        )
    elif row.slope is None:
        yield f"There is no telling whether the chances of matches are right ({figures})."
    elif not clearly_off(row.slope, 1.0):
        few = row.slope.high - row.slope.low > VAGUE
        right = "may be right, but there are few matches" if few else "are right"
        yield f"Chances of matches {right} ({figures})."
    else:
        wrong = "too extreme" if row.slope.value < 1.0 else "too cautious"
        # The verdict does not go by them then.
        text = (
            " Where handicaps make matches nearly even, that is not a fault of the model: the "
            "ratings' favourite is mostly picked by their noise."
        )
        yield f"Chances of matches are {wrong} ({figures}).{text if found.spots else ''}"


def _prior(found: Validation, scale: Scale) -> str:
    points = f"{points_text(found.prior_sd, scale)} points on the {scale.name} scale"
    log_odds = f"{found.prior_sd:.2g} in log-odds"
    if len(found.priors) == 1:
        return f"The prior was given: a standard deviation of {points}, {log_odds}."
    if found.skill.low <= 0.0:
        return (
            "There is no telling which prior to use, since nothing shows that the ratings know "
            f"anything; the best was {points} ({log_odds})."
        )
    if at_the_edge(found.prior_sd, found):
        return (
            f"There is no telling which prior to use: the last that was tried, {points} "
            f"({log_odds}), predicts best."
        )
    best = scored_of(found, "game")
    cost = dict(found.priors)[PRIOR_SD] - best.log_loss.value
    return (
        f"The best prior has a standard deviation of {points} ({log_odds}). The default of "
        f"{points_text(PRIOR_SD, scale)} points costs {cost:.4f} more log-loss a game. With the "
        f"prior chosen anew before each date, log-loss would have been {best.as_it_went:.4f}."
    )


def _default(found: Validation, scale: Scale) -> Iterator[str]:
    """Yield how chances are with the default prior, and whether matches have a best one."""
    wrong = wrong_chances(found.usual, found)
    how = {-1: "too extreme", 1: "too cautious", 0: "not clearly wrong"}
    judged = [
        f"chances of {'games' if row.of == 'game' else 'matches'} are {how[wrong.get(row.of, 0)]} "
        f"(slope {_slope_text(row.slope)})"
        for row in found.usual
        if row.slope is not None and not (row.of == "match" and found.spots)
    ]
    if judged:
        yield f"With the default prior of {points_text(PRIOR_SD, scale)} points {listed(judged)}."
    if len(found.priors) > 1 and "match" in found.gain and not found.spots:
        best = scored_of(found, "match").prior_sd
        if at_the_edge(best, found):
            yield (
                "There is no telling which prior suits matches: the last that was tried, "
                f"{points_text(best, scale)} points, predicts them best."
            )


def _integrated(found: Validation) -> str:
    # Under handicaps chances of matches are mostly noise, so games are used.
    of = "match" if "match" in found.gain and not found.spots else "game"
    gain = found.gain[of]
    figures = f"({gain.value:+z.4f} of log-loss a {of}, {gain.low:+z.4f} to {gain.high:+z.4f})"
    if gain.low > 0.0:
        return f"Averaging over the uncertainty of the ratings predicts better {figures}."
    if gain.high < 0.0:
        return f"Averaging over the uncertainty of the ratings predicts worse {figures}."
    own = ", each with its own best prior" if len(found.priors) > 1 else ""
    return (
        f"Ratings at face value predict as well as averaging over their uncertainty{own} {figures}."
    )


def _dispersion(test: Dispersion) -> str:
    figures = (
        f"their squared errors are {test.seen:.2f} times those of known strengths, and with the "
        f"uncertainty of the ratings {test.by_chance:.2f} times is expected ({_p(test.p_value)})"
    )
    if test.p_value >= DOUBT:
        return f"Scores vary as much as expected: {figures}."
    more = more_or_less(test.seen > test.by_chance)
    if test.p_value >= UNLIKELY:
        return f"Scores may vary {more} than expected, but that is not certain: {figures}."
    return f"Scores vary {more} than expected: {figures}."


def spread_words(found: Validation) -> str:
    """Return why scores vary more than they should, '' where they do not."""
    test = found.dispersion
    if test is None or test.p_value >= UNLIKELY or test.seen <= test.by_chance:
        return ""
    percent = 100.0 * (test.seen / test.by_chance - 1.0)
    others = []
    if winner_breaks(found):
        others.append("a strong break under winner breaks")
    if found.spots:
        others.append("handicaps that know more about the players than these ratings")
    also = listed(others, "or")
    return (
        f"Match scores vary {percent:.0f} % more than expected, so favourites win fewer long races "
        "than predicted. Players have good and bad days, or the ratings lag behind."
        + (f" {also[0].upper()}{also[1:]} would have the same effect." if also else "")
    )


def _streaks(test: Streaks) -> str:
    figures = (
        f"{test.runs:,} runs in the racks of {count_of(test.matches, 'match', 'matches')}, "
        f"{test.expected:,.0f} expected in random order ({_p(test.p_value)})"
    )
    if test.p_value >= UNLIKELY:
        return f"Racks do not come in streaks: {figures}."
    if test.z < 0:
        return f"Racks come in streaks: {figures}. Winner breaks cause such streaks too."
    return f"Wins alternate more than by chance: {figures}. Alternate breaks cause that."


def _advantages(found: Validation) -> Iterator[str]:
    test = found.first_breaks
    if test is not None:
        sign = "no clear advantage"
        if test.p_value < UNLIKELY:
            sign = "an advantage" if test.won > test.expected else "a disadvantage"
        yield (
            f"Players who broke first won {test.won:,} of "
            f"{count_of(test.matches, 'match', 'matches')}, {test.expected:,.1f} expected "
            f"({_p(test.p_value)}): {sign}."
        )
    if found.breaker is not None:
        yield _advantage(found.breaker, "The break", "the breaker")
    if found.side is not None:
        text = _advantage(found.side, "Being in the first column", "player_a")
        if clearly_off(found.side, 0.0):
            text += (
                " If player_a is the home player, that is home advantage; otherwise the order of "
                "the columns is not random."
            )
        yield text


def _advantage(estimate: Estimate, what: str, who: str) -> str:
    p, low, high = (1.0 / (1.0 + math.exp(-b)) for b in estimate)
    sign = ("no clear advantage", "an advantage", "a disadvantage")[clearly_off(estimate, 0.0)]
    return (
        f"{what} is {sign}: {who} wins {p:.3f} ({low:.3f} to {high:.3f}) of games between equal "
        "players."
    )


def _slope_text(slope: Estimate) -> str:
    return f"{slope.value:.2f}, {slope.low:.2f} to {slope.high:.2f}"


def _p(value: float) -> str:
    return f"p {value:.2g}" if value >= 1e-4 else "p below 0.0001"
