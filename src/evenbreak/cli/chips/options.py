"""What the commands of `evenbreak chips` share: who plays, on how many tables, which chart."""

from __future__ import annotations

from functools import update_wrapper
from typing import TYPE_CHECKING, Any

import click

from evenbreak.cli.kit.options import (
    OF_LIST,
    SAY_WHICH,
    Command,
    scale_option,
    seed_option,
    with_options,
)
from evenbreak.cli.kit.starters import starter_options, with_starters
from evenbreak.cli.kit.systems import refuse_levels, refuse_other_scale
from evenbreak.cli.kit.values import Whole, refuse
from evenbreak.tournaments.evening.format import MOST_PLAYERS

if TYPE_CHECKING:
    from evenbreak.answers.chips import ChipField
    from evenbreak.ratings.scale import Scale


def field_options(command: Command) -> Command:
    """Add the options about the players; the command gets `field`, `warnings` and `seed`.

    The command has an argument or option `entrants`, None where the field is made up.
    """

    def run(
        *,
        entrants: str | None,
        tables: int,
        scale: Scale | None,
        starter: float | None,
        starter_sd: float | None,
        **rest: Any,
    ) -> Any:
        field, warnings = _field(entrants, tables, scale, starter, starter_sd)
        return command(field=field, warnings=warnings, **rest)

    wrapped: Any = update_wrapper(run, command)
    wrapped = seed_option("The seed of the simulation.", default=0)(wrapped)
    wrapped = starter_options(wrapped)
    return with_options(  # type: ignore[no-any-return]
        wrapped,
        scale_option(f"{OF_LIST}; without a file, fargo", fixed=False),
        click.option(
            "--tables",
            type=Whole(1, 1000),
            metavar="T",
            default=4,
            show_default=True,
            help="The number of tables.",
        ),
    )


def _field(
    entrants: str | None,
    tables: int,
    stated: Scale | None,
    starter: float | None,
    starter_sd: float | None,
) -> tuple[ChipField, list[str]]:
    from evenbreak import files, ratings
    from evenbreak.answers.chips import ChipField, spread_field
    from evenbreak.answers.kit.remarks import file_name

    if entrants is None:
        return spread_field(stated or ratings.SCALES["fargo"], tables), []
    file = files.read_entrants(entrants)
    if stated is not None:
        refuse_other_scale(
            file, stated, "--scale", "leave --scale out, or correct the file", stated=True
        )
    else:
        refuse_levels(file, "say with --scale how many levels double the odds")
    scale = file.scale_by(stated, SAY_WHICH)
    roster = with_starters(file.roster, scale, starter, starter_sd)
    if not 2 <= len(roster) <= MOST_PLAYERS:
        refuse(f"{entrants} has {len(roster):,} entrants; a tournament takes 2 to 256")
    field = ChipField(roster.players, roster.rating, scale, tables, f"in {file_name(file)}")
    return field, list(file.warnings)
