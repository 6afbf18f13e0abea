import numpy as np
import pytest

from evenbreak.errors import InputError
from evenbreak.ratings import Results, find_problems
from rows import each_of


def season(**columns):
    return Results.from_names(
        ["Ann", "Bo", "Cy", "Bo"], ["Bo", "Cy", "Ann", "Ann"], [7, 0, 3, 0], [5, 0, 7, 0], **columns
    )


def test_names_become_positions_in_the_order_of_the_names():
    results = season()
    assert results.players == ("Ann", "Bo", "Cy")
    assert results.player_a.tolist() == [0, 1, 2, 1]
    assert results.player_b.tolist() == [1, 2, 0, 0]
    assert len(results) == 4


def test_a_season_prints_in_one_line():
    assert repr(season()).count("\n") == 0
    assert f"{len(season()):,} matches" in repr(season())


def test_forfeits_and_empty_rows_are_left_out_and_counted_apart():
    played = season(forfeit=[False, True, False, False]).played()
    assert (len(played.results), played.forfeits, played.empty) == (2, 1, 1)
    assert played.results.score_b.tolist() == [5, 7]
    assert played.results.players == ("Ann", "Bo", "Cy")


def test_a_forfeit_is_left_out_whatever_its_score():
    played = season(forfeit=[True, False, False, False]).played()
    assert (len(played.results), played.forfeits, played.empty) == (1, 1, 2)


def test_selection_takes_every_column_along():
    results = season(
        racks=["aaaaaaabbbbb", "", "", ""], race_a=[7, 7, 7, 7], date=["2026-01-02"] * 4
    )
    first = results.select(np.array([0]))
    assert (first.racks.tolist(), first.race_a.tolist()) == (["aaaaaaabbbbb"], [7])
    assert str(first.date[0]) == "2026-01-02"
    assert first.event is None


def test_columns_are_copies_that_cannot_be_written():
    scores = np.array([7, 0, 3, 0])
    results = Results(("Ann", "Bo"), [0, 1, 0, 1], [1, 0, 1, 0], scores, scores)
    scores[0] = 99
    assert results.score_a[0] == 7
    with pytest.raises(ValueError, match="read-only"):
        results.score_a[0] = 1
    with pytest.raises(AttributeError):
        results.players = ()


def test_no_rows_are_results_too():
    results = Results.from_names([], [], [], [])
    assert (len(results), results.players, results.played().empty) == (0, (), 0)


def test_columns_of_other_lengths_are_refused():
    with pytest.raises(
        InputError, match=r"forfeit must have one value for each of 4 rows; its shape is \(1,\)"
    ):
        season(forfeit=[True])


@pytest.mark.parametrize(
    ("column", "values"),
    [("winner", [3, 0, 0, 0]), ("first_break", [-1, 0, 0, 0]), ("break_format", [6, 0, 0, 0])],
)
def test_codes_out_of_range_are_refused(column, values):
    with pytest.raises(InputError, match=f"{column} must hold codes below"):
        season(**{column: values})


def test_players_out_of_range_are_refused():
    with pytest.raises(InputError, match="player_b must hold codes below 2"):
        Results(("Ann", "Bo"), [0], [2], [1], [0])


def test_a_name_is_listed_once():
    with pytest.raises(InputError, match="players must have each name once; one appears twice"):
        Results(("Ann", "Ann"), [0], [1], [1], [0])


@pytest.mark.parametrize(
    ("name", "values"),
    [
        ("forfeit", [False, np.nan, False, False]),
        ("forfeit", ["no", "no", "no", "no"]),
        ("unscored", ["no", "no", "no", "no"]),
        ("winner", [257, 0, 0, 0]),
        ("race_a", [7, 7.5, 7, 7]),
        ("date", [20260131] * 4),
        ("racks", ["ab", np.nan, "", ""]),
        ("event", ["League", None, "", ""]),
    ],
)
def test_what_a_column_cannot_hold_is_refused(name, values):
    with pytest.raises(InputError, match=f"^{name} must be .*; you gave "):
        season(**{name: values})


@pytest.mark.parametrize("score", [2.5, np.nan, np.inf, "7", None])
def test_scores_are_whole_numbers(score):
    with pytest.raises(InputError, match=r"^score_a must be whole numbers"):
        Results.from_names(["Ann"], ["Bo"], [score], [5])
    with pytest.raises(InputError, match=r"^score_b must be whole numbers"):
        Results.from_names(["Ann"], ["Bo"], [7], [score])
    assert Results.from_names(["Ann"], ["Bo"], [7.0], [5]).score_a.tolist() == [7]


