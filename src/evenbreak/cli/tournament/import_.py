"""`evenbreak tournament import`: go on with a tournament that another program has saved."""

from __future__ import annotations

from evenbreak.answers.kit.answer import Answer
from evenbreak.cli.kit.asked import command_of
from evenbreak.cli.kit.values import SAY_WHICH, refuse
from evenbreak.cli.tournament.evening import moment, night_of
from evenbreak.questions.evening import Import


@command_of(Import, "import")
def command(asked: Import) -> Answer:
    """Go on with a tournament from another program."""
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

    saved, scale, at = asked.saved, asked.scale, moment(asked.at)
    known: dict[str, Entrant] = {}
    warnings: list[str] = []
    points = scale or SCALES[DEFAULT_SCALE]
    if asked.ratings is not None:
        file = files.read_entrants(asked.ratings)
        points, warnings = file.scale_by(scale, SAY_WHICH), [*file.warnings]
        filled = file.roster.with_starters(points.centre, points.points_per_doubling, points)
        warnings += filter(None, [games_words(file.roster, filled)])
        errors = np.nan_to_num(filled.standard_error).tolist()
        known = {
            name: Entrant(name, rating, error)
            for name, rating, error in zip(
                file.roster.players, file.roster.rating.tolist(), errors, strict=True
            )
            if np.isfinite(rating)
        }
    plan = Plan(
        "imported",
        asked.race or 0,
        scale=points.text,
        starter=points.centre,
        starter_error=points.points_per_doubling,
        tables=asked.tables or 0,
        discipline=asked.discipline or "",
    )
    if is_database(saved):
        refuse(
            f"{saved} is a database already; go on with it as --file {saved}, or import what "
            "evenbreak tournament export --events writes of it"
        )
    if is_event_list(saved):
        events = read_event_list(saved)
    else:
        events = read_saved_tournament(saved, plan, known, at)
    state = evening(events)
    players, played = len(state.entrants), len(state.winners) if state.drawn else 0
    said = [f"{count_of(players, 'player')} and {count_of(played, 'result')} are imported."]
    if played and (starts := sum(one.race is not None for one in state.counted.values())):
        had = f"{count_of(starts, 'match', 'matches')} had a head start"
        to_come = "; the matches to come have none" if state.standing.to_play else ""
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
