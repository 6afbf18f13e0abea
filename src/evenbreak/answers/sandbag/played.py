"""What losing on purpose gains in a system without points per match: exact or simulated."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import Any, cast

from evenbreak import files, handicaps, league
from evenbreak.answers.kit.answer import Answer
from evenbreak.answers.kit.columns import columns_of, in_files
from evenbreak.answers.kit.parts import Table
from evenbreak.answers.kit.systems import chart_for, level_system
from evenbreak.answers.kit.wording import count_of
from evenbreak.answers.sandbag.pay import (
    PayQuestion,
    sandbag_charts_answer,
    sandbag_pay,
    sandbag_pay_answer,
    stakes_in_words,
)
from evenbreak.handicaps.ladders.level_ladder import Dumping
from evenbreak.handicaps.systems.system import System
from evenbreak.questions.ladders import SandbagPay

_COLUMNS = "dumped given_away p_first p_in_a_row extra_wins extra_wins_error pays_from profit"


def numbers_dumped(most: int) -> list[int]:
    """Return the numbers of dumped matches to simulate: a few numbers up to the most.

    >>> numbers_dumped(12), numbers_dumped(30)
    ([0, 1, 2, 3, 4, 6, 8, 12], [0, 1, 2, 3, 4, 6, 8, 12, 16, 24, 30])
    """
    usual = [0, 1, 2, 3, 4, 6, 8, 12, 16, 24, 32, 48, 64]
    return sorted({number for number in usual if number < most} | {most})


def dumping_answer(
    system: System, rows: Sequence[Dumping], question: PayQuestion, leagues: int
) -> Answer:
    """Return what dumping pays; in files, a row per number of matches dumped, starting with 0.

    `leagues` were simulated for each; 0 if nothing was drawn.
    """
    honest = rows[0].p_in_a_row

    def profit(row: Dumping) -> float:
        return row.profit(question.stake, question.dumped_stake, question.prize, honest)

    cells: list[tuple[Any, ...]] = [
        (
            row.dumped,
            row.given_away,
            row.p_first,
            row.p_in_a_row,
            row.extra_wins,
            row.error,
            row.given_away / row.extra_wins if row.extra_wins > 1e-9 else None,
            profit(row),
        )
        for row in rows
    ]
    best = max(rows, key=lambda row: (profit(row), -row.dumped))
    error = f" ± {question.stake * best.error:.2f}" if leagues else ""
    first = (
        "Sandbagging pays at these stakes. The most profitable plan is to dump "
        f"{count_of(best.dumped, 'match', 'matches')}, for a profit of "
        f"{profit(best):.2f}{error}."
        if best.dumped and profit(best) > 2.0 * question.stake * best.error
        else "Sandbagging does not pay at these stakes, however many matches are dumped."
        if not leagues
        else "Nothing shows that sandbagging pays at these stakes."
    )
    how = (
        f"Played in {leagues:,} leagues for each number of matches dumped, all with the same "
        "random numbers; '±' is one standard error."
        if leagues
        else "Exact: nothing is simulated."
    )
    columns = columns_of(_COLUMNS, wins=question.in_a_row, matches=question.earnest)
    names = in_files(str(column.name) for column in columns)
    kind = "level" if system.publishes == "levels" else "rating"
    lower = rows[-1]
    return Answer(
        f"What losing on purpose pays: system {system.name}\n"
        f"{system.in_words[:1].upper()}{system.in_words[1:]}. Opponents are as good as the player "
        f"and stay correctly rated.\n{stakes_in_words(question)}",
        [
            first,
            f"After {count_of(lower.dumped, 'match', 'matches')} lost on purpose, the {kind} is "
            + (
                f"{-lower.published:.3g} lower than an honest player's."
                if lower.published < 0.0
                else "no lower than an honest player's."
            ),
            Table("", columns, cells),
            how,
        ],
        data={"system": system.name, "leagues": leagues, "rows": list(rows)},
        csv=Table("rows", names, cells),
    )


DOUBLINGS = 4
"""How far off a rating may be: up to where the odds of a game are 16 to 1."""

PLAYED = 1000
"""How many leagues are simulated for each number of matches dumped, if no chain can be solved."""


def pay(asked: SandbagPay) -> Answer:
    """Return what losing on purpose pays."""
    question = PayQuestion(
        dumped=asked.dumped,
        earnest=asked.earnest,
        start=asked.start_error,
        stake=asked.stake,
        dumped_stake=asked.dumped_stake,
        in_a_row=asked.in_a_row,
        prize=asked.prize,
    )
    levels = level_system(asked.system, asked.chart)
    if levels is not None or not isinstance(asked.system, handicaps.StepSystem | None):
        return _pay_by_play(asked, levels or cast("handicaps.System", asked.system), question)
    system = handicaps.steps_of(asked.system or "npl")
    if asked.compare:
        ladders = [_wide(system, chart) for chart in system.known_charts()]
        return sandbag_charts_answer(
            [sandbag_pay(ladder, question, cycles=False) for ladder in ladders], question
        )
    chart, warnings = chart_for(system, asked.chart)
    findings = sandbag_pay(_wide(system, chart), question)
    return replace(sandbag_pay_answer(findings, question, warnings), drawn=findings.pays)


def _pay_by_play(asked: SandbagPay, system: handicaps.System, question: PayQuestion) -> Answer:
    """Return what dumping pays in a system without points per match: solved or simulated."""
    for name in ("start_error", "compare", "plot"):
        if name in asked.given:
            asked.refuse("{" + name + "} is for systems that move points by match. Leave it out.")
    if isinstance(system, handicaps.MarkovSystem):
        chart: Any = system.chart
        many, middle = len(chart.levels), len(chart.levels) // 2
        skills = handicaps.level_skills(chart)
        equals = tuple(float(place == middle) for place in range(many))
        ladder = handicaps.LevelLadder(system, float(skills.points[middle]), equals, skills)
        rows = ladder.dumping(asked.dumped, asked.earnest, asked.in_a_row)
        return dumping_answer(system, rows, question, 0)
    if asked.chart is not None:
        system = system.on_chart(files.find_chart(asked.chart))
    numbers = numbers_dumped(asked.dumped)
    rows = league.dumping_played(
        system, numbers, earnest=asked.earnest, in_a_row=asked.in_a_row, replicas=PLAYED
    )
    return dumping_answer(system, rows, question, PLAYED)


def _wide(system: handicaps.StepSystem, chart: handicaps.Chart) -> handicaps.Ladder:
    """Return a wide ladder against correctly rated opponents."""
    return handicaps.Ladder(
        system, chart, widest=round(DOUBLINGS * system.scale.points_per_doubling)
    )
