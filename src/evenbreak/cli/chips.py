"""`evenbreak chips`: chip tournaments and their charts."""

from __future__ import annotations

from typing import TYPE_CHECKING

import click

from evenbreak.answers.kit.answer import Answer
from evenbreak.answers.kit.systems import (
    LEAVE_OUT,
    LEVELS_DOUBLE,
    SAY_WHICH,
    refuse_levels,
    refuse_other_scale,
    with_starters,
)
from evenbreak.cli.kit.asked import command_of
from evenbreak.cli.kit.groups import Entry, LazyGroup
from evenbreak.cli.kit.said import refuse
from evenbreak.questions import chips as questions
from evenbreak.tournaments.evening.format import MOST_PLAYERS
from evenbreak.words import Parameter

if TYPE_CHECKING:
    from evenbreak.answers.chips import ChipField

COMMANDS = {
    "odds": Entry("chips:odds", "Find each player's odds in a chip tournament."),
    "audit": Entry("chips:audit", "Check whom a chip chart favours."),
    "design": Entry("chips:design", "Design a fairer chip chart."),
}
"""Each command, with its line of help."""


@click.command("chips", cls=LazyGroup, table=COMMANDS)
def command() -> None:
    """Find the odds of chip tournaments; audit and design chip charts.

    In a chip tournament the loser of a rack pays a chip and goes to the end of the line, the
    winner stays at the table, and whoever has no chips left is out. Weaker players start with
    more chips, by a chart.
    """


@command_of(questions.ChipOdds, "odds")
def odds(asked: questions.ChipOdds) -> Answer:
    """Find each player's odds."""
    from evenbreak.answers.chips import chip_odds_answer
    from evenbreak.files.charts import chip_chart_of

    field, warnings = _field(asked, asked.entrants)
    chart = None if asked.chips is None else chip_chart_of(asked.chips)
    return chip_odds_answer(field, chart, asked.left, seed=asked.seed, warnings=warnings)


@command_of(questions.ChipAudit, "audit")
def audit(asked: questions.ChipAudit) -> Answer:
    """Check whom a chip chart favours."""
    from evenbreak.answers.chips import chip_audit_answer
    from evenbreak.files.charts import chip_chart_of

    field, warnings = _field(asked, asked.entrants)
    chart = chip_chart_of(asked.chart)
    return chip_audit_answer(field, chart, seed=asked.seed, warnings=warnings)


@command_of(questions.ChipDesign, "design")
def design(asked: questions.ChipDesign) -> Answer:
    """Design a chip chart."""
    from evenbreak.answers.chips import chip_design_answer

    field, warnings = _field(asked, asked.entrants)
    return chip_design_answer(
        field,
        bands=asked.bands,
        fewest=asked.fewest,
        most=asked.most,
        seed=asked.seed,
        warnings=warnings,
    )


def _field(asked: questions.ChipField, entrants: str | None) -> tuple[ChipField, list[str]]:
    """Return who plays, made up if no file says it, and what is doubtful about it."""
    from evenbreak import files, ratings
    from evenbreak.answers.chips import ChipField, spread_field
    from evenbreak.answers.kit.remarks import file_name

    if entrants is None:
        return spread_field(asked.scale or ratings.SCALES["fargo"], asked.tables), []
    file = files.read_entrants(entrants)
    if asked.scale is not None:
        refuse_other_scale(file, asked.scale, Parameter("scale"), LEAVE_OUT, stated=True)
    else:
        refuse_levels(file, LEVELS_DOUBLE)
    scale = file.scale_by(asked.scale, SAY_WHICH)
    roster = with_starters(file.roster, scale, asked.starter, asked.starter_sd)
    if not 2 <= len(roster) <= MOST_PLAYERS:
        refuse(f"{entrants} has {len(roster):,} entrants; a tournament takes 2 to 256")
    field = ChipField(roster.players, roster.rating, scale, asked.tables, f"in {file_name(file)}")
    return field, list(file.warnings)
