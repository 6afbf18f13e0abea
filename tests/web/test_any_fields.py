"""Every address answers whatever is asked of it: it fails for nobody, and refuses in words."""

from __future__ import annotations

import random
import re
import urllib.parse
from contextlib import closing
from pathlib import Path

import pytest

from evenbreak.fields.question import declared
from evenbreak.questions.moves import COMMANDS
from evenbreak.web.forms import name_of
from evenbreak.web.site import Site
from tries import tries
from web.asked import Browser, Room
from web.test_random_evenings import Played

SEEDS = tries("any fields at any address", 1)
ASKED = 300
VALUES = [
    *("", "x", "-1", "0", "1", "2", "3", "99", "1e3", "nan", "inf", "²", "9" * 30, "9" * 199),
    *("3:2", "<b>", "P01", "P02", "P03", "A\u202eB", "\0", "a\nb", "1,2", "1-99999999", "5-8"),
    *("TV", "25:99", "2025-03-01T19:30:00+02:00", "yes", "no", "on", "time", "keep", "W1.1", "F"),
    *("match 1", "#1", "//evil", "/desk?match=1", "é" * 300, "[]", "{}", "../..", "%00", "1_0"),
]
FIELDS = [
    *{name_of(one) for question, *_ in COMMANDS.values() for one in declared(question)},
    *("a", "b", "seen", "player_a", "player_b", "code", "minutes", "give", "read", "back", "sure"),
    *("named", "event", "once", "begun", "entrants", "format", "races", "discipline", "scale"),
    *("chips", "rounds", "groups", "qualifiers", "fee", "house", "unit", "added", "payout", "only"),
    *("play", "corrected", "language", "itself", "paper", "other", "save", "team", "number"),
]
LEFT_ALONE = ("/desk/pin", "/leave", "/pin", "/events")


@pytest.mark.slow
@pytest.mark.parametrize("seed", [None, *range(SEEDS)])
def test_no_address_fails_whatever_is_asked_of_it(seed: int | None, tmp_path: Path) -> None:
    evening: Room | Played
    luck, path = random.Random(str(seed)), tmp_path / "tonight.db"
    if seed is None:  # nothing has begun
        room = evening = Room(Site(path, hosts=frozenset({"localhost"})))
        browsers = [Browser(room, director=True), Browser(room)]
    else:
        evening = played = Played(path, seed)
        room, browsers = played.room, [played.director, played.tablet, played.phones[0]]
        assert browsers[0].send("/desk/draw", sure="yes").status == 303
        assert browsers[2].claims("P01").status == 303
    routes = [(how, one.path) for one in room.app.routes for how in one.methods or ()]  # type: ignore[attr-defined]
    routes = [one for one in routes if one[1] not in LEFT_ALONE and one[0] in ("GET", "POST")]
    with closing(evening):
        for asked in [*routes, *luck.choices(routes, k=ASKED)]:
            how, path = asked
            who = luck.choice([browsers[0], *browsers])
            value = urllib.parse.quote(luck.choice(VALUES), safe="")
            path = re.sub(r"{\w+}", value, path)
            fields = [(n, luck.choice(VALUES)) for n in luck.sample(FIELDS, luck.randrange(9))]
            if how == "GET":
                got = who.open(path, **dict(fields))
            else:
                hidden = {n: v for n, v in who.hidden().items() if luck.random() < 0.97}
                got = who.ask("POST", path, [*hidden.items(), *fields])
            assert got.status < 500, (how, path, fields, got.words)
            assert "Traceback" not in got.text, (how, path, fields)