def test_names_are_text():
    with pytest.raises(InputError, match="holds nan, which isn't text"):
        Results.from_names(["Ann", np.nan], ["Bo", "Cy"], [7, 7], [5, 5])
    with pytest.raises(InputError, match="players must be names; it holds 1, which isn't text"):
        Results((1, 2), [0], [1], [7], [5])


WRONG = [
    # columns of one row beside Ann - Bo, the column blamed, what the message quotes
    ({"score": (-3, 7)}, "score_a", "score_a is -3"),
    ({"score": (7, -1)}, "score_b", "score_b is -1"),
    ({"race": (-7, 7)}, "race_a", "race_a is -7"),
    ({"race": (7, 0)}, "race_b", "race_b is empty"),
    ({"race": (0, 7)}, "race_a", "race_a is empty"),
    ({"score": (8, 5), "race": (7, 7)}, "score_a", "8-5 in a race 7:7"),
    ({"score": (5, 6), "race": (7, 5)}, "score_b", "5-6 in a race 7:5"),
    ({"score": (7, 5), "race": (7, 5)}, "score_b", "7-5 in a race 7:5"),
    ({"score": (6, 4), "race": (7, 5)}, "score_a", "6-4 in a race 7:5"),
    ({"winner": 2}, "winner", "winner is b, but a won more games (7-5)"),
    ({"score": (3, 3), "winner": 1}, "winner", "3-3"),
    ({"score": (4, 5), "race": (7, 5), "winner": 1}, "winner", "but b reached the race"),
    ({"racks": "ab"}, "racks", "racks 'ab' adds up to 1-1, but the score is 7-5"),
    ({"racks": "a/b"}, "racks", "'a/b'"),
    (
        {"score": (2, 1), "race": (2, 2), "racks": "aab"},
        "racks",
        "2-1 in a race 2:2",
    ),
]

RIGHT = [
    {},
    {"race": (7, 7), "winner": 1},
    # The weaker player wins the handicap race with fewer games.
    {"score": (6, 5), "race": (7, 5), "winner": 2},
    {"score": (3, 3)},  # a session that ended level
    {"score": (4, 2), "race": (7, 7), "forfeit": True, "winner": 2},
    {"score": (0, 0), "race": (7, 7)},
    {"score": (2, 1), "race": (2, 2), "racks": "aba"},
    {"score": (2, 1), "racks": "aab"},
]


def row(score=(7, 5), race=None, winner=None, racks=None, forfeit=None):
    columns = {}
    if race is not None:
        columns |= {"race_a": [race[0]], "race_b": [race[1]]}
    for name, value in (("winner", winner), ("racks", racks), ("forfeit", forfeit)):
        if value is not None:
            columns[name] = [value]
    return Results.from_names(["Ann"], ["Bo"], [score[0]], [score[1]], **columns)


@each_of("cells, column, words", WRONG)
def test_each_contradiction_is_found_once_and_says_how_to_mend_it(cells, column, words):
    (problem,) = find_problems(row(**cells))
    assert (problem.row, problem.column) == (0, column)
    assert words in problem.message
    assert ". " in problem.message


@pytest.mark.parametrize("cells", RIGHT)
def test_what_can_be_true_is_let_pass(cells):
    assert find_problems(row(**cells)) == []


@each_of("cells", [cells for cells, _, _ in WRONG if "racks" not in cells])
def test_it_does_not_matter_who_is_called_a(cells):
    swapped = {name: value[::-1] for name, value in cells.items() if name in ("score", "race")}
    swapped.setdefault("score", (5, 7))
    if "winner" in cells:
        swapped["winner"] = 3 - cells["winner"]
    assert len(find_problems(row(**swapped))) == 1


def test_no_player_is_on_both_sides():
    (problem,) = find_problems(Results.from_names(["Ann"], ["Ann"], [7], [5]))
    assert problem.column == "player_b"
    assert problem.message.startswith("'Ann'")


def test_problems_come_in_the_order_of_the_rows():
    results = Results.from_names(["A", "B", "C"], ["C", "B", "A"], [-1, 7, 3], [-1, 5, -2])
    assert [(p.row, p.column) for p in find_problems(results)] == [
        (0, "score_a"),
        (0, "score_b"),
        (1, "player_b"),
        (2, "score_b"),
    ]


def test_many_rows_are_checked_at_once():
    rows = 100_000
    score_a = np.full(rows, 7)
    score_a[77_777] = 6
    results = Results(
        ("Ann", "Bo"),
        np.zeros(rows, int),
        np.ones(rows, int),
        score_a,
        np.full(rows, 5),
        race_a=np.full(rows, 7),
        race_b=np.full(rows, 7),
        winner=np.ones(rows, int),
        racks=np.full(rows, "abababababaa", dtype=object),
    )
    assert [(p.row, p.column) for p in find_problems(results)] == [
        (77_777, "score_a"),
        (77_777, "racks"),
    ]
