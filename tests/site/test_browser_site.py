"""The site in a real browser, opened from the disk: its script, axe, small phones, two taps."""

from __future__ import annotations

import itertools
from datetime import date
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from evenbreak.answers.league.roster_matchups import OfferedRaces
from evenbreak.files.store.folder import write_files
from evenbreak.handicaps import chart
from evenbreak.handicaps.charts.level_chart import level_chart, points_chart
from evenbreak.handicaps.charts.level_skills import level_skills
from evenbreak.league.tables.fixtures import Fixture
from evenbreak.ratings.roster import Roster
from evenbreak.ratings.scale import SCALES
from evenbreak.site.names import PublicNames
from evenbreak.site.pages import site_files
from evenbreak.site.races import LeagueRaces
from evenbreak.site.tournaments import tournament_of
from published_leagues import published
from tournament_nights import night
from web.chromium import browser as browser

pytestmark = pytest.mark.slow

NAMES = [f"Player {k:02}" for k in range(12)]
RATINGS = np.random.default_rng(3).normal(500.0, 120.0, 12)
CLUB = Roster(NAMES, RATINGS, np.linspace(0.0, 130.0, 12), component=[1] * 10 + [2] * 2)
FARGO = SCALES["fargo"]
APA = level_chart("apa_8ball")

RULES = {
    "race to 9": LeagueRaces(CLUB, FARGO, OfferedRaces(race_to=9)),
    "with form": LeagueRaces(CLUB, FARGO, OfferedRaces(race_to=7), form=0.45),
    "7 to 13 games": LeagueRaces(CLUB, FARGO, OfferedRaces(games=(7, 13)), form=0.2),
    "chart of differences": LeagueRaces(CLUB, FARGO, chart("fargo_r6_hot"), form=0.3),
    "chart of levels": LeagueRaces(
        Roster(NAMES, np.arange(12) % 6 + 2.0), FARGO, APA, level_skills(APA)
    ),
    "chart of points": LeagueRaces(
        Roster(NAMES, np.arange(12) % 9 + 1.0), FARGO, points_chart("apa_9ball")
    ),
}


def opened(browser: Any, place: Path, **asked: Any) -> Any:
    context = browser.new_context(
        viewport={"width": asked.pop("width", 390), "height": 844}, **asked
    )
    page = context.new_page()
    page.goto(place.as_uri())
    return page


@pytest.mark.parametrize("rule", RULES)
def test_the_script_has_the_numbers_of_the_engine(browser: Any, rule: str, tmp_path: Path) -> None:
    races = RULES[rule]
    league = published()
    object.__setattr__(league, "races", races)
    object.__setattr__(league, "names", PublicNames.of(NAMES))
    write_files(tmp_path, {"races.html": site_files_of_races(league)})
    page = opened(browser, tmp_path / "races.html")
    order = page.evaluate("data.players.map((one) => one[0])")
    made = page.evaluate(
        "data.players.map((_, a) => data.players.map((_, b) => a === b ? 0 : race(a, b)))"
    )
    for a, b in itertools.permutations(range(len(order)), 2):
        wanted = races.by_pair.get((order[a], order[b]))
        if wanted is None:
            assert made[a][b] is None
            continue
        assert (made[a][b]["m"], made[a][b]["n"]) == wanted[:2]
        if made[a][b]["p"] is None:
            assert np.isnan(wanted[2])
        else:
            assert made[a][b]["p"] == pytest.approx(wanted[2], abs=2e-7)
    page.context.close()


def site_files_of_races(league: Any) -> bytes:
    from evenbreak.site.pages import _Pages

    return _Pages(league, (), ()).races()


@pytest.fixture(scope="module")
def site(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("site")
    league = published(by_player={"Bo Diaz": "initials"})
    tournament = tournament_of("fall-open", night(8, "double", 99), league.names)
    assert tournament is not None
    fixtures = [Fixture(1, "Ann Lee", "José Álvarez", date(2025, 9, 23), "Corner", 2)]
    write_files(folder, site_files(league, [tournament], fixtures))
    return folder


def pages_of(site: Path) -> list[Path]:
    return [*sorted(site.glob("*.html")), site / "players" / "ann-lee.html"]


@pytest.mark.parametrize(("width", "scheme"), [(390, "light"), (390, "dark"), (1280, "light")])
def test_axe_objects_to_nothing(browser: Any, site: Path, width: int, scheme: str) -> None:
    axe_api = pytest.importorskip(
        "axe_playwright_python.sync_playwright",
        reason="no axe-playwright-python; pip install -e '.[browser]'",
    )
    every = (width, scheme) == (390, "light")
    for place in pages_of(site) if every else [site / "index.html", site / "races.html"]:
        page = opened(browser, place, width=width, color_scheme=scheme, bypass_csp=True)
        found = axe_api.Axe().run(page).response["violations"]
        objections = [(one["id"], node["html"][:120]) for one in found for node in one["nodes"]]
        assert objections == [], place
        page.context.close()


def test_nothing_scrolls_sideways_and_nothing_is_refused(browser: Any, site: Path) -> None:
    page = opened(browser, site / "index.html", width=320)
    said: list[str] = []
    page.on("console", lambda message: said.append(message.text))
    page.on("pageerror", lambda error: said.append(str(error)))
    for place in pages_of(site):
        page.goto(place.as_uri())
        assert page.evaluate("document.documentElement.scrollWidth") <= 320, place
    assert said == []
    page.context.close()


def test_two_taps_show_a_race(browser: Any, site: Path) -> None:
    page = opened(browser, site / "races.html")
    page.get_by_role("button", name="Ann Lee").click()
    assert "Who is Ann Lee playing?" in page.inner_text("#said")
    page.get_by_role("button", name="José Álvarez").click()
    assert "Ann Lee needs" in page.inner_text("#said")
    assert page.inner_text("#race strong").replace("–", "-").count("-") == 1
    page.fill("#filter", "jos")
    assert page.locator(".names button:visible").count() == 1
    page.context.close()
