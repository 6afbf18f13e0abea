"""One vocabulary for files and DataFrames: nothing in it is out of reach."""

from evenbreak.ratings.results_frame import FORFEIT_WORDS, FORMAT_WORDS, FORMATS, letters


def test_every_word_is_written_as_it_is_compared():
    words = [*FORFEIT_WORDS, *FORMAT_WORDS]
    assert [letters(word) for word in words] == words


def test_every_format_has_a_word():
    assert {FORMATS[code] for code in FORMAT_WORDS.values()} == set(FORMATS) - {""}
