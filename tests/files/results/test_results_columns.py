import pytest

from evenbreak.errors import DataError
from evenbreak.files.results.columns import RESULTS_FILE
from evenbreak.files.results.results_file import read_results


@pytest.fixture
def read_row(tmp_path):
    """Read one match between Ann and Bo, 7-5, with the columns given."""

    def read(**cells):
        cells = {"player_a": "Ann", "player_b": "Bo", "score_a": "7", "score_b": "5", **cells}
        path = tmp_path / "r.csv"
        path.write_text(f"{','.join(cells)}\n{','.join(cells.values())}\n", encoding="utf-8")
        return read_results(path).results

    return read


def value(results, column):
    return getattr(results, column)[0]


@pytest.mark.parametrize(
    ("column", "text", "meaning"),
    [
        ("winner", "a", 1),
        ("winner", "A", 1),
        ("winner", "Player A", 1),
        ("winner", "1", 1),
        ("winner", "Ann", 1),
        ("winner", "ann", 1),
        ("winner", "", 0),
        ("first_break", "b", 2),
        ("first_break", "2", 2),
        ("first_break", "Bo", 2),
        ("break_format", "winner", 1),
        ("break_format", "Winner breaks", 1),
        ("break_format", "loser", 2),
        ("break_format", "alternate", 3),
        ("break_format", "Alternating breaks", 3),
        ("break_format", "a", 4),
        ("break_format", "B", 5),
        ("break_format", "", 0),
        ("forfeit", "yes", True),
        ("forfeit", "TRUE", True),
        ("forfeit", "W/O", True),
        ("forfeit", "no", False),
        ("forfeit", "0", False),
        ("forfeit", "", False),
        ("racks", "ABBA ABAA ABAA".replace("ABAA ABAA", "abababaa"), "abbaabababaa"),
        ("event", "Autumn", "Autumn"),
        ("race_a", "7.0", 7),
    ],
)
def test_what_cells_mean(read_row, column, text, meaning):
    other = {"race_a": {"race_b": "7"}}.get(column, {})
    assert value(read_row(**{column: text}, **other), column) == meaning


@pytest.mark.parametrize(
    ("text", "day"),
    [
        ("2024-09-03", "2024-09-03"),
        ("2024/9/3", "2024-09-03"),
        ("2024-09-03 20:15:00", "2024-09-03"),
        ("2024-09-03T20:15Z", "2024-09-03"),
        ("2024-02-29", "2024-02-29"),
        ("3.9.2024", "2024-09-03"),
        ("03.09.2024 20:15", "2024-09-03"),
        ("", "NaT"),
    ],
)
def test_dates(read_row, text, day):
    assert str(value(read_row(date=text), "date")) == day


@pytest.mark.parametrize(
    ("column", "text"),
    [
        ("date", "03/09/2024"),
        ("date", "9.13.2024"),
        ("date", "3.9.24"),
        ("date", "2023-02-29"),
        ("date", "0000-01-01"),
        ("date", "2024-09-03-04"),
        ("date", "yesterday"),
        ("winner", "Cy"),
        ("winner", "draw"),
        ("winner", "b"),
        ("first_break", "c"),
        ("break_format", "random"),
        ("forfeit", "perhaps"),
        ("racks", "abba"),
        ("racks", "aaaaaaabbbbx"),
        ("race_a", "7"),
        ("player_b", "Ann"),
        ("player_b", "An\x1b[31m"),
        ("player_b", ""),
        ("score_a", ""),
    ],
)
def test_cells_that_mean_nothing_or_contradict_are_one_problem(read_row, column, text):
    with pytest.raises(DataError) as caught:
        read_row(**{column: text})
    (problem,) = caught.value.problems
    assert ":2: " in problem
    assert ". " in problem


def test_a_name_as_written_means_the_player_before_a_letter_does(read_row):
    names = {"player_a": "B", "player_b": "A", "score_a": "5", "score_b": "7"}
    assert value(read_row(**names, winner="A"), "winner") == 2
    assert value(read_row(**names, winner="b"), "winner") == 2


def test_a_forfeit_may_leave_its_scores_empty(read_row):
    results = read_row(score_a="", score_b="", forfeit="yes")
    assert results.played()[1:] == (1, 0)


def test_a_race_decides_who_won(read_row):
    results = read_row(score_a="4", score_b="3", race_a="7", race_b="3", winner="b")
    assert value(results, "winner") == 2


