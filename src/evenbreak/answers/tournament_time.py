"""When tonight's tournament ends, and when each match starts."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

from evenbreak.answers.answer import Answer
from evenbreak.answers.form_words import form_used_words
from evenbreak.answers.parts import Column, Part, Quantities, Quantity, Table
from evenbreak.answers.tournament import Tournament, slot_words
from evenbreak.answers.wording import clock, count_of, percent
from evenbreak.matches.pace import Pace, Turnover
from evenbreak.tournaments.clock.finish import Finish, finish, minutes_later

_DAY = 24 * 60
_WORTH_SAYING = 10.0  # minutes
_CHANGES = {
    "one_more_table": "With one more table",
    "races_one_shorter": "With all races one game shorter",
}


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
    >>> from evenbreak.files.roster import RosterFile
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
    laws = tournament.laws_of(tournament.races, form=form)
    found = finish(tournament.bracket, laws, tables=tables, **asked)
    show = clock if start is None else _time_of_day(start)
    more_tables = finish(tournament.bracket, laws, tables=tables + 1, **asked)
    savings = {"one_more_table": minutes_later(found, more_tables)[0]}
    if (shorter := tournament.shorter_races) is not None:
        laws = tournament.laws_of(shorter, form=form)
        other = finish(tournament.bracket, laws, tables=tables, **asked)
        savings["races_one_shorter"] = minutes_later(found, other)[0]
    early, middle, late = found.bands
    quantities = Quantities(
        [
            Quantity("finish_p10", early),
            Quantity("finish_p50", middle),
            Quantity("finish_p90", late),
            *(Quantity(f"minutes_saved_{what}", saved) for what, saved in savings.items()),
        ]
    )
    table = _table(tournament, found, show)
    parts: list[Part] = [_in_words(found, savings, show, timed=start is not None)]
    parts += [quantities, table]
    parts += filter(
        None,
        [
            tournament.byes,
            _assumed(tables, pace, turnover),
            form_used_words(form, tournament.scale),
        ],
    )
    return Answer(
        tournament.heading,
        parts,
        warnings=[*tournament.file.warnings, *warnings],
        csv=table,
    )


def _time_of_day(start: int) -> Callable[[float], str]:
    def show(minutes: float) -> str:
        moment = (start + round(minutes)) % _DAY
        return f"{moment // 60}:{moment % 60:02d}"

    return show


def _table(tournament: Tournament, found: Finish, show: Callable[[float], str]) -> Table:
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
    bracket = tournament.bracket
    rows: list[list[Any]] = []
    for name in found.names:
        players = tuple(slot_words(bracket, slot) for slot in bracket.by_name[name].slots)
        early, middle, late, played = found.start(name)
        if played:  # some of a consolation event never are
            rows.append([name, players, middle, (early, late), played])
    rows.sort(key=lambda row: row[2])
    return Table("matches", columns, rows)


def _in_words(
    found: Finish, savings: dict[str, float], show: Callable[[float], str], *, timed: bool
) -> str:
    early, middle, late = map(show, found.bands)
    text = f"It {'ends at' if timed else 'takes'} about {middle}; 8 times out of 10 "
    text += f"between {early} and {late}."
    said = [
        f"{_CHANGES[what]} it would end {clock(saved)} earlier."
        for what, saved in savings.items()
        if saved >= _WORTH_SAYING
    ]
    return "\n".join(filter(None, [text, " ".join(said)]))


def _assumed(tables: int, pace: Pace | str, turnover: Turnover | None) -> str:
    """Return what the times assume."""
    of_games = (
        f"Matches take as long as {pace} matches do in real tournaments"
        if isinstance(pace, str)
        else f"A game takes {pace.per_game:g} minutes on average"
    )
    between = "about 4 minutes" if turnover is None else f"{turnover.mean:g} minutes on average"
    return (
        f"{of_games}, on {count_of(tables, 'table')}, with {between} between two matches on a "
        "table. A round starts when the rounds that feed it are over; of the matches that can "
        "start, the one with the longest way to the end goes first."
    )
