"""Places as keys and as headings."""

import pytest

from evenbreak.answers.tournament.odds import place_key, place_words
from evenbreak.tournaments import Place


@pytest.mark.parametrize(
    ("place", "key", "words"),
    [
        (Place(1, 1), "p_title", "title"),
        (Place(3, 3), "p_third", "third"),
        (Place(3, 4), "p_3_4", "3-4"),
        (Place(9, 9), "p_9", "9"),
        (Place(1, 1, "consolation"), "p_consolation_1", "consolation 1"),
        (Place(3, 4, "consolation"), "p_consolation_3_4", "consolation 3-4"),
    ],
)
def test_places(place, key, words):
    assert (place_key(place), place_words(place)) == (key, words)
