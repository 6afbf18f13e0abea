from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from evenbreak.errors import AccuracyError, InputError
from evenbreak.games import (
    BREAK_FORMATS,
    Ahead,
    Race,
    Rack,
    alternate_breaks,
    player_1_breaks,
    winner_breaks,
)
from evenbreak.matches import match_length, match_odds


def test_an_even_race_two_two() -> None:
    length = match_length(Race(2, 2, Rack(0.5)))
    assert length.games.tolist() == [2, 3]
    assert length.probability.tolist() == [0.5, 0.5]
    assert (length.mean, length.sd, length.p_never_ends, length.tail_mass) == (2.5, 0.5, 0.0, 0.0)
    assert length.bounded
    assert length.span == 3


def test_a_quantile_at_a_tie_is_the_smaller_length() -> None:
    assert match_length(Race(2, 2, Rack(0.5))).quantile(0.5) == 2
    # P(three racks) = .1^3 + .9^3 = .73, which floats miss: a level of .73 is reached there.
    assert match_length(Race(3, 3, Rack(0.1))).quantile(0.73) == 3
    assert match_length(Race(3, 3, Rack(0.1))).quantile(0.73 + 1e-9) == 4
    assert match_length(Race(3, 3, Rack(0.1))).quantile(1.0) == 5
    assert match_length(Race(3, 3, Rack(0.1))).quantile(0.0) == 3
    assert match_length(Race(3, 3, Rack(1.0))).quantile(1.0) == 3


@given(
    p1=st.floats(0.01, 0.99),
    p2=st.floats(0.01, 0.99),
    m=st.integers(1, 8),
    n=st.integers(1, 8),
    breaks=st.sampled_from(list(BREAK_FORMATS.values())),
    q=st.floats(0.0, 1.0),
)
def test_a_quantile_is_the_first_length_that_is_enough(
    p1: float, p2: float, m: int, n: int, breaks: Any, q: float
) -> None:
    length = match_length(Race(m, n, Rack(p1, p2), breaks=breaks))
    k = length.quantile(q)
    up_to = length.probability[length.games <= k].sum()
    before = length.probability[length.games < k].sum()
    assert up_to >= q - 1e-12
    assert before < q or k == min(m, n)


@given(p=st.floats(0.0, 1.0), lead=st.integers(1, 8))
def test_the_duration_of_an_n_ahead_match(p: float, lead: int) -> None:
    # Wald: the mean lead at the end is the mean length times the mean lead per rack.
    length = match_length(Ahead(lead, lead, Rack(p)), tail=1e-3)
    odds = match_odds(Ahead(lead, lead, Rack(p)))
    assert length.mean * (2 * p - 1) == pytest.approx(
        lead * (odds.p_win_1 - odds.p_win_2), rel=1e-12, abs=1e-12
    )
    assert length.mean >= lead * (1 - 1e-15)
    assert length.tail_mass <= 1e-3


def test_a_match_without_a_longest_length_says_what_it_leaves_out() -> None:
    # Two ahead of equals: each pair of racks ends the match with chance 1/2.
    length = match_length(Ahead(2, 2, Rack(0.5)), tail=0.01)
    assert length.games.tolist() == list(range(2, 15))
    assert length.probability[::2].tolist() == [0.5**k for k in range(1, 8)]
    assert not length.probability[1::2].any()
    assert length.tail_mass == 0.5**7
    assert length.mean == pytest.approx(4.0, rel=1e-15)
    assert length.sd == pytest.approx(8.0**0.5, rel=1e-15)
    assert not length.bounded
    assert length.quantile(0.75) == 4
    assert length.quantile(1.0) is None
    with pytest.raises(AccuracyError, match=r"the 0.995 quantile lies beyond 14 racks"):
        length.quantile(0.995)


def test_mean_and_spread_do_not_lose_digits_where_the_match_is_nearly_certain() -> None:
    q = 1e-12
    length = match_length(Ahead(5, 5, Rack(1.0 - 1e-12)))
    assert length.mean == pytest.approx(5 / (1 - 2 * q), rel=1e-14)
    assert length.sd == pytest.approx((4 * q * (1 - q) * 5 / (1 - 2 * q) ** 3) ** 0.5, rel=1e-10)


