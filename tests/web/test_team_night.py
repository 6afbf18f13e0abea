"""A team night through the page: each captain's phone, the director's, a guest's, the screen."""

import itertools
import json
import re
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import NamedTuple

import pytest
from click.testing import CliRunner

from evenbreak.cli.program import program
from evenbreak.files.league.league_file import read_league
from evenbreak.files.store.team_night import read_team_events
from evenbreak.files.store.tournament import new_tournament, read_tournament
from evenbreak.handicaps.charts.level_chart import level_chart
from evenbreak.teams.evening.events import LevelsTonight, meeting_of
from evenbreak.teams.evening.fold import TeamEvening, team_evening
from evenbreak.tournaments.evening.events import Entrant, Event, Opened, Plan
from evenbreak.web.site import Site
from web.conftest import Opens
from web.phones import Phone, Shown, answering, running

RACKS = {"Ann": (640, 6), "Bo": (560, 5), "Cleo": (500, 5), "Dan": (450, 4)}
CUES = {"Uli": (600, 6), "Vic": (580, 5), "Wim": (490, 4)}
AT = "2025-03-01T20:00:00"


def listed(team: dict[str, tuple[int, int]]) -> str:
    rows = [f"{name},{rating},{level}" for name, (rating, level) in team.items()]
    return "\n".join(["player,rating,level", *rows])


def fields(**how: object) -> dict[str, object]:
    """Return the form of a night of three sets, with what is said besides."""
    return {
        "team_a": "Racks",
        "team_b": "Cues",
        "players_a": listed(RACKS),
        "players_b": listed(CUES),
        "race": 4,
        "races": "even",
        "order": "alternate",
        "scale": "fargo",
        "count": "sets",
        **how,
    }


class Night(NamedTuple):
    """A page with a team night, and the phones in the room."""

    site: Site
    director: Phone
    captains: tuple[Phone, Phone]
    guest: Phone

    @property
    def state(self) -> TeamEvening:
        """What the file holds now."""
        state = team_evening(read_team_events(self.site.path))
        assert state is not None
        return state

    def put(self, side: int, name: str, *, by: Phone | None = None, **more: object) -> Shown:
        """Let a captain put somebody up in the set that comes next."""
        state = self.state
        pick = ",".join(str(state.plan.teams[side].players.index(one)) for one in name.split("+"))
        line = state.to_name
        asked = {"night": state.began, "by": side, "number": line.number if line else 1}
        return (by or self.captains[side]).send("/team/put", **{**asked, "pick": pick, **more})

    def say(self, side: int, number: int, score: tuple[int, int], **more: object) -> Shown:
        """Let a captain enter the result of a set."""
        asked = {"night": self.state.began, "by": side, "number": number}
        asked |= {"a": score[0], "b": score[1], **more}
        return self.captains[side].send("/team/result", **asked)

    def direct(self, what: str, **asked: object) -> Shown:
        """Send a form of the director."""
        return self.director.send(
            f"/team/{what}", **{"night": self.state.began, "by": "director", **asked}
        )


@contextmanager
def night_of(path: Path, opened: Opens = answering, **how: object) -> Iterator[Night]:
    with opened(path) as site:
        director = Phone(site, director=True)
        shown = director.send("/team/new", **fields(**how))
        assert shown.status == 200, shown.words
        captains = Phone(site), Phone(site)
        night = Night(site, director, captains, Phone(site))
        for side, phone in enumerate(captains):
            pin = site.captain_pin(night.state.began, side)
            assert phone.send("/team/pin", pin=pin).status == 200
        yield night


@pytest.fixture
def night(tmp_path: Path) -> Iterator[Night]:
    with night_of(tmp_path / "tonight.db") as found:
        yield found


def lineup(folder: Path, *words: str) -> dict:
    """Return what the command answers for the same teams."""
    places = []
    for name, team in (("ours", RACKS), ("theirs", CUES)):
        places.append(folder / f"{name}.csv")
        places[-1].write_text(listed(team))
    asked = ["lineup", *map(str, places), "--race", "4", "--scale", "fargo", *words, "--json"]
    return json.loads(CliRunner().invoke(program, asked).stdout)


