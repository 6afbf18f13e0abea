"""What a team night's page shows to a captain alone."""

from __future__ import annotations

from typing import Any

from evenbreak.answers.team.night import cap_words
from evenbreak.teams.advice import Advice
from evenbreak.teams.evening.fold import TeamEvening
from evenbreak.teams.sealed import SealedNight
from evenbreak.web.team_night import Advised
from evenbreak.web.team_view import (
    OptionView,
    advised_line_ups,
    advised_options,
    drawn,
    drawn_line_up,
    pick_value,
    plain_options,
)


def captain_values(
    whole: TeamEvening, captain: int, found: Advised | None, lot: str
) -> dict[str, Any]:
    """Return what a captain sees: the advice, and the form in which they choose.

    Parameters
    ----------
    whole
        the state of the night, with all picks.
    captain
        whose: 0 for team A, 1 for B.
    found
        the advice; None: not known yet.
    lot
        by which a pick is drawn, where it is best to draw.
    """
    state = whole.seen_by(captain)
    line = state.to_name
    own = line.picks[captain] if line else ()
    handed_in = bool(own) and line is not None and state.unseen(line.number)
    may_pick = line is not None and (captain in whole.due or handed_in)
    options: list[OptionView] = []
    chosen, lots = pick_value(state, captain, own), None
    line_up = [pick_value(state, captain, one.picks[captain]) for one in state.sets]
    match found.found if found else None:
        case SealedNight() as sealed:
            options = advised_line_ups(sealed)
            if not own:
                line_up = drawn_line_up(sealed, state.plan.teams[captain].players, lot)
        case Advice() as advised if may_pick:
            options = advised_options(state, captain, advised)
            lots = drawn(options, lot)
            chosen = chosen or (lots or options[0]).value
        case _ if may_pick and not state.sealed:
            options = plain_options(state, captain)
    return {
        "line": line,
        "may_pick": may_pick,
        "handed_in": handed_in,
        "named": bool(own),
        "chosen": chosen,
        "lots": lots,
        "options": options,
        "words": found.answer.sentences[0] if found else "",
        "working": bool(whole.due) and found is None,
        "caps": cap_words(state, captain),
        "line_up": line_up,
        "squad": state.plan.teams[captain].players,
    }
