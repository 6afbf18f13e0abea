"""A tournament's money: each place's prize, and each player's expected prize."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

from evenbreak.answers.kit.answer import Answer
from evenbreak.answers.kit.columns import columns_of, quantities_of
from evenbreak.answers.kit.parts import Part, Quantities, Table
from evenbreak.answers.kit.wording import count_of
from evenbreak.errors import InputError
from evenbreak.tournaments.evening.fold import Evening
from evenbreak.tournaments.evening.outlook import Outlook
from evenbreak.tournaments.money.calcutta import calcutta, fair_shares, lot_worth
from evenbreak.tournaments.money.payouts import Payouts, PrizeMoney
from evenbreak.tournaments.odds.title import PlaceOdds
from evenbreak.words import Sentence, joined, say, say_count


def tournament_prizes_answer(
    state: Evening, money: PrizeMoney, odds: PlaceOdds | None, *, source: str = ""
) -> Answer:
    """Return each place's prize, and each player's expected prize (None: before the draw).

    If payments are recorded, the pot counts only the players who have paid.

    >>> from evenbreak.tournaments.evening.events import Entrant, Event, Opened, Plan
    >>> from evenbreak.tournaments.evening.fold import evening
    >>> begun = Opened(Plan("single", 5), (Entrant("Ann", 80.0), Entrant("Bo", 70.0)))
    >>> state = evening([Event("2025-03-01T19:30:00", begun)])
    >>> print(tournament_prizes_answer(state, PrizeMoney(added=200.0), None).sentences[0])
    200.00 is paid to 2 places among 2 players: 140.00 for the winner.
    """
    entrants = len(state.entrants)
    payers = state.payers
    pot, payouts = money.pot(payers), money.payouts(entrants)
    amounts = money.amounts(entrants, payers)
    paid = sum(amounts)
    if len(amounts) > entrants:
        raise InputError(
            "{places} places are paid, but there are {players} players",
            places=len(amounts),
            players=entrants,
        )
    places = Table(
        "places",
        columns_of("place share money"),
        [[k, amount / pot if pot else 0.0, amount] for k, amount in enumerate(amounts, start=1)],
    )
    parts: list[Part] = [
        _paid_words(amounts, entrants, pot, money.left(entrants, payers)),
        Quantities(quantities_of({"pot": pot, "paid": paid})),
        places,
    ]
    if payers < entrants and money.fee:
        parts.insert(1, say("{n} of {players} players have paid.", n=payers, players=entrants))
    csv = places
    if odds is not None:
        csv = _expected(odds, amounts)
        parts.append(csv)
    else:
        parts.append(say("Each player's expected payout will be known after the draw."))
    how = say("Shares: {payouts}.", payouts=payouts.name)
    if payouts.source:
        how = say("Shares: {payouts} ({source}).", payouts=payouts.name, source=payouts.source)
    return Answer(source or say("Prizes"), [*parts, how], csv=csv)


def _paid_words(amounts: Sequence[float], entrants: int, pot: float, left: float) -> Sentence:
    paid = sum(amounts)
    text = say_count(
        "{paid:.2f} is paid to {n} place among {players} players: {winner:.2f} for the winner.",
        "{paid:.2f} is paid to {n} places among {players} players: {winner:.2f} for the winner.",
        len(amounts),
        paid=paid,
        players=entrants,
        winner=amounts[0],
    )
    parts = [text]
    house = pot - paid - left
    if house >= 0.005:
        parts.append(
            say("The other {left:.2f} of {pot:.2f} goes to the house.", left=house, pot=pot)
        )
    if left >= 0.005:
        parts.append(say("Rounding leaves {left:.2f} over.", left=left))
    return joined(parts)


def _expected(odds: PlaceOdds, amounts: Sequence[float]) -> Table:
    prizes = odds.expected_prize(amounts)
    in_money = odds.p_place[:, [place.first <= len(amounts) for place in odds.bracket.places]]
    columns = columns_of("name p_paid prize_mean")
    rows: list[list[Any]] = [
        [name, float(paid), float(prize)]
        for name, paid, prize in zip(
            odds.bracket.players, in_money.sum(axis=1), prizes, strict=True
        )
    ]
    rows.sort(key=lambda row: -row[2])
    return Table("players", columns, rows, title=say("Expected payouts"))


def calcutta_answer(
    odds: PlaceOdds,
    payouts: Payouts,
    sold: Mapping[str, float],
    *,
    house: float = 0.0,
    source: str = "",
) -> Answer:
    """Return the current value of each player still to be sold in a Calcutta.

    `house` is the share of the pot that isn't paid out.
    """
    shares = payouts.shares(len(odds.bracket.players))
    raw = fair_shares(odds, shares)
    whole = sum(raw.values())
    fair = {name: share / whole for name, share in raw.items()}
    paid_out = min(1.0, (1.0 - house) * whole)
    lots = calcutta(fair, sold, paid_out=paid_out)
    rows: list[list[Any]] = []
    for lot in sorted(lots, key=lambda one: -one.fair_share):
        half = None
        if lot.break_even is not None:
            half = lot_worth(fair, sold, lot.player, lot.break_even, paid_out=paid_out) / 2.0
        rows.append([lot.player, lot.fair_share, lot.break_even, half])
    columns = columns_of("name fair_share break_even half")
    table = Table("lots", columns, rows)
    bids = sum(sold.values())
    if not rows:
        words = f"All players have been sold, for a total of {bids:.2f}."
    elif rows[0][2] is None:
        words = (
            "No player has been sold yet, so no one knows how large the pot will be. The shares "
            "show what part of the pot each player is worth."
        )
    else:
        words = (
            f"{count_of(len(sold), 'player has', 'players have')} been sold so far, for "
            f"{bids:.2f}. {rows[0][0]} is worth a bid of up to {rows[0][2]:,.2f} now."
        )
    parts: list[Part] = [
        words,
        table,
        "On average, a break-even bid wins back what it costs if the remaining players go for "
        "what their shares are worth. Players who are allowed to buy back half of themselves "
        "should do so at any lower bid.",
    ]
    return Answer(source or "Calcutta", parts, csv=table)


class Stake(NamedTuple):
    """What a match decides: the average change in title odds and prize money from its result."""

    title: float
    prize: float | None = None


def stakes(outlook: Outlook, prizes: Sequence[float] = ()) -> dict[str, Stake]:
    """Return what the playable matches decide, most decisive first.

    It is empty where that takes too long: in a very large bracket, in a Swiss, and before a redraw.
    """
    ready = set(outlook.state.standing.to_play)
    money = {lever.match: lever.swing for lever in outlook.leverages(prizes)} if prizes else {}
    found = {
        lever.match: Stake(
            float(lever.swing.sum()) / 2.0,
            float(money[lever.match].sum()) / 2.0 if lever.match in money else None,
        )
        for lever in outlook.leverages()
        if lever.match in ready
    }
    return dict(sorted(found.items(), key=lambda one: -one[1].title))
