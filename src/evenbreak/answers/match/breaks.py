"""What each break format is worth to two players in the long run."""

import math
from collections.abc import Sequence
from typing import Any

from evenbreak.answers.kit.answer import Answer
from evenbreak.answers.kit.by_way import by_way
from evenbreak.answers.kit.columns import columns_of
from evenbreak.answers.kit.parts import Table
from evenbreak.answers.kit.wording import count_of, listed, percent
from evenbreak.chains.ways import Way
from evenbreak.games.rack import Rack
from evenbreak.practice.breaks import BreakFormatValue, compare_break_formats

USUAL = ("winner", "loser", "alternate")

SAME = 1e-12
"""Two shares that differ by less are the same but for rounding."""


def breaks_answer(
    rack: Rack[float],
    *,
    win: float = 1.0,
    lose: float = 1.0,
    first_breaker: int = 1,
    via: Way | None = None,
) -> Answer:
    """Return the break formats, the best for player 1 first; player 1 is A.

    Parameters
    ----------
    rack
        the chances with the break.
    win, lose, first_breaker, via
        as for `compare_break_formats`.

    >>> from evenbreak.games import Rack
    >>> print(breaks_answer(Rack(0.9, 0.5), lose=2).sentences[0])
    A does best with winner breaks, winning 83% of the racks; B does best with loser breaks, ...
    At these stakes A comes out ahead with winner and alternate breaks and behind with loser breaks.
    Over 100 racks with winner breaks, A comes out 50 points ahead on average, give or take 17.
    """
    stakes: dict[str, Any] = {"win": win, "lose": lose, "first_breaker": first_breaker}
    values = compare_break_formats(rack, via=via, **stakes)
    kernel = {value.name: value.share for value in compare_break_formats(rack, **stakes)}
    usual = [value for value in values if value.name in USUAL]
    columns = columns_of(
        "breaks share_a points_per_rack sd_points fair_win first_break_racks memory"
    )
    return Answer(
        f"The breaker wins a rack with probability {rack.p1:g} (A) or "
        f"{rack.chance(2, breaker=2):g} (B)\nA wins {win:g} for each rack won and pays {lose:g} "
        "for each rack lost",
        [
            f"{_who_gains(usual)}\n{_in_a_session(usual[0])}",
            Table("formats", columns, [_row(value, lose) for value in values]),
            "'Even if a win pays': what A should get for a rack won to make the stakes fair. "
            "'First break': how many more racks A wins in a long session by breaking first.",
            *by_way(via, ((value.share, kernel[value.name]) for value in values)),
        ],
        [
            "'Spread of points': multiply it by the square root of N for the standard deviation of "
            "A's points over N racks. 'Left after a rack': how much of the first break's effect is "
            "left one rack later (the second eigenvalue of the chain of breakers); below 0, the "
            "advantage changes sides."
        ],
    )


def _row(value: BreakFormatValue, lose: float) -> tuple[Any, ...]:
    fair_win = value.fair_ratio * lose
    head_start = value.name in USUAL and math.isfinite(value.first_break)
    return (
        {"player 1": "a", "player 2": "b"}.get(value.name, value.name),
        value.share,
        value.points,
        value.sd_points,
        fair_win if math.isfinite(fair_win) else None,
        value.first_break if head_start else None,
        value.memory,
    )


def _who_gains(usual: Sequence[BreakFormatValue]) -> str:
    """Return which of the usual formats suits whom, and where the stakes turn."""
    for value in usual:
        if math.isinf(value.first_break):
            return f"With {value.name} breaks, the player who breaks first breaks every rack."
    best, worst = usual[0], usual[-1]
    if best.share - worst.share < SAME:
        return "Winner, loser and alternate breaks are worth the same to both."
    text = (
        f"A does best with {best.name} breaks, winning {percent(best.share)} of the racks; B does "
        f"best with {worst.name} breaks, winning {percent(1.0 - worst.share)}."
    )
    gains = [value.name for value in usual if value.points > SAME]
    losses = [value.name for value in usual if value.points < -SAME]
    if gains and losses:
        text += (
            f"\nAt these stakes A comes out ahead with {listed(gains)} breaks "
            f"and behind with {listed(losses)} breaks."
        )
    return text


def _in_a_session(best: BreakFormatValue) -> str:
    points = round(100 * best.points)
    ahead = f"{count_of(abs(points), 'point')} {'ahead' if points > 0 else 'behind'}"
    return (
        f"Over 100 racks with {best.name} breaks, A comes out {ahead if points else 'even'} on "
        f"average, give or take {10 * best.sd_points:,.0f}."
    )
