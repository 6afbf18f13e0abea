"""What the page asks and the terminal asks too: the same choices, defaults, limits and answers."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import replace
from html.parser import HTMLParser
from pathlib import Path
from typing import Any

import click
import pytest
from click.testing import CliRunner

from evenbreak.cli.kit.asked import AskedCommand
from evenbreak.cli.league.report import command as report
from evenbreak.cli.program import program
from evenbreak.cli.team.lineup import command as lineup
from evenbreak.cli.tournament.new import command as new
from evenbreak.fields.kinds import Choice, Whole
from evenbreak.fields.question import declaration
from evenbreak.files.store.tournament import read_tournament
from evenbreak.questions.match import Fair
from evenbreak.questions.ratings import Report
from evenbreak.questions.teams import Lineup
from evenbreak.questions.tournament import NewTournament
from evenbreak.ratings.scale import DEFAULT_SCALE
from evenbreak.tournaments.evening.format import LONGEST_RACE
from rows import each_of
from web.phones import Phone, answering


class Fields(HTMLParser):
    """The fields of a page's forms: what each may be and what it is unless changed."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.usual: dict[str, str] = {}
        self.choices: dict[str, list[str]] = {}
        self._select = self._area = ""
        self.feed(text)

    def handle_starttag(self, tag: str, pairs: list[tuple[str, str | None]]) -> None:
        given = {name: value or "" for name, value in pairs}
        if tag == "select":
            self._select = given["name"]
        elif tag == "option":
            self.choices.setdefault(self._select, []).append(given["value"])
            if "selected" in given or self._select not in self.usual:
                self.usual[self._select] = given["value"]
        elif tag == "textarea":
            self._area, self.usual[given["name"]] = given["name"], ""
        elif tag == "input" and given.get("type") == "radio":
            if "checked" in given:
                self.usual[given["name"]] = given["value"]
        elif tag == "input" and given.get("type") == "checkbox":
            self.usual[given["name"]] = given["value"] if "checked" in given else ""
        elif tag == "input":
            self.usual[given.get("name", "")] = given.get("value", "")

    def handle_data(self, text: str) -> None:
        if self._area:
            self.usual[self._area] += text

    def handle_endtag(self, tag: str) -> None:
        if tag == "textarea":
            self._area = ""


@pytest.fixture(scope="module")
def director(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Phone]:
    with answering(tmp_path_factory.mktemp("asked") / "tonight.db") as site:
        yield Phone(site, director=True)


def option(command: click.Command, name: str) -> click.Parameter:
    return next(one for one in command.params if one.name == name)


def usual(command: click.Command, name: str) -> str:
    """Return the default of an option as a form writes it; '' if it has none, or is off."""
    if isinstance(command, AskedCommand):
        field = declaration(command.question, name)
        return "" if field.default is None else field.usual
    default: Any = option(command, name).default
    return default if isinstance(default, str) else ""


NAMED_BY_THE_PAGE = {"form": "format"}
ASKED_BY_BOTH = (
    *("form", "final", "qualifiers", "groups", "pod_size", "rounds", "third_place", "seeding"),
    "knockout_size",
    *("losers_race", "final_race", "discipline", "scale", "tables"),
)


@each_of("name", ASKED_BY_BOTH)
def test_a_tournament_has_the_same_defaults_on_the_page(director: Phone, name: str) -> None:
    fields = Fields(director.open("/new").text)
    assert fields.usual[NAMED_BY_THE_PAGE.get(name, name)] == usual(new, name)


@pytest.mark.parametrize("name", ["form", "seeding", "discipline"])
def test_a_tournament_has_the_same_choices_on_the_page(director: Phone, name: str) -> None:
    kind = declaration(NewTournament, name).kind
    assert isinstance(kind, Choice)
    shown = set(Fields(director.open("/new").text).choices[NAMED_BY_THE_PAGE.get(name, name)])
    assert shown - {""} == set(kind.of) - {"drawn"}  # a draw on paper has rows for byes


@pytest.mark.parametrize(
    "name",
    ["race", "losers_race", "final_race", "qualifiers", "groups", "rounds"],
)
def test_a_tournament_has_the_same_limits_on_the_page(director: Phone, name: str) -> None:
    kind = declaration(NewTournament, name).kind
    assert isinstance(kind, Whole)
    form = {
        "qualifiers": "groups",
        "groups": "groups",
        "rounds": "swiss",
    }.get(name, "double")
    asked = {
        "entrants": "Ann,612\nBo,540\nCy,500\nDi,480",
        "format": form,
        "races": "even",
        "race": 5,
        "tables": 2,
        "discipline": "9-ball",
        "seeding": "",
        "scale": "",
    }
    refused = director.send("/new", **asked | {name: 10**6}).words
    found = re.search(r"from ([\d,]+) to ([\d,]+)", refused)
    assert found, refused
    assert [int(end.replace(",", "")) for end in found.groups()] == [kind.low, kind.high]


