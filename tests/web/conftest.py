"""A tournament of sixteen players on a page."""

import sqlite3
from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager, closing, contextmanager
from pathlib import Path
from typing import NamedTuple

import pytest

from evenbreak.files.store.tournament import read_tournament
from evenbreak.tournaments.clock.finish import finish
from evenbreak.tournaments.evening.fold import Evening
from evenbreak.web import beside
from evenbreak.web.site import Site
from web.chromium import browser as browser
from web.phones import Phone, answering, running

Opens = Callable[[Path], AbstractContextManager[Site]]

PLAYERS = [f"Player {k}" for k in range(1, 17)]


class Hall(NamedTuple):
    """A page, the director's phone and a guest's."""

    site: Site
    director: Phone
    guest: Phone

    @property
    def state(self) -> Evening:
        """What the file holds now."""
        return read_tournament(self.site.path)


def begun(director: Phone, players: list[str], **plan: object) -> None:
    """Start a tournament through the page, and draw it."""
    rows = [f"{name},{700 - 10 * k}" for k, name in enumerate(players)]
    asked = {
        "entrants": "\n".join(["player,rating", *rows]),
        "format": "double",
        "races": "even",
        "race": 3,
        "losers_race": 2,
        "tables": 4,
        "discipline": "9-ball",
        "seeding": "rating",
        "scale": "fargo",
        **plan,
    }
    shown = director.send("/new", **asked)
    assert shown.status == 200, shown.words
    assert director.send("/desk/draw").status == 200


@pytest.fixture(scope="module", autouse=True)
def few_evenings() -> Iterator[None]:
    """Each entry has the page work out the finish: of 100 evenings, not 2000, without a rest."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(beside, "_MOST_REST", 0.0)
        patch.setitem(finish.__kwdefaults__, "runs", 100)
        yield


def copied(path: Path, to: Path) -> Path:
    """Return a copy of a file, to go on from."""
    with closing(sqlite3.connect(path)) as kept, closing(sqlite3.connect(to)) as fresh:
        kept.backup(fresh)
    return to


@contextmanager
def hall_of(path: Path, opened: Opens = answering) -> Iterator[Hall]:
    """Open the page of a file of a tournament that is under way."""
    with opened(path) as site:
        yield Hall(site, Phone(site, director=True), Phone(site))


@pytest.fixture(scope="session")
def drawn(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The file of a tournament of sixteen that has been drawn, from which halls are copied."""
    path = tmp_path_factory.mktemp("drawn") / "tonight.db"
    with answering(path) as site:
        begun(Phone(site, director=True), PLAYERS)
    return path


@pytest.fixture
def hall(drawn: Path, tmp_path: Path, request: pytest.FixtureRequest) -> Iterator[Hall]:
    opened = running if "browser" in request.fixturenames else answering
    with hall_of(copied(drawn, tmp_path / "tonight.db"), opened) as found:
        yield found


@pytest.fixture(scope="module")
def standing_hall(drawn: Path, tmp_path_factory: pytest.TempPathFactory) -> Iterator[Hall]:
    """The same for tests that change nothing."""
    with hall_of(copied(drawn, tmp_path_factory.mktemp("hall") / "tonight.db")) as found:
        yield found


@pytest.fixture(scope="module")
def served_hall(drawn: Path, tmp_path_factory: pytest.TempPathFactory) -> Iterator[Hall]:
    """The same behind a real server, for tests of connections."""
    path = copied(drawn, tmp_path_factory.mktemp("served") / "tonight.db")
    with hall_of(path, running) as found:
        yield found
