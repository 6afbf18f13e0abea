"""Other programs enter what happens: once each, in their own name, and asked before a loss."""

from __future__ import annotations

import asyncio
import json
from collections.abc import Iterator
from contextlib import closing
from pathlib import Path
from typing import Any

import pytest

from evenbreak.files.store.tokens import create_token, revoke_token
from evenbreak.files.store.tournament import read_events
from evenbreak.web.site import Site
from web.asked import Browser, Got, Room
from web.conftest import copied
from web.test_who_may import NEW

AT = "2025-03-01T19:00:00"


class Night:
    """A drawn tournament, and a program for each scope."""

    def __init__(self, path: Path) -> None:
        self.path, self.room = path, room_on(path)
        self.director = Browser(self.room, director=True)
        self.tokens = {
            name: create_token(path, name, scope, AT)
            for name, scope in {"board": "scores", "desk": "director", "tv": "table:2"}.items()
        }

    def enters(self, move: str, who: str = "board", room: Room | None = None, **more: Any) -> Got:
        """Enter a move; further headers begin with an underscore."""
        body = {key: value for key, value in more.items() if not key.startswith("_")}
        head = {key[1:]: value for key, value in more.items() if key.startswith("_")}
        program = Browser(room or self.room, address="10.0.0.9")
        may = f"Bearer {self.tokens[who]}"
        return program.tells("POST", f"/api/v1/tonight/{move}", body, authorization=may, **head)

    @property
    def count(self) -> int:
        return len(read_events(self.path))


def room_on(path: Path) -> Room:
    return Room(Site(path, hosts=frozenset({"localhost"})))