def test_a_match_that_may_never_end() -> None:
    length = match_length(Ahead(2, 2, Rack(1.0, 1.0), breaks=alternate_breaks))
    assert length.mean is None
    assert length.sd is None
    assert length.p_never_ends == 1.0
    assert length.quantile(0.5) is None
    sometimes = match_length(Ahead(2, 2, Rack(1.0, [1.0, 0.5]), breaks=alternate_breaks))
    assert sometimes.p_never_ends.tolist() == [1.0, 0.0]
    assert np.isnan(sometimes.mean[0])
    assert np.isnan(sometimes.sd[0])
    assert sometimes.mean[1] == pytest.approx(4.0)
    assert np.isnan(sometimes.quantile(0.5)[0])
    assert sometimes.quantile(0.5)[1] == 2


def test_a_set_that_never_ends_is_a_match_that_never_ends() -> None:
    endless = Ahead(2, 2, Rack(1.0, [1.0, 0.5]), breaks=alternate_breaks)
    length = match_length(Race(2, 2, endless, breaks=player_1_breaks))
    assert length.p_never_ends.tolist() == [1.0, 0.0]
    assert length.mean[1] == pytest.approx(8.0)


def test_arrays() -> None:
    p1, p2 = np.array([0.2, 0.5, 0.9]), np.array([[0.4], [0.7]])
    for match_of in (
        lambda rack: Race(4, 3, rack, breaks=winner_breaks),
        lambda rack: Race(4, 3, rack, breaks=player_1_breaks, win_by=2),
        lambda rack: Ahead(2, 3, rack, breaks=alternate_breaks),
        lambda rack: Race(2, 2, Race(2, 3, rack, breaks=alternate_breaks)),
    ):
        lengths = match_length(match_of(Rack(p1, p2)))
        assert lengths.probability.shape == (2, 3, len(lengths.games))
        for at in np.ndindex(2, 3):
            one = match_length(match_of(Rack(float(p1[at[1]]), float(p2[at[0], 0]))))
            shared = min(one.games.size, lengths.games.size)
            assert lengths.probability[at][:shared] == pytest.approx(
                one.probability[:shared], rel=1e-12, abs=0
            )
            assert lengths.mean[at] == pytest.approx(one.mean, rel=1e-13)
            assert lengths.sd[at] == pytest.approx(one.sd, rel=1e-13)
            assert lengths.quantile(0.9)[at] == one.quantile(0.9)
            assert lengths.tail_mass[at] <= 1e-12


def test_a_score_mid_match_and_a_decided_match() -> None:
    race = Race(7, 5, Rack(0.6), score=(1, 0))
    assert match_length(race, (6, 4)).probability.tolist() == [1.0]
    assert match_length(race, (6, 4)).games.tolist() == [1]
    over = match_length(race, (7, 4))
    assert (over.games.tolist(), over.probability.tolist(), over.mean) == ([0], [1.0], 0.0)
    over = match_length(Ahead(2, 2, Rack([0.5, 0.6])), (2, 0))
    assert over.probability.tolist() == [[1.0], [1.0]]
    assert over.bounded


def test_only_a_match_without_a_longest_length_is_cut_off(monkeypatch: Any) -> None:
    monkeypatch.setattr("evenbreak.matches.endings._LONGEST", 5)
    sets = match_length(Race(2, 2, Race(3, 3, Rack(0.5))))
    assert sets.span == 15
    assert sets.probability.sum() == pytest.approx(1.0, rel=1e-14)
    ahead = match_length(Ahead(2, 2, Rack(0.5)))
    assert (ahead.span, ahead.tail_mass) == (5, 0.25)
    assert ahead.mean == pytest.approx(4.0, rel=1e-14)


def test_a_set_that_is_over_is_no_set() -> None:
    with pytest.raises(InputError, match="a set that is over at its start score"):
        Race(2, 2, Race(3, 2, Rack(0.5), score=(3, 1)))


def test_wrong_options_are_refused() -> None:
    with pytest.raises(InputError, match="tail is 2, not a probability"):
        match_length(Race(2, 2, Rack(0.5)), tail=2)
    with pytest.raises(InputError, match=r"q is \[0.5, 0.9\]; give one number"):
        match_length(Race(2, 2, Rack(0.5))).quantile([0.5, 0.9])  # type: ignore[arg-type]
    with pytest.raises(InputError, match=r"q is 1\.5, not a probability"):
        match_length(Race(2, 2, Rack(0.5))).quantile(1.5)
