"""Who entered something is shown with every name as it is, in every language."""

import pytest

from evenbreak.web.page import page_face
from evenbreak.web.sessions import author_words, phones_of
from evenbreak.words import in_face


@pytest.mark.parametrize("other", ["Bo", "Player and Son", "the Shark"])
def test_a_name_with_an_and_in_it_stays_whole(other: str) -> None:
    players = ["Tom and Jerry", other]
    said = in_face(author_words(phones_of(players)), page_face("de"))
    assert all(name in said for name in players)


def test_two_plain_names_are_joined_in_the_language_of_the_page() -> None:
    assert in_face(author_words(phones_of(["Ann", "Bo"])), page_face("de")).endswith("Ann und Bo")
