"""Evenings by whatever forms the pages show: nothing played is lost, and every page agrees."""

from __future__ import annotations

import csv
import itertools
import random
from collections.abc import Iterator
from contextlib import closing
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from click.testing import CliRunner

from evenbreak.cli.program import program
from evenbreak.files.store.tournament import read_events, read_tournament
from evenbreak.tournaments.evening.events import BY_ITSELF, Called
from evenbreak.tournaments.evening.fold import Evening
from evenbreak.web.night import Night
from evenbreak.web.site import Site
from night_views import views_are_right
from tries import tries
from web.asked import Browser, Form, Got, Room, forms_of

EVENINGS = tries("evenings by forms", 2)
STEPS = 25
FORMS = {
    "double": {"losers_race": 2}, "single": {"third_place": "on"}, "round-robin": {},
    "swiss": {"rounds": 3}, "groups": {"groups": 2, "qualifiers": 1}, "chips": {"chips": "hoboken"},
    "consolation": {}, "king-of-the-hill": {}, "pods": {"qualifiers": 2},
}  # fmt: skip
LEFT_ALONE = ("/desk/pin", "/leave", "/language", "/desk/save", "/pin", "/new", "/league/tonight")
ODD = ("", "x", "-1", "1e3", "²", "9" * 30, "3:2", "<b>", " 2 ")


