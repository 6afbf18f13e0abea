import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from evenbreak.answers.faces.to_csv import to_csv
from evenbreak.answers.league.rate import rate_answer
from evenbreak.errors import DataError
from evenbreak.files.lists.roster import read_roster
from evenbreak.files.results.results_file import ResultsFile
from evenbreak.ratings import Results, fit
from evenbreak.ratings.roster import NOT_STATED
from evenbreak.ratings.scale import SCALES


@pytest.fixture(scope="session")
def read(tmp_path_factory):
    path = tmp_path_factory.mktemp("roster") / "roster.csv"

    def read_text(text):
        path.write_bytes(text if isinstance(text, bytes) else text.encode())
        return read_roster(path)

    return read_text


def problems_of(read, text):
    with pytest.raises(DataError) as caught:
        read(text)
    return [problem.partition("roster.csv")[2] for problem in caught.value.problems]


def test_all_columns(read):
    file = read("player,rating,standard_error,games,component\nAnn,92.5,9,140,1\n\nBo,,,0,2\n")
    roster = file.roster
    assert roster.players == ("Ann", "Bo")
    assert roster.rating[0] == 92.5
    assert np.isnan(roster.rating[1])
    assert roster.standard_error[0] == 9.0
    assert np.isnan(roster.standard_error[1])
    assert roster.games.tolist() == [140, 0]
    assert roster.component.tolist() == [1, 2]
    assert file.lines.tolist() == [2, 4]
    assert file.warnings == ()


def test_ratings_and_levels_stand_side_by_side(read):
    both = read("player,Fargo rating,skill level\nAnn,612,6\nBo,,4\n")
    assert (both.levels, both.scale) == (False, SCALES["fargo"])
    assert both.roster.rating[0] == 612.0
    assert both.roster.level.tolist() == [6.0, 4.0]
    alone = read("player,SL\nAnn,6\nBo,\n")
    assert alone.levels
    np.testing.assert_array_equal(alone.roster.rating, alone.roster.level)


def test_a_quasi_error_is_taken_where_it_stands(read):
    roster = read(
        "player,rating,standard_error,quasi_error\nAnn,92,9,6\nBo,80,8,\nCy,70,,5\n"
    ).roster
    assert roster.standard_error.tolist() == [6.0, 8.0, 5.0]
    text = "player,rating,quasi_error\nAnn,92,-1\n"
    (problem,) = problems_of(read, text)
    assert problem.startswith(":2: quasi_error '-1' isn't a number from 0")


def test_a_list_of_ratings_is_a_roster_with_the_errors_of_differences(tmp_path):
    season = Results.from_names(["Ann", "Bo", "Cy"], ["Bo", "Cy", "Ann"], [7, 7, 3], [4, 5, 7])
    ratings = fit(season)
    path = tmp_path / "ratings.csv"
    answer = rate_answer(ResultsFile(season, "season.csv", (), (), ""), ratings)
    path.write_text("".join(to_csv(answer)), encoding="utf-8")
    roster = read_roster(path).roster
    at = [ratings.players.index(name) for name in roster.players]
    np.testing.assert_allclose(roster.standard_error, ratings.quasi_error[at], atol=1e-6)
    np.testing.assert_allclose(roster.rating, ratings.rating[at], atol=1e-6)


def test_ratings_that_may_be_thousands_are_refused(read):
    for one, other in (('"1,500"', '"1,700"'), ("1.500", "1.700")):
        first, second = problems_of(read, f"name,rating\nAnn,{one}\nBo,{other}\n")
        assert first.startswith(":2: rating ")
        assert "1500 or 1.5" in first
        assert second.startswith(":3: rating ")
        assert "1700 or 1.7" in second


def test_two_columns_suffice(read):
    roster = read("Name;Skill level\nAnn;5\nBo;4\n").roster
    assert roster.rating.tolist() == [5.0, 4.0]
    assert roster.games.tolist() == [NOT_STATED, NOT_STATED]