def offered(shown: Shown) -> list[tuple[str, str]]:
    """Return the picks that a captain's page offers, each with its chance."""
    found = re.findall(
        r'<bdi class="pair">([^<]+)</bdi>(?: \(\d+\))? <span class="worth">([^<]+)</span>',
        shown.text,
    )
    return [(name, chance) for name, chance in found]


def asked_for(answer: dict) -> list[tuple[str, str]]:
    return [(row["name"], f"{100 * row['p_win']:.1f}%") for row in answer["options"]]


def test_the_advice_is_that_of_the_command(night: Night, tmp_path: Path) -> None:
    first = lineup(tmp_path, "--order", "ABA")
    shown = night.captains[0].open("/team")
    assert offered(shown) == asked_for(first)
    assert first["options"][0]["answer"] in shown.words
    assert f"Racks wins the night {first['p_win']:.0%} of the time" in night.guest.open("/").words

    night.put(0, "Bo")
    night.put(1, "Vic")
    for side in (0, 1):
        night.say(side, 1, (4, 1))
    night.put(1, "Wim")
    so_far = ("--order", "ABA", "--used", "Bo,Vic", "--score", "1:0", "--named", "Wim")
    second = lineup(tmp_path, *so_far)
    assert offered(night.captains[0].open("/team")) == asked_for(second)

    night.put(0, "Dan")  # and while set 2 is being played
    playing = (*so_far[:-2], "--playing", "Dan v Wim 0:0")
    third = lineup(tmp_path, *playing)
    assert offered(night.captains[0].open("/team")) == asked_for(third)
    assert f"{third['p_win']:.0%}" in night.guest.open("/screen").words


@pytest.mark.slow
def test_a_cap_keeps_out_who_would_break_it(tmp_path: Path) -> None:
    with night_of(tmp_path / "tonight.db", cap="15") as night:
        free = lineup(tmp_path, "--order", "ABA", "--cap", "15")
        shown = night.captains[0].open("/team")
        assert offered(shown) == asked_for(free)
        assert re.search(r"Ann</bdi> \(\d+\)", shown.text)  # what she counts under the cap
        for side, name, total in ((0, "Ann", 6), (1, "Wim", 4), (1, "Vic", 9), (0, "Bo", 11)):
            assert night.put(side, name).status == 200
            words = night.captains[side].open("/team").words
            assert f"is {total}; the limit is 15" in words
        words = night.captains[0].open("/team").words
        assert "Cleo can't be put up in set 3" in words
        assert night.put(0, "Cleo").status == 400


@pytest.mark.slow
def test_the_page_says_when_the_next_set_starts_and_when_the_night_ends(tmp_path: Path) -> None:
    with night_of(tmp_path / "tonight.db", tables="2", discipline="9-ball") as night:
        plan = night.state.plan
        assert (plan.tables, plan.discipline) == (2, "9-ball")
        for number, picks in enumerate((((0, "Ann"), (1, "Wim")), ((1, "Vic"), (0, "Bo"))), 1):
            assert f"Set {number} can start now" in night.captains[0].open("/team").words
            for side, name in picks:
                night.put(side, name)
        for phone in (*night.captains, night.guest):
            words = phone.open("/team").words
            assert re.search(r"Set 3 starts at about \d\d:\d\d \(8 nights in 10", words)
            assert re.search(r"the night ends at about \d\d:\d\d \(8 nights in 10", words)
        assert "the night ends at about" in night.guest.open("/screen").words
        for number in (1, 2, 3):
            if number == 3:
                for side, one in enumerate(("Dan", "Uli")):
                    night.put(side, one)
            night.direct("result", number=number, a=4, b=1)
        assert "ends at about" not in night.guest.open("/team").words


def by_level(team: dict[str, tuple[int, int]]) -> str:
    return "\n".join(["player,level", *(f"{name},{level}" for name, (_, level) in team.items())])


