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

FAR_SPREAD = 1.5
"""How many times as spread as the model says scores must be for it to be given up."""

PLENTY = 100.0
"""Games of a player, on average, from which strengths that differ would show."""

DOUBT = 0.05
"""A p-value below which a test is not called passed either."""


def verdict(found: Validation, scale: Scale) -> str:
    """Return in a sentence or two what to do, and whether the model holds for the league."""
    slope = _row(found, "game", "integrated").slope
    if found.skill.low <= 0.0 or slope is None:
        return _no_skill(found, slope)
    missed = list(_missed(found))
    wrong = _wrong(found.scored, found)
    if wrong:
        more = f" Beside that, {'; '.join(missed)}." if missed else ""
        return _do_not(found, wrong, scale) + more
    spread = found.dispersion
    if spread is not None and spread.p_value < ODD:
        times = spread.seen / spread.by_chance
        if times > FAR_SPREAD:
            return _bad_days(found, times, scale)
    if missed:
        held = f"the model holds on the whole, but {'; '.join(missed)}."
    elif slope.high - slope.low > VAGUE:
        held = "nothing speaks against the model, but the matches are few."
    else:
        held = "the model holds for this league."
    lead = _lead(found, scale)
    return f"{lead}{held}" if lead else held[0].upper() + held[1:]


def _no_skill(found: Validation, slope: Estimate | None) -> str:
    games_each = 2.0 * float(found.forecasts.games.sum()) / len(_players(found))
    turned = slope is not None and _off(slope, 0.0) < 0
    if games_each >= PLENTY and found.skill.low <= 0.0 and not turned:
        return "The ratings know no more than a coin: these players are too alike."
    if found.skill.high < 0.0:
        return "The ratings predict worse than a coin: do not trust them for this league."
    return "There are too few matches to tell whether the model holds for this league."


def _players(found: Validation) -> set[int]:
    season = found.forecasts.results
    return {*season.player_a.tolist(), *season.player_b.tolist()}


def _wrong(scored: tuple[Scored, ...], found: Validation) -> dict[str, str]:
    """Return of which predictions chances are surely off, and how."""
    # A handicap that works leaves matches no favourites, whatever the ratings say.
    judged = ("game",) if found.spots else ("game", "match")
    off = {
        row.of: _off(row.slope, 1.0)
        for row in scored
        if row.how == "integrated" and row.of in judged and row.slope is not None
    }
    return {of: "too sure" if way < 0 else "too timid" for of, way in off.items() if way}


def _chances(wrong: dict[str, str]) -> str:
    """Return which chances are off in words.

    >>> _chances({"game": "too sure", "match": "too sure"})
    'chances of games and of matches are too sure'
    """
    plural = {"game": "games", "match": "matches"}
    if len(set(wrong.values())) == 1:
        of = " and of ".join(plural[name] for name in wrong)
        return f"chances of {of} are {next(iter(wrong.values()))}"
    return " and ".join(f"chances of {plural[name]} are {how}" for name, how in wrong.items())


def _do_not(found: Validation, wrong: dict[str, str], scale: Scale) -> str:
    if len(found.priors) == 1:
        size = "smaller" if "too sure" in wrong.values() else "larger"
        return (
            f"Do not use a prior of {_points(found.prior_sd, scale)} points: "
            f"{_chances(wrong)}. Use a {size} --prior; leave it out here to find the best."
        )
    fade = ""
    if "too sure" in wrong.values() and found.forecasts.half_life is None:
        fade = " Let old games fade: try --half-life 365."
    return (
        f"Do not take chances as they are told: {_chances(wrong)}, even with the prior that "
        f"suits them best.{fade}"
    )


def _bad_days(found: Validation, times: float, scale: Scale) -> str:
    best = _row(found, "match", "integrated")
    use = ""
    if len(found.priors) > 1 and not found.spots and not _edge(best.prior_sd, found):
        use = f" For chances of matches use --prior {_points(best.prior_sd, scale)}."
    return (
        f"Do not take chances of matches as they are told: scores are {times:.1f} times as "
        "spread as the model says. Players have good and bad days, or ratings lag behind: "
        f"favourites win fewer long races than they are told to.{use}"
    )


def _lead(found: Validation, scale: Scale) -> str:
    """Return which prior to use where the one that is used unless another is given is wrong."""
    wrong = _wrong(found.usual, found)
    if not wrong:
        return ""
    usual = (
        f"the {_points(PRIOR_SD, scale)} points that they use unless told otherwise, "
        f"{_chances(wrong)}"
    )
    if _edge(found.prior_sd, found):
        size = "smaller" if "too sure" in wrong.values() else "larger"
        return f"Give rate and report a {size} --prior: with {usual}. Apart from that, "
    return (
        f"Give rate and report --prior {_points(found.prior_sd, scale)}: with {usual}. "
        "With that prior "
    )


