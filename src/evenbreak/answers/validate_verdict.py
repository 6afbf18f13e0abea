"""Whether the model holds for a league, in a sentence or two that begin with what to do."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from evenbreak.ratings.calibration import Estimate
from evenbreak.ratings.fit import PRIOR_SD

if TYPE_CHECKING:
    from evenbreak.ratings.handicap_fairness import HandicapFairness
    from evenbreak.ratings.scale import Scale
    from evenbreak.ratings.scored import Scored
    from evenbreak.ratings.validate import Validation

ODD = 0.01
"""A p-value below which chance is not blamed; several tests are looked at at once."""

VAGUE = 0.5
"""An interval of the slope that is wider says too little."""

FAR_SPREAD = 1.5
"""How many times as spread as the model says scores must be for it to be given up."""

PLENTY = 100.0
"""Games of a player, on average, from which strengths that differ would show."""


def verdict(found: Validation, scale: Scale) -> str:
    """Return in a sentence or two what to do, and whether the model holds for the league."""
    slope = told_of(found, "game", "integrated").slope
    if found.skill.low <= 0.0 or slope is None:
        return _no_skill(found, slope)
    missed = list(_missed(found))
    wrong = wrong_chances(found.scored, found)
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
    turned = slope is not None and surely_off(slope, 0.0) < 0
    if games_each >= PLENTY and found.skill.low <= 0.0 and not turned:
        return "The ratings know no more than a coin: these players are too alike."
    if found.skill.high < 0.0:
        return "The ratings predict worse than a coin: do not trust them for this league."
    return "There are too few matches to tell whether the model holds for this league."


def _players(found: Validation) -> set[int]:
    season = found.forecasts.results
    return {*season.player_a.tolist(), *season.player_b.tolist()}


def wrong_chances(scored: tuple[Scored, ...], found: Validation) -> dict[str, str]:
    """Return of which predictions chances are surely off, and how."""
    # A handicap that works leaves matches no favourites, whatever the ratings say.
    judged = ("game",) if found.spots else ("game", "match")
    off = {
        row.of: surely_off(row.slope, 1.0)
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
            f"Do not use a prior of {points_text(found.prior_sd, scale)} points: "
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
    best = told_of(found, "match", "integrated")
    use = ""
    if len(found.priors) > 1 and not found.spots and not at_the_edge(best.prior_sd, found):
        use = f" For chances of matches use --prior {points_text(best.prior_sd, scale)}."
    return (
        f"Do not take chances of matches as they are told: scores are {times:.1f} times as "
        "spread as the model says. Players have good and bad days, or ratings lag behind: "
        f"favourites win fewer long races than they are told to.{use}"
    )


def _lead(found: Validation, scale: Scale) -> str:
    """Return which prior to use where the one that is used unless another is given is wrong."""
    wrong = wrong_chances(found.usual, found)
    if not wrong:
        return ""
    usual = (
        f"the {points_text(PRIOR_SD, scale)} points that they use unless told otherwise, "
        f"{_chances(wrong)}"
    )
    if at_the_edge(found.prior_sd, found):
        size = "smaller" if "too sure" in wrong.values() else "larger"
        return f"Give rate and report a {size} --prior: with {usual}. Apart from that, "
    return (
        f"Give rate and report --prior {points_text(found.prior_sd, scale)}: with {usual}. "
        "With that prior "
    )


def _missed(found: Validation) -> Iterator[str]:
    """Yield what speaks against the model, each test with p < `ODD`."""
    spread, runs, first = found.dispersion, found.streaks, found.first_breaks
    if spread is not None and spread.p_value < ODD:
        more = more_or_less(spread.seen > spread.by_chance)
        yield f"scores are {more} spread than the model says"
    if runs is not None and runs.p_value < ODD:
        yield "racks come in streaks" if runs.z < 0 else "racks alternate more than by chance"
    if first is not None and first.p_value < ODD:
        more = more_or_less(first.won > first.expected)
        yield f"who breaks first wins {more} than the model says"
    if found.breaker is not None and (way := surely_off(found.breaker, 0.0)):
        yield f"the break is {'an advantage' if way > 0 else 'a disadvantage'}"
    if found.side is not None and (way := surely_off(found.side, 0.0)):
        yield f"the player in the first column wins {more_or_less(way > 0)} than the model says"
    if found.spots:
        share = share_of(found.spots[-1])
        if way := surely_off(share, 0.5):
            yield f"the chart gives too {'little' if way > 0 else 'much'}"
        if way := surely_off(share, found.spots[-1].expected):
            yield f"longer races win {more_or_less(way > 0)} than the ratings say"


def more_or_less(yes: bool) -> str:
    """Return 'more' or 'less'."""
    return "more" if yes else "less"


def points_text(prior_sd: float, scale: Scale) -> str:
    """Return a prior's standard deviation in points."""
    return f"{prior_sd * scale.points_per_log_odds:.3g}"


def at_the_edge(prior_sd: float, found: Validation) -> bool:
    """Return whether a prior is the first or the last of those that were tried."""
    return prior_sd in (found.priors[0][0], found.priors[-1][0])


def told_of(found: Validation, of: str, how: str) -> Scored:
    """Return how good one kind of prediction was."""
    return next(row for row in found.scored if (row.of, row.how) == (of, how))


def surely_off(estimate: Estimate, right: float) -> int:
    """Return 1 or -1 where an estimate is surely above or below what is right, p < `ODD`."""
    # The interval is of 95 %, that is 1.96 standard errors each way; 2.58 leave out 1 %.
    far = (estimate.high - estimate.low) / 2.0 * 2.576 / 1.960
    middle = (estimate.high + estimate.low) / 2.0
    return int(middle - far > right) - int(middle + far < right)


def share_of(spot: HandicapFairness) -> Estimate:
    """Return the part of handicap races that the longer race won."""
    return Estimate(spot.share, spot.low, spot.high)