@pytest.mark.slow
@pytest.mark.parametrize(
    ("chart", "race", "score", "brought"),
    [("apa_8ball", "5:3", (5, 2), "2-1"), ("apa_9ball", "46:31", (46, 21), "15-5")],
)
def test_a_night_by_skill_level_alone(
    tmp_path: Path, chart: str, race: str, score: tuple[int, int], brought: str
) -> None:
    lists = {"players_a": by_level(RACKS), "players_b": by_level(CUES), "scale": ""}
    with night_of(
        tmp_path / "tonight.db", **lists, races=chart, count="points", cap="15", at_most="1:6"
    ) as night:
        names = ("ours", "theirs")
        for name, team in zip(names, (RACKS, CUES), strict=True):
            (tmp_path / f"{name}.csv").write_text(by_level(team))
        asked = ["lineup", *(str(tmp_path / f"{name}.csv") for name in names), "--chart", chart]
        asked += ["--count", "points", "--cap", "15", "--at-most", "1:6", "--json"]
        told = json.loads(CliRunner().invoke(program, asked).stdout)
        assert offered(night.captains[0].open("/team")) == asked_for(told)
        night.put(0, "Ann")
        night.put(1, "Wim")
        assert f"race {race}" in night.captains[0].open("/team").words
        for side in (0, 1):
            night.say(side, 1, score)
        assert brought in night.guest.open("/team").words
    with answering(tmp_path / "other.db") as site:
        lists["players_b"] = "player,level\nUli,6\nVic,\nWim,4"
        shown = Phone(site, director=True).send("/team/new", **fields(**lists, races=chart))
        assert "Vic has no skill level" in shown.words
        lists["players_b"] = by_level(CUES)
        shown = Phone(site, director=True).send("/team/new", **fields(**lists, races=chart))
        assert told["sentences"][-1] in shown.words  # what the chances rest on


@pytest.mark.slow
@pytest.mark.parametrize("own", [False, True])
def test_a_night_by_levels_goes_by_the_leagues_own_results(tmp_path: Path, own: bool) -> None:
    """The page says what `lineup` says, also after a restart on other results."""
    rows = ["player_a,player_b,score_a,score_b,level_a,level_b"]  # every 5 beats every 4 easily
    rows += [f"P{k % 9},Q{k % 7},5,{k % 2},5,4" for k in range(120 if own else 20)]
    (tmp_path / "results.csv").write_text("\n".join(rows))
    rules = 'name = "Ours"\nchart = "apa_8ball"\n[[results]]\nfile = "results.csv"\n'
    (tmp_path / "league.toml").write_text(rules)
    places = []
    for name, team in (("ours", RACKS), ("theirs", CUES)):
        places.append(str(tmp_path / f"{name}.csv"))
        Path(places[-1]).write_text(by_level(team))
    asked = ["lineup", *places, "--league", str(tmp_path), "--json"]
    told = json.loads(CliRunner().invoke(program, asked).stdout)
    assert ("your own results" in told["sentences"][-1]) is own
    path = tmp_path / "tonight.db"
    lists = {"players_a": by_level(RACKS), "players_b": by_level(CUES), "scale": ""}
    with answering(path) as site:
        site.rules = read_league(tmp_path)
        shown = Phone(site, director=True).send("/team/new", **fields(**lists, races="apa_8ball"))
        assert told["sentences"][-1] in shown.words  # what the chances rest on
    (tmp_path / "results.csv").unlink()
    meeting_of.cache_clear()
    with answering(path) as site:
        state = team_evening(read_team_events(path))
        assert state is not None
        captain = Phone(site)
        captain.send("/team/pin", pin=site.captain_pin(state.began, 0))
        assert offered(captain.open("/team")) == asked_for(told)
    levels = state.plan.levels
    assert levels is not None
    assert levels == LevelsTonight.of(levels.skills(level_chart("apa_8ball")))


PAGES = ("/team", "/screen", "/", "/desk", "/team/history", "/team/new")


def test_nobody_else_sees_a_captains_advice(night: Night) -> None:
    for moment in (lambda: None, lambda: night.put(0, "Ann"), lambda: night.put(1, "Wim")):
        moment()
        chances = [dict(offered(phone.open("/team"))) for phone in night.captains]
        assert sum(map(bool, chances)) == 1
        due = 0 if chances[0] else 1
        advised = "Best pick now"
        assert advised in night.captains[due].open("/team").words
        for phone in (night.captains[1 - due], night.director, night.guest):
            for page in PAGES:
                shown = phone.open(page)
                assert advised not in shown.words
                assert not [one for one in chances[due].values() if one in shown.words]


