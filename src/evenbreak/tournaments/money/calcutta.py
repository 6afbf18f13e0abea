"""The Calcutta: players are auctioned, and the pot is paid to the buyers of the best.

A lot's fair share of the pot is the sum over places of payout times P(place). A bid's value depends
on the whole pot, which no one knows before the last lot: the money bid so far, this bid, and what
the upcoming lots will bring. If these go for their fair shares f of the final pot R, and B has been
bid so far,

    R = B + b + R (sum of f still to come),

so a bid b on a lot of fair share s breaks even where b = s R, that is at

    b = s B / (1 - s - sum of f still to come).
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from evenbreak.checks import number
from evenbreak.errors import InputError
from evenbreak.tournaments.odds.title import PlaceOdds


@dataclass(frozen=True)
class Lot:
    """A lot in the auction.

    Parameters
    ----------
    fair_share
        the expected share of the pot.
    break_even
        the bid at which it wins back its cost, on average; None if nothing has been sold yet,
        because no one knows then what the lots will bring.
    """

    player: str
    fair_share: float
    break_even: float | None


def fair_shares(odds: PlaceOdds, shares: Sequence[float]) -> dict[str, float]:
    """Return each player's fair share of a pot that is paid out by place.

    Parameters
    ----------
    shares
        the share of the pot for first place, second, ...

    >>> import numpy as np
    >>> from evenbreak.tournaments import single_elimination, title_odds
    >>> odds = title_odds(single_elimination(["Ann", "Bo"]), np.array([[0.5, 0.75], [0.25, 0.5]]))
    >>> {player: round(share, 3) for player, share in fair_shares(odds, [0.7, 0.3]).items()}
    {'Ann': 0.6, 'Bo': 0.4}
    """
    values = odds.expected_prize(shares)
    return dict(zip(odds.bracket.players, values.tolist(), strict=True))


def calcutta(
    fair: Mapping[str, float],
    sold: Mapping[str, float] | None = None,
    *,
    paid_out: float = 1.0,
) -> list[Lot]:
    """Return the current value of the lots still to be sold.

    Each is valued as if it came next and the others then went for their fair shares of the pot.

    Parameters
    ----------
    fair
        each player's fair share of the payout; they sum to 1.
    paid_out
        the share of the pot that is paid out; the rest goes to the house.

    Raises
    ------
    InputError
        if a share or a bid cannot be used, or an unknown player was sold.

    >>> lots = calcutta({"Ann": 0.5, "Bo": 0.3, "Cy": 0.2}, {"Cy": 30})
    >>> [(lot.player, round(lot.break_even, 2)) for lot in lots]
    [('Ann', 75.0), ('Bo', 45.0)]
    """
    auction = _Auction.of(fair, sold, paid_out)
    pot = auction.pot()
    return [
        Lot(player, fair[player], None if pot is None else share * pot)
        for player, share in auction.to_come.items()
    ]


def lot_worth(
    fair: Mapping[str, float],
    sold: Mapping[str, float],
    player: str,
    bid: float,
    *,
    paid_out: float = 1.0,
) -> float:
    """Return a lot's expected winnings if it goes for a bid.

    Half of a lot is worth half as much and costs half the bid: a player who may buy half of
    themselves should do so if this is more than the bid.

    Parameters
    ----------
    fair, sold, paid_out
        as in `calcutta`.
    player, bid
        the lot, and the price it would go for.

    >>> round(lot_worth({"Ann": 0.5, "Bo": 0.3, "Cy": 0.2}, {"Cy": 30}, "Bo", 60), 2)
    54.0
    """
    auction = _Auction.of(fair, sold, paid_out)
    if player not in auction.to_come:
        raise InputError(
            "player must be one who hasn't been sold; you gave {player!r}", player=player
        )
    share = auction.to_come[player]
    others = sum(auction.to_come.values()) - share
    if others >= 1.0:
        raise InputError("sold must not be empty. Give the bids so far.")
    return share * (auction.bids + number(bid, "bid", low=0.0)) / (1.0 - others)


@dataclass(frozen=True)
class _Auction:
    """The money bid so far, and each upcoming lot's share of the pot."""

    bids: float
    to_come: dict[str, float]

    @classmethod
    def of(
        cls, fair: Mapping[str, float], sold: Mapping[str, float] | None, paid_out: float
    ) -> _Auction:
        """Return the auction's current state, after checking it."""
        bids = dict(sold or {})
        part = number(paid_out, "paid_out", above=0.0, high=1.0)
        shares = {name: number(s, f"fair share of {name}", low=0.0) for name, s in fair.items()}
        if abs(sum(shares.values()) - 1.0) > 1e-6:
            total = sum(shares.values())
            raise InputError("fair shares must sum to 1; they sum to {total:g}", total=total)
        for name in bids:
            if name not in shares:
                raise InputError("{sold} has {name!r}, who isn't among the players", name=name)
        total = sum(number(bid, f"bid for {name}", low=0.0) for name, bid in bids.items())
        return cls(total, {name: part * s for name, s in shares.items() if name not in bids})

    def pot(self) -> float | None:
        """Return the whole pot if all upcoming lots go for their fair shares."""
        left = 1.0 - sum(self.to_come.values())
        return self.bids / left if self.bids and left > 0.0 else None
