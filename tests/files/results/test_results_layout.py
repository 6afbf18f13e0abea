"""Results in the layouts that people keep them in."""

import pytest

from evenbreak.errors import DataError
from evenbreak.files.results.results_file import read_results
from evenbreak.ratings.fit import fit


@pytest.fixture
def read(tmp_path):
    def read_content(content):
        path = tmp_path / "r.csv"
        path.write_text(content, encoding="utf-8")
        return read_results(path)

    return read_content


def problems(read, content):
    with pytest.raises(DataError) as caught:
        read(content)
    return [problem.rpartition("r.csv")[2] for problem in caught.value.problems]


def matches(file):
    """Return who beat whom by how much, whatever the order of the players."""
    results = file.results
    rows = zip(
        results.player_a,
        results.player_b,
        results.score_a,
        results.score_b,
        *results.races,
        strict=True,
    )
    return [(results.players[a], results.players[b], *map(int, counts)) for a, b, *counts in rows]


@pytest.mark.parametrize(
    "content",
    [
        "winner,loser,score\nAnn,Bo,7-5\n",
        "Loser;Score;Winner\nBo;7 : 5;Ann\n",
        "winner,loser,score\nAnn,Bo,7/5\n",
        "winner,loser,score\nAnn,Bo,7 – 5\n",
        "winner,loser,score\nAnn,Bo,'7-5\n",
        "winner,loser,score\nAnn,Bo,7:05\n",
        "winner,loser,winner score,loser score\nAnn,Bo,7,5\n",
        "winner,loser,score_a,score_b\nAnn,Bo,7,5\n",
        "winner,loser,racks\nAnn,Bo,ababababaaba\n",
        "player_a,player_b,score\nAnn,Bo,7-5\n",
        "player_a,player_b,winner,score\nAnn,Bo,ann,7-5\n",
        "Player 1,Player 2,Result\nAnn,Bo,7-5\n",
        "winner,loser,score,race\nAnn,Bo,7-5,\n",
    ],
)
def test_one_match_in_many_layouts(read, content):
    (found,) = matches(read(content))
    assert found == ("Ann", "Bo", 7, 5, 0, 0)


@pytest.mark.parametrize(
    ("content", "race"),
    [
        ("winner,loser,score,race\nAnn,Bo,7-5,7\n", (7, 7)),
        ("winner,loser,score,race\nAnn,Bo,5-6,5:7\n", (5, 7)),
        ("winner,loser,score,Race to\nAnn,Bo,7-5,Race to 7\n", (7, 7)),
        ("winner,loser,score,race_a,race_b\nAnn,Bo,5-6,5,7\n", (5, 7)),
        ("winner,loser,score,winner race,loser race\nAnn,Bo,5-6,5,7\n", (5, 7)),
        ("player_a,player_b,score,race\nBo,Ann,6-5,7/5\n", (7, 5)),
    ],
)
def test_races(read, content, race):
    (found,) = matches(read(content))
    assert found[4:] == race


def test_winner_first_rates_as_the_usual_layout_does(read):
    usual = read("player_a,player_b,score_a,score_b\nAnn,Bo,7,5\nCy,Ann,3,7\nBo,Cy,7,6\n")
    first = read("winner,loser,score\nAnn,Bo,7-5\nAnn,Cy,7-3\nBo,Cy,7-6\n")
    assert fit(first.results).rating == pytest.approx(fit(usual.results).rating)
    assert first.results.winner is not None
    assert list(first.results.winner) == [1, 1, 1]


def test_a_winner_and_a_race_are_enough(read):
    file = read("winner,loser,race\nAnn,Bo,7\nCy,Bo,5-7\n")
    assert file.results.unscored is not None
    assert list(file.results.unscored) == [True, True]
    assert matches(file)[1] == ("Cy", "Bo", 0, 0, 5, 7)


@pytest.mark.parametrize("text", ["W/O", "walkover", "Forfeit", "bye", "DQ"])
def test_a_walkover_in_the_place_of_the_score_is_a_forfeit(read, text):
    file = read(f"winner,loser,score\nAnn,Bo,{text}\nAnn,Cy,7-5\n")
    assert file.results.forfeit is not None
    assert list(file.results.forfeit) == [True, False]


def test_players_called_like_the_sides_keep_their_names(read):
    file = read("winner,loser,score\nB,A,7-5\nA,Cy,7-5\n")
    assert matches(file) == [("B", "A", 7, 5, 0, 0), ("A", "Cy", 7, 5, 0, 0)]


@pytest.mark.parametrize(
    ("cell", "told"),
    [
        ("5-7", "the loser won more games (5-7)"),
        ("7-7", "the score is tied (7-7)"),
        ("7", "'7' isn't a score"),
        ("75", "'75' isn't a score"),
        ("won", "'won' isn't a score"),
        ("7-5 hill", "isn't a score"),
        ("3-1 2-3 3-0", "has more than one score"),
        ("2024-07-05", "looks like a date"),
        ("05-Jul", "looks like a date"),
        ("Jul-05", "looks like a date"),
        ("5. Jul", "isn't a score"),
        ("07/05", "looks like a date"),
        ("7-05", "looks like a date"),
        ("-1-3", "isn't a score"),
        ("", "score is empty"),
    ],
)
def test_a_cell_that_is_no_score_is_one_problem_in_its_line(read, cell, told):
    (problem,) = problems(read, f"winner,loser,score\nAnn,Bo,7-5\nAnn,Bo,{cell}\n")
    assert problem.startswith(":3:")
    assert told in problem


@pytest.mark.parametrize(
    ("content", "told"),
    [
        ("winner,loser,score,race\nAnn,Bo,5-7,7\n", "the loser would have won this race (5-7 in a"),
        ("winner,loser,score,race\nAnn,Bo,5-6,7\n", "neither player reached their race"),
        ("winner,loser,score,race\nAnn,Bo,7-5,soon\n", "'soon' isn't a race"),
        ("winner,loser,score\nAnn,Ann,7-5\n", "'Ann' is on both sides"),
        ("winner,loser,score\nAnn,,7-5\n", "loser is empty"),
        ("player_a,player_b,winner,score\nAnn,Bo,Bo,7-5\n", "winner is b, but a won more"),
    ],
)
def test_contradictions_are_one_problem(read, content, told):
    (problem,) = problems(read, content)
    assert told in problem


@pytest.mark.parametrize(
    ("content", "unused"),
    [
        ("player_a,player_b,score_a,score_b,result\nAnn,Bo,7,5,won\n", "'score'"),
        ("player_a,player_b,winner,loser,score\nAnn,Bo,Ann,Bo,7-5\n", "'loser'"),
        ("winner,loser,score_a,score_b,race,race_a,race_b\nAnn,Bo,7,5,7,7,7\n", "'race'"),
        ("player_a,player_b,score,winner_score\nAnn,Bo,7-5,7\n", "'winner_score'"),
    ],
)
def test_columns_that_others_replace_are_not_used_and_named(read, content, unused):
    file = read(content)
    assert matches(file)[0][:4] == ("Ann", "Bo", 7, 5)
    (warning,) = file.warnings
    assert "not used" in warning
    assert unused in warning


def test_ties_are_named(read):
    (warning,) = read("player_a,player_b,score\nAnn,Bo,7-5\nAnn,Bo,6-6\nCy,Bo,3-3\n").ties
    assert ":3: the score is tied (6-6)" in warning
    assert "1 more" in warning
    assert read("player_a,player_b,score,race\nAnn,Bo,5-5,5-7\n").ties == ()
