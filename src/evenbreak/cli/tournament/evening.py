"""What the commands of a tournament under way share: the file, the time, the answer."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from datetime import datetime, timedelta
from functools import update_wrapper
from pathlib import PurePath
from typing import TYPE_CHECKING, Any

import click

from evenbreak.cli.kit.options import Command, with_options
from evenbreak.cli.tournament.time import TimeOfDay

if TYPE_CHECKING:
    from evenbreak.answers.answer import Answer
    from evenbreak.tournaments.evening.events import Event, What
    from evenbreak.tournaments.evening.fold import Evening

_HALF_A_DAY = timedelta(hours=12)


def file_option(command: Command) -> Command:
    """Add --file."""
    return with_options(
        command,
        click.option(
            "--file",
            metavar="FILE.db",
            envvar="EVENBREAK_TOURNAMENT",
            default="tonight.db",
            show_default=True,
            help="The file of the tournament.",
        ),
    )


def at_option(command: Command) -> Command:
    """Add --at, which the command gets as `at`: a time such as 2025-03-01T19:30:00."""

    def run(*, at: int | None, file: str | None = None, **rest: Any) -> Any:
        moment = datetime.now().replace(microsecond=0)
        if at is not None:
            moment = _near(moment if file is None else _last(file), at, same_day=file is None)
        if file is not None:
            rest["file"] = file
        return command(at=moment.isoformat(), **rest)

    wrapped: Any = update_wrapper(run, command)
    return with_options(  # type: ignore[no-any-return]
        wrapped,
        click.option(
            "--at",
            metavar="HH:MM",
            type=TimeOfDay(),
            help="When it happened.  [default: now]",
        ),
    )


def _last(file: str) -> datetime:
    """Return when something happened last."""
    from evenbreak.files.tournament_store import read_events

    return datetime.fromisoformat(read_events(file)[-1].at)


def _near(reference: datetime, at: int, *, same_day: bool) -> datetime:
    """Return the moment of a time of day, in minutes, that is nearest to another moment.

    >>> _near(datetime(2025, 3, 1, 23, 50), 15, same_day=False)
    datetime.datetime(2025, 3, 2, 0, 15)
    """
    moment = reference.replace(hour=at // 60, minute=at % 60, second=0)
    if same_day or abs(moment - reference) <= _HALF_A_DAY:
        return moment
    return moment + timedelta(days=1 if moment < reference else -1)


def add(file: str, at: str, decide: Callable[[Evening], Sequence[What]]) -> tuple[Evening, Evening]:
    """Add what a function decides to the file, and return the state before and after."""
    from evenbreak.files.tournament_store import add_events
    from evenbreak.tournaments.evening.events import Event

    def events(state: Evening) -> list[Event]:
        return [Event(at, what) for what in decide(state)]

    return add_events(file, events)


def answer_of(file: str, state: Evening, at: str, said: Sequence[str] = ()) -> Answer:
    """Return the answer: what happened, what is played next, the odds, when it ends."""
    from evenbreak.answers.tournament_night import Night, night_answer

    return night_answer(Night(state, at), said, source=PurePath(file).name)