@pytest.mark.slow
@pytest.mark.parametrize("order", ["blind", "sealed"])
def test_nobody_else_sees_an_unseen_pick(tmp_path: Path, order: str) -> None:
    with night_of(tmp_path / "tonight.db", order=order) as night:
        others = (night.captains[1], night.director, night.guest)
        before = [[phone.open(page).words for page in PAGES[:4]] for phone in others]
        if order == "blind":
            shown = night.put(0, "Dan")
        else:
            line_up = {"pick1": 3, "pick2": 0, "pick3": 1}
            shown = night.captains[0].send("/team/hand", night=night.state.began, by=0, **line_up)
        assert shown.status == 200
        assert "Dan" in night.captains[0].open("/team").words
        for phone, earlier in zip(others, before, strict=True):
            for page, words in zip(PAGES, [*earlier, "", ""], strict=True):
                now = phone.open(page).words
                assert now.count("Dan") <= words.count("Dan")  # the captain's own list
        assert "Dan" not in night.guest.open("/team").words
        assert "Dan" not in night.director.open("/team").words
        assert "handed in" in night.guest.open("/team").words
        if order == "blind":  # the director does not find it by guessing either
            for pick in range(4):
                asked = {"number": 1, "team": 0, "pick": pick}
                assert night.direct("put", **asked).status == 409
            night.put(1, "Wim")
        else:
            night.direct("hand", team=1, pick1=0, pick2=1, pick3=2)
        assert "Dan" in night.guest.open("/team").words
        assert "Dan" in night.director.open("/team/history").words


@pytest.mark.slow
def test_where_it_is_best_to_draw_lots_the_page_draws_them(tmp_path: Path) -> None:
    with night_of(tmp_path / "tonight.db", order="blind") as night:
        found = []
        for phone in night.captains:
            texts = {re.sub(r'"once" value="[^"]+"', "", phone.open("/team").text) for _ in "ab"}
            assert len(texts) == 1  # drawn once
            found.append(
                re.search(r'pick"><bdi>(\w+)<.*?value="(\d)" required checked', *texts, re.S)
            )
        answer = lineup(tmp_path, "--order", "blind")
        mixed = {row["name"] for row in answer["options"] if row["mix"] > 0}
        assert found[0]
        assert found[0][1] in mixed
        assert list(RACKS)[int(found[0][2])] == found[0][1]


def test_both_captains_enter_a_result_and_the_director_settles_what_differs(night: Night) -> None:
    night.put(0, "Ann")
    night.put(1, "Wim")
    assert "counts once Cues" in night.say(0, 1, (4, 2)).words
    assert "a different result" in night.say(1, 1, (2, 4)).words
    assert night.state.score == (0, 0)
    assert night.director.open("/team").words.count(" reports ") == 3  # one is what can be undone
    assert night.direct("result", number=1, a=4, b=2).status == 200
    assert night.state.score == (1, 0)
    assert night.say(1, 1, (2, 4)).status == 400
    assert night.direct("result", number=1, a=2, b=4).status == 200
    assert night.state.score == (0, 1)
    by = [one.by for one in read_team_events(night.site.path)]
    assert by[1:3] == ["captain of Racks", "captain of Cues"]
    assert {by[0], by[-1]} == {"director's page"}
    assert "Result in set 1: 2-4" in night.director.open("/team/history").words


def test_a_form_that_comes_in_twice_does_nothing_twice(night: Night) -> None:
    found = re.search(r'name="once" value="([^"]+)"', night.captains[0].open("/team").text)
    assert found
    asked = {"once": found[1], "number": 1}
    night.put(0, "Ann", **asked)
    assert "already been entered" in night.put(0, "Ann", **asked).words
    events = read_team_events(night.site.path)
    undo = {"seen": len(events), "once": "u"}
    for _ in range(2):
        assert night.direct("undo", **undo).status == 200
    assert night.state.sets[0].picks[0] == ()
    night.put(0, "Ann", **asked)  # a replay from before the undo
    assert night.state.sets[0].picks[0] == ()
    assert len(read_team_events(night.site.path)) == len(events) + 1
    assert night.direct("undo", seen=1).status == 409
    shown = night.director.send("/team/new", **fields(once="n", race=5))
    began = night.state.began
    night.put(0, "Bo")
    assert night.director.send("/team/new", **fields(once="n", race=5)).status == shown.status
    assert night.state.began == began


