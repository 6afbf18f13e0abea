"""`evenbreak simulate --compare`: systems side by side, for ratings, levels and teams."""

import csv
import json
import re
from pathlib import Path

import pytest

RATED = "player,rating\nAnn,120\nBo,100\nCy,80\nDi,60\nEd,40\nFlo,90\n"
LEVELS = "player,skill level\nAnn,7\nBo,4\nCy,3\nDi,5\nEd,2\nFlo,\n"
TEAMS = "team,player,rating,level,scale\n" + "".join(
    f"{team},{team}{k},{600 - 40 * k},{6 - k},fargo\n" for team in ("Red", "Blue", "Green")
    for k in range(4)
)  # fmt: skip
FEW = ("--replicas", "40", "--weeks", "8")


@pytest.fixture
def simulated(run, tmp_path):
    def ask(text, *words):
        (tmp_path / "club.csv").write_text(text, encoding="utf-8")
        few = () if "--replicas" in words else FEW
        return run("simulate", str(tmp_path / "club.csv"), *few, *map(str, words))

    return ask


@pytest.fixture
def found(simulated):
    def ask(text, *words):
        result = simulated(text, *words, "--json")
        assert result.exit_code == 0, result.stderr
        return json.loads(result.stdout)

    return ask


@pytest.mark.parametrize(
    ("words", "systems"),
    [
        (("--compare", "npl", "--compare", "step 2"), ["npl", "step 2"]),
        (("--compare", "none, npl"), ["none", "npl"]),
        (("--compare", "step-2"), ["npl", "step 2"]),
        (("--system", "step 3", "--compare", "npl"), ["step 3", "npl"]),
    ],
)
def test_the_first_system_is_the_leagues_own(found, words, systems):
    assert found(RATED, *words)["systems"] == systems


@pytest.mark.parametrize(
    ("text", "words", "own"),
    [
        (LEVELS, (), "level-review"),
        (LEVELS, ("--chart", "apa_8ball"), "level-review"),
        ("player,Fargo rating\nAnn,600\nBo,500\nCy,550\n", (), "fargo-like"),
        (TEAMS, ("--chart", "apa_8ball", "--sets", "3"), "level-review"),
        (TEAMS, ("--sets", "3"), "fargo-like"),
    ],
)
def test_a_league_that_names_no_system_has_the_one_of_its_list(found, text, words, own):
    assert found(text, *words)["systems"] == [own]


def test_the_first_line_says_which_is_fairer_by_how_much_and_what_it_costs(simulated):
    text = " ".join(simulated(RATED, "--compare", "none, npl", "--text").stdout.split())
    assert re.search(r"npl is fairer than none: [\d.]+ more matches in 100 are even", text)
    assert "a player's number changes" in text.partition("What it costs: ")[2]


@pytest.mark.parametrize("systems", ["none, none 1", "none 1, none"])
def test_shorter_races_are_not_fairer_the_other_way_round_either(simulated, systems):
    text = " ".join(simulated(RATED, "--compare", systems, "--text").stdout.split())
    assert re.search(r"none 1 makes [\d.]+ more matches in 100 even than none", text)
    assert "it is not fairer: luck decides more of its matches." in text


def test_a_pace_gives_the_minutes_of_a_match(simulated, found):
    words = ("--compare", "npl, none", "--minutes-per-game", "6")
    told = " ".join(simulated(RATED, *words, "--text").stdout.split())
    minutes = [6.0 * row["value"] for row in found(RATED, *words)["measures"]
               if row["measure"] == "mean_games"]  # fmt: skip
    shown = "a match takes {:.0f} minutes with npl and {:.0f} minutes with none"
    assert shown.format(*minutes) in told


def test_a_difference_within_its_error_is_none(simulated):
    words = ("--compare", "npl, step 1", "--newcomers", "0", "--text")
    assert "No difference in fairness was found" in simulated(RATED, *words).stdout


def test_one_league_shows_no_difference(simulated):
    words = ("--compare", "npl, none", "--replicas", "1", "--text")
    assert "One season can't show which is fairer" in simulated(RATED, *words).stdout


def test_seasons_in_a_row_are_titles_each(found):
    answer = found(RATED, "--compare", "npl, none", "--seasons", "3")
    assert (answer["seasons"], answer["replicas"]) == (3, 40)


def test_teams_play_as_many_matches_as_a_night_has(found):
    answer = found(TEAMS, "--sets", "3", "--newcomers", "0")
    assert answer["matches_a_season"] == 8 * 3  # of three teams one is free each week


def test_line_ups_keep_to_the_cap(found):
    """With levels 6, 5, 4 and 3 in a team, only 5, 4 and 3 add up to 12."""
    words = ("--chart", "apa_8ball", "--sets", "3", "--newcomers", "0", "--cap", "12")
    free, capped = (found(TEAMS, *some) for some in (words[:-2], words))
    even = [next(row["value"] for row in answer["measures"] if row["measure"] == "p_even")
            for answer in (free, capped)]  # fmt: skip
    assert even[0] != even[1]


@pytest.mark.slow
def test_files_hold_measures_deciles_nights_players_and_pictures(simulated, tmp_path):
    out = tmp_path / "out"
    assert simulated(RATED, "--compare", "npl, none", "--out", out).exit_code == 0
    assert sorted(path.name for path in out.iterdir()) == [
        "deciles.csv",
        "errors_by_night.png",
        "errors_by_night.svg",
        "even_by_decile.png",
        "even_by_decile.svg",
        "measures.csv",
        "nights.csv",
        "players.csv",
    ]
    rows = csv.DictReader((out / "measures.csv").read_text(encoding="utf-8").splitlines())
    assert {row["system"] for row in rows} == {"npl", "none"}


def test_without_a_folder_nothing_is_written(simulated, tmp_path):
    assert simulated(RATED).exit_code == 0
    assert [path.name for path in Path(tmp_path).iterdir()] == ["club.csv"]


@pytest.mark.parametrize(
    ("text", "words", "error"),
    [
        (LEVELS, ("--chart", "apa_9ball"), "counts points"),
        (LEVELS, ("--compare", "npl, none"), "doesn't use"),
        (RATED, ("--compare", "npl, level review", "--chart", "apa_8ball"), "can't be used with"),
        (RATED, ("--compare", "nonesuch"), "nonesuch"),
        (RATED, ("--compare", "npl", "--rack-by-rack"), "can't be used together."),
        (RATED, ("--newcomers", "2", "--compare", "npl"), "share"),
        (TEAMS, ("--sets", "5"), "at least 5 players"),
        ("team,player,rating\nA,Ann,80\n,Bo,70\n", (), "team is empty"),
        (TEAMS, ("--sets", "3", "--random"), "--random is for individual players"),
        (RATED, ("--compare", "npl", "--cap", "23"), "--cap is for teams"),
        (LEVELS + "Gus,9\n", (), "'Gus' has skill level 9"),
    ],
)
def test_what_cannot_be_simulated_is_one_clear_error(simulated, text, words, error):
    result = simulated(text, *words)
    assert result.exit_code in (2, 3), result.stdout
    assert error in result.stderr
