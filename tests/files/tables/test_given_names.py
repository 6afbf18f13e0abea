"""Names written as Lee, Ann."""

from evenbreak.files.lists.roster import read_roster
from evenbreak.files.lists.teams import read_squads
from evenbreak.files.results.results_file import read_results
from evenbreak.files.tables.given_names import given_name_first
from rows import each_of


@each_of(
    "name, meant",
    [
        ("Lee, Ann", "Ann Lee"),
        ("van der Berg,Jo", "Jo van der Berg"),
        ("Żak, Élodie Maria", "Élodie Maria Żak"),
        ("O'Neil, Ed", "Ed O'Neil"),
        ("Davis, Jr.", "Davis, Jr."),
        ("Lee, Ann, 7", "Lee, Ann, 7"),
        ("Racks 7, Bo", "Racks 7, Bo"),
        ("Lee,", "Lee,"),
    ],
)
def test_a_name_is_turned_where_one_comma_is_between_two_names(name, meant):
    assert given_name_first(name) == meant


def test_results_and_lists_name_the_players_alike_whichever_name_comes_first(tmp_path):
    results, players = tmp_path / "r.csv", tmp_path / "p.csv"
    results.write_text(
        'player_a,player_b,score,winner\n"Lee, Ann","Diaz, Bo",7-5,"Lee, Ann"\n'
        '"Diaz, Bo",BYE,,\n"Ng, Cy","Diaz, Bo",3-7,b\n'
    )
    players.write_text('name,rating\n"Lee, Ann",600\n"Diaz, Bo",500\n')
    file = read_results(results)
    assert file.results.players == ("Ann Lee", "Bo Diaz", "Cy Ng")
    assert file.results.winner.tolist() == [1, 2]
    assert any("last name first" in text for text in file.warnings)
    assert read_roster(players).roster.players == ("Ann Lee", "Bo Diaz")


def test_a_few_commas_among_other_names_change_nothing(tmp_path):
    path = tmp_path / "p.csv"
    path.write_text('name,rating\n"Lee, Ann",600\nBo Diaz,500\n"Ng, Cy",400\n')
    assert read_roster(path).roster.players == ("Lee, Ann", "Bo Diaz", "Ng, Cy")


@each_of(
    "text",
    [
        "First name,Last name,Rating\nAnn,Lee,600\nBo,Diaz,500\n",
        "Vorname;Name;Elo\nAnn;Lee;600\nBo;Diaz;500\n",
        "imię;nazwisko;Elo\nAnn;Lee;600\nBo;Diaz;500\n",
        "Surname,Forename,Rating\nLee,Ann,600\nDiaz,Bo,500\n",
    ],
)
def test_given_name_and_surname_in_two_columns_are_one_name(tmp_path, text):
    path = tmp_path / "p.csv"
    path.write_text(text, encoding="utf-8")
    assert read_roster(path).roster.players == ("Ann Lee", "Bo Diaz")


def test_a_full_name_next_to_a_given_name_stays(tmp_path):
    path = tmp_path / "p.csv"
    path.write_text("First name,Name,Rating\nAnn,Ann Lee,600\nBo,Bo Diaz,500\n")
    assert read_roster(path).roster.players == ("Ann Lee", "Bo Diaz")


@each_of(
    "text",
    [
        'Player,Rating,Games\nRacks,,\n"Lee, Ann",600,9\n"Ng, Cy",,\nCues,,\n"Diaz, Bo",500,7\n',
        "Player,Rating,x\nTeam: Racks,,\nAnn Lee,600,\nCy Ng,,\nTeam: Cues,,\nBo Diaz,500,\n",
    ],
)
def test_rows_that_name_the_team_of_the_players_below(tmp_path, text):
    path = tmp_path / "p.csv"
    path.write_text(text)
    squads = read_squads(path)
    assert {team: one.file.roster.players for team, one in squads.items()} == {
        "Racks": ("Ann Lee", "Cy Ng"),
        "Cues": ("Bo Diaz",),
    }
    file = read_roster(path)
    assert file.roster.players == ("Ann Lee", "Cy Ng", "Bo Diaz")
    assert any("'Racks', 'Cues'" in text for text in file.warnings)


def test_a_new_player_without_a_rating_is_no_team(tmp_path):
    path = tmp_path / "p.csv"
    path.write_text("Player,Rating\nAnn,\nBo,500\nCy,\n")
    assert len(read_roster(path).roster.players) == 3
