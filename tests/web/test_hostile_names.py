"""Names of every kind, through pages, files and back: text that nothing runs, and kept intact."""

from __future__ import annotations

import csv
import io
import random
import re
from collections.abc import Iterator
from contextlib import closing
from functools import cache
from html import unescape
from html.parser import HTMLParser
from pathlib import Path
from tempfile import TemporaryDirectory

import pytest

from evenbreak.files.csv_writer import FORMULA_STARTS, undefused
from evenbreak.files.tables.names import clean_name, is_name, same_name
from evenbreak.web.night import Night
from evenbreak.web.site import Site
from tries import tries
from web.asked import Browser, Room
from web.test_who_may import NEW

NUMBER = re.compile(r"[+-]?[0-9]+")
EVENINGS = tries("evenings of odd names", 4)
PIECES = (
    *("<script>alert(1)</script>", "<b>", "</td>", "<!--", "&amp;", "&#60;", '" onload="x', "'"),
    *('"', "`", "{{7*7}}", "{%", "%s", "{0}", "\\", "=cmd()", "+1", "-2", "@SUM(A1)", "'=1", "＝1"),
    *(
        "\u202eabc",
        "\u200b",
        "עברית",
        "العربية",
        "🎱",
        "👩‍🚀",
        "Zoe\u0308",
        "ﬁ",
        "Ａ",
        "İ",
        "ß",
        "李",
    ),
    *("; =1", ",", ";", "|", "\x00", "\x1b[31m", "\x85", "\u2028", "\ud7ff", "and", " against "),
    *("beat", "W1.1", "5:3", "1.", "nan", "None", "null", "0", "x" * 70, "'); DROP TABLE event;--"),
    *("Ann", "Bo", "Bo Diaz", "O’Neil", "$(id)", "../x", "javascript:x", "winner of", "Sieger"),
)
PAGES = ("/", "/players", "/bracket", "/screen", "/desk", "/desk/history", "/desk/codes", "/fair")


class Tags(HTMLParser):
    """The tags of a page with the names of their attributes."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.found: set[str] = set()
        self.feed(text)

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.found |= {tag, *(f"{tag} {name}" for name, _ in attrs)}

    def handle_comment(self, data: str) -> None:
        self.found.add(f"comment {data}")


def odd_names(luck: random.Random) -> list[str]:
    """Return names that are apart from each other as the program sees them."""
    found: dict[str, str] = {}
    while len(found) < 4:
        pieces = luck.choices(PIECES, k=luck.choice((1, 2, 2, 3)))
        name = luck.choice(("", " ")).join(pieces)[:78]
        clean = clean_name(name)
        if is_name(clean) and not re.search(r"[\r\n\x85\u2028]", name):
            found.setdefault(same_name(clean), name)
    return list(found.values())


def begun(room: Room, names: list[str]) -> tuple[Browser, list[str]]:
    """Begin an evening of these names; return those that were let in, by a list and one by one."""
    director = Browser(room, director=True)
    rows = io.StringIO()
    csv.writer(rows).writerows([("player", "rating"), *((n, 600 - k) for k, n in enumerate(names))])
    got = director.send("/new", **{**NEW, "entrants": rows.getvalue()})
    if got.status == 303:
        return director, [clean_name(name) for name in names]
    assert got.status == 400, got.words
    plain = "player,rating\nAaa,600\nBbb,590\n"
    assert director.send("/new", **{**NEW, "entrants": plain}).status == 303
    taken = [n for n in names if director.send("/desk/late", player=n, rating="500").status == 303]
    return director, ["Aaa", "Bbb", *map(clean_name, taken)]


@cache
def plain_tags() -> set[str]:
    """Return the tags and attributes of the pages where all names are plain, in both languages."""
    found: set[str] = set()
    for seed in (0, 2):
        with TemporaryDirectory() as folder:
            room = Room(Site(Path(folder, "tonight.db"), hosts=frozenset({"localhost"})))
            with closing(room):
                director, _ = begun(room, ["Aaa", "Bbb", "Ccc", "Ddd"])
                for _, text in shown(director, random.Random(seed)):
                    found |= Tags(text).found
    return found


def shown(director: Browser, luck: random.Random) -> Iterator[tuple[str, str]]:
    """Draw, call, and enter a result; yield what the pages show."""
    night = director.room.site.night
    director.send("/desk/draw")
    first, *rest = night.state().standing.to_play
    director.send("/desk/call", match=first, table=1)
    for match in rest:
        director.send("/desk/call", match=match, table=2)
    director.send("/language", language=luck.choice(("en", "de")), back="/")
    director.claims(night.state().pair(first)[0])
    links = ["/me", "/me?play=1", "/table/1", "/table/2", "/desk/codes"]
    for page in (*PAGES, *links):
        yield page, director.open(page).text
    director.send("/desk/result", match=first, a=3, b=1)
    for page in (*PAGES, *links):
        got = director.open(page)
        assert got.status == 200, page
        yield page, got.text


@pytest.mark.slow_after(1)
@pytest.mark.parametrize("seed", range(EVENINGS))
def test_a_name_is_text_everywhere(
    seed: int, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    async def not_yet(_: Night) -> None:
        """The odds know no names."""

    monkeypatch.setattr(Night, "outlook", not_yet)
    luck = random.Random(seed)
    room = Room(Site(tmp_path / "tonight.db", hosts=frozenset({"localhost"})))
    with closing(room):
        director, names = begun(room, odd_names(luck))
        night = room.site.night
        assert list(night.state().entrants) == names, seed
        for page, text in shown(director, luck):
            assert Tags(text).found <= plain_tags(), (seed, page)
            assert text.count("<script") <= 1, (seed, page)
            if page in ("/players", "/bracket"):
                said = unescape(text)
                assert all(name in said for name in names), (seed, page, names)
        ((first, _),) = night.state().counted.items()
        text = director.open("/results.csv").body.decode()
        (row,) = list(csv.DictReader(io.StringIO(text)))
        pair = [undefused(row["player_a"]), undefused(row["player_b"])]
        assert sorted(pair) == sorted(night.state().counted[first].players), seed
        for cell in (row["player_a"], row["player_b"], row["winner"]):
            starts = [one.strip(' "') for one in re.split(r"[;\t\r\n]", cell)]
            wild = [
                one for one in starts if one[:1] in FORMULA_STARTS and not NUMBER.fullmatch(one)
            ]
            assert all(not one or NUMBER.fullmatch(one) for one in wild), (seed, cell)
        if seed % 5 == 0:
            for paper in ("/bracket.pdf", "/cards.pdf"):
                assert director.open(paper).body.startswith(b"%PDF"), (seed, paper)
