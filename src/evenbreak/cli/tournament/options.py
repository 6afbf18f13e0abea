"""What the commands of `evenbreak tournament` share: the entrants, the format, the races."""

from __future__ import annotations

from functools import update_wrapper
from typing import TYPE_CHECKING, Any, NamedTuple

import click

from evenbreak import files, ratings, tournaments
from evenbreak.answers.kit.scales import chart_doubts
from evenbreak.cli.kit.options import (
    OF_LIST,
    SAY_WHICH,
    Command,
    chart_option,
    scale_option,
    seed_option,
    with_options,
)
from evenbreak.cli.kit.starters import starter_options, with_starters
from evenbreak.cli.kit.systems import chart_by_difference, refuse_levels, refuse_other_scale
from evenbreak.cli.kit.values import Whole, refuse
from evenbreak.cli.tournament.checked_options import (
    check_qualifiers,
    refuse_of_other_formats,
    refuse_races,
)
from evenbreak.files.charts import chip_chart_of
from evenbreak.handicaps.charts.chart import Chart
from evenbreak.tournaments.evening.bracket_of_plan import bracket_of
from evenbreak.tournaments.evening.events import Plan
from evenbreak.tournaments.evening.fold import ELIMINATIONS
from evenbreak.tournaments.evening.opening import (
    BYE,
    FORMATS,
    LONGEST_RACE,
    MOST_PLAYERS,
    usual_seeding,
)
from evenbreak.tournaments.evening.races_of_plan import races_of

if TYPE_CHECKING:
    from evenbreak.answers.tournament.tournament import Tournament
    from evenbreak.ratings.scale import Scale

DROPS = {"fewest-rematches": "fewest rematches", "usual": "usual", "straight": "straight"}
PLACEMENTS = {"half-shift": "half shift", "redraw": "redraw"}
SEEDINGS = ("listed", "rating", "blind", "drawn")


def _race_option(name: str, what: str) -> Any:
    return click.option(name, type=Whole(1, LONGEST_RACE), metavar="N", help=what)


class Entered(NamedTuple):
    """What the options say: what is played, and who has entered, in the order of the file."""

    plan: Plan
    races: tournaments.Races
    file: files.RosterFile
    roster: ratings.Roster
    scale: Scale
    warnings: list[str]
    seed: int


def tournament_options(command: Command) -> Command:
    """Add the options about the tournament, which the command gets as `tournament`.

    It also gets the `warnings` about them, and `seed`.
    """

    def run(*, entered: Entered, before_draw: bool = False, **rest: Any) -> Any:
        from evenbreak.answers.tournament.tournament import Tournament

        plan, file, scale = entered.plan, entered.file, entered.scale
        if plan.form == "chips":
            refuse(
                "for a chip tournament before its first rack, ask evenbreak chips odds; for one "
                "under way leave out ENTRANTS.csv"
            )
        if before_draw:
            _refuse_drawn(plan)
            roster, seeded, lines = entered.roster, "to be drawn blind", None
        else:
            roster, seeded, lines = drawn_up(entered.roster, plan.seeding, entered.seed)
        if lines is not None and plan.form not in ELIMINATIONS:
            refuse(f"--seeding drawn is for eliminations, not {plan.form}")
        bracket = bracket_of(plan, roster.players, None if lines is None else tuple(lines))
        tournament: Tournament = Tournament(
            file, roster, bracket, entered.races, scale, seeded, _to_draw(plan, before_draw)
        )
        return command(tournament=tournament, warnings=entered.warnings, seed=entered.seed, **rest)

    wrapped: Any = update_wrapper(run, command)
    return entry_options(wrapped, required=False)  # type: ignore[no-any-return]


def _refuse_drawn(plan: Plan) -> None:
    if plan.seeding not in ("listed", "blind"):
        refuse(f"--before-draw is for a blind draw; leave out --seeding {plan.seeding}")
    if plan.form in ("round-robin", "swiss"):
        refuse(f"--before-draw is for formats with a draw, not {plan.form}")
    if plan.placement == "redraw":
        refuse("--before-draw takes --placement half-shift, not redraw")


