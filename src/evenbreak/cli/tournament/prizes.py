"""`evenbreak tournament prizes`: payouts, what each player may expect, and the Calcutta."""

from __future__ import annotations

from pathlib import PurePath
from typing import Any

import click

from evenbreak import tournaments
from evenbreak.answers.answer import Answer
from evenbreak.cli.kit.faces import faces
from evenbreak.cli.kit.values import NUMBER, Number, refuse
from evenbreak.cli.tournament.evening import at_option, file_option, outlook_of
from evenbreak.files.known_names import KnownNames

MONEY = Number(0.0, 1e9, " is not an amount of money; give a number such as 20")
SHARE = Number(0.0, 0.99, " is not a part; give a number from 0 to 0.99, such as 0.1")

EXAMPLES = """\b
Examples:
  evenbreak tournament prizes --fee 20 --added 100
  evenbreak tournament prizes --fee 20 --payout 50,30,20 --house 0.1
  evenbreak tournament prizes --calcutta --sold "Ann Lee=60" --sold "Bo Diaz=25"
"""


@click.command("prizes", epilog=EXAMPLES)
@click.option(
    "--fee", type=MONEY, metavar="MONEY", default=0.0, help="What each player pays to enter."
)
@click.option("--added", type=MONEY, metavar="MONEY", default=0.0, help="Money added to the pot.")
@click.option(
    "--house",
    type=SHARE,
    metavar="P",
    default=0.0,
    help="The part of the pot that the house keeps.",
)
@click.option(
    "--payout",
    metavar="NAME|P,...",
    help="What the places get: hoboken, 40/30/20/10, 40/30/15, 70/30, or percentages such as "
    "50,30,20.  [default: 70/30 for fewer than 8 players, else 40/30/20/10]",
)
@click.option("--calcutta", is_flag=True, help="What each player is worth in the Calcutta.")
@click.option(
    "--sold",
    multiple=True,
    metavar="NAME=BID",
    help="With --calcutta: a player who has been sold, and for how much; may be repeated.",
)
@file_option
@at_option
@faces()
def command(
    *,
    fee: float,
    added: float,
    house: float,
    payout: str | None,
    calcutta: bool,
    sold: tuple[str, ...],
    file: str,
    at: str,
) -> Answer:
    """Find what each place is paid, and what each player may expect.

    With --calcutta, find what each player still to be sold is worth: the share of the pot, and the
    bid at which it wins back what it costs.
    """
    from evenbreak.answers.tournament_prizes import calcutta_answer, tournament_prizes_answer
    from evenbreak.files.tournament_store import read_tournament

    state = read_tournament(file)
    entrants, name = len(state.entrants), PurePath(file).name
    table = _payouts(payout, entrants)
    if calcutta:
        if fee or added:
            refuse("--fee and --added are for the prizes; the pot of a Calcutta is its bids")
        return calcutta_answer(
            outlook_of(file, at).odds, table, _bids(sold, state.order), house=house, source=name
        )
    if sold:
        refuse("--sold is for --calcutta")
    pot = (fee * entrants + added) * (1.0 - house)
    if not pot:
        refuse("there is no prize money; give --fee or --added")
    odds = outlook_of(file, at).odds if state.drawn else None
    return tournament_prizes_answer(state, table, pot, odds, source=name)


def _payouts(text: str | None, entrants: int) -> Any:
    if text is None:
        return tournaments.payout_table("70/30" if entrants < 8 else "40/30/20/10")
    if text in tournaments.PAYOUTS:
        return tournaments.payout_table(text)
    parts = [part.strip().removesuffix("%") for part in text.split(",")]
    if not all(NUMBER.fullmatch(part) for part in parts):
        known = ", ".join(tournaments.PAYOUTS)
        refuse(f"--payout {text!r}; give {known}, or percentages such as 50,30,20")
    shares = [float(part) / 100.0 for part in parts]
    if min(shares) < 0.0 or sum(shares) > 1.0 + 1e-9:
        refuse(f"--payout {text!r} adds up to {100.0 * sum(shares):g}; give 100 percent at most")
    return tournaments.payout_table(shares)


def _bids(sold: tuple[str, ...], players: tuple[str, ...]) -> dict[str, float]:
    known, bids = KnownNames(players), {}
    for text in sold:
        name, _, amount = text.rpartition("=")
        place = known.place(name.strip())
        if not NUMBER.fullmatch(amount.strip()) or float(amount) < 0.0:
            refuse(f"--sold {text!r}; give a player and a bid, such as 'Ann Lee=60'")
        if place is None:
            refuse(f"--sold {text!r}: {name.strip()!r} is not in the tournament{known.hint(name)}")
        bids[players[place]] = float(amount)
    return bids
