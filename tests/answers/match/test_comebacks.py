"""Which cells the comeback table has, and where its star is."""

from evenbreak.answers.faces.to_text import to_text
from evenbreak.answers.kit.answer import Answer
from evenbreak.answers.match.live import comeback_tables
from evenbreak.games import Ahead, Race, Rack, winner_breaks
from evenbreak.matches import live_odds

BROKEN = Rack(0.6, 0.5)


def tables(match, winners=()):
    return list(comeback_tables(match, live_odds(match, winners), ("A", "B")))


def test_a_race_is_a_matrix_of_scores():
    (table,) = tables(Race(3, 2, Rack(0.5)), [1])
    assert [column.words for column in table.columns] == ["", "B 0", "B 1"]
    assert table.rows == [("A 1", "*50.0", "25.0"), ("A 2", "75.0", "50.0")]


def test_there_is_a_table_for_each_breaker():
    by_a, by_b = tables(Race(2, 2, BROKEN, breaks=winner_breaks), [2])
    assert by_a.rows == [("A 1", "60.0")]
    assert by_b.rows == [("A 0", "*30.0")]


def test_an_ahead_match_is_a_list_of_leads():
    (table,) = tables(Ahead(2, 2, Rack(0.5)), [2])
    assert table.rows == [
        ("B leads by 1", "*25.0"),
        ("level", "50.0"),
        ("A leads by 1", "75.0"),
    ]


def test_a_match_of_sets_has_the_set_under_way_and_the_sets():
    sets = Race(2, 2, Race(2, 2, Rack(0.5)))
    starred = ["*" in str(table.rows) for table in tables(sets, [1])]
    assert starred == [True, False]
    # As the next set begins, its score and that of the match are both the score now.
    assert ["*" in str(table.rows) for table in tables(sets, [1, 1])] == [True, True]


def test_a_match_that_is_over_has_no_table():
    (words,) = tables(Race(1, 1, Rack(0.5)), [1])
    assert isinstance(words, str)


def test_a_wide_table_is_cut_to_the_width_of_a_terminal():
    text = to_text(Answer("a long race", tables(Race(4, 30, Rack(0.5)))))
    assert max(map(len, text.splitlines())) <= 80
    assert text.count("A 0") == 3
