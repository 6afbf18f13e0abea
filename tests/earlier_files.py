"""What the files that an earlier version wrote hold, as plain data."""

import json
from pathlib import Path
from typing import Any

from evenbreak.files.lists.saved_ratings import read_saved
from evenbreak.files.results.seasons import read_seasons
from evenbreak.files.store.desk import PROPOSED, phone_entries
from evenbreak.files.store.evening_file import opened
from evenbreak.files.store.prizes import kept_prizes
from evenbreak.files.store.team_night import read_team_events
from evenbreak.files.store.tournament import read_events, read_tournament
from evenbreak.ratings.scale import SCALES
from evenbreak.teams.evening.fold import team_evening
from evenbreak.web.league import League

TOURNAMENTS = ("tournament", "chips", "swiss", "groups")
NIGHT = "team_night"


def held(folder: Path) -> dict[str, Any]:
    """Return what the files of a version in a folder hold, by the names of the files."""
    found = {f"{name}.db": tournament(folder / f"{name}.db") for name in TOURNAMENTS}
    found |= {f"{NIGHT}.db": team_night(folder / f"{NIGHT}.db"), "league": league(folder)}
    plain: dict[str, Any] = json.loads(json.dumps(found, default=vars))
    return plain


def tournament(path: Path) -> dict[str, Any]:
    """Return the state of a tournament, and what is kept beside its events."""
    state = read_tournament(path)
    return {
        "form": state.plan.form,
        "tables": state.plan.tables,
        "entrants": {one.name: one.rating for one in state.entrants.values()},
        "order": state.order,
        "dropped": state.dropped,
        "counted": {
            name: [one.players, one.score, one.winner, one.forfeit, one.corrects]
            for name, one in state.counted.items()
        },
        "results": state.results,
        "to play": {name: state.pair(name) for name in state.standing.to_play},
        "needed": {name: state.needed(name, state.pair(name)) for name in state.standing.to_play},
        "on tables": {name: one.call.table for name, one in state.on_tables.items()},
        "live": {name: one.what.score for name, one in state.live.items()},
        "times": [event.at for event in read_events(path)],
        **_beside(path),
        "authors": [one.by for one in read_events(path) if one.by],
        "proposals": [
            [*map(str, (one.what.match, one.what.player, one.what.score))]
            for one in phone_entries(path)
            if one.kind == PROPOSED
        ],
        "prizes": _prizes(path),
    }


def _prizes(path: Path) -> dict[str, Any] | None:
    """Return the prize money as earlier versions kept it: exact to the hundredth."""
    money = kept_prizes(path)
    if money is None:
        return None
    assert money.unit == 0.0
    return {name: getattr(money, name) for name in ("fee", "added", "house", "payout")}


def team_night(path: Path) -> dict[str, Any]:
    """Return the state of a team night, and what is kept beside its events."""
    events = read_team_events(path)
    state = team_evening(events)
    assert state is not None
    return {
        "teams": state.teams,
        "needs": [state.needs(line) if line.named else None for line in state.sets],
        "sets": [[line.picks, line.said, line.score] for line in state.sets],
        "score": state.score,
        "due": state.due,
        "events": [[one.at, one.by] for one in events],
        **_beside(path),
    }


def _beside(path: Path) -> dict[str, Any]:
    with opened(path) as base:
        kept = base.execute("SELECT name, value FROM secret").fetchall()
    return {"secrets": dict(kept)}


def league(folder: Path) -> dict[str, Any]:
    """Return the results of a league, and the ratings that were saved of it."""
    kept = League(folder / "tournament.db")
    results = read_seasons(kept.paths).results
    saved = read_saved(folder / "ratings.csv", SCALES["fargo"], results.players).beginning
    scale, race = kept._shown()
    columns = (results.player_a, results.player_b, results.score_a, results.score_b)
    return {
        "shown": [scale.text, race],
        "players": results.players,
        "rows": [[int(cell) for cell in row] for row in zip(*columns, strict=True)],
        "ratings": dict(zip(saved.players, saved.rating.tolist(), strict=True)),
        "as of": str(saved.as_of),
    }
