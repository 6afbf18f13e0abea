"""The views that other programs read: the fold of the log after whatever is entered."""

import random
import re
import shutil
import sqlite3
from contextlib import closing, suppress
from datetime import datetime
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from evenbreak.errors import EvenbreakError
from evenbreak.files.demo import write_demo_evening
from evenbreak.files.store import evening_file
from evenbreak.files.store.tournament import (
    add_events,
    begin_beside,
    delete_tournament,
    keep_prizes,
    new_tournament,
    read_tournament,
    renew_views,
)
from evenbreak.files.store.views import are_current
from evenbreak.tournaments import CHIP_CHARTS
from evenbreak.tournaments.evening import beside, moves, roster, settling, undoing
from evenbreak.tournaments.evening.events import Entrant, Event, Opened, Plan
from evenbreak.tournaments.evening.fold import Evening
from evenbreak.tournaments.evening.listed import decided_places
from evenbreak.tournaments.evening.outlook import Outlook
from evenbreak.tournaments.money.payouts import PrizeMoney
from night_views import VIEWS, selected, views_are_right
from places import ROOT
from tiers import examples
from tournament_nights import AT, SAVED

FORMS = {
    "double": {"losers_race": 2}, "single": {"third_place": True}, "round-robin": {},
    "swiss": {"rounds": 3}, "groups": {"groups": 2, "qualifiers": 1}, "consolation": {},
    "chips": {"chips": CHIP_CHARTS["pharaohs"]}, "king-of-the-hill": {},
}  # fmt: skip


def begun(path: Path, form: str, players: int, **more: object) -> None:
    entrants = tuple(Entrant(f"P{k}", 600.0 - 15.0 * k) for k in range(players))
    race = 1 if form == "chips" else 3
    plan = Plan(form, race, scale="fargo", starter=500.0, tables=3, **FORMS[form] | more)  # type: ignore[arg-type]
    new_tournament(path, [Event(AT, Opened(plan, entrants))])


def enter(path: Path, decide: Any, event: int = 1, at: str = AT) -> None:
    add_events(path, lambda state: [Event(at, what) for what in decide(state)], event=event)


def something(state: Evening, luck: random.Random):
    """Return what a director might enter next, be it allowed or not."""
    rng = np.random.default_rng(luck.randrange(1000))
    names = list(state.entrants)
    if not state.drawn:
        return luck.choice(
            [
                lambda: moves.draw_next(state, rng),
                lambda: [roster.check_in(state, luck.choice(names), paid=True)],
            ]
        )()
    ready, over = list(state.standing.to_play), list(state.counted)
    name = luck.choice(ready) if ready else "F"
    needs = state.needed(name, state.pair(name)) if ready else (1, 1)
    won = luck.choice([(needs[0], 0), (0, needs[1])])
    return luck.choice(
        [
            *([lambda: [moves.result(state, name, won)]] * 6),
            lambda: [moves.call(state, name, None)],
            lambda: [moves.score(state, name, (0, 1))],
            lambda: [moves.call_back(state, name)],
            lambda: [moves.correct(state, luck.choice(over), won)],
            lambda: undoing.undo(state),
            lambda: undoing.undo(state, luck.choice(sorted(undoing.free_entries(state)))),
            lambda: undoing.redo(state),
            lambda: settling.stand(state, luck.choice([one.result.match for one in state.aside])),
            lambda: [roster.rename(state, luck.choice(names), f"R{luck.randrange(99)}")],
            lambda: [moves.drop(state, luck.choice(names))],
            lambda: [moves.late(state, Entrant(f"L{luck.randrange(99)}", 500.0))],
            lambda: [roster.substitute(state, luck.choice(names), Entrant("Sub", 480.0))],
            lambda: [moves.change(state, tables=luck.randint(1, 4))],
            lambda: moves.draw_next(state, rng),
            lambda: [settling.break_ties(state, rng).ranked],
        ]
    )()


