"""Options of a tournament that do not go together."""

from __future__ import annotations

from typing import Any

from evenbreak.cli.kit.values import refuse
from evenbreak.tournaments.evening.opening import FORMATS_WITH


def refuse_of_other_formats(form: str, given: set[str]) -> None:
    """Refuse parts of a plan that are for other formats, or exclude each other."""
    for name, formats in FORMATS_WITH.items():
        if name in given and form not in formats:
            option = f"--{name.replace('_', '-')}"
            refuse(f"{option} is for --format {' or '.join(formats)}, not {form}")
    if {"qualifiers", "final"} <= given:
        refuse("--qualifiers leads to one final; leave out --final")
    if "placement" in given and "qualifiers" not in given:
        refuse("--placement is for qualifiers; give --qualifiers M, or leave it out")


def check_qualifiers(form: str, qualifiers: int | None) -> None:
    """Refuse a number of qualifiers that a format cannot have."""
    if qualifiers is None:
        return
    if form == "double" and (qualifiers < 2 or qualifiers & (qualifiers - 1)):
        refuse(f"--qualifiers is {qualifiers}; give 2, 4, 8 or another power of 2")
    if form == "pods" and qualifiers > 2:
        refuse(f"--qualifiers is {qualifiers}; 1 or 2 go on from a pod")


def refuse_races(chips: str | None, *races: Any) -> None:
    """Refuse a chip tournament with races, or without a chart."""
    if any(one is not None for one in races):
        refuse("a chip tournament is played by the rack; leave out the races")
    if chips is None:
        refuse("the chip chart is missing; give it with --chips, such as --chips hoboken")