class Played:
    """An evening in play: a director at two servers on one file and at the command line.

    And two phones, a tablet, and tabs that were left open.
    """

    def __init__(self, path: Path, seed: int) -> None:
        self.luck = random.Random(seed)
        seconds = itertools.count()
        clock = lambda: f"2025-03-01T20:{(n := next(seconds)) // 60 % 60:02d}:{n % 60:02d}"  # noqa: E731
        hosts = frozenset({"localhost"})
        self.room, self.other = (Room(Site(path, hosts=hosts, clock=clock)) for _ in range(2))
        self.path = path
        self.director = Browser(self.room, director=True)
        self.stale: list[tuple[Browser, list[tuple[str, str]], Form]] = []
        self.taken: set[str] = set()
        self.last = ""
        form = self.luck.choice(list(FORMS))
        size = self.luck.choice((5, 6, 7, 8)) if form != "pods" else 16
        names = [f"P{k:02d}" for k in range(size)]
        plan = {
            "entrants": "\n".join(f"{name},{700 - 20 * k}" for k, name in enumerate(names)),
            "format": form, "races": "even", "race": 3, "tables": 3, "discipline": "8-ball",
            "seeding": "", "scale": "fargo", **FORMS[form],
        }  # fmt: skip
        if form == "chips":
            plan.pop("race")
        got = self.director.send("/new", **plan)
        assert got.status == 303, got.words
        self.about = f"seed {seed}, {form} of {size}"
        self.phones = [Browser(self.room, address="10.0.0.1"), Browser(self.other, address="10.2")]
        self.again = Browser(self.other, director=True)
        self.tablet = Browser(self.room, director=True, address="10.0.0.3")

    def close(self) -> None:
        for room in (self.room, self.other):
            room.close()

    @property
    def state(self) -> Evening:
        return read_tournament(self.path)

    def fill(self, form: Form) -> list[tuple[str, str]]:
        """Fill a form in, mostly as somebody would who knows what they do."""
        luck, more = self.luck, {}
        for name in form.typed:
            sense = {
                "a": str(luck.choice((3, 3, 2, 1, 0))), "b": str(luck.choice((3, 2, 1, 0))),
                "name": f"N{luck.randrange(20)}", "rating": luck.choice(("", "500")),
                "tables": luck.choice(("", "2", "4")), "race": luck.choice(("", "", "2", "4")),
            }.get(name, "")  # fmt: skip
            more[name] = sense if luck.random() < 0.95 else luck.choice(ODD)
        for name, values in form.choices.items():
            more[name] = luck.choice([one for one in values if one] or [""])
        return form.filled(**more)

    def step(self) -> None:
        """Let somebody send a form that they see, or saw a while ago."""
        luck, before = self.luck, self.state
        if luck.random() < 0.1:
            self.command(before)
            return
        if self.stale and luck.random() < 0.15:
            browser, fields, form = luck.choice(self.stale)
        else:
            browser, page = self.page(before)
            shown = [one for one in forms_of(page) if one.action not in LEFT_ALONE]
            if not shown:
                return
            form = self.chosen(shown)
            fields = self.fill(form)
            if luck.random() < 0.3:
                self.stale.append((browser, fields, form))
        question = self.sent(browser, fields, form)
        if question is not None and luck.random() < 0.8:
            if luck.random() < 0.2:  # somebody enters something before it is answered
                self.step()
            self.sent(browser, question.filled(sure="yes"), question)

    def page(self, state: Evening) -> tuple[Browser, Got]:
        """Return somebody's page, and whose it is."""
        if state.drawn and state.standing.to_play and self.luck.random() < 0.35:
            match = self.luck.choice(list(state.standing.to_play)[:3])
            browser = self.luck.choice(self.phones)
            if self.luck.random() < 0.4:
                name = self.luck.choice(state.pair(match))
                browser.send("/me/code", code=self.room.site.player_code(name))
            return browser, browser.open("/me?play=1")
        pages = ["/desk", "/desk", "/desk", "/desk/more", "/desk/history"]
        if state.drawn:
            if self.luck.random() < 0.15:
                return self.tablet, self.tablet.open(f"/table/{state.plan.tables}")
            number = self.luck.randrange(1, len(state.match_numbers) + 2)
            pages += [f"/desk?match={number}", f"/bracket?match={number}"]
        browser = self.luck.choice((self.director, self.director, self.again))
        return browser, browser.open(self.luck.choice(pages))

    def command(self, state: Evening) -> None:
        """Enter something at the command line, which asks for nothing."""
        luck, names = self.luck, list(state.entrants)
        words = luck.choice(
            [
                ["draw"],
                ["undo"],
                ["redo"],
                ["late", f"C{luck.randrange(20)}", "480"],
                ["rename", luck.choice(names), f"R{luck.randrange(20)}"],
                ["drop", luck.choice(names)],
                ["change", "--tables", str(luck.choice((2, 3, 4)))],
                *(
                    [move, str(luck.randrange(1, 9)), *more]
                    for move, more in (
                        ("result", [luck.choice(("3:1", "2:3"))]),
                        ("call", []),
                        ("uncall", []),
                        ("correct", ["1:3"]),
                        ("wait", ["--reason", "smoking"]),
                        ("swap-tables", [str(luck.randrange(1, 9))]),
                    )
                ),
            ]
        )
        count = len(read_events(self.path))
        line = ["tournament", *words, "--file", str(self.path)]
        ran = CliRunner().invoke(program, line)
        self.last = f"{self.about}: {' '.join(words)} -> {ran.exit_code} {ran.output[-300:]}"
        assert ran.exit_code in (0, 1, 2, 3), (self.last, ran.exception)
        assert ran.exit_code == 0 or len(read_events(self.path)) == count, self.last
        self.sits_once(self.state)

    def sits_once(self, state: Evening) -> None:
        """Look whether each table has one match, and each player one table."""
        on = state.on_tables.values() if state.drawn else ()
        taken = [one for each in on for one in (each.call.table, *each.call.players)]
        assert len(taken) == len(set(taken)), (self.last, taken)

    def chosen(self, shown: list[Form]) -> Form:
        """Choose results more often than anything else."""
        weights = {"/desk/result": 6, "/desk/call": 4, "/desk/draw": 3, "/desk/drop": 0.4}
        each = [weights.get(one.action, 1) for one in shown]
        return self.luck.choices(shown, each)[0]

    def sent(self, browser: Browser, fields: list[tuple[str, str]], form: Form) -> Form | None:
        """Send a form and look at what became of it; return the question that it is asked."""
        before, earlier = self.state, read_events(self.path)
        count = len(earlier)
        got = browser.ask("POST", form.action, fields)
        after = self.state
        assert read_events(self.path)[:count] == earlier  # of what was entered nothing changes
        said = f"{self.about}: {form.action} {fields[2:]} -> {got.status} {got.words[-300:]}"
        assert got.status in (200, 303, 400, 403, 404, 409, 429), said
        if got.status != 303:
            assert len(read_events(self.path)) == count, said
        question = next((one for one in forms_of(got) if one.action == form.action), None)
        if got.status == 200:
            assert question is not None, said
            question.words += got.words
        named = " ".join([form.words, *(value for _, value in fields)])
        self.last = said
        self.sits_once(after)
        for match in lost(before, after) - called_with(before, after):
            known = {match, str(before.match_words(match))}
            assert any(one in named for one in known), f"{said}: lost {known}"
        entered, key = dict(fields), repr(sorted(fields))
        if key in self.taken:  # the answer may be as before, and nothing is entered again
            assert len(read_events(self.path)) == count, said
        elif got.status == 303 and form.action == "/desk/result":
            there = after.counted.get(entered["match"])
            pair = after.pair(entered["match"])
            score = (there.games[pair[0]], there.games[pair[1]]) if there else None
            if "games" in entered and there:
                assert there.winner == entered["winner"], said
                assert there.games[there.loser] == int(entered["games"]), said
            else:
                assert score == (int(entered["a"]), int(entered["b"])), said
        if got.status == 303:
            self.taken.add(key)
        return question if got.status == 200 else None

    def look(self) -> None:
        """Compare what the pages show with the file."""
        state = self.state
        views_are_right(self.path)
        for other in (self.room.site, self.other.site, Site(self.path)):
            there = other.night.state()
            assert there.log == state.log, self.last
            if state.drawn:
                assert there.counted == state.counted, self.last
                assert there.on_tables == state.on_tables, self.last
        history = self.director.open("/desk/history")
        assert history.status == 200
        for page in ("/", "/players", "/screen", "/bracket", "/desk/codes", "/prizes?fee=10"):
            assert self.director.open(page).status in (200, 404), (self.last, page)
        if not state.drawn or not state.counted:
            return
        rows = list(csv.DictReader(self.director.open("/results.csv").text.splitlines()))
        exported = {
            (row["match"], row["player_a"], row["player_b"], row["score_a"], row["score_b"])
            for row in rows
        }
        bracket = self.director.open("/bracket").text
        for name, result in played(state):
            pair = state.pair(name)
            score = str(result.games[pair[0]]), str(result.games[pair[1]])
            number = str(state.number_of(name))
            found = {(number, *pair, *score), (number, *pair[::-1], *score[::-1])}
            assert found & exported, self.last
            assert all(who in bracket for who in pair), self.last


