"""Every answer of the interface keeps to its own schema, over whole evenings of every format."""

from __future__ import annotations

import asyncio
import re
from collections.abc import Iterator
from contextlib import closing
from pathlib import Path
from typing import Any

import pytest
from jsonschema import Draft202012Validator

from evenbreak.tournaments.evening.later_draws import can_draw
from evenbreak.web.api import RESOURCES, description
from evenbreak.web.api.resource import V1
from evenbreak.web.site import Site
from web.asked import Browser, Room
from web.test_random_evenings import FORMS
from web.test_who_may import TEAMS


@pytest.fixture
def director(tmp_path: Path) -> Iterator[Browser]:
    site = Site(tmp_path / "tonight.db", hosts=frozenset({"localhost"}), clock=Clock())
    with closing(Room(site)) as room:
        yield Browser(room, director=True)


class Clock:
    """A minute later each time a result is entered."""

    minutes = 0

    def __call__(self) -> str:
        return f"2025-03-01T{19 + self.minutes // 60}:{self.minutes % 60:02}:00"


def begin(director: Browser, form: str, **more: object) -> None:
    many = 16 if form == "pods" else 6
    listed = "\n".join(f"P{k:02},{700 - 20 * k}" for k in range(many))
    plan = {
        "entrants": listed, "format": form, "races": "even", "race": 3, "tables": 3,
        "discipline": "8-ball", "seeding": "listed", "scale": "fargo", **FORMS[form], **more,
    }  # fmt: skip
    if form == "chips":
        plan.pop("race")
    got = director.send("/new", **plan)
    assert got.status == 303, got.words


def known(director: Browser) -> None:
    """Wait until the odds are worked out."""
    night = director.room.site.night
    for _ in range(200):
        director.room.loop.run_until_complete(night.outlook())
        if night.known and night.known.of is night.state():
            return
        director.room.loop.run_until_complete(asyncio.sleep(0.02))
    raise AssertionError("the odds are not worked out")


def told(browser: Browser, query: str = "", race: str = "P00") -> dict[str, Any]:
    """Return all that is answered, each checked by its own schema, and by its ETag."""
    found, other = {}, "P01" if race == "P00" else "Ant"
    for path, validator in VALIDATORS.items():
        more = {"/tonight/race": f"?a={race}&b={other}", "/tonight/tables": ""}.get(path, query)
        got = browser.tells("GET", f"{V1}{path}{more}")
        assert got.status == 200, (path, got.text)
        assert [f"{one.json_path}: {one.message}" for one in validator.iter_errors(got.json)] == []
        tag = got.headers["etag"]
        again = browser.tells("GET", f"{V1}{path}{more}", if_none_match=tag)
        same = again.headers["etag"] == tag  # unless odds have been worked out since
        assert again.status == 304 if same else again.json != got.json
        found[path.removeprefix("/tonight").strip("/")] = got.json
    check_groups(found["standings"], found["matches"]["matches"])
    return found


def check_groups(standings: dict[str, Any], matches: list[dict[str, Any]]) -> None:
    """Compare what groups say of each player's matches with the matches themselves."""
    for group in standings["groups"]:
        swiss = re.fullmatch(r"Standings after round (\d+)", group["title"])
        rounds = int(swiss[1]) if swiss else 99
        chosen = [
            {side["name"]: side["won"] for side in one["players"]} for one in matches
            if one["state"] in ("done", "forfeit") and one["column"] < rounds
            and group["title"] in (one["part"], *([swiss[0]] if swiss else ["Chips"]))
        ]  # fmt: skip
        ranks = [one["rank"] for one in group["players"]]
        assert ranks == sorted(ranks)
        for one in group["players"]:
            own = [match[one["name"]] for match in chosen if one["name"] in match]
            byes = rounds - len(own) if swiss else 0
            assert (one["won"], one["lost"]) == (sum(own) + byes, len(own) - sum(own)), one


def validator_of(path: str) -> Draft202012Validator:
    got = description()["paths"][V1 + path]["get"]["responses"]["200"]
    schema = got["content"]["application/json"]["schema"]
    return Draft202012Validator(
        {**closed(schema), "components": closed(description()["components"])}
    )


def closed(schema: Any) -> Any:
    """Return a schema that allows no other names than those that it has."""
    if isinstance(schema, list):
        return [closed(one) for one in schema]
    if not isinstance(schema, dict):
        return schema
    found = {key: closed(value) for key, value in schema.items()}
    return found | ({"additionalProperties": False} if schema.get("type") == "object" else {})


VALIDATORS = {
    one.path: validator_of(one.path)
    for one in RESOURCES
    if one.method == "GET" and one.path.startswith("/tonight") and one.path != "/tonight/team"
    and not one.path.endswith("/changes")
}  # fmt: skip


