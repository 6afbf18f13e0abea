"""A match of straight pool: who wins it, how long it takes, and the spot that makes it even."""

from evenbreak.answers.kit.answer import Answer
from evenbreak.answers.kit.columns import quantities_of
from evenbreak.answers.kit.parts import Quantities
from evenbreak.answers.kit.wording import count_of, percent
from evenbreak.matches.straight_pool import (
    Spot,
    StraightPool,
    StraightPoolOdds,
    even_spot,
    straight_pool_odds,
)


def straight_answer(match: StraightPool, averages: tuple[float, float] | None = None) -> Answer:
    """Return the chances of a match of straight pool, its length and its spot; player 1 is A.

    Parameters
    ----------
    match
        the match, with the same `safety_1` and `safety_2`.
    averages
        the balls an inning that the two make on average, if their chances come from these.

    >>> from evenbreak.matches import StraightPool
    >>> print(straight_answer(StraightPool(100, 100, 0.9, 0.85)).sentences[0])
    A wins the match 89% of the time. The winner needs 11.8 innings on average.
    For an even match, B should play to 60 points: A then wins 50% of the time.
    """
    odds, spot = straight_pool_odds(match), even_spot(match)
    even_a = even_b = None
    if spot.points is not None:
        even_a, even_b = match.points_1, match.points_2
        even_a, even_b = (spot.points, even_b) if spot.weaker == 1 else (even_a, spot.points)
    return Answer(
        _heading(match, averages),
        [
            _in_words(match, odds, spot),
            Quantities(
                quantities_of(
                    {
                        "p_make_a": float(match.p1),
                        "p_make_b": float(match.p2),
                        "safety": float(match.safety_1),
                        "points_a": match.points_1,
                        "points_b": match.points_2,
                        "p_win_a": odds.p_win_1,
                        "p_win_b": odds.p_win_2,
                        "-p_never_ends": odds.p_never_ends,
                        "mean_innings": odds.mean_innings,
                        "sd_innings": odds.sd_innings,
                        "innings_p50": odds.innings_p50,
                        "innings_p90": odds.innings_p90,
                        "even_points_a": even_a,
                        "even_points_b": even_b,
                        "p_win_a_even": spot.p_win_1,
                    },
                    a="A",
                    b="B",
                )
            ),
        ],
    )


def _heading(match: StraightPool, averages: tuple[float, float] | None) -> str:
    if averages is not None:
        text = f"A averages {averages[0]:g} balls an inning, B {averages[1]:g}"
    else:
        text = f"A makes a shot with probability {match.p1:g}, B with {match.p2:g}"
    text += f"; {' AB'[match.first]} shoots first\n"
    if match.safety_1 != 1:
        text += (
            f"The first shot of an inning goes in {match.safety_1:g} times as often as the others\n"
        )
    return text + f"A plays to {match.points_1} points, B to {match.points_2}"


def _in_words(match: StraightPool, odds: StraightPoolOdds, spot: Spot) -> str:
    if odds.mean_innings is None:
        return "Neither player ever makes a ball, so the match never ends."
    name, p = ("A", odds.p_win_1) if odds.p_win_1 >= odds.p_win_2 else ("B", odds.p_win_2)
    text = (
        f"{name} wins the match {percent(p)} of the time. "
        f"The winner needs {odds.mean_innings:.1f} innings on average.\n"
    )
    if spot.points is None or spot.p_win_1 is None:
        return f"{text}No spot makes this match even."
    if spot.points == (match.points_1, match.points_2)[spot.weaker - 1]:
        return f"{text}No other spot brings it nearer to even."
    return (
        f"{text}For an even match, {' AB'[spot.weaker]} should play to "
        f"{count_of(spot.points, 'point')}: A then wins {percent(spot.p_win_1)} of the time."
    )