def test_a_race_has_the_same_limits_on_the_page(director: Phone) -> None:
    kind = declaration(Fair, "race_to").kind
    assert isinstance(kind, Whole)
    assert declaration(Report, "race_to").kind == kind
    allowed = f"from {kind.low} to {kind.high}"
    page = director.open("/fair", a="612", b="540", scale="fargo", race=10**6)
    assert f"from 1 to {LONGEST_RACE}" in page.words  # as tonight's races: guests ask it
    results = "player_a,player_b,score_a,score_b\nAnn,Bo,7,5\n"
    asked = {"results": results, "scale": "fargo", "race": 10**6}
    assert allowed in director.send("/league", **asked).words


def test_a_league_and_a_team_night_have_the_same_scale_on_the_page(director: Phone) -> None:
    assert Fields(director.open("/league").text).usual["scale"] == DEFAULT_SCALE
    assert usual(report, "scale") == ""  # by the chart, which the page does not ask for
    assert Fields(director.open("/team/new").text).usual["scale"] == usual(lineup, "scale") == ""
    assert Fields(director.open("/fair").text).usual["scale"] == ""


@each_of("name", ("sets", "order", "count", "doubles", "cap", "at_most", "times", "sure"))
def test_a_team_night_has_the_same_defaults_on_the_page(director: Phone, name: str) -> None:
    assert Fields(director.open("/team/new").text).usual[name] == usual(lineup, name)


def test_a_team_night_has_the_same_choices_on_the_page(director: Phone) -> None:
    kind = declaration(Lineup, "count").kind
    assert isinstance(kind, Choice)
    assert Fields(director.open("/team/new").text).choices["count"] == list(kind.of)


@pytest.mark.parametrize("name", ["sets", "times", "race"])
def test_a_team_night_has_the_same_limits_on_the_page(director: Phone, name: str) -> None:
    kind = declaration(Lineup, name).kind
    assert isinstance(kind, Whole)
    asked = {"team_a": "Racks", "players_a": "Ann,600", "team_b": "Cues", "players_b": "Cy,500"}
    asked |= {"races": "even", "race": "5", "order": "home", "scale": "fargo"}
    refused = director.send("/team/new", **asked | {name: 10**6}).words
    assert f"from {kind.low} to {kind.high}" in refused


LISTS = {
    "Ann Lee,612\nBo Diaz,540\nCy Young,500\nDi Ray,480": "fargo",
    "player,rating,games\nAnn Lee,612,12\nBo Diaz,540,0\nCy Young,500,300": "fargo",
    "Ann Lee,92\nBo Diaz,71\nCy Young,64\nDi Ray,55": "npl",
    "Ann Lee,1712\nBo Diaz,1540\nCy Young,1500\nDi Ray,1480": "elo",
    "Ann Lee\nBo Diaz\nCy Young\nDi Ray": DEFAULT_SCALE,
    "Ann Lee,190\nBo Diaz,140\nCy Young,150\nDi Ray,160": "",
    "Ann Lee,612\nBo Diaz,92\nCy Young,500\nDi Ray,480": "",
}


@pytest.mark.slow_after(5)
@pytest.mark.parametrize("text", LISTS)
def test_a_list_means_the_same_on_the_page_and_on_the_terminal(tmp_path: Path, text: str) -> None:
    path = tmp_path / "list.txt"
    path.write_text(text)
    words = ["tournament", "new", str(path), "--race", "5", "--tables", "2"]
    typed = CliRunner().invoke(program, [*words, "--out", str(tmp_path / "typed.db")])
    with answering(tmp_path / "page.db") as site:
        fields = Fields(Phone(site, director=True).open("/new").text).usual
        asked = {k: v for k, v in fields.items() if k not in ("csrf", "", "file", "in_place_of")}
        shown = Phone(site, director=True).send(
            "/new", **asked | {"entrants": text, "race": 5, "tables": 2}
        )
    if not LISTS[text]:
        assert (typed.exit_code, shown.status) == (2, 400)
        for said in (typed.stderr, shown.words):
            assert re.search(r"Ann Lee wins a game against Bo Diaz \d+% of the time by NPL", said)
        assert "--scale npl" in typed.stderr
        assert "--" not in shown.words
        return
    assert (typed.exit_code, shown.status) == (0, 200), (typed.output, shown.words)
    nights = [read_tournament(tmp_path / f"{face}.db") for face in ("typed", "page")]
    assert nights[0].plan == replace(nights[1].plan, date="")  # the page notes it
    assert nights[0].entrants == nights[1].entrants
    assert nights[0].plan.scale == LISTS[text]