def play(director: Browser, most: int, event: int = 1) -> int:
    """Enter results as they can be, the first players' wins; return how many were entered."""
    site = director.room.site
    night = next(one for one in site.nights if one.event == event)
    for played in range(most):
        state = night.state()
        if can_draw(state):
            assert director.send("/desk/draw", event=event).status == 303
            state = night.state()
        if not state.standing.to_play:
            if director.send("/desk/tiebreak", event=event).status != 303:
                return played
            continue
        match = state.standing.to_play[0]
        one, other = state.pair(match)
        a, b = state.needed(match, (one, other))
        wins = state.entrants[one].rating > state.entrants[other].rating
        score = (a, 0) if wins else (0, b)
        site.clock.minutes += 1  # type: ignore[attr-defined]
        got = director.send("/desk/result", match=match, a=score[0], b=score[1], event=event)
        assert got.status == 303, got.words
    return most


@pytest.mark.slow_after(1)
@pytest.mark.parametrize("form", ["single", *(form for form in FORMS if form != "single")])
def test_every_answer_keeps_to_its_schema(director: Browser, form: str) -> None:
    begin(director, form)
    before = told(director)
    assert before[""]["state"] == "registered"
    assert before["bracket"]["parts"] == before["matches"]["matches"] == []
    assert director.send("/desk/draw", sure="yes").status == 303
    known(director)
    drawn = told(director)
    assert drawn["odds"]["known"]
    assert sum(one["title"] for one in drawn["odds"]["players"]) == pytest.approx(1.0, abs=0.01)
    assert drawn["finish"]["ends"]["early"] <= drawn["finish"]["ends"]["late"]
    assert form == "chips" or drawn["queue"]["queue"][0]["table"] == "1"
    night = director.room.site.night
    if form != "chips":
        first = drawn["queue"]["queue"][0]["match"]
        name = first["name"]
        assert director.send("/desk/call", match=name, table=1).status == 303
        assert director.send("/desk/score", match=name, a=1, b=0).status == 303
        known(director)
        table = told(director)["tables"]["tables"][0]
        assert (table["state"], table["match"]["number"]) == ("playing", first["number"])
        assert [one["games"] for one in table["match"]["players"]] == [1, 0]
        p, q = (one["chance"] for one in table["match"]["players"])
        assert p + q == pytest.approx(1.0)
    for _ in range(2):  # then a Swiss is in its second round
        play(director, 2)
        told(director)
    play(director, 200)
    known(director)
    over = told(director)
    assert over[""]["state"] == "finished"
    assert over[""]["played"] == over[""]["matches"]
    placed = [one["name"] for one in over["standings"]["places"]]
    assert sorted(placed) == sorted(night.state().order)
    assert over[""]["champion"] == "P00"
    assert director.send("/desk/undo").status == 303
    told(director)


@pytest.mark.slow
def test_two_events_share_the_tables(director: Browser) -> None:
    begin(director, "single", name="A")
    others = "\n".join(f"P0{k},{600 - k}" if k < 2 else f"Q0{k},{600 - k}" for k in range(6))
    begin(director, "round-robin", name="B", beside="yes", entrants=others)
    for event in (1, 2):
        assert director.send("/desk/draw", event=event).status == 303
    both = told(director)
    assert [one["name"] for one in both[""]["events"]] == ["A", "B"]
    assert {one["match"]["event"] for one in both["queue"]["queue"]} == {1, 2}
    second = told(director, "?event=2")
    assert (second[""]["name"], second["bracket"]["event"]) == ("B", 2)
    assert {one["match"]["event"] for one in second["queue"]["queue"]} == {2}
    for event in (1, 2):
        one = next(one["match"] for one in told(director)["queue"]["queue"]
                   if one["match"]["event"] == event)  # fmt: skip
        sent = director.send("/desk/call", match=one["name"], table=event, event=event)
        assert sent.status == 303
    tables = told(director)["tables"]["tables"]
    assert [one["match"] and one["match"]["event"] for one in tables] == [1, 2, None]


@pytest.mark.slow
@pytest.mark.parametrize("form", ["single", "swiss", "round-robin"])
def test_no_place_is_decided_before_anything_is_played(director: Browser, form: str) -> None:
    """However much one player is the favorite."""
    begin(director, form, entrants="Cat,2000\nAnt,100\nBat,100\nDog,100")
    assert director.send("/desk/draw").status == 303
    known(director)
    assert told(director, race="Cat")["standings"]["places"] == []


def test_a_team_night_is_told_by_its_own_address(director: Browser) -> None:
    assert director.send("/team/new", **TEAMS).status == 303
    got = director.tells("GET", f"{V1}/tonight")
    assert (got.status, f"{V1}/tonight/team" in got.json["detail"]) == (404, True)
    got = director.tells("GET", f"{V1}/tonight/team")
    assert list(validator_of("/tonight/team").iter_errors(got.json)) == []
    assert got.json["teams"] == ["Racks", "Cues"]
