"""Payouts: each place's share of the prize money, by number of entrants."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np

from evenbreak.checks import number, whole
from evenbreak.errors import InputError
from evenbreak.words import joined, say


class PayoutRow(NamedTuple):
    """The shares of the places for a range of entrants.

    Parameters
    ----------
    entrants_from, entrants_to
        None for no upper limit.
    shares
        the share of the prize money for first place, second, ...; they sum to at most 1, and any
        remainder goes to the house.
    """

    entrants_from: int
    entrants_to: int | None
    shares: tuple[float, ...]


@dataclass(frozen=True)
class Payouts:
    """A payout table.

    Parameters
    ----------
    rows
        the rows, by ascending number of entrants.

    Raises
    ------
    InputError
        if rows overlap, or shares are negative or sum to more than 1.

    >>> two = Payouts("70/30", (PayoutRow(2, None, (0.7, 0.3)),))
    >>> two.amounts(12, 240)
    [168.0, 72.0]
    """

    name: str
    rows: tuple[PayoutRow, ...]
    source: str = ""

    def __post_init__(self) -> None:
        rows = tuple(PayoutRow(first, last, tuple(shares)) for first, last, shares in self.rows)
        object.__setattr__(self, "rows", rows)
        if not rows:
            raise InputError("rows is empty. Give shares for each number of entrants.")
        before = 0
        for row in rows:
            first = whole(row.entrants_from, "entrants_from", at_least=1)
            last = float("inf") if row.entrants_to is None else row.entrants_to
            if first <= before or last < first:
                raise InputError("row {row} overlaps another, or ends before it starts", row=row)
            before = int(min(last, 10**9))
            total = sum(number(share, "share", low=0.0) for share in row.shares)
            if not row.shares or total > 1.0 + 1e-9:
                raise InputError(
                    "shares must be one or more numbers that add up to at most 1; they are "
                    "{shares}",
                    shares=row.shares,
                )

    def shares(self, entrants: int) -> tuple[float, ...]:
        """Return the places' shares for a number of entrants.

        Raises
        ------
        InputError
            if the table has no row for it.
        """
        count = whole(entrants, "entrants", at_least=1)
        for row in self.rows:
            if row.entrants_from <= count and (row.entrants_to is None or count <= row.entrants_to):
                return row.shares
        spans = [
            say("{n} or more", n=row.entrants_from)
            if row.entrants_to is None
            else f"{row.entrants_from}-{row.entrants_to}"
            for row in self.rows
        ]
        raise InputError(
            "{payouts} is for {spans} entrants, not {entrants}. Enter your own shares.",
            payouts=self.name,
            spans=joined(spans, ", "),
            entrants=count,
        )

    def amounts(self, entrants: int, pot: float) -> list[float]:
        """Return the money for first place, second, ..."""
        money = number(pot, "pot", low=0.0)
        return [share * money for share in self.shares(entrants)]


PAYOUTS: dict[str, Payouts] = {
    "hoboken": Payouts(
        "hoboken",
        (
            PayoutRow(2, 9, (1.0,)),
            PayoutRow(20, 24, (0.50, 0.25, 0.15, 0.10)),
            PayoutRow(25, 32, (0.50, 0.20, 0.15, 0.08, 0.07)),
            PayoutRow(33, 49, (0.40, 0.18, 0.14, 0.07, 0.06, 0.05, 0.05, 0.05)),
            PayoutRow(50, 80, (0.35, 0.15, 0.12, 0.07, 0.06, 0.05, 0.05, 0.05, 0.05, 0.05)),
        ),
        "chip tournaments at a club in Hoboken, as published",
    ),
    "40/30/20/10": Payouts(
        "40/30/20/10", (PayoutRow(4, None, (0.4, 0.3, 0.2, 0.1)),), "a common split"
    ),
    "40/30/15": Payouts(
        "40/30/15",
        (PayoutRow(3, None, (0.4, 0.3, 0.15)),),
        "a common split, with the rest going to the house",
    ),
    "70/30": Payouts("70/30", (PayoutRow(2, None, (0.7, 0.3)),), "a common split"),
}
"""The payout tables that come with the package, by name."""


def payout_table(name_or_shares: str | Sequence[float] | Payouts) -> Payouts:
    """Return a table by name, or a table that always pays the same shares.

    Raises
    ------
    InputError
        if no table has this name, or the shares are invalid.

    >>> payout_table("40/30/20/10").shares(16)
    (0.4, 0.3, 0.2, 0.1)
    >>> payout_table([0.6, 0.4]).amounts(8, 100)
    [60.0, 40.0]
    """
    if isinstance(name_or_shares, Payouts):
        return name_or_shares
    if isinstance(name_or_shares, str):
        if name_or_shares not in PAYOUTS:
            listed = ", ".join(PAYOUTS)
            raise InputError(
                "there's no payout table {name!r}. Choose one of {tables}, or give shares.",
                name=name_or_shares,
                tables=listed,
            )
        return PAYOUTS[name_or_shares]
    shares = tuple(float(share) for share in np.asarray(name_or_shares, dtype=float).ravel())
    return Payouts("own shares", (PayoutRow(1, None, shares),))


# The prize money of a tournament: what comes in, what the house keeps, how it is paid out.


_PERCENTS = re.compile(r"[0-9]{1,3}(\.[0-9]+)?(/[0-9]{1,3}(\.[0-9]+)?)*", re.ASCII)


@dataclass(frozen=True)
class PrizeMoney:
    """A tournament's prize money.

    Parameters
    ----------
    fee
        each player's entry fee.
    house
        the share of the pot, from 0 to .99, that the house keeps.
    payout
        the name of a payout table, or the places' percentages, such as 50/30/20; '' for 70/30 with
        fewer than 8 players, else 40/30/20/10.
    unit
        prizes are whole multiples of this, such as 5; 0: exact to the hundredth.

    Raises
    ------
    InputError
        if a parameter has an invalid value.

    >>> money = PrizeMoney(fee=20.0, added=100.0, payout="50/30/20", unit=5.0)
    >>> money.pot(8), money.amounts(8), money.left(8)
    (260.0, [135.0, 75.0, 50.0], 0.0)
    """

    fee: float = 0.0
    added: float = 0.0
    house: float = 0.0
    payout: str = ""
    unit: float = 0.0

    def __post_init__(self) -> None:
        number(self.fee, "fee", low=0.0)
        number(self.added, "added", low=0.0)
        number(self.house, "house", low=0.0, high=0.99)
        number(self.unit, "unit", low=0.0)
        self.payouts(8)

    def pot(self, entrants: int) -> float:
        """Return how much is paid out, if the payout table pays all of it."""
        return (self.fee * entrants + self.added) * (1.0 - self.house)

    def payouts(self, entrants: int) -> Payouts:
        """Return the places' shares."""
        return _payouts(self.payout or ("70/30" if entrants < 8 else "40/30/20/10"))

    def amounts(self, entrants: int, payers: int | None = None) -> list[float]:
        """Return the money for first place, second, ...

        Each is rounded down to the hundredth or to a multiple of `unit`; what is left over goes to
        first place, in whole units. They never sum to more than the pot.

        Parameters
        ----------
        entrants
            how many entrants there are, which decides how many places are paid.
        payers
            how many have paid the fee; None: all entrants.
        """
        pot = _hundredths(self.pot(entrants if payers is None else payers))
        step = max(1, round(self.unit * 100))
        shares = self.payouts(entrants).shares(entrants)
        paid = [_hundredths(share * pot / 100.0) // step * step for share in shares]
        paid[0] += (self._for_places(pot, shares) - sum(paid)) // step * step
        return [one / 100.0 for one in paid]

    def left(self, entrants: int, payers: int | None = None) -> float:
        """Return what is left over after rounding the places' money."""
        pot = _hundredths(self.pot(entrants if payers is None else payers))
        money = self._for_places(pot, self.payouts(entrants).shares(entrants))
        return (money - _hundredths(sum(self.amounts(entrants, payers)))) / 100.0

    @staticmethod
    def _for_places(pot: int, shares: Sequence[float]) -> int:
        """Return how much the places get in all, in hundredths."""
        return min(pot, _hundredths(sum(shares) * pot / 100.0))


def _hundredths(money: float) -> int:
    """Return an amount in whole hundredths, rounded down, but correcting floating-point error."""
    return int(money * 100.0 + 1e-6)


def shared_prize(amounts: Sequence[float], first: int, last: int, unit: float = 0.0) -> float:
    """Return what each player gets if several share the places `first` to `last`.

    >>> shared_prize([50.0, 30.0, 15.0, 10.0], 3, 4, 5.0), shared_prize([50.0], 5, 6)
    (10.0, 0.0)
    """
    step = max(1, round(unit * 100))
    shared = sum(_hundredths(one) for one in amounts[first - 1 : last])
    return shared // (last - first + 1) // step * step / 100.0


def with_prizes(
    places: Sequence[tuple[str, str]], prizes: Sequence[float], unit: float = 0.0
) -> list[tuple[str, str, float]]:
    """Return places, such as 5-6, with their pay in multiples of `unit`; tied players split it.

    >>> with_prizes([("1", "Ann"), ("2-3", "Bo"), ("2-3", "Cy")], [100.0, 60.0, 30.0])
    [('1', 'Ann', 100.0), ('2-3', 'Bo', 45.0), ('2-3', 'Cy', 45.0)]
    """
    found = []
    for place, name in places:
        ends = [int(part) for part in re.findall(r"\d+", place)] if place[:1].isdigit() else []
        paid = shared_prize(prizes, ends[0], ends[-1], unit) if ends else 0.0
        found.append((place, name, paid))
    return found


def _payouts(text: str) -> Payouts:
    if text in PAYOUTS:
        return PAYOUTS[text]
    percents = [float(one) for one in text.split("/")] if _PERCENTS.fullmatch(text) else []
    if not any(percents):
        raise InputError(
            "there's no payout table {text!r}. Choose one of {tables}, or percentages "
            "such as 50/30/20.",
            text=text,
            tables=", ".join(PAYOUTS),
        )
    if sum(percents) > 100.0 + 1e-6:
        raise InputError(
            "the payout {text!r} adds up to {total:g}%; it must be at most 100%",
            text=text,
            total=sum(percents),
        )
    return replace(payout_table([one / 100.0 for one in percents]), name=text)
