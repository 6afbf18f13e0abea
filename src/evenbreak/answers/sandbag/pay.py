"""The profit from losing matches on purpose: by matches dumped, in cycles, and by chart."""

import math
from collections.abc import Iterator, Sequence
from typing import Any, NamedTuple

from evenbreak.answers.kit.answer import Answer
from evenbreak.answers.kit.columns import columns_of, in_files
from evenbreak.answers.kit.parts import Table
from evenbreak.answers.kit.wording import count_of, percent
from evenbreak.errors import InputError
from evenbreak.handicaps.ladders.ladder import Ladder
from evenbreak.league.dump_cycle import DumpCycle, best_cycle
from evenbreak.league.sandbag_pay import (
    DumpRow,
    Sandbagging,
    entering_low,
    most_dumped,
    sandbagging,
)

CYCLE = 10
"""The cycle lengths considered, in matches dumped and matches played for real."""


class PayQuestion(NamedTuple):
    """How many matches are dumped and how many count afterward, from which rating error, for what.

    `start` is in points; a stake is the difference in value between winning and losing a match.
    `prize` is paid for `in_a_row` wins.
    """

    dumped: int
    earnest: int
    start: int
    stake: float
    dumped_stake: float
    in_a_row: int
    prize: float


class PayFindings(NamedTuple):
    """What sandbagging pays on one ladder.

    `all_pays` goes on to as many dumped matches as the ladder allows; `cycle` is the most
    profitable cycle for a player willing to be underrated by one doubling (None: not calculated);
    `enters` has the extra wins for a player who enters one doubling too low, established or as a
    newcomer.
    """

    ladder: Ladder
    pays: Sandbagging
    all_pays: Sandbagging
    cycle: DumpCycle | None
    enters: dict[str, float]

    @property
    def doubling(self) -> int:
        """The points that double the odds in a game."""
        return round(self.ladder.system.scale.points_per_doubling)


def sandbag_pay(ladder: Ladder, question: PayQuestion, *, cycles: bool = True) -> PayFindings:
    """Return what sandbagging pays on a ladder.

    Raises InputError if one dumped match already takes the rating to the ladder's end.
    """
    asked = question._asdict()
    most = most_dumped(ladder, question.start)
    if not most:
        raise InputError(
            "with the system {name}, a single loss takes the rating more than {widest} points "
            "below the skill. Use smaller steps, or start with a higher rating.",
            name=ladder.system.name,
            widest=ladder.widest,
        )
    pays = sandbagging(ladder, **{**asked, "dumped": min(question.dumped, most)})
    # The best number may lie beyond the table.
    all_pays = sandbagging(ladder, **{**asked, "dumped": most})
    doubling = round(ladder.system.scale.points_per_doubling)
    kinds = {"established": False} | ({"newcomer": True} if ladder.system.newcomer_steps else {})
    enters = {
        kind: float(entering_low(ladder, doubling, question.earnest, newcomer=new)[-1])
        for kind, new in kinds.items()
    }
    stakes = {"stake": question.stake, "dumped_stake": question.dumped_stake}
    cycle = best_cycle(ladder, [CYCLE], lowest=-float(doubling), **stakes) if cycles else None
    return PayFindings(ladder, pays, all_pays, cycle, enters)


def sandbag_pay_answer(
    found: PayFindings, question: PayQuestion, warnings: Sequence[str] = ()
) -> Answer:
    """Return what sandbagging pays on one ladder; in files, a `DumpRow` per number dumped.

    >>> from evenbreak.handicaps import Ladder
    >>> question = PayQuestion(2, 20, 0, 10.0, 1.0, 3, 0.0)
    >>> found = sandbag_pay(Ladder("npl", widest=120), question, cycles=False)
    >>> print(sandbag_pay_answer(found, question).sentences[0])
    Sandbagging pays at these stakes. The most profitable plan is to dump 64 matches, for a profit
    of 57.67.
    """
    ladder, best = found.ladder, found.all_pays.best
    shown = len(found.pays.rows) - 1
    if shown < question.dumped:
        warnings = [
            *warnings,
            f"{ladder.chart.name}: at most {count_of(shown, 'match', 'matches')} can be dumped; "
            f"the rating is then {ladder.widest} points below the skill",
        ]
    plain = [tuple(map(_finite, row)) for row in found.pays.rows]
    rows = Table("rows", in_files(best._fields), plain)
    return Answer(
        _heading(found, question),
        [*_in_words(found, question), _by_dumped(found.pays.rows, question), _EXPLANATION],
        warnings=warnings,
        data={
            "chart": ladder.chart.name,
            "system": ladder.system.name,
            "best": best,
            "p_win": found.pays.p_win,
            "p_honest": found.pays.p_honest,
            "cycle": found.cycle,
            "enters_low": found.enters,
        },
        csv=rows,
    )


_EXPLANATION = (
    "'Wins given up': how many of the dumped matches an honest player would have won. 'Extra "
    "wins': how many more of the matches that count the sandbagger wins; 'from the last': how "
    "many of these come from the last match dumped. 'Pays from': for sandbagging to pay, a win "
    "that counts must be worth at least this many times as much as a win in a dumped match. "
    "'Profit': how much more the player gains than an honest one, in the same unit as the stakes."
)