def played(state: Evening) -> Iterator[tuple[str, Any]]:
    for name, result in state.counted.items():
        if name in state.records and not result.forfeit:
            yield name, result


def lost(before: Evening, after: Evening) -> set[str]:
    """Return the matches whose result, table or score has gone, and that have not just ended."""
    if not before.drawn:
        return set()
    then = dict(played(before))
    now = dict(played(after)) if after.drawn else {}
    names = {who: name for name, who in after.entries.items()}
    names = {name: names.get(who, name) for name, who in before.entries.items()}

    def called(games: dict[str, int]) -> dict[str, int]:
        return {names.get(name, name): won for name, won in games.items()}

    gone = {n for n, one in then.items() if n not in now or now[n].games != called(one.games)}
    if before.plan.form == "chips":  # racks have no score, and a table takes the next in the queue
        return gone
    on, live = (after.on_tables, after.live) if after.drawn else ({}, {})
    for name, one in before.on_tables.items():
        ended = name in now and set(now[name].players) == {
            *called(dict.fromkeys(one.call.players, 0))
        }
        if name not in on and not ended:
            gone.add(name)
    for name, score in before.live.items():
        pair = {*called(dict.fromkeys(score.what.players, 0))}
        ended = name in now and set(now[name].players) == pair
        if any(score.what.score) and name not in live and not ended:
            gone.add(name)
    return gone


def called_with(before: Evening, after: Evening) -> set[str]:
    """Return the matches that were called with a result that is taken back: that is told."""
    gone = [
        event
        for number, event in zip(before.numbers, before.events, strict=True)
        if number not in after.numbers
    ]
    calls = [one.what for one in gone if isinstance(one.what, Called) and one.by == BY_ITSELF]
    return {call.match for call in calls if call.match not in before.live}


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(EVENINGS))
def test_an_evening_by_forms_loses_nothing_unsaid(
    seed: int, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    async def not_yet(_: Night) -> None:
        """The odds are worked out beside, and have tests of their own."""

    lots, drawn = np.random.default_rng(seed), np.random.default_rng
    monkeypatch.setattr(np.random, "default_rng", lambda *given: drawn(*given) if given else lots)
    monkeypatch.setattr(Night, "outlook", not_yet)
    evening = Played(tmp_path / "tonight.db", seed)
    with closing(evening):
        for step in range(STEPS):
            evening.step()
            if step % 8 == 7:
                evening.look()
        evening.look()