def test_two_players_with_one_name_are_refused_with_their_lines(read):
    text = "player,rating\nAnn Lee,92\nBo,71\n Ann  Lee ,85\nBo,70\n"
    one, other = problems_of(read, text)
    assert one.startswith(":4: player 'Ann Lee' is already in line 2")
    assert other.startswith(":5: player 'Bo' is already in line 3")


def test_all_problems_at_once(read):
    text = (
        "player,rating,standard_error,games\n"
        ",80,,\nAnn,six hundred,-1,1\nBo,1e9,x,-2\nCy,,,12\nDi,80,2000000,0\n"
    )
    problems = problems_of(read, text)
    assert [line.split(":")[1] for line in problems] == ["2", "3", "3", "4", "4", "4", "5", "6"]
    assert problems[-2] == (
        ":5: rating is empty, but the player has 12 games. Fill it in, or write 0 games."
    )


@pytest.mark.parametrize(
    "name", ["Lee, Ann", 'Ann "Ace" Lee', "Ann\nLee", "שרה כהן", "🎱 Zoë", "=cmd()", "+1", "a;b"]
)
def test_names_of_all_kinds(read, name):
    quoted = name.replace('"', '""')
    file = read(f'player,rating\n"{quoted}",80\n')
    assert file.roster.players == (" ".join(name.split()),)


def test_names_that_differ_in_case_or_spaces_are_one_player_listed_twice(read):
    (problem,) = problems_of(read, "player,rating\nAnn Lee,80\nBo,75\nann  lee,71\n")
    assert problem.startswith(":4: player 'ann lee' is already in line 2 as 'Ann Lee'. ")


def test_similar_names_are_a_warning(read):
    (warning,) = read("player,rating\nBo Petersen,80\nBo Peterson,71\n").warnings
    assert "'Bo Petersen' and 'Bo Peterson' may be the same player" in warning


@pytest.mark.parametrize(
    ("text", "problem"),
    [
        ("player,rating\n", "has no players below its header"),
        ("player\nAnn\n", "there's no column 'rating'"),
        ("rating\n80\n81\n", "there's no column 'player'"),
    ],
)
def test_nothing_to_read(read, text, problem):
    (found,) = problems_of(read, text)
    assert problem in found


CELLS = st.sampled_from(["Ann", "Bo", "80", "", "9.5", "-3", "0", '"', "x", "1e400", "NaN"])
ROWS = st.lists(st.lists(CELLS | st.text(max_size=4), min_size=3, max_size=5), max_size=6)


@given(ROWS)
def test_any_cells_are_read_or_refused(read, rows):
    text = "player,rating,standard_error,games\n" + "\n".join(",".join(row) for row in rows)
    try:
        roster = read(text.encode("utf-8", "replace")).roster
    except DataError:
        return
    assert len(set(roster.players)) == len(roster) > 0
    assert not np.isinf(roster.rating).any()


@given(st.binary(max_size=200))
def test_any_bytes_are_read_or_refused(read, content):
    try:
        roster = read(b"player,rating\n" + content).roster
    except DataError:
        return
    assert len(set(roster.players)) == len(roster) > 0


def test_matches_are_counts_or_not_stated(tmp_path):
    path = tmp_path / "roster.csv"
    path.write_text("player,rating,Matches Played\nAnn,92,64\nBo,80,\n", encoding="utf-8")
    assert read_roster(path).roster.matches.tolist() == [64, NOT_STATED]
    path.write_text("player,rating,matches\nAnn,92,six\nBo,80,-1\n", encoding="utf-8")
    with pytest.raises(DataError) as caught:
        read_roster(path)
    assert len(caught.value.problems) == 2


def test_the_columns_of_a_season_are_no_surprise_but_a_misspelt_one_is(tmp_path):
    path = tmp_path / "roster.csv"
    path.write_text(
        "player,rating,skill,strength,day_sd,drift,joins,leaves,absence,absense\n"
        "Ann,92,90,91,4,0,1,9,0.1,0.1\n",
        encoding="utf-8",
    )
    assert read_roster(path).warnings == (f"{path}: columns not used: 'absense'",)


