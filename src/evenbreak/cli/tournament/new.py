"""How a tournament starts: `evenbreak tournament new`, and `import` from another program."""

from __future__ import annotations

from typing import TYPE_CHECKING

from evenbreak.answers.kit.answer import Answer
from evenbreak.answers.kit.systems import POINTS_OR_SCALE, SAY_WHICH
from evenbreak.cli.kit.asked import command_of
from evenbreak.cli.kit.said import refuse
from evenbreak.cli.tournament.evening import moment, night_of
from evenbreak.cli.tournament.options import Entered, drawn_up, entered_in, none_learned
from evenbreak.questions.evening import Import, SecondChance
from evenbreak.questions.tournament import NewTournament
from evenbreak.words import say

if TYPE_CHECKING:
    from evenbreak.tournaments.evening.fold import Evening


@command_of(NewTournament, "new")
def command(asked: NewTournament) -> Answer:
    """Start a tournament."""
    from dataclasses import replace

    from evenbreak.answers.tournament.time import venue_words
    from evenbreak.files.store.tournament import begin_beside, new_tournament
    from evenbreak.tournaments.evening.events import Drawn, Event
    from evenbreak.tournaments.evening.fold import evening
    from evenbreak.tournaments.evening.plan import entrants_of, opened

    if asked.like is not None:
        return _like(asked, asked.like)
    entered, at = entered_in(asked), moment(asked.at)
    plan = replace(
        entered.plan,
        tables=asked.tables.many,
        labels=asked.tables.labels or (),
        discipline=asked.discipline,
        name=asked.name,
    )
    roster, lines = entered.roster, None
    if asked.seeding == "drawn":
        roster, _, lines = drawn_up(roster, asked.seeding, asked.seed)
    events: list[Event] = [Event(at, opened(plan, entrants_of(roster)))]
    if lines is not None:
        events.append(Event(at, Drawn(roster.players, tuple(lines))))
    state = evening(events)
    said = [*_unrated(entered, state), *filter(None, [venue_words(plan.discipline, plan.earlier)])]
    answer = night_of(asked.out, state, at, said)
    if asked.beside:
        number = begin_beside(asked.out, lambda _: events)
        answer = night_of(asked.out, state, at, [_beside_words(number), *said])
    else:
        new_tournament(asked.out, events)  # last, so that what cannot be shown is never written
    return replace(
        answer,
        warnings=[
            *entered.file.warnings,
            *entered.warnings,
            *none_learned(asked, plan.earlier),
            *answer.warnings,
        ],
    )


def _like(asked: NewTournament, path: str) -> Answer:
    """Start the next edition of a tournament."""
    from dataclasses import replace

    import numpy as np

    from evenbreak import files
    from evenbreak.files.lists.roster import refuse_to_read
    from evenbreak.files.store.prizes import kept_prizes
    from evenbreak.files.store.tournament import keep_prizes, new_tournament, read_tournament
    from evenbreak.ratings.scale import scale_of
    from evenbreak.tournaments.evening.edition import next_edition
    from evenbreak.tournaments.evening.events import Entrant, Event
    from evenbreak.tournaments.evening.fold import evening
    from evenbreak.tournaments.evening.plan import opened

    at = moment(asked.at)
    plan, entrants = next_edition(read_tournament(path), at[:10])
    plan = replace(plan, name=asked.name or plan.name)
    warnings: tuple[str, ...] = ()
    if asked.entrants is not None:
        file = files.read_entrants(asked.entrants)
        refuse_to_read(file, scale_of(plan.scale), path, say("put all on one scale"))
        warnings = file.warnings
        known = {one.name: one for one in entrants}
        rows = zip(file.roster.players, file.roster.rating.tolist(), strict=True)
        entrants = tuple(
            Entrant(name, rating) if np.isfinite(rating) else known.get(name, plan.newcomer(name))
            for name, rating in rows
        )
    events = [Event(at, opened(plan, entrants))]
    answer = night_of(asked.out, evening(events), at, [])
    new_tournament(asked.out, events)
    if (money := kept_prizes(path)) is not None:
        keep_prizes(asked.out, money)
    return replace(answer, warnings=[*warnings, *answer.warnings])


def _beside_words(number: int) -> str:
    return f"This is event {number} of the night: use --event {number} with the other commands."


