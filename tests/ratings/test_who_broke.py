import pytest

from evenbreak.errors import InputError
from evenbreak.ratings import Results
from evenbreak.ratings.results_frame import FORMATS
from evenbreak.ratings.who_broke import breakers, count_broken
from rows import each_of


def counts(racks="", form="", first=0, score=None):
    won = (racks.count("a"), racks.count("b")) if score is None else score
    season = Results.from_names(
        ["Ann"],
        ["Bo"],
        [won[0]],
        [won[1]],
        racks=[racks],
        break_format=[FORMATS.index(form)],
        first_break=[first],
    )
    broken = count_broken(season)
    return tuple(broken.won[:, 0].tolist()), tuple(broken.lost[:, 0].tolist())


@each_of(
    "racks, form, first, won, lost",
    [
        # who broke:  a a b b a
        ("abbaa", "winner", 1, (0, 2, 1), (0, 1, 1)),
        # who broke:  ? a b b a
        ("abbaa", "winner", 0, (1, 1, 1), (0, 1, 1)),
        # who broke:  b b a a b
        ("abbaa", "loser", 2, (0, 1, 2), (0, 1, 1)),
        # who broke:  a b a b a
        ("abbaa", "alternate", 1, (0, 2, 1), (0, 1, 1)),
        ("abbaa", "alternate", 0, (3, 0, 0), (2, 0, 0)),
        ("abbaa", "a", 0, (0, 3, 0), (0, 2, 0)),
        ("abbaa", "b", 1, (0, 0, 3), (0, 0, 2)),
        ("abbaa", "", 0, (3, 0, 0), (2, 0, 0)),
        ("abbaa", "", 2, (2, 0, 1), (2, 0, 0)),
        ("", "winner", 1, (0, 0, 0), (0, 0, 0)),
    ],
)
def test_who_broke_follows_from_format_and_racks(racks, form, first, won, lost):
    assert counts(racks, form, first) == (won, lost)


def test_scores_tell_who_broke_only_where_one_player_did_throughout():
    assert counts(form="a", score=(7, 4)) == ((0, 7, 0), (0, 4, 0))
    assert counts(form="alternate", first=1, score=(7, 4)) == ((7, 0, 0), (4, 0, 0))


def test_no_columns_no_breakers():
    broken = count_broken(Results.from_names(["A"], ["B"], [7], [5]))
    assert (broken.won[:, 0].tolist(), broken.lost[:, 0].tolist()) == ([7, 0, 0], [5, 0, 0])


def test_racks_beyond_the_score_are_refused():
    with pytest.raises(InputError, match="find_problems"):
        counts("aab", "winner", 1, score=(1, 1))


@pytest.mark.parametrize(
    ("form", "first", "expected"),
    [
        ("winner", 2, [2, 1, 2, 2, 1]),
        ("loser", 2, [2, 2, 1, 1, 2]),
        ("alternate", 2, [2, 1, 2, 1, 2]),
        ("a", 1, [1, 1, 1, 1, 1]),
        ("b", 2, [2, 2, 2, 2, 2]),
        ("", 1, [1, 0, 0, 0, 0]),
        ("winner", 0, [0, 1, 2, 2, 1]),
        ("alternate", 0, [0, 0, 0, 0, 0]),
    ],
)
def test_breakers_rack_by_rack(form, first, expected):
    assert breakers("abbaa", form, first) == expected
