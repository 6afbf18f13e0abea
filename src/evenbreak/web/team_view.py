"""A team night as its page shows it, in plain values, with only what the reader may see."""

from __future__ import annotations

from collections.abc import Sequence
from random import Random
from typing import Any, NamedTuple

from evenbreak.answers.team.lineup import names_words
from evenbreak.answers.team.night import cap_words
from evenbreak.teams.advice import Advice
from evenbreak.teams.evening.events import Pick, Score
from evenbreak.teams.evening.fold import TeamEvening
from evenbreak.teams.evening.moves import choices
from evenbreak.teams.sealed import SealedNight
from evenbreak.web.team_night import Advised

_RARE = 5e-4  # shares below this are not shown


class SetView(NamedTuple):
    """A set; '' and None where something is unknown.

    `hidden` is the team whose pick is in but not shown yet; `said` is each team's result.
    """

    number: int
    names: tuple[str, str]
    hidden: tuple[bool, bool]
    needs: Score | None
    score: Score | None
    said: tuple[Score | None, Score | None]


class OptionView(NamedTuple):
    """A pick that a captain can make.

    `value` has its players' positions in the squad, `worth` is the chance of winning the night with
    it, `reply` is the other side's best answer ('': none follows), `mix` is its share if both teams
    pick unseen, and `counts` is its weight under a cap.
    """

    value: str
    name: str
    worth: float | None = None
    reply: str = ""
    mix: float | None = None
    counts: str = ""


def set_views(seen: TeamEvening) -> list[SetView]:
    """Return all sets of a state, as the reader sees them."""
    return [
        SetView(
            line.number,
            (_names(line.picks[0]), _names(line.picks[1])),
            line.hidden,
            seen.needs(line) if line.named else None,
            line.score,
            line.said,
        )
        for line in seen.sets
    ]


def _names(pick: Pick) -> str:
    return names_words(pick) if pick else ""


def pick_value(state: TeamEvening, team: int, pick: Pick) -> str:
    """Return a pick as a form sends it."""
    squad = state.meeting.squads[team]
    return ",".join(str(squad.place(name)) for name in pick)


def _counts(state: TeamEvening, team: int, pick: Pick) -> str:
    """Return how much a pick counts under a cap."""
    if state.plan.cap is None and state.plan.at_most is None:
        return ""
    sheet = state.plan.teams[team]
    by_name = dict(zip(sheet.players, sheet.weights, strict=True))
    return f"{sum(by_name[name] for name in pick):g}"


def advised_options(state: TeamEvening, team: int, found: Advice) -> list[OptionView]:
    """Return what a captain can pick, best first."""
    return [
        OptionView(
            pick_value(state, team, option.names),
            names_words(option.names),
            option.worth,
            "" if found.blind else _names(option.answer),
            option.mix if found.blind else None,
            _counts(state, team, option.names),
        )
        for option in found.options
    ]


def advised_line_ups(found: SealedNight) -> list[OptionView]:
    """Return the lineups that a captain does well to submit, most frequent first."""
    played = sorted((one for one in found.ours if one.mix > _RARE), key=lambda one: -one.mix)
    return [OptionView("", ", ".join(one.names), one.worth, "", one.mix) for one in played]


def drawn(options: Sequence[OptionView], lot: str) -> OptionView | None:
    """Return the pick that a lot draws from a mixture, always the same; None without a mixture."""
    shares = [one.mix or 0.0 for one in options]
    if sum(share > _RARE for share in shares) < 2:
        return None
    return Random(lot).choices(list(options), shares)[0]  # noqa: S311 (keyed by the lot)


def drawn_line_up(found: SealedNight, squad: Sequence[str], lot: str) -> list[str]:
    """Return a lineup drawn by its share, in random order, as a form sends it."""
    chance = Random(lot)  # noqa: S311 (keyed by the lot)
    names = list(chance.choices(found.ours, [one.mix for one in found.ours])[0].names)
    chance.shuffle(names)
    return [str(squad.index(name)) for name in names]


def plain_options(state: TeamEvening, team: int) -> list[OptionView]:
    """Return what a team can pick, in its list's order."""
    return [
        OptionView(
            pick_value(state, team, pick), names_words(pick), counts=_counts(state, team, pick)
        )
        for pick in choices(state, team).picks
    ]


def captain_values(
    whole: TeamEvening, captain: int, found: Advised | None, lot: str
) -> dict[str, Any]:
    """Return what captain 0 (A) or 1 (B) sees: the advice, and the form for their choice.

    `lot` draws a pick if drawing is best.
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
