"""Names in full, as initials or not at all; and file names for any name."""

import ntpath
import re
from pathlib import PureWindowsPath

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from evenbreak.errors import DataError
from evenbreak.files.store.tournament import new_tournament
from evenbreak.site.names import PublicNames, by_appearance, file_names
from evenbreak.site.pages import site_files
from evenbreak.site.tournaments import tournament_of
from evenbreak.tournaments.evening.events import Drawn, Entrant, Event, Opened, Plan, Result
from leagues import HOSTILE
from published_leagues import PLAYERS, published, season
from tiers import examples


def test_each_is_named_as_asked() -> None:
    names = PublicNames.of(
        ["Ann Lee", "Al Lum", "Bo", "Cy Fox"], "initials", {"Bo": "full", "cy  fox": "hidden"}
    )
    assert [*names.names.values()] == ["A. L.", "A. L. (2)", "Bo", "Player 4"]


def test_a_public_name_is_nobody_elses() -> None:
    names = PublicNames.of(["Player 2", "Bo", "A. L.", "Ann Lee"], "full", {"Bo": "hidden"})
    assert names["Bo"] == "Player 2 (2)"
    assert PublicNames.of(["A. L.", "Al Ly"], by_player={"Al Ly": "initials"})["Al Ly"] != "A. L."


def test_a_slip_in_a_name_is_refused_and_not_published() -> None:
    with pytest.raises(DataError, match="'Zeb Quackenbush' isn't a player in this league"):
        PublicNames.of(PLAYERS, by_player={"Zeb Quackenbush": "hidden"})


def test_other_spellings_and_aliases_are_the_same_player() -> None:
    names = PublicNames.of(
        ["Ann Lee", "Zebulon Q", "ann  LEE", "Zeb"],
        by_player={"Zeb": "initials", "ANN lee": "hidden"},
        aliases={"zeb": "Zebulon Q"},
    )
    assert dict(names.names) == {"Ann Lee": "Player 1", "Zebulon Q": "Z. Q."}
    assert [names[name] for name in ("ann lee", "ZEB", "Zebulon  q")] == [
        "Player 1",
        "Z. Q.",
        "Z. Q.",
    ]
    assert names["Somebody Else"] == "A guest"


def test_later_players_change_nobodys_name_or_file() -> None:
    before, after = [*PLAYERS[:3]], [*PLAYERS, "Zoe Quinn", "Ann lee!"]
    for usual in ("full", "initials", "hidden"):
        first, then = PublicNames.of(before, usual), PublicNames.of(after, usual)
        assert [then[name] for name in before] == [first[name] for name in before]
    assert [*file_names(after).values()][:3] == [*file_names(before).values()]


def test_players_are_in_the_order_of_their_first_match() -> None:
    assert by_appearance(season())[:3] == [*PLAYERS[:3]]


RESERVED = getattr(ntpath, "isreserved", lambda name: PureWindowsPath(name).is_reserved())
"""Whether Windows keeps a name; the newer function is of Python 3.13."""


@settings(max_examples=examples(60))
@given(st.lists(st.text(min_size=1, max_size=80), unique=True, max_size=12))
def test_a_file_name_is_safe_on_every_disk(players: list[str]) -> None:
    files = [*file_names(players).values()]
    assert len({*files}) == len(players)
    for one in files:
        assert re.fullmatch(r"[a-z0-9][a-z0-9-]{0,70}", one), one
        assert not RESERVED(f"{one}.html")


@pytest.mark.parametrize("name", [*HOSTILE, "..", "/etc/passwd", "CON", "a" * 300])
def test_hostile_names_have_files(name: str) -> None:
    assert re.fullmatch(r"[a-z0-9][a-z0-9-]*", file_names([name])[name])


def final(names: tuple[str, str]) -> list[Event]:
    entrants = tuple(Entrant(name, 500.0) for name in names)
    happened = (
        Opened(Plan("single", 5), entrants),
        Drawn(names, (0, 1)),
        Result("F", names, (5, 3), names[0]),
    )
    return [Event("2025-10-01T19:30:00", what) for what in happened]


@pytest.mark.slow
@pytest.mark.parametrize("usual", ["initials", "hidden"])
def test_no_file_has_a_name_that_is_not_to_be_shown(usual: str, tmp_path) -> None:
    """The pages, the script's data, the tables, the pictures and the names of files."""
    private = ("Zebulon Quackenbush", "Ophelia Wrzesniewski")
    results = season(event=["Quackenbush memorial"] * 30)
    league = published(results, usual="full", by_player=dict.fromkeys(private, usual))
    state = new_tournament(tmp_path / "quackfree.db", final(("zebulon quackenbush", "Guest Star")))
    tournament = tournament_of("night", state, league.names)
    assert tournament is not None
    files = site_files(league, [tournament])
    assert b"Ann Lee" in files["index.html"]
    for word in ("zebulon", "quackenbush", "ophelia", "wrzesniewski", "guest star"):
        for name, content in files.items():
            assert word not in name
            assert word.encode() not in content.lower(), name


def test_who_is_not_named_has_no_page_and_no_button() -> None:
    league = published(by_player={"Bo Diaz": "hidden"})
    files = site_files(league)
    assert "players/ann-lee.html" in files
    assert not any("player-4" in name for name in files)
    assert b'"Player 4"' not in files["races.html"]
    assert b"Player 4" in files["index.html"]
    assert b"1 player is shown by a number" in files["about.html"]
    assert b"noindex" in files["index.html"]
