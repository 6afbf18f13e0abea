"""An evening of nineteen players through phones of 390 pixels, with and without scripts.

The director pastes a list, draws, and enters results by two taps; every tap is counted. Five
players scan a code once each and score matches on their own phones, of which two disagree; a wrong
result is found later and corrected from the bracket while the next match is being played; one
player goes home; the page is restarted in the middle. The same evening is then typed as commands.
"""

from __future__ import annotations

import json
import random
import re
import shlex
from pathlib import Path
from typing import Any

import pytest
from click.testing import CliRunner

from evenbreak.cli.program import program
from evenbreak.files.store.tournament import read_tournament
from evenbreak.web.site import Site
from web.chromium import claimed, opened
from web.night_shown import RATED
from web.phones import running

pytestmark = pytest.mark.thorough

LIST = "\n".join(
    f"{k}. {name} {rating or ''}".strip() for k, (name, rating) in enumerate(RATED.items(), 1)
)
MOST_TAPS = 100
WITH_PHONES = ("Kev", "Mike Santos", "Ann Lee", "Paul Smith", "Priya Nair")
"""Who scores on a phone of their own, if both players of a match do."""
WRONG, FOUND, LEAVES, RESTART, DIFFER = 4, 9, 14, 12, 2
"""After how many results: one is entered wrongly, and that is found; a player leaves; the page is
restarted; two phones disagree."""

Score = tuple[int, int]