@pytest.mark.slow
@pytest.mark.parametrize("form", FORMS)
@given(seed=st.integers(0, 10_000))
@settings(max_examples=examples(3))
def test_views_are_the_fold_of_the_log_after_every_entry(form, seed, tmp_path_factory):
    path, luck = tmp_path_factory.mktemp("night") / "tonight.db", random.Random(seed)
    begun(path, form, luck.randint(5, 9), handicapped=luck.random() < 0.3 and form != "chips")
    views_are_right(path)
    keep_prizes(path, PrizeMoney(20.0, payout="50/30/20"))
    events = [1]
    for k in range(24):
        event, at = luck.choice(events), f"2025-03-01T20:{k:02}:00"
        with suppress(EvenbreakError, IndexError):
            if k == 12 and form != "chips":
                chance = lambda now, at=at: [Event(at, beside.second_chance(now))]  # noqa: E731
                events.append(begin_beside(path, chance))
            enter(path, lambda state: something(state, luck), event, at)
        if k % 3 == 2:
            views_are_right(path)
    places_are_those_of_the_odds(read_tournament(path))


def places_are_those_of_the_odds(state: Evening) -> None:
    """A place that is decided is the only one left; when all is over, nobody lacks theirs."""
    if not state.drawn or (state.plan.form == "chips" and len(state.chip_night.order) > 1):
        return
    odds, places = Outlook(state, AT).as_if_sure, decided_places(state)
    for k, name in enumerate(state.order):
        left = [odds.bracket.places[j] for j in np.flatnonzero(odds.p_place[k] > 1e-12)]
        if name in places:
            assert (places[name].first, places[name].last) == (left[0].first, left[-1].last)
        elif odds.exact and not (
            state.dropped or state.bracket.groups
        ):  # certain before it is over
            assert len(left) > 1, name


@pytest.mark.parametrize("form", [pytest.param(one, marks=pytest.mark.slow) for one in FORMS])
def test_places_and_prizes_when_all_is_over(form, tmp_path):
    path, rng = tmp_path / "tonight.db", np.random.default_rng(5)
    begun(path, form, 8)
    keep_prizes(path, PrizeMoney(10.0, payout="50/30/20"))
    while not (state := read_tournament(path)).drawn or state.standing.to_play or (
        form == "swiss" and len(state.later) < 3
    ) or settling.tied_groups(state):  # fmt: skip

        def step(state):
            if not state.drawn or not (state.standing.to_play or settling.tied_groups(state)):
                return moves.draw_next(state, rng)
            if not state.standing.to_play:
                return [settling.break_ties(state, rng).ranked]
            name = state.standing.to_play[0]
            m, n = state.needed(name, state.pair(name))
            return [moves.result(state, name, (m, 0) if rng.random() < 0.5 else (0, n))]

        enter(path, step)
        places_are_those_of_the_odds(read_tournament(path))
    views_are_right(path)
    rows = selected(path, "SELECT * FROM standings")
    assert all(row["place"] for row in rows)
    assert sum(row["prize"] for row in rows) == pytest.approx(80.0, abs=0.02)


def test_an_entry_of_an_earlier_version_shows_until_the_next(tmp_path):
    path = tmp_path / "tonight.db"
    begun(path, "single", 4)
    late = '{"entrant": {"name": "New", "rating": 500.0}}'
    with closing(sqlite3.connect(path)) as base:  # as a version without views adds to the log
        base.execute("INSERT INTO entry SELECT '1', 2, at, 'late', ?, '', NULL FROM entry", (late,))
        base.commit()
    assert selected(path, "SELECT entry, up_to_date FROM events") == [{"entry": 1, "up_to_date": 0}]
    renew_views(path)
    views_are_right(path)
    assert "New" in [row["name"] for row in selected(path, "SELECT name FROM players")]
    delete_tournament(path)
    assert selected(path, "SELECT * FROM events") == []


def test_a_form_that_adds_nothing_leaves_the_views_up_to_date(tmp_path):
    path = tmp_path / "tonight.db"
    begun(path, "single", 4)
    add_events(path, lambda _: [], form="the same tap again")
    with closing(sqlite3.connect(path)) as base:
        taken = base.execute("SELECT strand FROM entry WHERE form NOT NULL").fetchall()
        assert taken == [("1 taken",)]
        assert are_current(base)


FAILING = {
    **{name: [f"DROP VIEW {name}", f"CREATE TABLE {name} (a)"] for name in VIEWS[::2]},
    **{name: [f"DROP VIEW {name}", f"CREATE VIEW {name} AS SELECT 7 AS a"] for name in VIEWS[1::2]},
    "in capitals": ["DROP VIEW players", "CREATE VIEW Players AS SELECT event FROM players_rows"],
    "rows": ["DROP TABLE matches_rows", "CREATE TABLE matches_rows (a)"],
    "trigger": [
        "CREATE TRIGGER own AFTER INSERT ON players_rows BEGIN SELECT RAISE(ABORT, 'no'); END"
    ],
}


