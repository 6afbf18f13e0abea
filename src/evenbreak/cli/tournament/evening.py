"""What the commands of a tournament under way share: the file, the time, the answer."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from datetime import datetime, timedelta
from pathlib import Path, PurePath
from typing import TYPE_CHECKING

from evenbreak.cli.kit.said import refuse
from evenbreak.questions.evening import TimedUnderWay

if TYPE_CHECKING:
    from evenbreak.answers.kit.answer import Answer
    from evenbreak.tournaments.evening.events import What
    from evenbreak.tournaments.evening.fold import Evening
    from evenbreak.tournaments.evening.outlook import Outlook

_HALF_A_DAY = timedelta(hours=12)


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


def add(
    asked: TimedUnderWay, decide: Callable[[Evening], Sequence[What]]
) -> tuple[Evening, Evening]:
    """Add what a function decides to the file, and return the state before and after.

    What takes away a match in play or a result besides is refused, unless the question says that
    it is meant.
    """
    from evenbreak.answers.tournament.moves import lost_words
    from evenbreak.files.store.tournament import add_events
    from evenbreak.tournaments.evening.events import Event

    at = moment(asked.at, asked.path)

    def events(state: Evening) -> list[Event]:
        return [Event(at, what) for what in decide(state)]

    def check(before: Evening, after: Evening) -> None:
        meant = getattr(asked, "yes", False) or getattr(asked, "follow", None)
        lost = [] if meant else lost_words(before, after)
        if lost:
            refuse(
                f"nothing has been entered yet. {' '.join(lost)} "
                "If that's what you want, add --yes."
            )

    return add_events(asked.path, events, event=asked.event, check=check)


def answer_of(asked: TimedUnderWay, state: Evening, said: Sequence[str] = ()) -> Answer:
    """Return the answer: what happened, what is played next, the odds, when it ends."""
    return night_of(asked.path, state, moment(asked.at, asked.path), said)


def night_of(file: str, state: Evening, at: str, said: Sequence[str] = ()) -> Answer:
    """Return the same of the tournament in a file, at a time such as 2025-03-01T19:30:00."""
    from evenbreak.answers.tournament.night import night_answer
    from evenbreak.tournaments.evening.outlook import Outlook

    return night_answer(Outlook(state, at), said, source=PurePath(file).name)


def outlook_of(file: str, at: str, event: int = 1) -> Outlook:
    """Return what is to be expected of the tournament in a file; refuse one without a draw."""
    from evenbreak.files.store.tournament import read_tournament
    from evenbreak.tournaments.evening.outlook import Outlook

    if not Path(file).exists():
        refuse(
            "name a list of entrants, such as entrants.csv; there's no tournament under "
            f"way in {file}"
        )
    outlook = Outlook(read_tournament(file, event), at)
    _ = outlook.state.bracket
    return outlook
