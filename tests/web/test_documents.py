"""What a double click does: tonight's file, one page at a time, the browser let in once."""

import subprocess
import sys
from contextlib import closing
from datetime import date, datetime
from pathlib import Path
from unittest.mock import patch

import pytest
from click.testing import CliRunner, Result

from evenbreak.cli.program import program
from evenbreak.files.store.desk import back_up
from evenbreak.files.store.team_night import add_team_events
from evenbreak.files.store.tournament import add_events, begin_beside, new_tournament
from evenbreak.teams.evening.events import Begun, NightPlan, PutUp, TeamSheet
from evenbreak.teams.evening.events import Result as Ended
from evenbreak.tournaments.evening.events import Drawn, Entrant, Event, Opened, Plan
from evenbreak.tournaments.evening.moves import result
from evenbreak.web import documents
from evenbreak.web.documents import Alone, tonights_file
from evenbreak.web.sessions import Ticket
from evenbreak.web.site import Site
from web.asked import Browser, Room

AT = "2026-11-27T19:30:00"
TODAY = date(2026, 11, 28)
BOTH = ("Ann", "Bo")
PLAN = Plan("single", 5, scale="fargo", tables=1)
PAIR = Opened(PLAN, tuple(Entrant(n, 500.0) for n in BOTH))


def night(path: Path, *, over: bool) -> None:
    """Write a tournament of one match, which is over or still to be played."""
    path.parent.mkdir(exist_ok=True)
    state = new_tournament(path, [Event(AT, one) for one in (PAIR, Drawn(BOTH, (0, 1)))])
    if over:
        (match,) = state.standing.to_play
        add_events(path, lambda now: [Event(AT, result(now, match, (5, 3)))])


def team_night(path: Path, *, over: bool) -> None:
    """Write a team night of one set, which is over or still to be played."""
    path.parent.mkdir(exist_ok=True)
    us, them = (TeamSheet(n, (n[0],), (600.0,), (0.0,), (6.0,)) for n in ("Racks", "Cues"))
    happened = [Begun(NightPlan((us, them), 1, race=5)), PutUp(0, 1, ("R",)), PutUp(1, 1, ("C",))]
    for what in [*happened, *([Ended(1, (5, 3))] if over else [])]:
        add_team_events(path, lambda *_, what=what: [what], at=AT, by="")