def test_no_two_columns_share_a_name():
    keys = [
        "".join(filter(str.isalnum, name.casefold()))
        for name, column in RESULTS_FILE.columns.items()
        for name in (name, *column.aliases)
    ]
    assert len(keys) == len(set(keys))


def test_empty_scores_are_taken_from_the_racks(read_row):
    results = read_row(score_a="", score_b="", racks="abba")
    assert (results.score_a.tolist(), results.score_b.tolist()) == ([2], [2])
    assert results.unscored is None


@pytest.fixture
def read(tmp_path):
    def read(content):
        path = tmp_path / "r.csv"
        path.write_text(content, encoding="utf-8")
        return read_results(path).results

    return read


def test_scores_are_not_needed_where_race_and_winner_are_there(read):
    results = read("player_a,player_b,race_a,race_b,winner\nAnn,Bo,7,5,Bo\nBo,Cy,3,3,a\n")
    assert results.unscored.tolist() == [True, True]
    assert results.winner.tolist() == [2, 1]
    assert len(results.won_only()) == 2
    assert results.played()[1:] == (0, 0)


def test_racks_alone_are_enough(read):
    results = read("player_a,player_b,racks\nAnn,Bo,aab\n")
    assert (results.score_a.tolist(), results.score_b.tolist()) == ([2], [1])


def test_some_matches_may_be_known_by_their_winner_alone(read):
    results = read(
        "player_a,player_b,score_a,score_b,race_a,race_b,winner,forfeit\n"
        "Ann,Bo,7,3,7,5,,\n"
        "Bo,Cy,,,7,5,b,\n"
        "Bo,Cy,,,7,5,b,yes\n"
        "Bo,Cy,0,0,7,5,b,\n"
    )
    assert results.unscored.tolist() == [False, True, False, False]
    assert results.played()[1:] == (1, 1)


@pytest.mark.parametrize(
    "row",
    ["Ann,Bo,,,7,5,", "Ann,Bo,,,7,,a", "Ann,Bo,,,,,a", "Ann,Bo,7,,7,5,a", "Ann,Bo,,5,7,5,b"],
)
def test_an_empty_score_that_nothing_stands_in_for_is_told(read, row):
    with pytest.raises(DataError, match=r":2: score_[ab] is empty\. .*race_a, race_b and winner"):
        read(f"player_a,player_b,score_a,score_b,race_a,race_b,winner\n{row}\n")


def test_a_missing_score_column_is_told_where_nothing_stands_in_for_it(read):
    with pytest.raises(DataError, match="no columns 'score_a' and 'score_b'") as caught:
        read("player_a,player_b,race_a,race_b\nAnn,Bo,7,5\n")
    assert len(caught.value.problems) == 1


def test_without_score_columns_one_line_says_what_a_row_lacks(read):
    with pytest.raises(DataError) as caught:
        read("player_a,player_b,race_a,race_b,winner\nAnn,Bo,7,5,\nCy,Bo,x,5,a\nCy,Bo,7,5,Di\n")
    told = [problem.rpartition("r.csv")[2].partition(";")[0] for problem in caught.value.problems]
    assert told == [
        (":2: nothing shows who won. Write race_a, race_b and winner, or racks, or mark a forfeit"),
        (
            ":3: race_a 'x' isn't a whole number from 1 to 1,000,000. Write 1, 2, 3, "
            "..., or leave both races empty."
        ),
        (
            ":4: winner 'Di' is neither of the two players. Write a, b or one of the two "
            "names, or leave it empty."
        ),
    ]


@pytest.mark.parametrize(
    "header",
    [
        "player 1,player 2,score 1,score 2",
        "home player,away player,home score,away score",
        "Home,Away,Frames A,Frames B",
        "a,b,games_a,games_b",
        "Player A name,PLAYER-B-NAME,Games 1,Games 2",
        "player_a,player_b,racks won a,racks won b",
    ],
)
def test_other_names_of_the_columns_keep_the_sides_apart(tmp_path, header):
    path = tmp_path / "r.csv"
    path.write_text(f"{header}\nAnn,Bo,7,5\n", encoding="utf-8")
    results = read_results(path).results
    assert (results.players[results.player_a[0]], results.score_a[0]) == ("Ann", 7)
    assert (results.players[results.player_b[0]], results.score_b[0]) == ("Bo", 5)
