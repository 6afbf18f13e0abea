"""A finished tournament as a site shows it, under public names."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import NamedTuple

from evenbreak.answers.tournament.bracket_view import Box, Panel, bracket_panels
from evenbreak.site.names import PublicNames, file_names
from evenbreak.tournaments.evening.fold import Evening


class Tournament(NamedTuple):
    """A finished tournament under public names: its file, title, day, players and bracket."""

    file: str
    title: str
    day: str
    players: int
    won_by: str
    panels: Sequence[Panel]


def tournament_of(name: str, state: Evening, names: PublicNames) -> Tournament | None:
    """Return a tournament under public names; None unless it is over and has a bracket.

    The tournament's guests are named by the strictest rule.
    """
    if not state.drawn or state.plan.form == "chips" or state.standing.to_play:
        return None

    def public(box: Box) -> Box:
        first, second = (
            one._replace(text=names[one.text] if one.known else str(one.text)) for one in box.lines
        )
        return replace(box, lines=(first, second))

    panels = [
        replace(panel, boxes=tuple(map(public, panel.boxes))) for panel in bracket_panels(state)
    ]
    finals = [
        state.counted[match.name].winner
        for match in state.bracket.matches
        if match.side in ("final", "second final") and match.name in state.counted
    ]
    title = " ".join(name.replace("_", " ").replace("-", " ").split())
    title = title[:1].upper() + title[1:]
    file = next(iter(file_names([title]).values()))
    day = state.events[0].at[:10]
    won_by = names[finals[-1]] if finals else ""
    return Tournament(f"tournament-{file}.html", title, day, len(state.order), won_by, panels)
