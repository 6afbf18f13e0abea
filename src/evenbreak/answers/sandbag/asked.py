"""From a question about losing on purpose to its answer."""

from __future__ import annotations

from dataclasses import replace
from typing import Any, cast

from evenbreak import files, handicaps, league
from evenbreak.answers.kit.answer import Answer
from evenbreak.answers.kit.systems import chart_for, level_system
from evenbreak.answers.sandbag.pay import (
    PayQuestion,
    sandbag_charts_answer,
    sandbag_pay,
    sandbag_pay_answer,
)
from evenbreak.questions.ladders import SandbagPay

DOUBLINGS = 4
"""How far off a rating may be: to where the odds of a game are 16 to 1."""

PLAYED = 1000
"""Leagues that are played for each number of matches dumped, where there is no chain to solve."""


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
    """Return what dumping pays in a system without points by match: solved or played."""
    from evenbreak.answers.sandbag.played import dumping_answer, numbers_dumped

    for name in ("start_error", "compare", "plot"):
        if name in asked.given:
            asked.refuse("{" + name + "} is for systems that move points by match; leave it out")
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
    """Return a wide ladder against opponents who are correctly rated."""
    return handicaps.Ladder(
        system, chart, widest=round(DOUBLINGS * system.scale.points_per_doubling)
    )