def _to_draw(plan: Plan, before_draw: bool) -> str:
    """Return what of a tournament is drawn later than its odds are asked for."""
    if before_draw:
        return "lines"
    if plan.form == "swiss":
        return "rounds"
    return "qualifiers" if plan.placement == "redraw" else ""


def entry_options(command: Command, *, required: bool = True) -> Command:
    """Add the options about the tournament, which the command gets as `entered`.

    Parameters
    ----------
    command
        the command.
    required
        whether ENTRANTS.csv must be named.
    """

    def run(
        *,
        entrants: str,
        form: str,
        final: str | None,
        qualifiers: int | None,
        placement: str | None,
        drops: str | None,
        groups: int | None,
        pod_size: int | None,
        rounds: int | None,
        third_place: bool,
        seeding: str | None,
        race: int | None,
        race_to: int | None,
        chart: str | None,
        losers_race: int | None,
        final_race: int | None,
        chips: str | None,
        scale: Scale | None,
        starter: float | None,
        starter_sd: float | None,
        seed: int,
        **rest: Any,
    ) -> Any:
        if form == "chips":
            refuse_races(chips, race, race_to, chart, losers_race, final_race)
            race = 1
        races = _races(race, race_to, chart, losers_race, final_race)
        given = {
            "final": final,
            "qualifiers": qualifiers,
            "placement": placement,
            "drops": drops,
            "groups": groups,
            "pod_size": pod_size,
            "rounds": rounds,
            "third_place": third_place or None,
            "losers_race": losers_race,
            "final_race": final_race,
            "chips": chips,
        }
        refuse_of_other_formats(form, {name for name, value in given.items() if value is not None})
        check_qualifiers(form, qualifiers)
        file = files.read_entrants(entrants)
        points, warnings = _scale(file, scale, starter)
        warnings += chart_doubts(races.race, points)
        roster = with_starters(file.roster, points, starter, starter_sd)
        if not 2 <= len(roster) <= MOST_PLAYERS:
            refuse(f"{entrants} has {len(roster):,} entrants; a tournament takes 2 to 256")
        usual = race or race_to
        plan = Plan(
            form,
            usual or 1,
            final=final or "true",
            qualifiers=qualifiers,
            placement=PLACEMENTS[placement or "half-shift"],
            drops=DROPS[drops or "fewest-rematches"],
            groups=groups,
            pod_size=pod_size or 8,
            rounds=rounds,
            third_place=third_place,
            seeding=seeding or usual_seeding(form),
            losers_race=losers_race,
            final_race=final_race,
            handicapped=race_to is not None,
            chart=races.race if isinstance(races.race, Chart) else None,
            scale=points.text,
            starter=points.centre if starter is None else starter,
            starter_error=points.points_per_doubling if starter_sd is None else starter_sd,
            chips=None if chips is None else chip_chart_of(chips),
        )
        entered = Entered(plan, races, file, roster, points, warnings, seed)
        return command(entered=entered, **rest)

    wrapped: Any = update_wrapper(run, command)
    wrapped = seed_option("The seed of the draw, and of what is simulated.", default=0)(wrapped)
    wrapped = starter_options(wrapped)
    return with_options(  # type: ignore[no-any-return]
        wrapped,
        scale_option(OF_LIST, fixed=False),
        click.option(
            "--chips",
            metavar="NAME|FILE.csv",
            help="The chips at the start of a chip tournament: hoboken, pharaohs, or a file with "
            "the columns rating_from and chips.",
        ),
        chart_option("Races by this chart, instead of --race."),
        _race_option("--final-race", "Races of the final.  [default: as --race or --race-to]"),
        _race_option(
            "--losers-race", "Races on the losers' side.  [default: as --race or --race-to]"
        ),
        _race_option(
            "--race-to",
            "Handicapped races, instead of --race: the stronger player needs N games, the weaker "
            "as many as is fairest.",
        ),
        _race_option("--race", "Even races to N games."),
        click.option(
            "--seeding",
            type=click.Choice(SEEDINGS),
            help="The order of the seeds: as the file lists them, by rating, or drawn at random "
            "(blind). Or no seeds (drawn): the first two rows of the file meet, and so on, with "
            "rows named bye 1, bye 2 ... for byes.  [default: listed; for the line of a chip "
            "tournament blind]",
        ),
        click.option(
            "--third-place", is_flag=True, help="Single elimination with a match for third place."
        ),
        click.option(
            "--rounds",
            type=Whole(1, MOST_PLAYERS),
            metavar="N",
            help="The rounds of a Swiss.  [default: as many as a single elimination has]",
        ),
        click.option(
            "--pod-size",
            type=Whole(4, 16),
            metavar="N",
            help="The lines of a pod: 4, 8 or 16.  [default: 8]",
        ),
        click.option(
            "--groups",
            type=Whole(1, MOST_PLAYERS),
            metavar="N",
            help="The number of groups.  [default: groups of 4, or of 3 and 4]",
        ),
        click.option(
            "--drops",
            type=click.Choice(list(DROPS)),
            help="Where losers of the winners' side drop to, in a double elimination or in pods.  "
            "[default: fewest-rematches]",
        ),
        click.option(
            "--placement",
            type=click.Choice(list(PLACEMENTS)),
            help="How the losers' side's qualifiers meet the winners' side's: the halves crossed, "
            "or drawn.  [default: half-shift]",
        ),
        click.option(
            "--qualifiers",
            type=Whole(1, MOST_PLAYERS),
            metavar="M",
            help="Double elimination down to M players, half from each side, then single. Or how "
            "many go on from each group (2 unless given) or pod (1 or 2; 1 unless given).",
        ),
        click.option(
            "--final",
            type=click.Choice(["true", "single"]),
            help="The final of a double elimination: must the undefeated player lose twice "
            "(true), or once (single)?  [default: true]",
        ),
        click.option(
            "--format",
            "form",
            type=click.Choice(FORMATS),
            default="double",
            help="The kind of tournament. For the odds of chips before the first rack, see "
            "evenbreak chips.",
        ),
        click.argument(
            "entrants", metavar="ENTRANTS.csv" if required else "[ENTRANTS.csv]", required=required
        ),
    )


