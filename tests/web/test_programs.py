"""The director creates tokens for programs, and revokes them."""

import re
from collections.abc import Iterator
from contextlib import closing
from pathlib import Path

import pytest

from evenbreak.files.store.tokens import kept_tokens, token_in
from evenbreak.web.site import Site
from web.asked import Browser, Room, forms_of
from web.test_who_may import NEW


@pytest.fixture
def director(tmp_path: Path) -> Iterator[Browser]:
    room = Room(Site(tmp_path / "tonight.db", hosts=frozenset({"localhost"})))
    with closing(room):
        found = Browser(room, director=True)
        for where, fields in (("/new", NEW), ("/desk/draw", {})):
            assert found.send(where, **fields).status == 303
        yield found


def test_a_token_is_shown_once_and_revoked(director: Browser) -> None:
    path = director.room.site.path
    assert 'href="/desk/programs"' in director.open("/desk/more").text
    forms = [one.action for one in forms_of(director.open("/desk/programs"))]
    assert [one for one in forms if "programs" in one] == ["/desk/programs/create"]
    got = director.told("/desk/programs/create", name="<b>board", may="table:2")
    (token,) = set(re.findall(r"evenbreak-[a-z2-7]{32}", got.text))
    held = token_in(kept_tokens(path), token)
    assert held is not None
    assert (held.name, held.scope) == ("<b>board", "table:2")
    assert "/api/v1/tonight/score" in got.text
    again = director.open("/desk/programs")
    assert token not in again.text
    assert "&lt;b&gt;board" in again.text
    assert "only table 2 · no entries yet" in again.words
    refused = director.send("/desk/programs/create", name="<B>board", may="director")
    assert (refused.status, "already has a token" in refused.words) == (400, True)
    for may in ("table:3", "table:x", "table:0", "table:", "all", "", "Director"):
        assert director.send("/desk/programs/create", name="x", may=may).status == 400, may
    back = director.told("/desk/programs/revoke", name="<b>board")
    assert "<b>board can no longer enter anything" in back.words
    assert not kept_tokens(path)
    assert director.send("/desk/programs/revoke", name="<b>board").status == 400


def test_a_double_tap_creates_one_token_and_both_answers_show_it(director: Browser) -> None:
    form = {**director.hidden(), "name": "board", "may": "scores"}
    first, second = (director.ask("POST", "/desk/programs/create", form) for _ in range(2))
    assert (first.status, second.status) == (303, 303)
    assert re.search(r"evenbreak-[a-z2-7]{32}", director.open(second.to).text)
    assert len(kept_tokens(director.room.site.path)) == 1
