"""Leverages are the differences of the odds with and without a result."""

from __future__ import annotations

import numpy as np
import pytest

from evenbreak.errors import InputError
from evenbreak.tournaments import (
    consolation,
    double_elimination,
    groups_then_knockout,
    leverages,
    round_robin,
    title_odds,
)
from tournaments.fields import by_seed

PAYOUTS = [50, 25, 15, 10]


@pytest.mark.parametrize(
    "bracket",
    [double_elimination(7), groups_then_knockout(8, 2), round_robin(5), consolation(6)],
    ids=lambda bracket: bracket.format,
)
@pytest.mark.parametrize("payouts", [None, PAYOUTS])
def test_differences(bracket, payouts) -> None:
    win = by_seed(len(bracket.players))

    def value(results=None) -> np.ndarray:
        odds = title_odds(bracket, win, results=results)
        return odds.title if payouts is None else odds.expected_prize(PAYOUTS)

    now = value()
    for lever in leverages(bracket, win, payouts=payouts):
        assert lever.now == pytest.approx(now)
        if lever.players is None:
            continue
        one, other = (value({lever.match: bracket.players[player]}) for player in lever.players)
        assert lever.if_first == pytest.approx(one, abs=1e-11)
        assert lever.if_second == pytest.approx(other, abs=1e-11)
        p = lever.p_first
        swing = p * np.abs(one - now) + (1 - p) * np.abs(other - now)
        assert lever.swing == pytest.approx(swing, abs=1e-11)


def test_swing_of_matches_whose_players_are_not_known() -> None:
    """The mean, over the pairs that can meet, of what the result then changes."""
    bracket, win = double_elimination(5), by_seed(5)
    lever = next(x for x in leverages(bracket, win) if x.match == "F")
    assert lever.players is None
    # Given who is in the final, its result moves each of the two by p (1 - p) times two.
    final = title_odds(bracket, win).meetings["F"]
    want = np.zeros(5)
    for one, other, meet, p in zip(*final, strict=True):
        again = win[one, other]
        loss = again  # what slot 1's player still has after losing the first final
        want[[one, other]] += meet * 2 * p * (1 - p) * (1 - loss)
    assert lever.swing == pytest.approx(want)


def test_after_results_only_what_is_open_is_listed() -> None:
    bracket = double_elimination(4)
    results = {"W1.1": "1", "W1.2": "2", "W2.1": "1"}
    found = leverages(bracket, by_seed(4), results=results)
    assert [lever.match for lever in found] == ["L1.1", "L2.1", "F", "F2"]
    with pytest.raises(InputError, match="F"):
        leverages(bracket, by_seed(4), results={"F": "1"})


def test_too_large() -> None:
    with pytest.raises(InputError, match="too large"):
        leverages(double_elimination(32), by_seed(32))
