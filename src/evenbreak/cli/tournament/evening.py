"""What the commands of a tournament under way share: the file, the time, the answer."""

from __future__ import annotations

import os
from collections.abc import Callable, Sequence
from datetime import datetime, timedelta
from functools import update_wrapper
from pathlib import Path, PurePath
from typing import TYPE_CHECKING, Any

import click

from evenbreak.cli.kit.options import Command, with_options
from evenbreak.cli.kit.values import refuse
from evenbreak.cli.tournament.times import TimeOfDay

if TYPE_CHECKING:
    from evenbreak.answers.kit.answer import Answer
    from evenbreak.questions.tournament import OfEntrants
    from evenbreak.tournaments.evening.events import Event, What
    from evenbreak.tournaments.evening.fold import Evening
    from evenbreak.tournaments.evening.outlook import Outlook

_HALF_A_DAY = timedelta(hours=12)
_AT = "When it happened.  [default: now]"


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
        if file is not None:
            rest["file"] = file
        return command(at=moment(at, file), **rest)

    wrapped: Any = update_wrapper(run, command)
    return with_options(  # type: ignore[no-any-return]
        wrapped,
        click.option(
            "--at",
            metavar="HH:MM",
            type=TimeOfDay(),
            help=_AT,
        ),
    )


def file_of(asked: OfEntrants) -> str:
    """Return the file of the tournament under way."""
    return asked.file or os.environ.get("EVENBREAK_TOURNAMENT") or "tonight.db"


def moment(at: int | None, file: str | None = None) -> str:
    """Return a time of day, in minutes, as a time such as 2025-03-01T19:30:00; None: now."""
    when = datetime.now().replace(microsecond=0)
    if at is not None:
        when = _near(when if file is None else _last(file), at, same_day=file is None)
    return when.isoformat()


def _last(file: str) -> datetime:
    """Return when something happened last."""
    from evenbreak.files.store.tournament import read_events

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


def yes_option(command: Command) -> Command:
    """Add --yes, without which nothing is entered that takes away a match in play or a result."""
    return with_options(
        command,
        click.option(
            "--yes",
            is_flag=True,
            help="Enter it even if a match in play leaves its table, or a result no longer counts.",
        ),
    )


def add(
    file: str, at: str, decide: Callable[[Evening], Sequence[What]], *, yes: bool = False
) -> tuple[Evening, Evening]:
    """Add what a function decides to the file, and return the state before and after.

    What takes away a match in play or a result besides is refused, unless `yes` says that it is
    meant.
    """
    from evenbreak.answers.tournament.moves import lost_words
    from evenbreak.files.store.tournament import add_events
    from evenbreak.tournaments.evening.events import Event

    def events(state: Evening) -> list[Event]:
        return [Event(at, what) for what in decide(state)]

    def check(before: Evening, after: Evening) -> None:
        lost = [] if yes else lost_words(before, after)
        if lost:
            refuse(f"nothing was entered yet. {' '.join(lost)} Give --yes if that is meant")

    return add_events(file, events, check=check)


def answer_of(file: str, state: Evening, at: str, said: Sequence[str] = ()) -> Answer:
    """Return the answer: what happened, what is played next, the odds, when it ends."""
    from evenbreak.answers.tournament.night import night_answer
    from evenbreak.tournaments.evening.outlook import Outlook

    return night_answer(Outlook(state, at), said, source=PurePath(file).name)


def outlook_of(file: str, at: str) -> Outlook:
    """Return what is to be expected of the tournament in a file; refuse one without a draw."""
    from evenbreak.files.store.tournament import read_tournament
    from evenbreak.tournaments.evening.outlook import Outlook

    if not Path(file).exists():
        refuse(
            f"name a list of entrants, such as entrants.csv; there is no tournament under way in "
            f"{file}"
        )
    outlook = Outlook(read_tournament(file), at)
    _ = outlook.state.bracket
    return outlook