def _races(
    race: int | None,
    race_to: int | None,
    chart: str | None,
    losers_race: int | None,
    final_race: int | None,
) -> tournaments.Races:
    given = [value for value in (race, race_to, chart) if value is not None]
    if len(given) != 1:
        wanted = "give one of --race N, --race-to N and --chart NAME"
        refuse(f"{'the races are missing' if not given else 'the races are given twice'}; {wanted}")
    if chart is not None:
        if losers_race is not None or final_race is not None:
            refuse("--chart sets all races; leave out --losers-race and --final-race")
        return tournaments.Races(chart_by_difference("--chart", chart))
    return races_of(
        Plan(
            "",
            race or race_to or 1,
            losers_race=losers_race,
            final_race=final_race,
            handicapped=race_to is not None,
        )
    )


def _scale(
    file: files.RosterFile, stated: Scale | None, starter: float | None
) -> tuple[Scale, list[str]]:
    """Return the scale of the ratings, and what is doubtful about it."""
    from evenbreak.answers.kit.scales import far_doubts, league_doubts, starter_doubts

    if stated is not None:
        refuse_other_scale(
            file, stated, "--scale", "leave --scale out, or correct the file", stated=True
        )
    else:
        refuse_levels(file, "say with --scale how many levels double the odds")
    scale = file.scale_by(stated, SAY_WHICH)
    warnings = []
    if file.scale is None:
        remedy = "if they are on another scale, name it with --scale"
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
                f"--seeding drawn takes 2, 4, 8, 16 ... rows, and the file has {len(lines)}; add "
                "rows named bye 1, bye 2 ... where the byes are"
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
        ),
        words,
        lines,
    )