def test_undo_names_the_entry_and_whose_it_is(night: Night) -> None:
    night.put(0, "Ann")
    shown = night.director.open("/team")
    assert "Undo the entry by captain of Racks: Racks put up Ann in set 1" in shown.words
    seen = re.search(r'name="seen" value="([^"]+)"', shown.text)
    assert seen
    night.put(1, "Wim")
    assert night.direct("undo", seen=seen[1]).status == 409
    night.direct("result", number=1, a=4, b=2)
    assert "Undo: result in set 1: 4-2" in night.director.open("/team").words
    german = Phone(night.site, director=True, language="de").open("/team").words
    assert "Zurücknehmen: " in german


@pytest.mark.slow
def test_both_captains_at_the_same_moment_lose_nothing(tmp_path: Path) -> None:
    with night_of(tmp_path / "tonight.db", order="blind") as night:

        def both(move) -> None:
            codes = []
            threads = [
                threading.Thread(target=lambda k=k: codes.append(move(k).status)) for k in (0, 1)
            ]
            for thread in threads:
                thread.start()
            for thread in threads:
                thread.join()
            assert codes == [200, 200]

        for number, pair in enumerate((("Ann", "Wim"), ("Bo", "Vic"), ("Dan", "Uli")), 1):
            both(lambda side, pair=pair, number=number: night.put(side, pair[side], number=number))
            both(lambda side, number=number: night.say(side, number, (4, number)))
        assert night.state.score == (3, 0)
        assert "Racks has won the night" in night.guest.open("/team").words


@pytest.mark.slow
def test_a_night_survives_a_restart_and_needs_no_tournament(tmp_path: Path) -> None:
    path = tmp_path / "tonight.db"
    with night_of(path) as night:
        night.put(0, "Ann")
    with answering(path) as site:
        for phone in (night.director, *night.captains):
            phone.site = site
        again = night._replace(site=site, guest=Phone(site))
        assert again.put(1, "Wim").status == 200
        assert "Captain of Cues" in again.captains[1].open("/team").words
        assert again.guest.open("/").url.endswith("/team")
        assert "Ann – Wim" in again.guest.open("/screen").words
        assert again.director.open("/desk").url.endswith("/team")
        assert again.guest.open("/bracket").status == 404

    shown = CliRunner().invoke(program, ["tournament", "show", "--file", str(path)])
    assert shown.exit_code == 3
    assert "holds a team night, not a tournament" in shown.stderr
    assert len(shown.stderr.strip().splitlines()) == 1

    entrants = tuple(Entrant(name, 500.0) for name in RACKS)
    new_tournament(path, [Event(AT, Opened(Plan("single", 3, scale="fargo"), entrants))])
    assert len(read_tournament(path).entrants) == 4
    with answering(path) as site:
        guest = Phone(site)
        assert "4 players have entered" in guest.open("/").words
        assert "Ann – Wim" in guest.open("/team").words
        assert "Racks" not in guest.open("/screen").words


def test_serve_takes_a_file_with_a_team_night_alone(tmp_path: Path) -> None:
    path = tmp_path / "tonight.db"
    with night_of(path, running) as night:
        port = night.site.address.rpartition(":")[2]
        shown = CliRunner().invoke(program, ["serve", str(path), "--port", port])
    assert shown.exit_code == 2
    assert f"--port {port}" in shown.stderr  # it got as far as that


