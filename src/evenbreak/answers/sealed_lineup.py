"""Line-ups handed in before the night: who should play."""

from __future__ import annotations

from collections.abc import Sequence

from evenbreak.answers.answer import Answer
from evenbreak.answers.parts import Column, Quantities, Quantity, Table
from evenbreak.answers.scale_words import scale_words
from evenbreak.answers.team_meeting import cost_words, race_words
from evenbreak.answers.wording import chance, count_of, listed, percent
from evenbreak.teams.meeting import Meeting
from evenbreak.teams.sealed import SealedLineUp, SealedNight, sealed

_LISTED = 10


def sealed_answer(
    meeting: Meeting, warnings: Sequence[str], solution: SealedNight | None = None
) -> Answer:
    """Return whom to write on a line-up that the other team does not see.

    Parameters
    ----------
    meeting
        who meets whom, and what is played.
    warnings
        about the question.
    solution
        of the night, if it is known.

    >>> from evenbreak.ratings import SCALES, Roster
    >>> from evenbreak.teams import Squad
    >>> us, them = Roster(["Ann", "Bo"], [600, 500]), Roster(["Cy"], [560])
    >>> squads = Squad(us.players), Squad(them.players)
    >>> meeting = Meeting(us, them, squads, 5, SCALES["fargo"], (1,), "sealed")
    >>> print(sealed_answer(meeting, ()).sentences[0])
    Play Ann, in an order drawn at random: you win the night 67% of the time, whatever they do.
    """
    found = solution or sealed(meeting.night())
    played = [one for one in found.ours if one.mix > 5e-4]
    if len(played) == 1:
        words = f"Play {listed(list(played[0].names))}, in an order drawn at random"
    else:
        words = "Draw one of the line-ups below by its share, and its order at random"
    columns = [
        Column("name"),
        Column("sits_out", "sits out", left=True),
        Column("p_win", "you win\nthe night", chance),
        Column("cost", "worse than\nthe best by", cost_words),
        Column("mix", "hand it in", percent),
    ]
    listing = found.ours[:_LISTED]
    rows = [
        [
            ", ".join(one.names),
            ", ".join(name for name in meeting.ours.players if name not in one.names) or "nobody",
            one.worth,
            max(0.0, found.worth - one.worth),
            one.mix,
        ]
        for one in listing
    ]
    left = len(found.ours) - len(listing)
    more = f" {count_of(left, 'more line-up')} not listed." if left else ""
    table = Table("options", columns, rows)
    return Answer(
        f"Sealed line-ups of {count_of(len(meeting.sizes), 'set')}: {len(meeting.ours)} players "
        f"against {len(meeting.theirs)}, {race_words(meeting.race)}\nRatings "
        f"{scale_words(meeting.scale)}",
        [
            f"{words}: you win the night {percent(found.worth)} of the time, whatever they do.",
            Quantities([Quantity("p_win", found.worth), Quantity("best", _best(found.ours))]),
            table,
            f"Against a random order, every order of theirs is worth the same.{more}",
        ],
        data={"toss": None, "blind": True, "ours": True, "set": 1},
        warnings=warnings,
        csv=table,
    )


def _best(line_ups: Sequence[SealedLineUp]) -> str:
    return ", ".join(line_ups[0].names)