def _missed(found: Validation) -> Iterator[str]:
    """Yield what speaks against the model, each test with p < `ODD`."""
    spread, runs, first = found.dispersion, found.streaks, found.first_breaks
    if spread is not None and spread.p_value < ODD:
        yield f"scores are {_more(spread.seen > spread.by_chance)} spread than the model says"
    if runs is not None and runs.p_value < ODD:
        yield "racks come in streaks" if runs.z < 0 else "racks alternate more than by chance"
    if first is not None and first.p_value < ODD:
        yield f"who breaks first wins {_more(first.won > first.expected)} than the model says"
    if found.breaker is not None and (way := _off(found.breaker, 0.0)):
        yield f"the break is {'an advantage' if way > 0 else 'a disadvantage'}"
    if found.side is not None and (way := _off(found.side, 0.0)):
        yield f"the player in the first column wins {_more(way > 0)} than the model says"
    if found.spots:
        share = _share(found.spots[-1])
        if way := _off(share, 0.5):
            yield f"the chart gives too {'little' if way > 0 else 'much'}"
        if way := _off(share, found.spots[-1].expected):
            yield f"longer races win {_more(way > 0)} than the ratings say"


def _more(yes: bool) -> str:
    return "more" if yes else "less"


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
    told = _row(found, "game", "integrated")
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
    slope = _row(found, "game", "integrated").slope
    if slope is None:
        return (
            "Whether chances of games are right cannot be told: there were too few favourites, or "
            "they won all."
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


def _points(prior_sd: float, scale: Scale) -> str:
    return f"{prior_sd * scale.points_per_log_odds:.3g}"


def _edge(prior_sd: float, found: Validation) -> bool:
    """Return whether a prior is the first or the last of those that were tried."""
    return prior_sd in (found.priors[0][0], found.priors[-1][0])


def _prior(found: Validation, scale: Scale) -> str:
    points = f"{_points(found.prior_sd, scale)} points on the scale {scale.name}"
    log_odds = f"{found.prior_sd:.2g} in log-odds"
    if len(found.priors) == 1:
        return f"The prior's standard deviation was given: {points}, {log_odds}."
    if _edge(found.prior_sd, found):
        return (
            f"Which prior to use cannot be told: the last that was tried, {points} ({log_odds}), "
            "predicts best."
        )
    best = _row(found, "game", "integrated")
    cost = dict(found.priors)[PRIOR_SD] - best.log_loss.value
    return (
        f"The prior to use has a standard deviation of {points} ({log_odds}): give it to "
        f"rate and report as --prior. The {_points(PRIOR_SD, scale)} points that they use unless "
        f"told otherwise cost {cost:.4f} more log-loss a game. Had the prior been chosen as the "
        f"season went, log-loss would have been {best.as_it_went:.4f}."
    )


def _usual(found: Validation, scale: Scale) -> Iterator[str]:
    """Yield how chances are with the usual prior, and whether matches have a best one."""
    told = []
    wrong = _wrong(found.usual, found)
    for row in found.usual:
        if row.slope is not None and not (row.of == "match" and found.spots):
            many = "games" if row.of == "game" else "matches"
            slope = f"slope {row.slope.value:.2f}, {row.slope.low:.2f} to {row.slope.high:.2f}"
            how = wrong.get(row.of, "not surely wrong")
            told.append(f"chances of {many} are {how} ({slope})")
    if told:
        yield (
            f"As rate and report give them unless told otherwise, with a prior of "
            f"{_points(PRIOR_SD, scale)} points, {', '.join(told)}."
        )
    if len(found.priors) > 1 and "match" in found.gain and not found.spots:
        best = _row(found, "match", "integrated").prior_sd
        if _edge(best, found):
            yield (
                "Which prior suits matches cannot be told: the last that was tried, "
                f"{_points(best, scale)} points, predicts them best."
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
    useless = row.log_loss.low > math.log(2.0) or (row.slope is not None and row.slope.high < 0.5)
    if useless and found.spots:
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
    if test.p_value >= DOUBT:
        return f"Nothing speaks against the spread of scores: they are {told}."
    if test.p_value >= ODD:
        more = _more(test.seen > test.by_chance)
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
    way = _off(_share(every), every.expected)
    if way:
        little = "little" if way > 0 else "much"
        return (
            f"The chart may be right, but the ratings do not know it: {told}. They think too "
            f"{little} of those who give games; do not take chances of handicap matches from them."
        )
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
