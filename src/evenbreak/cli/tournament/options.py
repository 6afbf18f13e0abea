"""What the commands of `evenbreak tournament` share: the entrants, the format, the races."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

from evenbreak import files, ratings, tournaments
from evenbreak.answers.kit.scales import chart_doubts
from evenbreak.answers.kit.systems import (
    LEVELS_DOUBLE,
    chart_by_difference,
    scale_of_list,
    with_starters,
)
from evenbreak.cli.kit.said import refuse
from evenbreak.files.charts import chip_chart_of
from evenbreak.files.lists.entrants import nobody
from evenbreak.handicaps.charts.chart import Chart
from evenbreak.questions.plan import TournamentPlan
from evenbreak.questions.tournament import NewTournament, OfEntrants, TournamentTime
from evenbreak.tournaments.evening.events import Plan
from evenbreak.tournaments.evening.format import MOST_PLAYERS
from evenbreak.tournaments.evening.plan import BYE, bracket_of, races_of
from evenbreak.words import Sentence, say

if TYPE_CHECKING:
    from evenbreak.answers.tournament.tournament import Tournament
    from evenbreak.ratings.scale import Scale
    from evenbreak.tournaments.clock.event_pace import EarlierNight


class Entered(NamedTuple):
    """What the options say: what is played, and who has entered, in the order of the file."""

    plan: Plan
    races: tournaments.Races
    file: files.RosterFile
    roster: ratings.Roster
    scale: Scale
    warnings: list[str]


def tournament_of(asked: OfEntrants, *, before_draw: bool = False) -> tuple[Tournament, list[str]]:
    """Return the tournament that is asked about, and what is doubtful about it."""
    from evenbreak.answers.tournament.tournament import Tournament

    entered = entered_in(asked)
    plan = entered.plan
    if before_draw:
        roster, seeded, lines = entered.roster, "to be drawn blind", None
    else:
        roster, seeded, lines = drawn_up(entered.roster, plan.seeding, asked.seed)
    bracket = bracket_of(plan, roster.players, None if lines is None else tuple(lines))
    to_draw = _to_draw(plan, before_draw)
    tournament = Tournament(
        entered.file, roster, bracket, entered.races, entered.scale, seeded, to_draw
    )
    return tournament, entered.warnings


def _to_draw(plan: Plan, before_draw: bool) -> str:
    """Return what of a tournament is drawn later than its odds are asked for."""
    if before_draw:
        return "lines"
    if plan.form == "swiss":
        return "rounds"
    return "qualifiers" if plan.placement == "redraw" else ""


def entered_in(asked: NewTournament | OfEntrants) -> Entered:
    """Return what is played and who has entered."""
    earlier = earlier_in(asked) if isinstance(asked, NewTournament) else ()
    races = _races(asked)
    file = nobody() if asked.entrants is None else files.read_entrants(asked.entrants)
    points, warnings = _scale(file, asked.scale, asked.starter)
    warnings += chart_doubts(races.race, points)
    roster = with_starters(file.roster, points, asked.starter, asked.starter_sd)
    if asked.entrants is not None and not 2 <= len(roster) <= MOST_PLAYERS:
        refuse(f"{asked.entrants} has {len(roster):,} entrants; a tournament takes 2 to 256")
    plan = Plan(
        asked.form,
        asked.race or asked.race_to or 1,
        **asked.of_format,
        seeding=asked.seeded,
        handicapped=asked.race_to is not None,
        chart=races.race if isinstance(races.race, Chart) else None,
        scale=points.text,
        starter=points.center if asked.starter is None else asked.starter,
        starter_error=points.points_per_doubling if asked.starter_sd is None else asked.starter_sd,
        chips=None if asked.chips is None else chip_chart_of(asked.chips),
        earlier=earlier,
        match_form=file.form,
    )
    return Entered(plan, races, file, roster, points, warnings)


def earlier_in(asked: NewTournament | TournamentTime) -> tuple[EarlierNight, ...]:
    """Return the nights at the venue that the options name."""
    from evenbreak.files.store.tournament import earlier_nights

    for place in asked.pace:
        if not Path(place).exists():
            asked.refuse(
                "{pace} is {file}, which doesn't exist. Name the file of an earlier "
                "tournament, or a folder of them.",
                file=place,
            )
    return earlier_nights(asked.pace)


def none_learned(
    asked: NewTournament | TournamentTime, earlier: Sequence[EarlierNight]
) -> list[Sentence]:
    """Return that the nights that were named say nothing of the pace, if that is so."""
    from evenbreak.tournaments.clock.event_pace import nights_of

    if not asked.pace or nights_of(asked.discipline or "", earlier):
        return []
    return [
        say(
            "{places}: no finished {game} tournament there shows how long it took, so the usual "
            "times are used",
            places=", ".join(asked.pace),
            game=asked.discipline,
        )
    ]


def _races(asked: TournamentPlan) -> tournaments.Races:
    if asked.chart is not None:
        return tournaments.Races(chart_by_difference(asked.chart))
    return races_of(
        Plan(
            "",
            asked.race or asked.race_to or 1,
            losers_race=asked.losers_race,
            final_race=asked.final_race,
            handicapped=asked.race_to is not None,
        )
    )


def _scale(
    file: files.RosterFile, stated: Scale | None, starter: float | None
) -> tuple[Scale, list[str]]:
    """Return the scale of the ratings, and what is doubtful about it."""
    from evenbreak.answers.kit.scales import far_doubts, league_doubts, starter_doubts

    scale = scale_of_list(file, stated, LEVELS_DOUBLE)
    warnings = []
    if file.scale is None:
        remedy = "If they are on another scale, name it with --scale."
        warnings += league_doubts(scale, file.roster.rating, remedy)
    else:
        warnings += far_doubts(scale, file.roster.rating)
    if starter is None:
        warnings += starter_doubts(scale, file.roster.rating)
    return scale, warnings


def drawn_up(
    roster: ratings.Roster, seeding: str, seed: int
) -> tuple[ratings.Roster, str, list[int | None] | None]:
    """Return the players in seed order, in words where it comes from, and the lines if drawn."""
    import numpy as np

    places = list(range(len(roster)))
    lines: list[int | None] | None = None
    if seeding == "listed":
        return roster, "seeded in that order", None
    if seeding == "drawn":
        order = [k for k in places if not BYE.fullmatch(roster.players[k])]
        lines = [order.index(k) if k in order else None for k in places]
        if len(lines) & (len(lines) - 1):
            refuse(
                "--seeding drawn takes 2, 4, 8, 16 ... rows, and the file has "
                f"{len(lines)}. Add rows named bye 1, bye 2 ... where the byes are."
            )
        words = "drawn in that order"
    elif seeding == "rating":
        order, words = tournaments.by_rating(places, roster.rating.tolist()), "seeded by rating"
    else:
        order = tournaments.blind_draw(places, np.random.default_rng(seed))
        words = f"drawn blind (seed {seed})"
    return (
        ratings.Roster(
            [roster.players[k] for k in order],
            roster.rating[order],
            roster.standard_error[order],
            roster.games[order],
            provisional=roster.provisional[order],
        ),
        words,
        lines,
    )