@pytest.fixture(scope="module")
def opened(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The file that each night is copied from."""
    path = tmp_path_factory.mktemp("opened") / "tonight.db"
    with closing(room_on(path)) as room:
        director = Browser(room, director=True)
        for where, fields in (("/new", NEW), ("/desk/draw", {})):
            assert director.send(where, **fields).status == 303
    return path


@pytest.fixture
def night(opened: Path, tmp_path: Path) -> Iterator[Night]:
    found = Night(copied(opened, tmp_path / "tonight.db"))
    with closing(found.room):
        yield found


@pytest.mark.slow
def test_a_result_says_what_it_changed_and_calls_the_next_match(night: Night) -> None:
    called = night.enters("call", match="1", table="2").json
    assert (called["entries"], called["said"]) == ([3], ["Table 2: Ann against Hal."])
    scored = night.enters("score", match="1", score=[2, 0]).json
    (match,) = scored["matches"]
    assert (match["number"], [one["games"] for one in match["players"]]) == ("1", [2, 0])
    done = night.enters("result", match="1", score=[3, 0]).json
    assert done["entries"] == [5, 6]
    assert done["said"][0] == "Ann beat Hal 3-0 in match 1."
    assert done["said"][-1].startswith("Table 2: ")
    states = {one["number"]: one["state"] for one in done["matches"]}
    assert states["1"] == "done"
    assert "called" in states.values()
    assert [one.by for one in read_events(night.path)[2:]] == [*["program: board"] * 3, "by itself"]
    history = night.director.open("/desk/history").words
    assert "#5 · program: board" in history
    night.director.send("/language", language="de", back="/")
    assert "#5 · Programm: board" in night.director.open("/desk/history").words
    assert "Programm: board" in night.director.open("/desk").words


def test_scores_of_a_program_are_not_what_the_director_takes_back(night: Night) -> None:
    assert night.director.send("/desk/call", match="W1.1", table=2).status == 303
    assert night.enters("score", match="1", score=[1, 0]).status == 200
    assert night.director.send("/desk/undo").status == 303
    assert not night.room.site.night.state().on_tables


@pytest.mark.slow
def test_a_program_takes_back_the_entry_that_it_names_alone(night: Night) -> None:
    night.enters("call", match="1", table="1")
    entry = night.enters("result", match="1", score=[3, 1]).json["entries"][0]
    night.enters("score", "desk", match="2", score=[1, 0])
    count = night.count
    for move in ("undo", "redo"):
        got = night.enters(move, "desk")
        assert (got.status, got.json["parameter"]) == (400, "entry")
    for wrong, why in ((3, "Match 1 has been played"), (99, "There is no entry 99.")):
        refused = night.enters("undo", "desk", entry=wrong)
        assert (refused.status, refused.json["detail"][: len(why)]) == (400, why)
    assert night.count == count
    assert night.enters("undo", "desk", entry=entry).status == 200
    assert night.enters("redo", "desk", entry=entry).status == 200


@pytest.mark.slow
def test_the_same_request_is_entered_once_also_after_a_restart(night: Night) -> None:
    scored = {"match": "1", "score": [1, 0], "_idempotency_key": "7"}
    first = night.enters("score", **scored)
    assert (first.status, first.json["taken_before"]) == (200, False)
    count = night.count
    with closing(room_on(night.path)) as another:
        for room in (night.room, another):
            again = night.enters("score", room=room, **scored).json
            assert (again["taken_before"], again["entries"]) == (True, first.json["entries"])
            for other in ({"score": [2, 0]}, {"match": "2"}, {"sure": True}):
                got = night.enters("score", room=room, **(scored | other))
                assert (got.status, got.json["parameter"]) == (422, "Idempotency-Key")
            assert night.enters("call", match="2", _idempotency_key="7").status == 422
    assert night.count == count
    # What was so already is taken too; another program has keys of its own.
    assert night.enters("call", match="1", table="1", _idempotency_key="8").status == 200
    same = {"match": "1", "table": "1", "_idempotency_key": "9"}
    assert [night.enters("call", **same).json["taken_before"] for _ in range(2)] == [False, True]
    assert night.enters("score", "desk", **(scored | {"score": [2, 0]})).status == 200
    assert night.count == count + 2


@pytest.mark.slow
def test_what_would_be_lost_is_asked_about_first(night: Night) -> None:
    night.enters("call", match="1", table="2")
    night.enters("score", match="1", score=[2, 1])
    count = night.count
    got = night.enters("drop", "desk", player="Ann", _idempotency_key="1")
    assert got.status == 409
    assert got.json["lost"] == [
        {"match": "1", "players": ["Ann", "Hal"], "table": None, "score": [2, 1], "result": False}
    ]
    assert ("2-1" in got.json["detail"], [*got.json["how"]]) == (True, ["sure"])
    assert night.count == count
    for other in ("", "true", "0" * 16, False):
        assert night.enters("drop", "desk", player="Ann", sure=other).status == 409
    sure = night.enters("drop", "desk", player="Ann", sure=True, _idempotency_key="1")
    assert sure.status == 200
    assert sure.json["said"][0] == "Ann has withdrawn."


def test_what_is_asked_about_has_not_happened_yet(night: Night) -> None:
    for move, more in (("drop", {}), ("forfeit", {"match": "1"})):
        got = night.enters(move, "desk", player="Ann", **more)
        assert (got.status, "Ann would forfeit to Hal in match 1." in got.json["detail"]) == (
            409,
            True,
        )
        assert not {"has", "forfeited", "goes"} & {*got.json["detail"].split()}


@pytest.mark.slow
def test_what_is_so_already_is_not_entered_again(night: Night) -> None:
    same: list[tuple[str, dict[str, Any]]] = [
        ("call", {"match": "1", "table": "1"}),
        ("check-in", {"player": "Bo", "paid": "yes"}),
        ("score", {"match": "1", "score": [1, 0]}),
        ("result", {"match": "1", "score": [3, 0]}),
        ("correct", {"match": "1", "score": [3, 1]}),
    ]
    for move, asked in same:
        done = night.enters(move, "desk", **asked)
        assert done.json.get("entries"), done.json
        count = night.count
        again = night.enters(move, "desk", **asked)
        assert (again.status, again.json["entries"], night.count) == (200, [], count), move
        (said,) = again.json["said"]
        assert said[0] == said[0].upper()


@pytest.mark.slow
def test_who_agrees_to_a_loss_agrees_to_no_other(night: Night) -> None:
    """Between the question and the answer to it, another match began that would be lost."""
    night.enters("score", match="1", score=[2, 1])
    asked = night.enters("drop", "desk", player="Ann").json["how"]["sure"]
    for match in ("1", "2"):
        assert night.enters("result", match=match, score=[3, 1]).status == 200
    told = night.director.open("/api/v1/tonight/matches").json["matches"]
    (following,) = [one["number"] for one in told if one["state"] != "done"
                    and "Ann" in [player["name"] for player in one["players"]]]  # fmt: skip
    assert night.enters("score", match=following, score=[1, 0]).status == 200
    count = night.count
    moved = night.enters("drop", "desk", player="Ann", sure=asked)
    assert (moved.status, night.count) == (409, count)
    assert [one["match"] for one in moved.json["lost"]] == [following]
    assert night.enters("drop", "desk", player="Ann", sure=moved.json["how"]["sure"]).status == 200


@pytest.mark.slow
def test_a_repeated_request_is_told_all_that_the_first_changed(night: Night) -> None:
    """Also the calls that came with it, but not what was entered in the same second after it."""
    night.room.site.clock = lambda: AT
    night.enters("call", match="1", table="2")
    moves = [
        ("score", {"match": "1", "score": [2, 0]}),
        ("result", {"match": "1", "score": [3, 0]}),
        ("score", {"match": "3", "score": [1, 0]}),
        ("drop", {"player": "Bo", "sure": True}),
    ]
    first = [night.enters(move, "desk", **asked, _idempotency_key=str(n))
             for n, (move, asked) in enumerate(moves)]  # fmt: skip
    assert [one.status for one in first] == [200] * 4
    assert len(first[1].json["entries"]) > 1
    with closing(room_on(night.path)) as another:
        for n, (move, asked) in enumerate(moves):
            for room in (night.room, another):
                again = night.enters(move, "desk", room, **asked, _idempotency_key=str(n))
                assert (again.status, again.json["taken_before"]) == (200, True)
                assert again.json["entries"] == first[n].json["entries"]
                told = [[one["number"] for one in got.json["matches"]] for got in (again, first[n])]
                assert told[0] == told[1]


def test_a_text_that_is_too_long_is_named(night: Night) -> None:
    for move, asked in (
        ("late", {"player": "x" * 81}),
        ("forfeit", {"player": "Ann", "match": "x" * 201}),
    ):
        got = night.enters(move, "desk", **asked)
        assert (got.status, got.json["parameter"]) == (400, [*asked][-1])


def test_a_score_that_has_moved_on_is_not_written_over(night: Night) -> None:
    assert night.enters("score", match="1", score=[1, 0], seen=[0, 0]).status == 200
    for move, score in (("score", [1, 1]), ("result", [3, 0])):
        got = night.enters(move, match="1", score=score, seen=[0, 0], _accept_language="de")
        assert (got.status, "1:0" in got.json["detail"]) == (409, True)
        assert (got.json["parameter"], got.json["score"]) == ("seen", [1, 0])
    assert night.enters("result", match="1", score="3:0", seen=[1, 0]).status == 200


@pytest.mark.slow
def test_an_event_is_named_in_one_way_for_reads_and_writes(night: Night) -> None:
    entrants = "player,rating\nA,600\nB,500\nC,400\nD,300"
    second = {**NEW, "entrants": entrants, "name": "Second", "beside": "1"}
    assert night.director.send("/new", **second).status == 303
    assert night.director.send("/desk/draw", event=2).status == 303
    for event, table in (("02", "1"), ("%2B2", "2"), ("2", "1"), ("002", "2")):
        got = night.enters(f"call?event={event}", match="1", table=table)
        read = night.director.tells("GET", f"/api/v1/tonight/matches?event={event}")
        assert (got.status, read.status) in ((200, 200), (400, 400)), event
        if got.status == 200:
            assert got.json["event"] == read.json["event"] == 2
    for method in ("GET", "POST"):
        path = "/api/v1/tonight/call" if method == "POST" else "/api/v1/tonight"
        may = f"Bearer {night.tokens['board']}"
        got = night.director.tells(method, f"{path}?event=3", {}, authorization=may)
        assert (got.status, got.json["detail"]) == (404, "There is no event 3 tonight.")
    assert not night.room.site.night.state().on_tables


@pytest.mark.slow
def test_what_people_call_by_a_number_may_be_one(night: Night) -> None:
    assert night.enters("call", match=1, table=2).status == 200
    assert night.enters("score", match=1, score=[1, 0]).json["matches"][0]["number"] == "1"
    changed = night.enters("change", "desk", tables=3, reserved=3).json["said"]
    assert "3" in changed[0]
    got = night.enters("late", "desk", player="Zoe", rating="600")
    assert got.json["detail"] == "'rating': \"600\" is text. Leave out the quotes."


@pytest.mark.slow
def test_a_token_of_a_table_is_for_the_match_on_it(night: Night) -> None:
    scored = {"match": "1", "score": [1, 0]}
    assert night.enters("score", "tv", **scored).status == 403
    night.enters("call", match="1", table="1")
    night.enters("call", match="2", table="2")
    assert night.enters("score", "tv", **scored).status == 403
    assert night.enters("score", "tv", **scored | {"match": "2"}).status == 200
    assert night.enters("call", "tv", match="3").status == 403
    assert night.enters("result", "tv", match="match 2", score=[3, 0]).status == 200


def test_a_token_is_taken_back_at_once_at_every_server(night: Night) -> None:
    with closing(room_on(night.path)) as another:
        for room in (night.room, another):
            assert night.enters("call", room=room, match="1").status == 200
        taken = night.director.send("/desk/programs/revoke", name="board")
        assert taken.status == 303
        for room in (another, night.room):
            got = night.enters("score", room=room, match="1", score=[1, 0])
            assert (got.status, got.headers["www-authenticate"][:6]) == (401, "Bearer")
        revoke_token(night.path, "desk")
        assert night.enters("undo", "desk", room=another).status == 401


@pytest.mark.slow
def test_a_program_that_runs_wild_is_slowed_down(night: Night) -> None:
    night.room.site.entries.most = 3
    got = [night.enters("score", match="1", score=[1, n % 2]).status for n in range(5)]
    assert got == [200] * 3 + [429] * 2
    assert night.enters("score", "desk", match="1", score=[2, 0]).status == 200


def test_a_token_taken_back_between_two_looks_enters_nothing(
    night: Night, monkeypatch: pytest.MonkeyPatch
) -> None:
    known, count = dict(night.room.site.tokens), night.count
    monkeypatch.setattr(Site, "tokens", known)
    revoke_token(night.path, "board")
    assert night.enters("call", match="1").status == 401
    assert night.count == count


def test_a_request_that_comes_in_several_times_at_once_is_entered_once(night: Night) -> None:
    program, count = Browser(night.room), night.count
    body = json.dumps({"match": "1", "score": [1, 0]}).encode()
    head = {"host": "localhost", "content-type": "application/json", "idempotency-key": "1"}
    head |= {"authorization": f"Bearer {night.tokens['board']}", "content-length": str(len(body))}

    async def together() -> list[Got]:
        asked = (program._asked("POST", "/api/v1/tonight/score", head, body) for _ in range(5))
        return await asyncio.gather(*asked)

    got = night.room.loop.run_until_complete(together())
    assert sorted(one.json["taken_before"] for one in got) == [False, *[True] * 4]
    assert night.count == count + 1


def test_refusals_name_addresses_people_and_what_a_token_is_for(night: Night) -> None:
    program = Browser(night.room, address="10.0.0.9")
    told = {
        ("score", "board", '{"match": "1", "score": [3, 0]}'): (
            400,
            "to enter it: POST /api/v1/tonight/result.",
        ),
        ("score", "board", '{"match": "1", "score": [2, 9]}'): (400, "can't be the final score"),
        ("drop", "desk", '{"player": "Ha"}'): (400, "if you mean Hal, write that."),
        ("drop", "board", '{"player": "Hal"}'): (
            403,
            "good for: scores, results and calls. This needs a token for: everything a director",
        ),
        ("score", "tv", '{"match": "1", "score": [1, 0]}'): (
            403,
            "Match 1 isn't on the table that this program's token is for (only table 2).",
        ),
    }
    for (move, who, body), (status, words) in told.items():
        got = night.enters(move, who, **json.loads(body))
        assert (got.status, words in got.json["detail"]) == (status, True), got.json
    wrong = program.tells("DELETE", "/api/v1/tonight/score", {})
    assert (wrong.status, wrong.json["detail"].split()[0]) == (405, "DELETE")
    missing = program.tells("POST", "/api/v1/tonight/nothing", {})
    assert (missing.status, missing.json["detail"]) == (404, "There is no such address.")


@pytest.mark.slow
def test_results_that_would_be_lost_have_their_scores(night: Night) -> None:
    for match in ("1", "2"):
        night.enters("result", match=match, score=[3, 1])
    (follows,) = [
        name
        for name in night.room.site.night.state().standing.to_play
        if name.startswith(("W2", "L"))
    ][:1]
    night.enters("result", "desk", match=follows, score=[3, 2])
    lost = night.enters("correct", "desk", match="1", score=[1, 3]).json.get("lost", [])
    lost += night.enters("correct", "desk", match="2", score=[1, 3]).json.get("lost", [])
    assert any((one["result"], one["score"]) == (True, [3, 2]) for one in lost)
