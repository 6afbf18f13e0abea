"""`evenbreak tournament prizes`: payouts, what each player may expect, and the Calcutta."""

from __future__ import annotations

from dataclasses import replace
from pathlib import PurePath
from typing import TYPE_CHECKING

from evenbreak.answers.kit.answer import Answer
from evenbreak.cli.kit.asked import command_of
from evenbreak.cli.kit.values import refuse
from evenbreak.cli.tournament.evening import moment, outlook_of
from evenbreak.errors import InputError
from evenbreak.fields.kinds import Number
from evenbreak.files.tables.names import KnownNames
from evenbreak.questions.evening import PayOut

if TYPE_CHECKING:
    from evenbreak.tournaments import PrizeMoney


@command_of(PayOut, "prizes")
def command(asked: PayOut) -> Answer:
    """Find what each place is paid."""
    from evenbreak.answers.tournament.prizes import calcutta_answer, tournament_prizes_answer
    from evenbreak.files.store.desk import keep_prizes, kept_prizes
    from evenbreak.files.store.tournament import read_tournament

    file, house, has_money = asked.path, asked.house, asked.fee or asked.added
    state = read_tournament(file)
    entrants, name = len(state.entrants), PurePath(file).name
    money = _money(asked)
    if asked.calcutta:
        odds = outlook_of(file, moment(asked.at, file)).odds
        bids = _bids(asked, state.order)
        table = money.payouts(entrants)
        return calcutta_answer(odds, table, bids, house=house, source=name)
    kept = kept_prizes(file)
    if kept and not has_money:
        money = replace(kept, house=house or kept.house, payout=money.payout or kept.payout)
    pot = money.pot(entrants)
    if not pot:
        asked.refuse("there is no prize money; give {fee} or {added}")
    now = outlook_of(file, moment(asked.at, file)).odds if state.drawn else None
    answer = tournament_prizes_answer(state, money.payouts(entrants), pot, now, source=name)
    if asked.keep:
        keep_prizes(file, money)
    return answer


def _money(asked: PayOut) -> PrizeMoney:
    from evenbreak.tournaments import PAYOUTS, PrizeMoney

    text = asked.payout or ""
    if text not in PAYOUTS:
        text = "/".join(part.strip().removesuffix("%") for part in text.split(","))
    try:
        return PrizeMoney(asked.fee, asked.added, asked.house, text)
    except InputError as error:
        asked.refuse("{payout}: {why}", why=error.sentence)


def _bids(asked: PayOut, players: tuple[str, ...]) -> dict[str, float]:
    names, bids = KnownNames(players), {}
    for name, amount in asked.sold:
        place = names.place(name)
        if place is None:
            asked.refuse(
                "{sold} {name!r} is not in the tournament{hint}", name=name, hint=names.hint(name)
            )
        bids[players[place]] = amount
    return bids


def paid_places(text: str | None, players: int) -> tuple[float, ...]:
    """Return the money for each place that --prizes states."""
    if text is None:
        return ()
    wanted = "give an amount for each paid place, such as 500,300,150"
    try:
        amounts = tuple(Number(0.0, 1e12).read(part) for part in text.split(","))
    except InputError:
        refuse(f"--prizes is {text!r}; {wanted}")
    if len(amounts) > players:
        refuse(f"--prizes has {len(amounts)} places for {players} players; give fewer")
    return amounts
