"""Payouts and the Calcutta."""

from __future__ import annotations

import math
from fractions import Fraction

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from evenbreak.errors import InputError
from evenbreak.tournaments import (
    PAYOUTS,
    PayoutRow,
    Payouts,
    calcutta,
    double_elimination,
    fair_shares,
    lot_worth,
    payout_table,
    title_odds,
)
from evenbreak.tournaments.money.payouts import PrizeMoney, shared_prize
from tiers import examples
from tournaments.fields import by_seed

FAIR = {"Ann": 0.5, "Bo": 0.3, "Cy": 0.2}


def test_tables_as_published() -> None:
    hoboken = PAYOUTS["hoboken"]
    rows = {
        (2, 9): (1.0,),
        (20, 24): (0.50, 0.25, 0.15, 0.10),
        (25, 32): (0.50, 0.20, 0.15, 0.08, 0.07),
        (33, 49): (0.40, 0.18, 0.14, 0.07, 0.06, *[0.05] * 3),
        (50, 80): (0.35, 0.15, 0.12, 0.07, 0.06, *[0.05] * 5),
    }
    for ends, shares in rows.items():
        for players in ends:
            assert hoboken.shares(players) == shares
    for row in hoboken.rows:
        assert sum(row.shares) == pytest.approx(1.0)
    with pytest.raises(InputError, match="15"):
        hoboken.shares(15)
    assert payout_table("40/30/15").amounts(16, 1000) == [400.0, 300.0, 150.0]
    assert payout_table("40/30/20/10").shares(16) == (0.4, 0.3, 0.2, 0.1)
    assert payout_table("70/30").shares(8) == (0.7, 0.3)


@pytest.mark.parametrize(
    "rows",
    [
        (),
        (PayoutRow(2, None, (0.7, 0.4)),),
        (PayoutRow(2, 10, (1.0,)), PayoutRow(8, None, (1.0,))),
        (PayoutRow(2, None, (-0.5, 1.0)),),
        (PayoutRow(2, None, ()),),
    ],
)
def test_tables_that_cannot_be_paid_are_refused(rows) -> None:
    with pytest.raises(InputError):
        Payouts("own", rows)


def test_fair_shares() -> None:
    odds = title_odds(double_elimination(8), by_seed(8))
    shares = fair_shares(odds, payout_table("40/30/20/10").shares(8))
    assert sum(shares.values()) == pytest.approx(1.0)
    assert max(shares, key=shares.__getitem__) == "1"


def test_break_even_bids_win_back_what_they_cost() -> None:
    """Whatever the order, if all that follow go for what they are worth, nobody loses."""
    for order in (["Cy", "Bo", "Ann"], ["Ann", "Cy", "Bo"]):
        sold = {order[0]: 42.0}
        for player in order[1:]:
            sold[player] = next(
                lot.break_even for lot in calcutta(FAIR, sold) if lot.player == player
            )
        pot = sum(sold.values())
        for player in order[1:]:
            assert sold[player] == pytest.approx(FAIR[player] * pot)


def test_the_house_takes_its_part() -> None:
    (lot,) = calcutta(FAIR, {"Bo": 30.0, "Cy": 20.0}, paid_out=0.9)
    assert lot.break_even == pytest.approx(0.9 * 0.5 * (50.0 + lot.break_even))
    assert lot.fair_share == 0.5


def test_before_the_first_lot_nobody_knows() -> None:
    assert [lot.break_even for lot in calcutta(FAIR)] == [None, None, None]


def test_what_a_lot_is_worth_at_a_bid() -> None:
    sold = {"Cy": 30.0}
    lots = {lot.player: lot for lot in calcutta(FAIR, sold)}
    even = lots["Bo"].break_even
    assert lot_worth(FAIR, sold, "Bo", even) == pytest.approx(even)
    assert lot_worth(FAIR, sold, "Bo", even + 20) < even + 20
    assert lot_worth(FAIR, sold, "Bo", even - 20) > even - 20


@pytest.mark.parametrize(
    ("asked", "named"),
    [
        (lambda: calcutta({"Ann": 0.5}), "sum to 0.5"),
        (lambda: calcutta(FAIR, {"Ed": 5}), "Ed"),
        (lambda: calcutta(FAIR, {"Ann": -5}), "Ann"),
        (lambda: lot_worth(FAIR, {"Ann": 5}, "Ann", 5), "Ann"),
        (lambda: payout_table("none"), "none"),
    ],
)
def test_what_cannot_be_sold_is_refused(asked, named: str) -> None:
    with pytest.raises(InputError, match=named):
        asked()


MONEY = st.decimals(0, 10_000, places=2).map(float)


@settings(max_examples=examples(200))
@given(
    st.integers(1, 120),
    MONEY,
    MONEY,
    st.integers(0, 99),
    st.lists(st.integers(1, 100), min_size=1, max_size=8).filter(lambda one: sum(one) <= 100),
    st.sampled_from([0.0, 0.25, 1.0, 5.0, 10.0]),
    st.data(),
)
def test_prizes_are_exact_and_never_more_than_the_pot(
    entrants: int,
    fee: float,
    added: float,
    house: int,
    percents: list[int],
    unit: float,
    data: st.DataObject,
) -> None:
    """In hundredths, by whole numbers: an oracle without a rounding error."""
    payers = data.draw(st.integers(0, entrants))
    money = PrizeMoney(fee, added, house / 100, "/".join(map(str, percents)), unit)
    amounts = money.amounts(entrants, payers)
    exact = Fraction(round(fee * 100) * payers + round(added * 100)) * (100 - house) / 100
    step = max(1, round(unit * 100))
    cents = [round(one * 100) for one in amounts]
    assert all(one % step == 0 for one in cents)
    assert [abs(c / 100 - a) for c, a in zip(cents, amounts, strict=True)] == [0.0] * len(cents)
    assert sum(cents) <= exact * sum(percents) / 100 <= exact
    for one, percent in list(zip(cents, percents, strict=True))[1:]:
        assert one == math.floor(math.floor(exact) * percent / 100) // step * step
    left = round(money.left(entrants, payers) * 100)
    assert 0 <= left < step
    assert sum(cents) + left == math.floor(math.floor(exact) * sum(percents) / 100)
    assert cents == sorted(cents, reverse=True) or percents != sorted(percents, reverse=True)
    first = data.draw(st.integers(1, 9))
    last = data.draw(st.integers(first, 9))
    each = round(shared_prize(amounts, first, last, unit) * 100)
    assert each % step == 0
    assert each * (last - first + 1) <= sum(cents[first - 1 : last])
