"""When tonight's tournament ends, and when each match starts."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

from evenbreak.answers.answer import Answer
from evenbreak.answers.finish_words import finish_luck, finish_quantities
from evenbreak.answers.form_words import form_used_words
from evenbreak.answers.parts import Column, Part, Quantity, Table
from evenbreak.answers.times_of_day import ends_words, time_of_day
from evenbreak.answers.tournament import Tournament, pair_words
from evenbreak.answers.tournament_what_if import savings, savings_words, what_if
from evenbreak.answers.wording import clock, count_of, percent
from evenbreak.matches.pace import Pace, Turnover
from evenbreak.tournaments.clock.finish import Finish, finish
from evenbreak.tournaments.odds.races import Races


def tournament_time_answer(
    tournament: Tournament,
    *,
    tables: int,
    pace: Pace | str,
    turnover: Turnover | None = None,
    start: int | None = None,
    seed: int = 0,
    warnings: Sequence[str] = (),
) -> Answer:
    """Return when a tournament ends and when each of its matches starts.

    Parameters
    ----------
    tournament
        who plays what.
    tables
        how many tables there are.
    pace
        how long matches take: a discipline, at its usual pace, or a pace.
    turnover
        the time between two matches on a table; None: as in real events.
    start
        when it starts, in minutes after midnight; None: times are minutes from the start.
    seed
        of the evenings that are simulated.
    warnings
        about the question.

    >>> import numpy as np
    >>> from evenbreak.files.lists.roster import RosterFile
    >>> from evenbreak.ratings import SCALES, Roster
    >>> from evenbreak.tournaments import Races, double_elimination
    >>> club = Roster(["Ann", "Bo", "Cy", "Di"], [640, 600, 560, 520])
    >>> file = RosterFile(club, np.arange(2, 6), "club.csv", (), "")
    >>> asked = double_elimination(club.players), Races(5), SCALES["fargo"], "as listed"
    >>> tonight = Tournament(file, club, *asked)
    >>> answer = tournament_time_answer(tonight, tables=2, pace="9-ball", start=19 * 60)
    >>> print(answer.sentences[0].splitlines()[0])
    It ends at about 22:05; 8 times out of 10 between 21:19 and 23:06.
    """
    asked: Any = {"pace": pace, "turnover": turnover, "seed": seed}
    form = tournament.file.form
    laws_now = tournament.laws_of(tournament.races, form=form)
    found = finish(tournament.bracket, laws_now, tables=tables, **asked)
    show = clock if start is None else (lambda minutes: time_of_day(start + minutes))

    def ask(tables: int, races: Races) -> Finish:
        laws = laws_now if races is tournament.races else tournament.laws_of(races, form=form)
        return finish(tournament.bracket, laws, tables=tables, **asked)

    changes = what_if(found, ask, tournament.bracket, tables, tournament.races)
    saved = (Quantity(f"minutes_saved_{what}", by) for what, by in savings(changes).items())
    quantities = finish_quantities(found.finishes, *saved)
    table = starts_table(found, show)
    when = _takes(found) if start is None else ends_words(*(start + at for at in found.bands))
    words = "\n".join(filter(None, [when, savings_words(changes)]))
    parts: list[Part] = [words, quantities, table, changes]
    assumed = assumed_words(tables, pace, turnover)
    unrated = tournament.unrated_words(spread=False)
    form_words = form_used_words(form, tournament.scale)
    lines = [tournament.byes, unrated, assumed, form_words, finish_luck(found.finishes)]
    parts += filter(None, lines)
    return Answer(
        tournament.heading,
        parts,
        warnings=[*tournament.file.warnings, *warnings],
        csv=table,
    )


def _takes(found: Finish) -> str:
    early, middle, late = map(clock, found.bands)
    return f"It takes about {middle}; 8 times out of 10 between {early} and {late}."


def starts_table(found: Finish, show: Callable[[float], str]) -> Table:
    """Return when each match still to be played starts, soonest first."""
    columns = [
        Column("match", "match", left=True),
        Column(("player_1", "player_2"), "between", " - ".join, left=True),
        Column("start_p50", "starts\nabout", show),
        Column(
            ("start_p10", "start_p90"),
            "8 times out of 10\nbetween",
            lambda band: "" if band[0] == band[1] else f"{show(band[0])} and {show(band[1])}",
        ),
        Column("p_played", "is\nneeded", percent),
    ]
    rows: list[list[Any]] = []
    for name in found.names:
        players = pair_words(found.standing, name)
        early, middle, late, played = found.start(name)
        if played:  # some of a consolation event never are
            rows.append([name, players, middle, (early, late), played])
    rows.sort(key=lambda row: row[2])
    return Table("matches", columns, rows)


def assumed_words(tables: int, pace: Pace | str, turnover: Turnover | None) -> str:
    """Return what the times assume."""
    of_games = (
        f"Matches take as long as {pace} matches do in real tournaments"
        if isinstance(pace, str)
        else f"A game takes {pace.per_game:g} minutes on average"
    )
    between = "about 4 minutes" if turnover is None else f"{turnover.mean:g} minutes on average"
    return (
        f"{of_games}, on {count_of(tables, 'table')}, with {between} between two matches on a "
        "table. As on most evenings, a round starts when the rounds that feed it are over; of the "
        "matches that can start, the one with the longest way to the end goes first. Matches that "
        "are called sooner, as soon as both players and a table are free, gain time on this."
    )