def _heading(found: PayFindings, question: PayQuestion) -> str:
    chart, system = found.ladder.chart.name, found.ladder.system
    start = (
        f" The rating starts {question.start:+d} points off the skill." if question.start else ""
    )
    rule = f"{system.in_words[:1].upper()}{system.in_words[1:]}"
    return (
        f"What losing on purpose pays: chart {chart}, system {system.name}\n{rule}. Opponents are "
        f"as good as the player and correctly rated.{start}\n{stakes_in_words(question)}"
    )


def stakes_in_words(question: PayQuestion) -> str:
    """Return what is at stake, in a sentence."""
    prize = f"; a tournament win pays {question.prize:g}" if question.prize else ""
    return (
        f"Stakes: winning is worth {question.stake:g} in a match that counts, "
        f"and {question.dumped_stake:g} in a dumped match{prize}."
    )


def _in_words(found: PayFindings, question: PayQuestion) -> Iterator[str]:
    best, cheapest, cycle = found.all_pays.best, found.all_pays.cheapest, found.cycle
    if best.dumped:
        yield (
            "Sandbagging pays at these stakes. The most profitable plan is to dump "
            f"{count_of(best.dumped, 'match', 'matches')}, for a profit of {best.profit:.2f}."
        )
    else:
        yield "Sandbagging does not pay at these stakes, however many matches are dumped."
    if math.isfinite(cheapest.break_even):
        aside = "Leaving the prize aside, for it" if question.prize else "For it"
        yield (
            f"{aside} to pay off over {count_of(question.earnest, 'match', 'matches')} that "
            f"count, a "
            f"win in them must be worth at least {cheapest.break_even:.2f} times as much as a win "
            f"in a dumped match (with {cheapest.dumped} dumped)."
        )
    if cycle is not None and cycle.dumped and cycle.profit > 0.0:
        yield (
            f"In cycles of {CYCLE} matches, the most profitable plan for a player willing to be "
            f"{found.doubling} points underrated is to dump {cycle.dumped} and play "
            f"{cycle.earnest} that count. They are then {-cycle.rating_error:.1f} points "
            f"underrated when they start to play for real, win {percent(cycle.p_win)} of these "
            f"matches and gain {cycle.profit:.2f} a match."
        )
    steps = ""
    if "newcomer" in found.enters:
        steps = f"; with the newcomer steps, they win {found.enters['newcomer']:.2f} more"
    yield (
        f"A player who enters the league {found.doubling} points underrated wins "
        f"{found.enters['established']:.2f} more of their first {question.earnest} matches than a "
        f"correctly rated player{steps}."
    )


def _by_dumped(rows: Sequence[DumpRow], question: PayQuestion) -> Table:
    columns = columns_of(
        "dumped given_away p_first p_in_a_row extra_wins for_the_last pays_from profit",
        wins=question.in_a_row,
        matches=question.earnest,
    )
    of_dumps = ("given_away", "extra_wins", "for_the_last", "profit")
    view = [
        [
            None if not row.dumped and name in of_dumps else _finite(getattr(row, name))
            for name in (str(column.name) for column in columns)
        ]
        for row in rows
    ]
    return Table("", columns, view)


def sandbag_charts_answer(found: Sequence[PayFindings], question: PayQuestion) -> Answer:
    """Return what sandbagging pays on each of a system's charts; in files, a row for each."""
    columns = columns_of(
        "chart best_dumped p_first p_in_a_row extra_wins pays_from profit enters_low",
        wins=question.in_a_row,
        matches=question.earnest,
    )
    rows = []
    for one in found:
        best, name = one.all_pays.best, one.ladder.chart.name
        pays_from = _finite(one.all_pays.cheapest.break_even)
        wins = (best.p_first, best.p_in_a_row, best.extra_wins)
        rows.append((name, best.dumped, *wins, pays_from, best.profit, one.enters["established"]))
    least, most = (pick(found, key=lambda one: one.all_pays.best.profit) for pick in (min, max))
    return Answer(
        f"What losing on purpose pays by chart: system {found[0].ladder.system.name}\n"
        f"{stakes_in_words(question)}",
        [
            f"Sandbagging pays least on {least.ladder.chart.name}: at most "
            f"{least.all_pays.best.profit:.2f} at these stakes. It pays most on "
            f"{most.ladder.chart.name}: up to {most.all_pays.best.profit:.2f}.",
            Table("charts", columns, rows),
            "Each row is for the number of dumped matches that pays most. 'Pays from': for "
            f"sandbagging to pay, a win that counts must be worth at least this many times as "
            f"much as a win in a dumped match. 'Enters low': how many more of their first "
            f"{question.earnest} matches are won by a player who enters the league "
            f"{found[0].doubling} points underrated.",
        ],
    )


def _finite(value: Any) -> Any:
    return None if math.isinf(value) else value
