"""What is to be expected of tonight's tournament: its `odds`, `time` and `prizes`."""

from __future__ import annotations

from dataclasses import replace
from pathlib import PurePath
from typing import TYPE_CHECKING

from evenbreak.answers.kit.answer import Answer
from evenbreak.answers.kit.systems import stated_pace
from evenbreak.cli.kit.asked import command_of
from evenbreak.cli.kit.said import refuse
from evenbreak.cli.tournament.evening import moment, outlook_of
from evenbreak.cli.tournament.options import earlier_in, none_learned, tournament_of
from evenbreak.errors import InputError
from evenbreak.fields.kinds import Number
from evenbreak.files.tables.names import KnownNames
from evenbreak.questions.evening import PayOut
from evenbreak.questions.tournament import TournamentOdds, TournamentTime

if TYPE_CHECKING:
    from evenbreak.tournaments import PrizeMoney


@command_of(TournamentOdds, "odds")
def command(asked: TournamentOdds) -> Answer:
    """Find each player's odds."""
    import numpy as np

    from evenbreak.answers.tournament.odds import tournament_odds_answer

    if asked.entrants is None:
        return _odds_under_way(asked)
    tournament, warnings = tournament_of(asked, before_draw=asked.before_draw)
    if np.isnan(tournament.file.roster.rating).all():
        refuse(f"{tournament.file.source} has no ratings, so everyone's odds are the same")
    if asked.fairest and isinstance(tournament.races.race, int):
        refuse("--fairest is for handicapped races. Give --race-to N or --chart NAME, not --race.")
    return tournament_odds_answer(
        tournament,
        sure=asked.sure,
        walkovers=asked.walkovers,
        prizes=paid_places(asked.prizes, len(tournament.roster)),
        fairest=asked.fairest,
        seed=asked.seed,
        warnings=warnings,
    )


def _odds_under_way(asked: TournamentOdds) -> Answer:
    """Find each player's odds in the tournament under way."""
    from evenbreak.answers.tournament.under_way import odds_under_way

    file = asked.path
    outlook = replace(
        outlook_of(file, moment(asked.at, file), asked.event), walkovers=asked.walkovers
    )
    paid = paid_places(asked.prizes, len(outlook.state.order))
    return odds_under_way(outlook, sure=asked.sure, prizes=paid, source=PurePath(file).name)


@command_of(TournamentTime, "time")
def time(asked: TournamentTime) -> Answer:
    """Find when the tournament ends."""
    from evenbreak.answers.tournament.time import tournament_time_answer
    from evenbreak.matches import Turnover

    if asked.entrants is None:
        return _time_under_way(asked)
    tournament, warnings = tournament_of(asked)
    pace = stated_pace(asked.discipline, asked.minutes_per_game) or ""
    earlier = earlier_in(asked)
    return tournament_time_answer(
        tournament,
        tables=asked.tables or 1,
        pace=pace,
        earlier=earlier,
        turnover=None if asked.turnover is None else Turnover(asked.turnover),
        start=asked.start,
        seed=asked.seed,
        warnings=[*warnings, *none_learned(asked, earlier)],
    )


def _time_under_way(asked: TournamentTime) -> Answer:
    """Find when the tournament under way ends."""
    from evenbreak.answers.tournament.under_way import time_under_way
    from evenbreak.matches import Turnover

    file = asked.path
    return time_under_way(
        outlook_of(file, moment(asked.at, file), asked.event),
        tables=asked.tables,
        turnover=None if asked.turnover is None else Turnover(asked.turnover),
        source=PurePath(file).name,
    )


@command_of(PayOut, "prizes")
def prizes(asked: PayOut) -> Answer:
    """Find what each place is paid."""
    from evenbreak.answers.tournament.prizes import calcutta_answer, tournament_prizes_answer
    from evenbreak.files.store.prizes import kept_prizes
    from evenbreak.files.store.tournament import keep_prizes, read_tournament

    file, house, has_money = asked.path, asked.house, asked.fee or asked.added
    state = read_tournament(file, asked.event)
    entrants, name = len(state.entrants), PurePath(file).name
    money = _money(asked)
    if asked.calcutta:
        odds = outlook_of(file, moment(asked.at, file), asked.event).odds
        bids = _bids(asked, state.order)
        table = money.payouts(entrants)
        return calcutta_answer(odds, table, bids, house=house, source=name)
    kept = kept_prizes(file, asked.event)
    if kept and not has_money:
        money = replace(
            kept,
            house=house or kept.house,
            payout=money.payout or kept.payout,
            unit=asked.unit or kept.unit,
        )
    if not money.pot(state.payers):
        asked.refuse("there's no prize money. Add {fee} or {added}.")
    now = outlook_of(file, moment(asked.at, file), asked.event).odds if state.drawn else None
    answer = tournament_prizes_answer(state, money, now, source=name)
    if asked.keep:
        keep_prizes(file, money, asked.event)
    return answer


def _money(asked: PayOut) -> PrizeMoney:
    from evenbreak.tournaments import PAYOUTS, PrizeMoney

    text = asked.payout or ""
    if text not in PAYOUTS:
        text = "/".join(part.strip().removesuffix("%") for part in text.split(","))
    try:
        return PrizeMoney(asked.fee, asked.added, asked.house, text, asked.unit)
    except InputError as error:
        asked.refuse("{payout}: {why}", why=error.sentence)


def _bids(asked: PayOut, players: tuple[str, ...]) -> dict[str, float]:
    names, bids = KnownNames(players), {}
    for name, amount in asked.sold:
        place = names.place(name)
        if place is None:
            asked.refuse(
                "{sold} {name!r} isn't in the tournament{hint}", name=name, hint=names.hint(name)
            )
        bids[players[place]] = amount
    return bids


def paid_places(text: str | None, players: int) -> tuple[float, ...]:
    """Return the money for each place that --prizes states."""
    if text is None:
        return ()
    try:
        amounts = tuple(Number(0.0, 1e12).read(part) for part in text.split(","))
    except InputError:
        refuse(
            "--prizes must be an amount for each paid place, such as 500,300,150; you gave "
            f"{text!r}"
        )
    if len(amounts) > players:
        refuse(f"--prizes has {len(amounts)} places for {players} players. Give fewer.")
    return amounts
