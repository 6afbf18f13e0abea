"""The views in the file of a night, compared with the fold of its log by another route."""

from __future__ import annotations

import sqlite3
from contextlib import closing
from pathlib import Path
from typing import Any

from evenbreak.files.store.tournament import night_of, read_night
from evenbreak.files.store.views import renew
from evenbreak.tournaments.evening.fold import Evening
from evenbreak.tournaments.evening.matches import played_matches

VIEWS = "matches", "players", "standings", "events"
_RECOUNTED = """
SELECT s.event, s.name, s.won, s.lost, s.games_won, s.games_lost,
    SUM(m.winner = s.name), SUM(m.winner != s.name),
    SUM(CASE s.name WHEN player_a THEN score_a ELSE score_b END),
    SUM(CASE s.name WHEN player_a THEN score_b ELSE score_a END)
FROM (SELECT * FROM standings WHERE buchholz IS NULL) s LEFT JOIN matches m
    ON m.event = s.event AND s.name IN (player_a, player_b) AND m.state IN ('over', 'forfeit')
GROUP BY s.event, s.name
"""


def selected(path: Path, sql: str) -> list[dict[str, Any]]:
    """Return what another program reads."""
    with closing(sqlite3.connect(f"{path.absolute().as_uri()}?mode=ro", uri=True)) as base:
        base.row_factory = sqlite3.Row
        return [dict(row) for row in base.execute(sql)]


def views_are_right(path: Path) -> None:
    """Check that every view says what follows from the log, in all events."""
    shown = {view: selected(path, f"SELECT * FROM {view}") for view in VIEWS}  # noqa: S608
    assert all(row["up_to_date"] == 1 for row in shown["events"])
    night = night_of(path, read_night(path))
    with closing(sqlite3.connect(path)) as kept, closing(sqlite3.connect(":memory:")) as anew:
        kept.backup(anew)
        for view in VIEWS:
            anew.execute(f"DROP TABLE {view}_rows")
        renew(anew, path, night)
        for view in VIEWS:
            rows = f"SELECT * FROM {view}_rows"  # noqa: S608
            assert kept.execute(rows).fetchall() == anew.execute(rows).fetchall(), view
    for number, state in night.items():
        own = {v: [row for row in shown[v] if row["event"] == number] for v in VIEWS}
        _players_are_right(state, own["players"])
        if state.drawn:
            _matches_are_right(state, own["matches"])
            _places_are_right(state, own["standings"])
        else:
            assert not own["matches"]
            assert not own["standings"]
    for row in selected(path, _RECOUNTED):
        counted = [*row.values()][2:]
        assert counted[:4] == [one or 0 for one in counted[4:]], row


def _players_are_right(state: Evening, rows: list[dict[str, Any]]) -> None:
    assert [row["name"] for row in rows] == [*state.entrants]
    seeded = sorted((row["seed"], row["name"]) for row in rows if row["seed"])
    assert tuple(name for _, name in seeded) == state.order
    for word, names in (
        ("arrived", state.arrived),
        ("paid", state.paid),
        ("dropped", state.dropped),
    ):
        assert {row["name"] for row in rows if row[word]} == {*names} & {*state.entrants}, word
    assert {row["name"]: row["rating"] for row in rows} == {
        name: one.rating for name, one in state.entrants.items()
    }


def _matches_are_right(state: Evening, rows: list[dict[str, Any]]) -> None:
    here = {row["code"]: row for row in rows if row["state"] != "on hold"}
    assert [*here] == sorted(here, key=state.number_of)
    assert {*here} == {*state.bracket.by_name}
    for code, row in here.items():
        pair = row["player_a"], row["player_b"]
        assert row["match"] == state.number_of(code)
        assert {*pair} - {None} == state.sitting(code)
        known = None not in pair
        assert (row["race_a"], row["race_b"]) == (
            state.needed(code, pair) if known else (None, None)
        )
        if row["state"] != "forfeit":  # whose player may have gone home
            assert (row["ended"] is None) == (row["state"] != "over")
        entered = {event.at for event in state.log}
        assert {row["called"], row["ended"]} <= {*entered, None}
        assert (row["called"] is None) <= (row["table_name"] is None)
    over = {code: row for code, row in here.items() if row["state"] in ("over", "forfeit")}
    assert {code: row["winner"] for code, row in over.items()} == state.winners
    for code, row in over.items():
        result = state.counted[code]
        assert (row["state"] == "forfeit") == result.forfeit
        games = {row["player_a"]: row["score_a"], row["player_b"]: row["score_b"]}
        assert games == (dict.fromkeys(games) if result.forfeit else result.games)
    left = {code: row for code, row in here.items() if code in state.standing.to_play}
    for code, row in left.items():
        live, on = state.live.get(code), state.on_tables.get(code)
        assert row["state"] == ("playing" if live or on else "ready")
        assert (row["table_name"], row["called"]) == (
            (state.plan.table_name(on.call.table), on.at) if on else (None, None)
        )
        if live:
            score = dict(zip(live.what.players, live.what.score, strict=True))
            assert (row["score_a"], row["score_b"]) == (
                score[row["player_a"]], score[row["player_b"]]
            )  # fmt: skip
    others = {row["state"] for code, row in here.items() if code not in {*over, *left}}
    assert others <= {"waiting", "not needed"}
    results = sorted(
        (one.result.match, frozenset(one.result.games.items()), one.result.winner)
        for one in played_matches(state.records) if not one.result.forfeit
    )  # fmt: skip
    assert results == sorted(
        (
            row["code"],
            frozenset({row["player_a"]: row["score_a"], row["player_b"]: row["score_b"]}.items()),
            row["winner"],
        )
        for row in rows
        if row["state"] in ("over", "on hold") and row["score_a"] is not None
    )


def _places_are_right(state: Evening, rows: list[dict[str, Any]]) -> None:
    assert sorted(row["name"] for row in rows) == sorted(state.order)
    places = [(row["side"] or "", row["place"], row["place_to"]) for row in rows if row["place"]]
    assert places == sorted(places)
    for side in {one[0] for one in places}:
        taken: dict[tuple[int, int], int] = {}
        for _, first, last in (one for one in places if one[0] == side):
            taken[first, last] = taken.get((first, last), 0) + 1
        spots = [k for first, last in taken for k in range(first, last + 1)]
        assert len(spots) == len({*spots})
        assert all(count <= last - first + 1 for (first, last), count in taken.items())
