"""`evenbreak tournament prizes`: payouts, what each player may expect, and the Calcutta."""

from __future__ import annotations

from dataclasses import replace
from pathlib import PurePath
from typing import TYPE_CHECKING

import click

from evenbreak.answers.kit.answer import Answer
from evenbreak.cli.kit.faces import faces
from evenbreak.cli.kit.values import NUMBER, Number, refuse
from evenbreak.cli.tournament.evening import at_option, file_option, outlook_of
from evenbreak.errors import InputError
from evenbreak.files.tables.names import KnownNames

if TYPE_CHECKING:
    from evenbreak.tournaments import PrizeMoney

MONEY = Number(0.0, 1e9, " is not an amount of money; give a number such as 20")
SHARE = Number(0.0, 0.99, " is not a part; give a number from 0 to 0.99, such as 0.1")

EXAMPLES = """\b
Examples:
  evenbreak tournament prizes --fee 20 --added 100
  evenbreak tournament prizes --fee 20 --payout 50,30,20 --house 0.1 --keep
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
@click.option(
    "--keep",
    is_flag=True,
    help="Keep them with the tournament: the page shows them, and this command unless it is "
    "given others.",
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
    keep: bool,
    calcutta: bool,
    sold: tuple[str, ...],
    file: str,
    at: str,
) -> Answer:
    """Find what each place is paid, and what each player may expect.

    With --calcutta, find what each player still to be sold is worth: the share of the pot, and the
    bid at which it wins back what it costs.
    """
    from evenbreak.answers.tournament.prizes import calcutta_answer, tournament_prizes_answer
    from evenbreak.files.store.desk import keep_prizes, kept_prizes
    from evenbreak.files.store.tournament import read_tournament

    state = read_tournament(file)
    entrants, name = len(state.entrants), PurePath(file).name
    money = _money(fee, added, house, payout)
    if calcutta:
        if fee or added or keep:
            refuse(
                "--fee, --added and --keep are for the prizes; the pot of a Calcutta is its bids"
            )
        table = money.payouts(entrants)
        return calcutta_answer(
            outlook_of(file, at).odds, table, _bids(sold, state.order), house=house, source=name
        )
    if sold:
        refuse("--sold is for --calcutta")
    kept = kept_prizes(file)
    if kept and not (fee or added):
        money = replace(kept, house=house or kept.house, payout=money.payout or kept.payout)
    pot = money.pot(entrants)
    if not pot:
        refuse("there is no prize money; give --fee or --added")
    odds = outlook_of(file, at).odds if state.drawn else None
    answer = tournament_prizes_answer(state, money.payouts(entrants), pot, odds, source=name)
    if keep:
        keep_prizes(file, money)
    return answer


def _money(fee: float, added: float, house: float, payout: str | None) -> PrizeMoney:
    from evenbreak.tournaments import PAYOUTS, PrizeMoney

    text = payout or ""
    if text not in PAYOUTS:
        text = "/".join(part.strip().removesuffix("%") for part in text.split(","))
    try:
        return PrizeMoney(fee, added, house, text)
    except InputError as error:
        refuse(f"--{error}")


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
