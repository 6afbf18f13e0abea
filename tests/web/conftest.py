"""A tournament of sixteen players on a running page."""

from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

import pytest

from evenbreak.files.store.tournament import read_tournament
from evenbreak.tournaments.clock.finish import finish
from evenbreak.tournaments.evening.fold import Evening
from evenbreak.web.site import Site
from web.chromium import browser as browser
from web.phones import Phone, running

PLAYERS = [f"Player {k}" for k in range(1, 17)]


class Hall(NamedTuple):
    """A running page, the director's phone and a guest's."""

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
    """Each entry has the page work out the night's finish: of 100 evenings instead of 2000."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setitem(finish.__kwdefaults__, "runs", 100)
        yield


@pytest.fixture
def hall(tmp_path: Path) -> Iterator[Hall]:
    with running(tmp_path / "tonight.db") as site:
        director = Phone(site, director=True)
        begun(director, PLAYERS)
        yield Hall(site, director, Phone(site))


@pytest.fixture(scope="module")
def standing_hall(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Hall]:
    """The same for tests that change nothing."""
    with running(tmp_path_factory.mktemp("hall") / "tonight.db") as site:
        director = Phone(site, director=True)
        begun(director, PLAYERS)
        yield Hall(site, director, Phone(site))
