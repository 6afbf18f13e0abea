"""Forms begin with the rules of the league in whose folder the page runs."""

import re
from pathlib import Path

import pytest

from evenbreak.files.league.league_file import read_league
from web.phones import Phone, answering

RULES = """\
scale = "fargo"
discipline = "8-ball"
tables = 7
{races}
[team]
sets = 5
cap = 23
at_most = "2:6"
order = "ABBA"
count = "points"
"""


def as_they_stand(text: str) -> dict[str, str]:
    """Return the fields of a page: what is typed in them, and the chosen option of a list."""
    fields = dict(re.findall(r'<input name="(\w+)" value="([^"]*)"', text))
    for name, options in re.findall(r'<select name="(\w+)"[^>]*>(.*?)</select>', text, re.DOTALL):
        chosen = re.search(r'value="([^"]*)" selected', options)
        fields[name] = chosen[1] if chosen else ""
    return fields


@pytest.fixture
def begun(tmp_path):
    def fields(races: str, path: str) -> dict[str, str]:
        Path(tmp_path, "league.toml").write_text(RULES.format(races=races))
        with answering(tmp_path / "tonight.db") as site:
            site.rules = read_league(tmp_path)
            director = Phone(site, director=True)
            return as_they_stand(director.open(path).text)

    return fields


@pytest.mark.slow
@pytest.mark.parametrize(
    ("races", "shown"),
    [
        ('chart = "npl_10"', {"races": "npl_10"}),
        ("race_to = 9", {"races": "fair", "race": "9"}),
        ("race = 4", {"races": "even", "race": "4"}),
    ],
)
def test_a_tournament_begins_with_the_rules_of_the_league(begun, races, shown):
    fields = begun(races, "/new")
    wanted = {"scale": "fargo", "discipline": "8-ball", "tables": "7", **shown}
    assert {name: fields[name] for name in wanted} == wanted


def test_a_team_night_begins_with_the_rules_of_the_league(begun):
    fields = begun('chart = "apa_9ball"', "/team/new")
    wanted = {
        "races": "apa_9ball",
        "sets": "5",
        "cap": "23",
        "at_most": "2:6",
        "pattern": "ABBA",
        "count": "points",
        "discipline": "8-ball",
        "tables": "7",
    }
    assert {name: fields[name] for name in wanted} == wanted