class Evening:
    """The director's phone, the players', and the commands that would do the same."""

    def __init__(self, browser: Any, site: Site, *, scripts: bool) -> None:
        self.browser, self.site, self.scripts = browser, site, scripts
        self.desk = opened(browser, site, java_script_enabled=scripts)
        self.desk.set_default_timeout(8000)
        self.phones: dict[str, Any] = {}
        self.taps, self.scans, self.by_phones = 0, 0, 0
        self.commands: list[str] = []

    @property
    def state(self) -> Any:
        return read_tournament(self.site.path)

    def tap(self, button: Any, *, goes: bool = True) -> None:
        """Tap something on the director's phone."""
        self.taps += 1
        if goes:
            with self.desk.expect_navigation():
                button.click()
        else:
            button.click()

    def begins(self) -> None:
        """Paste the list and draw: neither is counted among the taps for the matches."""
        self.desk.goto(f"{self.site.address}/new")
        for name, text in {"entrants": LIST, "race": "2", "tables": "4"}.items():
            self.desk.fill(f"[name={name}]", text)
        self.desk.get_by_text("More choices").click()
        self.desk.select_option("[name=seeding]", "rating")
        self.desk.select_option("[name=scale]", "fargo")
        with self.desk.expect_navigation():
            self.desk.get_by_role("button", name="Go to check-in").click()
        with self.desk.expect_navigation():
            self.desk.get_by_role("button", name="Draw 19 players").click()
        self.commands.append("draw")
        self.desk.goto(f"{self.site.address}/desk/more")
        itself = self.desk.get_by_role(
            "switch", name="Call the next match automatically when a result comes in"
        )
        if itself.get_attribute("aria-checked") == "false":
            self.tap(itself)
        self.desk.goto(f"{self.site.address}/desk")

    def calls(self) -> None:
        """Call what the desk proposes, all at once if it is several."""
        for _ in range(200):
            state = self.state
            ready = [name for name in state.standing.to_play if name not in state.on_tables]
            if not ready or len(state.on_tables) == 4:
                return
            for name in (re.compile("^Call all"), re.compile(r"^Call( \d+ to table \w+)?$")):
                call = self.desk.get_by_role("button", name=name)
                if call.count():
                    self.tap(call.first)
                    break
            else:  # which match is best is still being worked out
                self.desk.wait_for_timeout(100)
                self.desk.goto(f"{self.site.address}/desk")
        raise AssertionError("no match is proposed for a free table")

    def enters(self, match: str, score: Score) -> None:
        """Tap the winner, then the loser's games."""
        state = self.state
        winner, games = (0, score[1]) if score[0] > score[1] else (1, score[0])
        form = self.desk.locator(".desk-grid form.taps").filter(
            has=self.desk.locator(f"input[name=match][value='{match}']")
        )
        self.tap(form.locator("label.seat").nth(winner), goes=False)
        self.tap(form.locator(f".after{winner} .pad button[value='{games}']"))
        self.commands.append(f"result {state.number_of(match)} {score[0]}:{score[1]}")

    def corrects(self, match: str, score: Score) -> None:
        """Tap the match in the bracket, the winner, the games; a loss is asked about."""
        number = self.state.number_of(match)
        self.desk.goto(f"{self.site.address}/bracket")
        if self.desk.locator(f"a[href*='match={number}']:visible").count() == 0:
            self.desk.goto(f"{self.site.address}/bracket?match={number}#sheet")
            self.taps += 2  # its round, and the match
        else:
            self.tap(self.desk.locator(f"a[href*='match={number}']:visible").first)
        winner, games = (0, score[1]) if score[0] > score[1] else (1, score[0])
        form = self.desk.locator(".sheet form.taps")
        self.tap(form.locator("label.seat").nth(winner), goes=False)
        self.tap(form.locator(f".after{winner} .pad button[value='{games}']"))
        follow = ""
        if (way := self.desk.locator(".bottom button[name=follow]:visible")).count():
            follow = f" --follow {way.first.get_attribute('value')}"
            self.tap(way.first)
        elif (sure := self.desk.get_by_role("button", name="Yes, do it")).count():
            self.tap(sure)
        self.commands.append(f"correct {number} {score[0]}:{score[1]}{follow}")
        self.desk.goto(f"{self.site.address}/desk")

    def phone(self, name: str) -> Any:
        """Return a player's phone, which scans its code the first time only."""
        if name not in self.phones:
            context = self.browser.new_context(
                viewport={"width": 390, "height": 844}, java_script_enabled=self.scripts
            )
            self.phones[name] = context.new_page()
            claimed(self.phones[name], self.site, name)
            self.scans += 1
        return self.phones[name]

    def players_score(self, match: str, score: Score) -> None:
        """Let both tap the games, and the director confirm: both phones have one address."""
        state = self.state
        pair, differ = state.pair(match), self.by_phones == DIFFER
        self.by_phones += 1
        for k, name in enumerate(pair):
            page, mine = self.phone(name), score[::-1] if differ and k else score
            page.goto(f"{self.site.address}/me")
            self.taps_games(page, pair, mine)
        self.desk.goto(f"{self.site.address}/desk")
        if differ:
            said = self.desk.get_by_role("button", name=f"won, says {pair[0]}")
            self.tap(said)
        else:
            self.tap(self.desk.get_by_role("button", name="Confirm").first)
        self.commands.append(f"result {state.number_of(match)} {score[0]}:{score[1]}")

    def taps_games(self, page: Any, pair: tuple[str, str], score: Score) -> None:
        """Tap the games of a match, the winner's last one last, and what is asked after a call."""
        loser = 0 if score[0] < score[1] else 1
        for _ in range(30):
            if page.locator(".sent, .card.is-stop").count():
                return
            if (coming := page.get_by_role("button", name="I'm coming")).count():
                self.shows(page, coming)
                continue
            shown = [page.locator(f".half-score[data-won='{k}']").all_inner_texts() for k in (0, 1)]
            if not all(shown):
                page.wait_for_timeout(100)  # what the last tap led to is just being shown
                continue
            games = [int(one[0]) for one in shown]
            short = [k for k in (loser, 1 - loser) if games[k] < score[k]]
            if not short:  # it is on its way
                page.wait_for_timeout(100)
                continue
            self.shows(page, page.get_by_role("button", name=f"Game for {pair[short[0]]}"))
        raise AssertionError(page.inner_text("main"))

    @staticmethod
    def shows(page: Any, button: Any) -> None:
        """Tap, and wait until the page shows something else: with scripts it stays there."""
        page.wait_for_timeout(620)  # two taps within 0.6 s are one that came twice
        before = page.inner_text("main")
        button.click()
        for _ in range(100):
            page.wait_for_timeout(50)
            if page.inner_text("main") != before:
                return
        raise AssertionError(before)

    def someone_leaves(self) -> None:
        state = self.state
        playing = {name for one in state.on_tables.values() for name in one.call.players}
        left = {name for match in state.standing.to_play for name in state.pair(match)}
        name = min(left - playing or left)
        self.desk.goto(f"{self.site.address}/desk/more")
        self.tap(self.desk.get_by_text("Someone is going home"), goes=False)
        form = self.desk.locator("form[action='/desk/drop']")
        form.locator("select").select_option(name)
        self.taps += 1
        self.tap(form.get_by_role("button", name="Withdraw"))
        if (sure := self.desk.get_by_role("button", name="Yes, do it")).count():
            self.tap(sure)
        self.commands.append(f"drop '{name}'")
        self.desk.goto(f"{self.site.address}/desk")

    def plays(self, luck: random.Random, *, until: int) -> None:
        """Play on until so many results have been entered, or the evening is over."""
        while (state := self.state).standing.to_play and len(self.entered) < until:
            self.calls()
            state = self.state
            tables = sorted(state.on_tables, key=lambda name: state.on_tables[name].call.table)
            match = luck.choice(tables)
            own = [name for name in tables if {*state.pair(name)} <= {*WITH_PHONES}]
            needs = state.needed(match, state.pair(match))
            score = (needs[0], luck.randrange(needs[1]))
            if luck.random() < 0.4:
                score = (luck.randrange(needs[0]), needs[1])
            if own and self.by_phones <= DIFFER:
                match, score = own[0], (2, 1)
                self.players_score(match, score)
            elif len(self.entered) == WRONG:
                self.enters(match, score[::-1] if score[0] != score[1] else score)
                self.wrong = match, score
            else:
                self.enters(match, score)
            self.entered.append(match)
            if len(self.entered) == FOUND:
                self.corrects(*self.wrong)
            if len(self.entered) == LEAVES:
                self.someone_leaves()

    entered: list[str]
    wrong: tuple[str, Score]