def test_who_may_do_what(night: Night) -> None:
    number = {"night": night.state.began, "number": 1}
    for phone, by in (
        (night.guest, 0),
        (night.guest, "director"),
        (night.captains[0], 1),
        (night.captains[0], "director"),
    ):
        more = {**number, "by": by, "team": 1}
        assert phone.send("/team/put", pick=0, **more).status == 403
        assert phone.send("/team/hand", pick1=0, pick2=1, pick3=2, **more).status == 403
        assert phone.send("/team/result", a=4, b=0, **more).status == 403
        assert phone.send("/team/undo", seen=1).status == 403
        assert phone.send("/team/new", **fields()).status == 403
        assert phone.open("/team/history").status == 403
        assert phone.open("/team/new").status == 403
    stolen = night.guest.token()
    asked = {"csrf": stolen, "by": 0, "pick": 0, **number}
    assert night.captains[0].send_raw("/team/put", asked).status == 403
    assert len(read_team_events(night.site.path)) == 1
    night.captains[0].send("/team/leave")
    assert night.put(0, "Ann").status == 403


def test_a_captains_pin_is_for_one_night_and_guessing_is_slow(night: Night) -> None:
    pins = {night.site.captain_pin(night.state.began, side) for side in (0, 1)}
    assert len(pins | {night.site.pin}) == 3
    assert not [pin for pin in pins if pin in night.guest.open("/team").text]
    assert all(pin in night.director.open("/team").text for pin in pins)
    old = night.state.began
    assert night.director.send("/team/new", **fields(race=5)).status == 200
    assert night.put(0, "Ann").status == 403
    assert night.direct("put", night=old, team=0, number=1, pick=0).status == 409
    codes = [night.guest.send("/team/pin", pin=f"wrong{k}").status for k in range(5)]
    assert codes == [403] * 5
    right = night.site.captain_pin(night.state.began, 0)
    assert night.guest.send("/team/pin", pin=right).status == 429
    assert night.guest.send("/pin", pin=night.site.pin).status == 429


@pytest.mark.slow
def test_who_names_next_waits_for_the_result_where_it_decides_that(tmp_path: Path) -> None:
    with night_of(
        tmp_path / "tonight.db", order="loser", doubles="3", times="2", sets="3"
    ) as night:
        assert night.put(0, "Ann").status == 200
        assert night.put(1, "Wim").status == 200
        for phone in (*night.captains, night.guest):
            words = phone.open("/team").words
            assert "The loser of set 1 puts up first in set 2" in words
        assert night.put(0, "Bo").status == 400
        night.direct("result", number=1, a=4, b=0)
        assert night.state.due == (1,)
        night.put(1, "Vic")
        night.direct("put", team=0, number=2, pick=1)
        night.direct("result", number=2, a=1, b=4)
        assert night.put(0, "Ann").status == 400  # a pair plays set 3
        assert night.put(0, "Cleo+Ann").status == 200
        assert "Ann and Cleo" in night.captains[1].open("/team").words


SCRIPT = "<script>alert(1)</script>"


@pytest.mark.slow
def test_names_of_teams_and_players_are_text(tmp_path: Path) -> None:
    more = {"team_b": SCRIPT, "players_b": f"player,rating\n{SCRIPT},500\n'; DROP,400\nC,300"}
    with night_of(tmp_path / "tonight.db", team_a="../../x", **more) as night:
        night.put(0, "Ann")
        for phone in (*night.captains, night.director):
            for page in PAGES:
                assert SCRIPT not in phone.open(page).text
        assert night.state.teams == ("../../x", SCRIPT)


@pytest.mark.slow_after(13)
@pytest.mark.parametrize(
    ("how", "why"),
    [
        ({"team_b": " "}, "has no name"),
        ({"team_b": "\u200b"}, "has no name"),
        ({"team_b": "Cu\x07es"}, "can't be printed"),
        ({"team_b": "rac\u200bks"}, "both teams are called"),
        ({"players_b": ""}, "Enter at least one player"),
        ({"players_b": "player,rating\nUli,high"}, "Cues: line 2: rating 'high'"),
        ({"cap": "5"}, "no lineup"),
        ({"cap": "-1"}, "number above 0"),
        ({"sets": "9"}, "can't fill 9 sets"),
        ({"race": "0"}, "whole number"),
        ({"races": "sideways"}, "must be one of"),
        ({"pattern": "AXB"}, "order 'axb'"),
        ({"at_most": "two"}, "such as 2:6"),
        ({"doubles": "last"}, "doesn't name any sets"),
        ({"doubles": "8"}, "set 8"),
        ({"players_a": "player,level\nAnn,6\nBo,5"}, "how many levels double the odds"),
        ({"players_b": "player,rating,scale\nUli,80,npl\nVic,70,npl"}, "different scales"),
    ],
)
def test_a_night_that_cannot_be_played_is_refused(
    standing: Night, how: dict[str, object], why: str
) -> None:
    if "scale" in str(how.get("players_b")):
        how = {**how, "players_a": "player,rating,scale\nAnn,500,fargo\nBo,400,fargo"}
    shown = standing.director.send("/team/new", **fields(**how))
    assert shown.status == 400
    assert why.lower() in shown.words.lower()
    assert len(read_team_events(standing.site.path)) == 1