@pytest.mark.parametrize("how", FAILING)
def test_views_that_cannot_be_written_refuse_no_entry_and_nothing_of_others_is_lost(
    how, tmp_path, caplog
):
    path = tmp_path / "tonight.db"
    begun(path, "single", 4)
    with closing(sqlite3.connect(path)) as base:
        for statement in FAILING[how]:
            base.execute(statement)
        asked = "SELECT name, sql FROM sqlite_master"
        before = base.execute(asked).fetchall()
        enter(path, lambda state: [moves.late(state, Entrant("New", 500.0))])
        keep_prizes(path, PrizeMoney(20.0, payout="50/30/20"))
        renew_views(path)
        assert "New" in read_tournament(path).entrants
        after = base.execute(asked).fetchall()
        assert {*before} <= {*after}
        assert "were left as they were" in caplog.text
        known = "SELECT MAX(entry) FROM events_rows"
        assert base.execute(known).fetchone() == (1,)  # all of them, so that they fit together
        delete_tournament(path)


def test_a_file_that_can_only_be_read_is_shown_with_the_views_it_has(tmp_path, monkeypatch):
    path = tmp_path / "tonight.db"
    begun(path, "single", 4)
    with closing(sqlite3.connect(path)) as base:
        base.execute("DROP VIEW players")

    def only_read(place: Path, *_: object) -> sqlite3.Connection:
        where = f"{place.absolute().as_uri()}?mode=ro"
        return sqlite3.connect(where, uri=True, isolation_level=None)

    monkeypatch.setattr(evening_file, "_connection", only_read)
    renew_views(path)
    assert list(read_tournament(path).entrants) == ["P0", "P1", "P2", "P3"]
    with pytest.raises(EvenbreakError, match="is read-only"):
        enter(path, lambda state: [moves.drop(state, "P0")])


@pytest.mark.parametrize("name", ["tournament", "chips", "swiss", "groups"])
def test_files_of_earlier_versions_get_views(name, tmp_path):
    (version,) = [one for one in SAVED.glob("v*") if one.name == "v0_2_0"]
    path = Path(shutil.copy(version / f"{name}.db", tmp_path))
    renew_views(path)
    views_are_right(path)
    written = path.stat().st_mtime_ns
    renew_views(path)  # they are current
    assert path.stat().st_mtime_ns == written


def test_views_have_types_and_cannot_be_changed(tmp_path):
    path = tmp_path / "tonight.db"
    begun(path, "single", 4)
    with closing(sqlite3.connect(path)) as base:
        types = {row[1]: row[2] for row in base.execute("PRAGMA table_info(matches)")}
        with pytest.raises(sqlite3.OperationalError, match="view"):
            base.execute("UPDATE players SET rating = 0")
    assert types["score_a"] == "INTEGER"
    assert types["called"] == types["player_a"] == "TEXT"


def test_the_page_about_files_shows_what_the_views_hold(tmp_path):
    page = (ROOT / "docs" / "reference" / "files.md").read_text("utf-8")
    path = tmp_path / "evening.db"
    write_demo_evening(path, datetime(2025, 3, 1, 21, 0))
    for view in VIEWS:
        (columns,) = re.findall(rf"^\| `{view}` \| (`event`.*) \|$", page, re.MULTILINE)
        listed = re.findall(r"`(\w+)`", re.sub(r"\(.*?\)+", "", columns))
        assert listed == [*selected(path, f"SELECT * FROM {view}")[0]], view  # noqa: S608
    shown = re.findall(
        r'^\$ sqlite3 -header evening.db "(.*)"\n((?:.+\n)*?)```$', page, re.MULTILINE
    )
    assert len(shown) == 1
    for query, output in shown:
        rows = selected(path, query)
        lines = [rows[0].keys(), *(row.values() for row in rows)]
        assert output == "".join("|".join(map(shell_word, one)) + "\n" for one in lines), query


def shell_word(value: object) -> str:
    return "" if value is None else str(value)
