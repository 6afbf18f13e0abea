import pytest

from evenbreak.answers.league.sheet import find_players, most_active
from evenbreak.errors import InputError
from evenbreak.ratings.fit import fit
from evenbreak.ratings.results import Results


@pytest.fixture(scope="module")
def ratings():
    """Ann > Bo > Cy play each other; Di and Ed play only each other."""
    season = Results.from_names(
        ["Ann", "Bo", "Cy", "Di"], ["Bo", "Cy", "Ann", "Ed"], [7, 7, 3, 5], [4, 5, 7, 5]
    )
    return fit(season)


def test_the_most_active_come_first_and_ties_by_name(ratings):
    assert [ratings.players[k] for k in most_active(ratings, 4)] == ["Bo", "Cy", "Ann", "Di"]
    assert len(most_active(ratings, 99)) == 5


def test_matches_known_by_the_winner_alone_break_a_tie():
    season = Results.from_names(
        *(["Ann", "Bo"], ["Bo", "Cy"], [0, 0], [0, 0]),
        race_a=[7, 7],
        race_b=[5, 5],
        winner=[1, 1],
        unscored=[True, True],
    )
    assert most_active(fit(season), 1) == [1]


def test_players_are_found_by_name_in_any_case_and_once(ratings):
    assert find_players(ratings, ["Cy", " ann ", "CY", "Bo"]) == [2, 0, 1]


def test_all_unknown_players_are_named_with_names_that_are_like_them(ratings):
    with pytest.raises(
        InputError,
        match=r"^--who: .*'Anne' \(did you mean 'Ann'\?\), 'Xaver'. Write each name",
    ):
        find_players(ratings, ["Anne", "Bo", "Xaver", "Anne"], said="--who")


def test_names_that_differ_in_case_alone_must_be_given_as_written():
    ratings = fit(Results.from_names(["Ann", "ANN"], ["Bo", "Bo"], [7, 5], [5, 7]))
    assert find_players(ratings, ["ANN"]) == [0]
    with pytest.raises(InputError, match="did you mean 'ANN' or 'Ann'"):
        find_players(ratings, ["ann"])