@command_of(SecondChance, "second-chance")
def second_chance(asked: SecondChance) -> Answer:
    """Begin a second chance for those who are out."""
    from evenbreak.files.store.tournament import begin_beside, read_tournament
    from evenbreak.tournaments.evening import beside
    from evenbreak.tournaments.evening.events import Event

    at = moment(asked.at, asked.path)
    number = begin_beside(
        asked.path, lambda state: [Event(at, beside.second_chance(state, race=asked.race))]
    )
    state = read_tournament(asked.path, number)
    said = [_beside_words(number), f"Entered: {', '.join(state.entrants)}."]
    return night_of(asked.path, state, at, said)


def _unrated(entered: Entered, state: Evening) -> list[str]:
    """Return what is assumed of players without a rating, as a sentence if there are any."""
    import numpy as np

    from evenbreak.answers.league.prior import games_words, unrated_words

    read = entered.file.roster
    unrated = [read.players[k] for k in np.flatnonzero(np.isnan(read.rating)).tolist()]
    names = [name for name in unrated if name in state.entrants]  # no bye rows
    plan = state.plan
    said = [unrated_words(names, plan.starter, plan.starter_error)] if names else []
    return [*said, *filter(None, [games_words(read, entered.roster)])]


@command_of(Import, "import")
def import_(asked: Import) -> Answer:
    """Import a tournament from another program."""
    from dataclasses import replace

    import numpy as np

    from evenbreak import files
    from evenbreak.answers.kit.wording import count_of
    from evenbreak.answers.league.prior import games_words, unrated_words
    from evenbreak.files.foreign.tournament import read_saved_tournament
    from evenbreak.files.store.evening_file import is_database
    from evenbreak.files.store.tournament import is_event_list, new_tournament, read_event_list
    from evenbreak.ratings.scale import DEFAULT_SCALE, SCALES
    from evenbreak.tournaments.evening.events import Entrant, Plan
    from evenbreak.tournaments.evening.fold import evening
    from evenbreak.tournaments.evening.plan import entrants_of

    saved, scale, at = asked.saved, asked.scale, moment(asked.at)
    known: dict[str, Entrant] = {}
    warnings: list[str] = []
    points = scale or SCALES[DEFAULT_SCALE]
    if asked.ratings is not None:
        file = files.read_entrants(asked.ratings)
        points, warnings = file.scale_by(scale, SAY_WHICH, POINTS_OR_SCALE), [*file.warnings]
        filled = file.roster.with_starters(points.center, points.points_per_doubling, points)
        warnings += filter(None, [games_words(file.roster, filled)])
        rated = np.isfinite(file.roster.rating)
        found = zip(entrants_of(filled), rated, strict=True)
        known = {one.name: one for one, is_rated in found if is_rated}
    plan = Plan(
        "imported",
        asked.race or 0,
        scale=points.text,
        starter=points.center,
        starter_error=points.points_per_doubling,
        tables=asked.tables or 0,
        discipline=asked.discipline or "",
    )
    if is_database(saved):
        refuse(
            f"{saved} is already a tournament's database. Continue it with --file {saved}, or "
            "import the output of evenbreak tournament export --events."
        )
    if is_event_list(saved):
        events = read_event_list(saved)
    else:
        events = read_saved_tournament(saved, plan, known, at)
    state = evening(events)
    players, played = len(state.entrants), len(state.winners) if state.drawn else 0
    said = [f"Imported {count_of(players, 'player')} and {count_of(played, 'result')}."]
    if played and (starts := sum(one.race is not None for one in state.counted.values())):
        had = f"{count_of(starts, 'match', 'matches')} had a head start"
        to_come = "; the remaining matches have none" if state.standing.to_play else ""
        said.append(f"{had}, which is taken out of the score{to_come}.")
    unrated = [
        one.name
        for one in state.entrants.values()
        if one.name not in known and one.standard_error == plan.starter_error
    ]
    if unrated:
        said.append(unrated_words(unrated, plan.starter, plan.starter_error))
    answer = night_of(asked.out, state, at, said)
    new_tournament(asked.out, events)  # last, so that what cannot be shown is never written
    return replace(answer, warnings=[*warnings, *answer.warnings])
