"""A clean name by its short way is that by the long one, whatever is written."""

import unicodedata

from hypothesis import given
from hypothesis import strategies as st

from evenbreak.files.csv_writer import undefused
from evenbreak.files.tables.names import _HIDDEN, LONGEST_NAME, clean_name, is_name

TEXTS = st.text(st.one_of(st.characters(), st.sampled_from(" '\t=@-Aa\u00ad\u202e\u0308é")))


@given(TEXTS)
def test_the_short_way_is_the_long_one(text):
    visible = unicodedata.normalize("NFC", _HIDDEN.sub("", text))
    assert clean_name(text) == undefused(" ".join(visible.split()))


@given(TEXTS)
def test_a_name_has_letters_and_no_control_signs(text):
    control = any(unicodedata.category(letter) == "Cc" for letter in text)
    assert is_name(text) == (0 < len(text) <= LONGEST_NAME and not control)