@pytest.fixture(scope="module")
def standing(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Night]:
    """A night for tests that change nothing."""
    with night_of(tmp_path_factory.mktemp("team") / "tonight.db") as found:
        yield found


def test_all_choices_of_the_form_make_the_plan(tmp_path: Path) -> None:
    more = {
        "players_a": "Ann,6.5\nBo,5.5\nCleo,5\nDan,4",
        "doubling": "1.5",
        "races": "fair",
        "count": "games",
        "pattern": "BA",
        "cap": "20",
        "at_most": "2:6",
        "times": "2",
        "sets": "4",
        "sure": "yes",
    }
    with night_of(tmp_path / "tonight.db", **more) as night:
        plan = night.state.plan
        assert (plan.handicapped, plan.count, plan.order, plan.times) == (True, "games", "BA", 2)
        assert (plan.cap, plan.at_most, plan.sets, plan.scale) == (20.0, (2, 6.0), 4, "1.5")
        assert plan.teams[0].weights == (6.5, 5.5, 5.0, 4.0)
        assert night.state.due == (1,)


def test_each_team_may_come_in_a_file(tmp_path: Path) -> None:
    teams = {"file_a": listed(RACKS).encode(), "file_b": listed(CUES).encode()}
    with answering(tmp_path / "tonight.db") as site:
        asked = fields(players_a="", players_b="")
        shown = Phone(site, director=True).send_files("/team/new", teams, **asked)
        assert shown.status == 200, shown.words
        state = team_evening(read_team_events(site.path))
        assert [sheet.players for sheet in state.plan.teams] == [tuple(RACKS), tuple(CUES)]


def test_players_without_a_rating_have_that_of_the_league(tmp_path: Path) -> None:
    names = ["Ann", "Bo", "Cleo", "Dan", "Uli", "Vic"]
    rows = [
        f"{a},{b},{7 if k % 3 else 5},{5 if k % 3 else 7}"
        for k, (a, b) in enumerate(itertools.permutations(names, 2))
    ]
    results = "\n".join(["player_a,player_b,score_a,score_b", *rows])
    with answering(tmp_path / "tonight.db") as site:
        director = Phone(site, director=True)
        director.send("/league", results=results, scale="fargo", race=7)
        for _ in range(200):
            if site.league.sheet is not None:
                break
            time.sleep(0.02)
        assert site.league.sheet is not None
        teams = {"players_a": "Ann\nBo\nNew", "players_b": "Uli,,5\nvic,555,4"}
        shown = director.send("/team/new", **fields(**teams))
        assert shown.status == 200, shown.words
        assert "1 player without a rating (New)" in shown.words
        now = site.teams._now()
        assert now is not None
        ours, theirs = now.state.plan.teams
        known = [site.league.known(name) for name in ("Ann", "Bo", "Uli")]
        assert [*ours.ratings[:2], theirs.ratings[0]] == [one[1] for one in known if one]
        assert theirs.ratings[1] == 555.0


@pytest.mark.parametrize("path", ["/team", "/team/new"])
def test_a_page_is_small_and_works_without_a_script(standing: Night, path: str) -> None:
    for phone in (standing.director, standing.captains[0]):
        text = phone.open(path).text
        assert phone.travels(path) < 60_000
        assert "style=" not in text
        assert text.count("<script>") <= 1
    assert "Kapitän von Racks" in german(standing).open("/team").words


def german(night: Night) -> Phone:
    phone = Phone(night.site, language="de")
    phone.send("/team/pin", pin=night.site.captain_pin(night.state.began, 0))
    return phone