@pytest.mark.parametrize("scripts", [True, False], ids=["with scripts", "without scripts"])
def test_an_evening_by_phones_ends_as_by_commands(
    browser: Any, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, *, scripts: bool
) -> None:
    luck = random.Random(7)
    with running(tmp_path / "page.db") as site:
        evening = Evening(browser, site, scripts=scripts)
        evening.entered = []
        evening.begins()
        evening.plays(luck, until=RESTART)
        address = site.address
    with running(tmp_path / "page.db", port=int(address.rpartition(":")[2])) as site:
        evening.site = site
        evening.desk.goto(f"{address}/desk")
        evening.plays(luck, until=999)
        by_page = read_tournament(site.path)
        evening.desk.goto(address)
        assert not by_page.standing.to_play
        for page in evening.phones.values():
            page.goto(f"{address}/me")
            assert "Who are you?" not in page.inner_text("main")
    assert len(evening.entered) >= 33
    assert evening.taps <= MOST_TAPS, f"{evening.taps} taps for {len(evening.entered)} results"
    assert evening.scans == len(evening.phones)

    monkeypatch.chdir(tmp_path)
    Path("entrants.txt").write_text(LIST, encoding="utf-8")
    races = "--race 2 --tables 4 --seeding rating --scale fargo"
    typed(f"tournament new entrants.txt --out commands.db {races}")
    for command in evening.commands:
        typed(f"tournament {command} --file commands.db")
    by_commands = read_tournament("commands.db")
    assert by_commands.counted == by_page.counted
    assert by_commands.order == by_page.order
    answers = [
        json.loads(typed(f"tournament next --file {file} --json"))
        for file in ("page.db", "commands.db")
    ]
    assert answers[0]["places"] == answers[1]["places"]


def typed(line: str) -> str:
    """Return what a command says."""
    done = CliRunner().invoke(program, shlex.split(line))
    assert done.exit_code == 0, (line, done.output)
    return done.stdout
