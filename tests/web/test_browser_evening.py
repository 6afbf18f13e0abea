"""An evening of sixteen players through phones of 390 pixels, with and without scripts.

The director begins it, draws, lets a late player in and calls matches to four tables; players tap
games on phones of their own, two of which disagree; a wrong result is corrected. The same evening
is then entered by commands.
"""

from __future__ import annotations

import json
import random
import re
from pathlib import Path
from typing import Any

import pytest

from evenbreak.files.store.tournament import read_tournament
from evenbreak.web.site import Site
from terminal import on_a_terminal
from web.chromium import opened
from web.phones import running

pytestmark = pytest.mark.thorough

PLAYERS = "\n".join(["player,rating", *(f"Player {k},{710 - 10 * k}" for k in range(1, 16))])
BY_PHONES, DIFFERING, WRONG = range(3, 6), 4, 9
"""Which matches players score themselves, in which they differ, and which is entered wrongly."""

Score = tuple[int, int]


def clicks(page: Any, button: Any) -> None:
    with page.expect_navigation():
        button.click()


def taps(page: Any, score: Score, pair: tuple[str, str]) -> None:
    """Tap the games of a match, the loser's first; the last tap proposes the result."""
    loser = 0 if score[0] < score[1] else 1
    while not page.locator(".said").count():
        shown = page.locator(".huge").all_inner_texts()
        games = [int(re.match(r"\d+", text)[0]) for text in shown]
        side = loser if games[loser] < score[loser] else 1 - loser
        clicks(page, page.get_by_role("button", name=f"Game for {pair[side]}"))


class Director:
    """The director's phone, and the commands that would do the same."""

    def __init__(self, browser: Any, site: Site, *, scripts: bool) -> None:
        self.browser, self.site, self.scripts = browser, site, scripts
        self.page = opened(browser, site, java_script_enabled=scripts)
        self.commands: list[str] = []

    def does(self, button: str, command: str = "", **fields: str) -> None:
        """Fill in the form that has a button, send it, and keep the command for it."""
        form = self.page.locator("form", has=self.page.get_by_role("button", name=button)).first
        for name, value in fields.items():
            form.locator(f"[name={name}]").fill(value)
        clicks(self.page, form.get_by_role("button", name=button))
        if command:
            self.commands.append(command)

    def begins(self) -> None:
        self.page.goto(self.site.address)
        self.page.get_by_role("link", name="New tournament").click()
        self.page.get_by_text("More choices").click()
        self.page.select_option("[name=seeding]", "rating")
        self.does("Go to check-in", entrants=PLAYERS, race="2", losers_race="1", tables="4")
        self.does("Draw ", "draw")
        self.page.get_by_text("Late entry").click()
        self.does("Add player", "late 'Late Larry' --rating 555", name="Late Larry", rating="555")

    def calls_all(self) -> None:
        """Call matches while the page proposes some; where it knows none yet, wait for them."""
        for _ in range(100):
            self.page.goto(f"{self.site.address}/desk")
            called = read_tournament(self.site.path)
            ready = len(called.standing.to_play) - len(called.on_tables)
            if not ready or len(called.on_tables) == 4:
                return
            call = self.page.locator("section").get_by_role("button", name="Call", exact=True)
            if call.count():
                clicks(self.page, call.first)
            else:
                self.page.wait_for_timeout(50)
        raise AssertionError("no match is proposed for a free table")

    def enters(self, match: str, score: Score, *, how: str = "new") -> None:
        word = "result" if how == "new" else "correct"
        match_field = self.page.locator(f"input[name=match][value='{match}']")
        form = self.page.locator(f"form[action='/desk/{word}']").filter(has=match_field)
        if form.count() == 2:  # a race to 1: a button for each player
            form = form.nth(0 if score[0] else 1)
        else:
            self.fills(form, score)
        clicks(self.page, form.get_by_role("button"))
        if (sure := self.page.get_by_role("button", name="Yes, do it")).count():
            clicks(self.page, sure)
        self.commands.append(f"{word} {match} {score[0]}:{score[1]}")

    @staticmethod
    def fills(form: Any, score: Score) -> None:
        if not form.is_visible():
            form.locator("xpath=ancestor::details").locator("summary").click()
        for name, games in zip("ab", score, strict=True):
            form.locator(f"input[name={name}]").fill(str(games))

    def lets_players_score(self, match: str, score: Score, *, differ: bool) -> None:
        state = read_tournament(self.site.path)
        pair = state.pair(match)
        for k, mine in enumerate((score, score[::-1] if differ else score)):
            context = self.browser.new_context(
                viewport={"width": 390, "height": 844}, java_script_enabled=self.scripts
            )
            page = context.new_page()
            page.goto(f"{self.site.address}/c/{self.site.player_code(pair[k])}")
            if (coming := page.get_by_role("button", name="I'm coming")).count():
                clicks(page, coming)
            taps(page, mine, pair)
            context.close()
        # Both browsers have the address of this computer: the director confirms what they agree on.
        self.page.goto(f"{self.site.address}/desk")
        alike = self.page.get_by_text("One person may have entered both").count()
        assert bool(alike) is not differ
        clicks(self.page, self.page.get_by_role("button", name="Confirm").first)
        self.commands.append(f"result {match} {score[0]}:{score[1]}")

    def plays_to_the_end(self, luck: random.Random) -> None:
        entered = 0
        while (state := read_tournament(self.site.path)).standing.to_play:
            self.calls_all()
            state = read_tournament(self.site.path)
            ready = sorted(state.on_tables)
            match = ready[0] if entered in BY_PHONES else luck.choice(ready)
            needs = state.needed(match, state.pair(match))
            score = (needs[0], luck.randrange(needs[1]))
            if luck.random() < 0.4:
                score = (luck.randrange(needs[0]), needs[1])
            if entered in BY_PHONES:
                score = max(score, (needs[0], needs[1] - 1)) if entered == DIFFERING else score
                self.lets_players_score(match, score, differ=entered == DIFFERING)
            elif entered == WRONG:
                self.enters(match, score[::-1])
                self.page.goto(f"{self.site.address}/desk")
                self.enters(match, score, how="correct")
            else:
                self.enters(match, score)
            entered += 1


@pytest.mark.parametrize("scripts", [True, False], ids=["with scripts", "without scripts"])
def test_an_evening_by_phones_ends_as_by_commands(
    browser: Any, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, *, scripts: bool
) -> None:
    with running(tmp_path / "page.db") as site:
        director = Director(browser, site, scripts=scripts)
        director.begins()
        director.plays_to_the_end(random.Random(7))
        director.page.goto(site.address)
        assert "Result" in director.page.inner_text("main")
        by_page = read_tournament(site.path)

    monkeypatch.chdir(tmp_path)
    Path("entrants.csv").write_text(PLAYERS, encoding="utf-8")
    races = "--race 2 --losers-race 1 --tables 4 --seeding rating --scale fargo"
    on_a_terminal(f"evenbreak tournament new entrants.csv --out commands.db {races}")
    for command in director.commands:
        on_a_terminal(f"evenbreak tournament {command} --file commands.db")
    by_commands = read_tournament("commands.db")
    assert by_commands.counted == by_page.counted
    assert by_commands.order == by_page.order
    assert len(by_page.counted) >= 30
    answers = [
        json.loads(on_a_terminal(f"evenbreak tournament next --file {file} --json"))
        for file in ("page.db", "commands.db")
    ]
    assert answers[0]["places"] == answers[1]["places"]