@pytest.fixture
def clicked(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> list[str]:
    """The addresses that the browser was opened on; files are kept in a folder of the test."""
    shown = list[str]()
    monkeypatch.setattr(documents.platformdirs, "user_documents_path", lambda: tmp_path)
    monkeypatch.setattr(documents.platformdirs, "user_cache_path", lambda *_: tmp_path / "cache")
    monkeypatch.setattr("evenbreak.web.command.show", shown.append)
    return shown


def click(*words: str, **ports: str) -> Result:
    """Start the program as a double click does, up to where it would wait for requests."""
    with (
        patch("uvicorn.Server.run"),
        patch("evenbreak.web.command.addresses", return_value=["127.0.0.77"]),
        patch("evenbreak.web.command._taken", lambda _, port: ports.get(f"p{port}", "")),
    ):
        return CliRunner().invoke(program, ["serve", *words, "--open"])


def files(folder: Path, **nights: str) -> None:
    for day, how in nights.items():
        path = folder / f"2026-11-{day[1:]}.db"
        if how.startswith("teams"):
            team_night(path, over=how == "teams over")
        else:
            night(path, over=how != "goes on")
        if how == "second goes on":
            begin_beside(path, lambda _: [Event(AT, PAIR)])


@pytest.mark.parametrize(
    ("nights", "name"),
    [
        ({}, "28"),
        ({"d27": "over"}, "28"),
        ({"d27": "goes on"}, "27"),  # past midnight, or the second day of two
        ({"d27": "goes on", "d28": "over"}, "28"),
        ({"d26": "goes on", "d27": "over"}, "28"),
        ({"d27": "second goes on"}, "27"),
        ({"d27": "teams go on"}, "27"),
        ({"d27": "teams over"}, "28"),
        ({"d24": "goes on"}, "28"),  # left lying
        ({"d29": "goes on"}, "28"),
    ],
)
def test_tonights_file_is_of_today_or_goes_on(
    tmp_path: Path, nights: dict[str, str], name: str
) -> None:
    files(tmp_path, **nights)
    (tmp_path / "2026-11-27-20261127-193000.db").write_bytes(b"a copy")
    assert tonights_file(tmp_path, TODAY) == tmp_path / f"2026-11-{name}.db"


def test_a_damaged_file_of_yesterday_does_not_keep_tonight_from_starting(tmp_path: Path) -> None:
    (tmp_path / "2026-11-27.db").write_bytes(b"no database" * 100)
    assert tonights_file(tmp_path, TODAY) == tmp_path / "2026-11-28.db"


def test_a_double_click_keeps_tonight_in_the_documents(clicked: list[str], tmp_path: Path) -> None:
    shown = click(p8000="address already in use")
    assert shown.exit_code == 0, shown.output
    assert f"{tmp_path / 'evenbreak' / str(date.today())}.db" in shown.output
    assert "Port 8000: address already in use; using 8001" in shown.output
    assert "http://127.0.0.1:8001" in shown.output
    assert not clicked  # the browser waits for the server


@pytest.mark.slow
def test_a_second_start_opens_the_first(clicked: list[str], tmp_path: Path) -> None:
    hold = (
        "import sys; from pathlib import Path; from evenbreak.web.documents import Alone\n"
        "with Alone(Path(sys.argv[1])) as alone:\n"
        "    alone.keep('http://127.0.0.1:8123', Path('saturday.db'))\n"
        "    print('ready', flush=True); sys.stdin.read()"
    )
    words = [sys.executable, "-c", hold, str(tmp_path / "cache" / "page")]
    with subprocess.Popen(words, stdin=-1, stdout=-1, text=True) as first:
        assert first.stdout
        assert first.stdout.readline() == "ready\n"
        shown = click()
        assert "saturday.db is open already: http://127.0.0.1:8123" in shown.output
        assert clicked == ["http://127.0.0.1:8123"]
        first.kill()  # however it ends, its turn ends too
    assert "Tonight's file is" in click().output


def test_without_a_folder_for_it_nobody_is_kept_out(tmp_path: Path) -> None:
    (tmp_path / "file").touch()
    with Alone(tmp_path / "file" / "page") as alone:
        alone.keep("http://127.0.0.1:8000", tmp_path)
        assert not alone.running


def test_a_ticket_lets_one_browser_of_this_computer_in_once(tmp_path: Path) -> None:
    now = [0.0]
    site = Site(tmp_path / "tonight.db", hosts=frozenset({"localhost"}))
    site.ticket = Ticket(clock=lambda: now[0])
    with closing(Room(site)) as room:
        own, guest = Browser(room, address="127.0.0.1"), Browser(room, address="10.0.0.7")
        ticket = site.ticket.draw()
        assert "PIN" in guest.open("/pin", ticket=ticket).words  # seen, but not theirs
        assert guest.send("/pin", ticket=ticket).status == 403
        assert "need no PIN" in own.open("/pin", ticket=ticket).words
        own.open("/pin", ticket=ticket)  # opening it again uses nothing up
        assert own.open("/new").status == 403
        again = guest.send("/pin", pin=f"{int(site.pin) ^ 1:06d}")
        assert "Wrong PIN." in again.words
        assert 'name="pin"' in again.text  # to try another one at once
        assert own.send("/pin", ticket=ticket).status == 303
        assert own.open("/new").status == 200
        other = Browser(room, address="127.0.0.1")
        assert "worked only once" in other.open("/pin", ticket=ticket).words
        for tried in (ticket, "guessed", site.ticket.draw()[:-1], ""):
            assert other.send("/pin", ticket=tried).status == 403
        late = site.ticket.draw()
        now[0] = 61.0
        assert Browser(room, address="127.0.0.1").send("/pin", ticket=late).status == 403


def test_the_browser_is_opened_with_a_ticket(clicked: list[str]) -> None:
    with patch("evenbreak.web.command.server_of") as server:
        assert CliRunner().invoke(program, ["serve", "--open", "--port", "9000"]).exit_code == 0
    server.call_args.kwargs["then"]()
    (address,) = clicked
    site = server.call_args.args[0]
    assert address.startswith("http://127.0.0.1:9000/pin?ticket=")
    assert site.ticket.is_good(address.partition("=")[2])


@pytest.mark.parametrize("over", [False, True])
def test_phones_that_were_in_are_let_in_again_until_they_are_shut_out(
    clicked: list[str], tmp_path: Path, over: bool
) -> None:
    path = tmp_path / "saturday.db"
    night(path, over=over)
    assert "127.0.0.77" not in click(str(path)).output  # never let in
    Site(path).let_phones(True)  # what comes after ends without a word, as by kill -9
    for _ in range(2):
        shown = click(str(path)).output
        assert ("let in again" in shown) == ("http://127.0.0.77:8000" in shown) == (not over)
    Site(path).let_phones(False)
    assert "127.0.0.77" not in click(str(path)).output
    assert not clicked


def test_the_desk_says_what_the_start_changed_until_it_is_read(tmp_path: Path) -> None:
    path = tmp_path / "saturday.db"
    night(path, over=False)
    site = Site(path, hosts=frozenset({"localhost"}))
    site.since_start.append("Phones are let in again.")
    with closing(Room(site)) as room:
        own = Browser(room, address="127.0.0.1", director=True)
        assert "Phones are let in again." in own.open("/desk").words
        assert own.send("/desk/phones", read="yes").to.endswith("/desk")
        assert "Phones are let in again." not in own.open("/desk").words


@pytest.mark.usefixtures("clicked")
def test_a_night_stays_at_its_port_or_says_loudly_that_it_moved(tmp_path: Path) -> None:
    path = str(tmp_path / "saturday.db")
    night(Path(path), over=False)
    taken = "address already in use"
    assert "127.0.0.1:8001" in click(path, p8000=taken).output
    assert path in (tmp_path / "cache" / "page").read_text()  # a second start finds it
    again = click(path).output
    assert "127.0.0.1:8001" in again
    assert "moved" not in again
    moved = click(path, p8001=taken).output
    assert "moved from port 8001 to port 8000" in moved
    assert "moved from port 8000 to port 9000" in click(path, "--port", "9000").output


@pytest.mark.usefixtures("clicked")
@pytest.mark.parametrize("copies", [0, 1])
def test_what_to_open_instead_of_a_damaged_file_is_said(tmp_path: Path, copies: int) -> None:
    path = tmp_path / "evenbreak" / f"{date.today()}.db"
    night(path, over=False)
    if copies:
        copy = back_up(path, datetime(2026, 11, 28, 20, 0))
        copy.with_name(copy.name.replace("-200000", "-210000")).write_bytes(b"damaged" * 99)
    path.write_bytes(b"no database" * 99)
    shown = click()
    assert shown.exit_code == 1
    assert f"rename {path.name}" in shown.output
    assert ("20261128-200000.backup.db" in shown.output) == bool(copies)
    (tmp_path / "notes.txt").write_text("Ann plays Bo")
    assert "notes.txt isn't a tournament file" in click(str(tmp_path / "notes.txt")).output
