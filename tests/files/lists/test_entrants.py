import numpy as np
import pytest
import xlsxwriter

from evenbreak.errors import DataError
from evenbreak.files.lists.entrants import read_entrants, roster_of_entrants
from evenbreak.files.lists.roster import read_roster
from evenbreak.files.lists.season import league_of_entrants, read_season_players

LEAGUE = "player,rating,standard_error,games,scale\nAnn Lee,92,6,140,npl\nBo Diaz,71,9,60,npl\n"


@pytest.fixture
def written(tmp_path):
    def write(text, name="entrants.txt"):
        path = tmp_path / name
        path.write_text(text, encoding="utf-8")
        return path

    return write


@pytest.mark.parametrize(
    "text",
    [
        "Ann Lee\nBo Diaz\n",
        "\ufeff\n  Ann  Lee \n\nBo Diaz",
        "Name\nAnn Lee\nBo Diaz\n",
        "player;rating\nAnn Lee;92\nBo Diaz;\n",
        "Seed,Player\n1,Ann Lee\n2,Bo Diaz\n",
    ],
)
def test_names_stand_on_lines_or_in_a_column(written, text):
    assert read_entrants(written(text)).roster.players == ("Ann Lee", "Bo Diaz")


def test_a_name_with_a_comma_is_a_name(written):
    assert read_entrants(written("Lee, Ann\nDiaz, Bo\n")).roster.players == ("Lee, Ann", "Diaz, Bo")


@pytest.mark.parametrize(
    ("text", "names", "ratings"),
    [
        ("Ann Lee,92\nBo Diaz;71,5\nCy\n", ("Ann Lee", "Bo Diaz", "Cy"), [92, 71.5, np.nan]),
        ("Ann Lee 92\nBo\t71\n", ("Ann Lee", "Bo"), [92, 71]),
        ("Ann Lee 92\nBo 71\n", ("Ann Lee", "Bo"), [92, 71]),
        ("Ann Lee 612\nBo\n", ("Ann Lee", "Bo"), [612, np.nan]),
        ("Player 1\nPlayer 2\n", ("Player 1", "Player 2"), [np.nan, np.nan]),
        ("Player 101\nPlayer 102\n", ("Player 101", "Player 102"), [np.nan, np.nan]),
        ("Ann Lee,\nBo,\n", ("Ann Lee", "Bo"), [np.nan, np.nan]),
        ("1. Ann Lee,92\n\n2. Bo,71\n", ("Ann Lee", "Bo"), [92, 71]),
        ("1) Ann\n3) Bo\n", ("Ann", "Bo"), [np.nan, np.nan]),
    ],
)
def test_ratings_may_follow_the_names(written, text, names, ratings):
    found = read_entrants(written(text))
    assert found.roster.players == names
    assert found.roster.rating.tolist() == pytest.approx(ratings, nan_ok=True)


def test_a_workbook_of_entrants(tmp_path):
    with xlsxwriter.Workbook(tmp_path / "entrants.xlsx") as book:
        sheet = book.add_worksheet()
        sheet.write_row(0, 0, ["Player", "Rating"])
        sheet.write_row(1, 0, ["Ann Lee", 612])
        sheet.write_row(2, 0, ["Bo"])
    assert read_entrants(tmp_path / "entrants.xlsx").roster.players == ("Ann Lee", "Bo")


@pytest.mark.parametrize(
    ("text", "line"),
    [
        ("Ann Lee\nann  lee\n", 2),
        ("Ann Lee,92,7\n", 1),
        ("Wer,Wieviel\nAnn,92\n", 1),
        ("Ann 92\nBo,x\nCy 61\nDi,3", 2),
        ("player,rating\nAnn,high\n", 2),
    ],
)
def test_what_cannot_be_meant_is_refused_with_its_line(written, text, line):
    with pytest.raises(DataError, match=f"entrants.txt:{line}: "):
        read_entrants(written(text))


def test_entrants_have_their_ratings_and_strangers_none(written):
    league = read_roster(written(LEAGUE, "club.csv"))
    file = roster_of_entrants(league, read_entrants(written("bo diaz\nAnne Lee\nCy\n")))
    assert file.roster.players == ("Bo Diaz", "Anne Lee", "Cy")
    assert file.roster.rating.tolist() == pytest.approx([71, np.nan, np.nan], nan_ok=True)
    assert file.roster.games.tolist() == [60, 0, 0]
    assert file.scale.name == "npl"
    near, far = file.warnings
    assert "'Ann Lee'" in near
    assert "entrants.txt:2" in near
    assert "did you mean" not in far


def test_a_stated_rating_is_for_strangers_only(written):
    league = read_roster(written(LEAGUE, "club.csv"))
    file = roster_of_entrants(
        league, read_entrants(written("player,rating\nAnn Lee,70\nCy,64\nBo Diaz,71\n"))
    )
    assert file.roster.rating.tolist() == [92, 64, 71]
    assert any("entrants.txt:2: the rating 70" in warning for warning in file.warnings)
    assert not any("Bo Diaz" in warning for warning in file.warnings)


def test_two_scales_are_refused(written):
    league = read_roster(written(LEAGUE, "club.csv"))
    entrants = read_entrants(written("player,rating,scale\nCy,480,fargo\n"))
    with pytest.raises(DataError, match="fargo"):
        roster_of_entrants(league, entrants)


def test_a_season_of_entrants(written):
    league = read_season_players(written(LEAGUE, "club.csv"))
    entrants = read_entrants(written("Cy\nAnn Lee\n"))
    file = league_of_entrants(league, entrants, starter=80.0, starter_sd=30.0)
    assert file.players.names == ("Cy", "Ann Lee")
    assert file.players.rating.tolist() == [80, 92]
    assert file.players.skill_sd.tolist() == [30, 6]
    assert (file.drawn, file.exact) == (2, 0)
    assert file.players.played[0] == 0


def test_skill_levels_and_points_do_not_mix(written):
    league = "player,rating\nAnn Lee,92\nBo Diaz,71\n"
    entrants = read_entrants(written("Name,Skill Level\nAnn Lee,5\nCy,4\n"))
    path = written(league, "league.csv")
    for join in (
        lambda: roster_of_entrants(read_roster(path), entrants),
        lambda: league_of_entrants(read_season_players(path), entrants, starter=75, starter_sd=30),
    ):
        with pytest.raises(DataError, match="skill levels"):
            join()
    named = read_entrants(written("Name\nAnn Lee\nBo Diaz\n"))
    assert len(roster_of_entrants(read_roster(path), named).roster) == 2
