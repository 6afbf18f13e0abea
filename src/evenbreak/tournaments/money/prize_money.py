"""The prize money of a tournament: what comes in, what the house keeps, how it is paid out."""

from __future__ import annotations

import re
from dataclasses import dataclass, replace

from evenbreak.checks import number
from evenbreak.errors import InputError
from evenbreak.tournaments.money.payouts import PAYOUTS, Payouts, payout_table

_PERCENTS = re.compile(r"[0-9]{1,3}(\.[0-9]+)?(/[0-9]{1,3}(\.[0-9]+)?)*", re.ASCII)


@dataclass(frozen=True)
class PrizeMoney:
    """The prize money of a tournament.

    Parameters
    ----------
    fee
        what each player pays to enter.
    added
        money added to the pot.
    house
        the part of the pot, from 0 to .99, that the house keeps.
    payout
        the name of a payout table, or what the places get in per cent, such as 50/30/20; '' for
        70/30 if fewer than 8 players enter, else 40/30/20/10.

    Raises
    ------
    InputError
        if a parameter has a value that it cannot have.

    >>> money = PrizeMoney(fee=20.0, added=100.0, payout="50/30/20")
    >>> money.pot(8), money.amounts(8)
    (260.0, [130.0, 78.0, 52.0])
    """

    fee: float = 0.0
    added: float = 0.0
    house: float = 0.0
    payout: str = ""

    def __post_init__(self) -> None:
        number(self.fee, "fee", low=0.0)
        number(self.added, "added", low=0.0)
        number(self.house, "house", low=0.0, high=0.99)
        self.payouts(8)

    def pot(self, entrants: int) -> float:
        """Return what is paid out, if the payout table pays all of it."""
        return (self.fee * entrants + self.added) * (1.0 - self.house)

    def payouts(self, entrants: int) -> Payouts:
        """Return the shares of the places."""
        return _payouts(self.payout or ("70/30" if entrants < 8 else "40/30/20/10"))

    def amounts(self, entrants: int) -> list[float]:
        """Return the money for first place, second, ..."""
        return self.payouts(entrants).amounts(entrants, self.pot(entrants))


def _payouts(text: str) -> Payouts:
    if text in PAYOUTS:
        return PAYOUTS[text]
    percents = [float(one) for one in text.split("/")] if _PERCENTS.fullmatch(text) else []
    if not any(percents):
        raise InputError(
            "there is no payout table {text!r}; choose one of {tables}, or percentages such "
            "as 50/30/20",
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