def test_the_scale_of_the_ratings_is_read(read):
    assert read("player,rating,scale\nAnn,612,Fargo\nBo,521,\n").scale == SCALES["fargo"]
    assert read("player;rating;scale\nAnn;612;33,5\n").scale.points_per_doubling == 33.5
    assert read("player,rating\nAnn,612\n").scale is None


@pytest.mark.parametrize(("scale", "named"), [("fargoo", "'fargoo'"), ("npl", "'fargo' in line 2")])
def test_an_unknown_or_a_second_scale_is_refused(read, scale, named):
    (problem,) = problems_of(read, f"player,rating,scale\nAnn,612,fargo\nBo,521,{scale}\n")
    assert problem.startswith(":3: scale ")
    assert named in problem


def test_a_cell_with_half_a_file_in_it_is_no_name(read):
    with pytest.raises(DataError, match=r":3: .*130,000 characters"):
        read("player,rating\nAnn,80\n" + 130_000 * "a" + ",70\n")


@pytest.mark.parametrize(
    ("title", "scale"), [("Fargo Rating", "fargo"), ("Elo", "elo"), ("Rating", None)]
)
def test_the_title_of_the_ratings_may_name_their_scale(tmp_path, title, scale):
    path = tmp_path / "club.csv"
    path.write_text(f"Name,{title}\nAnn,700\nBob,420\n", encoding="utf-8")
    file = read_roster(path)
    assert (file.scale and file.scale.name, file.levels) == (scale, False)


def test_a_title_that_names_another_scale_than_the_column_is_refused(tmp_path):
    path = tmp_path / "club.csv"
    path.write_text("Name,Fargo Rating,Scale\nAnn,700,elo\n", encoding="utf-8")
    with pytest.raises(DataError, match=r"'elo' differs from the column title 'Fargo Rating'"):
        read_roster(path)


@pytest.mark.parametrize("title", ["Skill Level", "level"])
def test_skill_levels_are_known_by_their_title(tmp_path, title):
    path = tmp_path / "apa.csv"
    path.write_text(f"Name,{title}\nAnn,7\nBob,4\n", encoding="utf-8")
    file = read_roster(path)
    assert (file.scale, file.levels) == (None, True)


@pytest.mark.parametrize(("yes", "no"), [("yes", "no"), ("TRUE", "false"), ("1", "0")])
def test_provisional_is_read_as_programs_and_our_workbook_write_it(read, yes, no):
    roster = read(f"player,rating,provisional\nAnn,600,{yes}\nBo,500,{no}\n").roster
    np.testing.assert_array_equal(roster.provisional, [True, False])


def test_a_fargo_search_gives_the_effective_rating_of_those_without_another(read):
    file = read(
        "readableId,firstName,lastName,rating,effectiveRating,robustness,provisionalRating\n"
        "1,Di,Diaz,523,523,1173,\n2,Bo,Fox,0,487,170,487\n3,Cy,Ash,,455,12,455\n4,Di,Orr,0,0,0,\n"
    )
    roster = file.roster
    assert roster.players[0] == "Di Diaz"
    np.testing.assert_array_equal(roster.rating, [523, 487, 455, np.nan])
    np.testing.assert_array_equal(roster.provisional, [False, True, True, False])
    np.testing.assert_array_equal(roster.games, [1173, 170, 12, 0])
    assert file.scale.name == "fargo"


def test_a_name_in_two_columns_may_have_one_title_above_both(read):
    """Where the upper row would do alone, or its titles are no part of the column's name."""
    file = read(
        "Fall,,,,\nTeam,Player,,Skill,Matches\n,Last name,First name,Level,Played\n"
        "Racks,Lee,Ann,5,12\nRacks,Fox,Bo,,0\n"
    )
    assert file.roster.players == ("Ann Lee", "Bo Fox")
    np.testing.assert_array_equal(file.roster.level, [5, np.nan])
    np.testing.assert_array_equal(file.roster.matches, [12, 0])
