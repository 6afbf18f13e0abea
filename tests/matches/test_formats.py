import pytest
from hypothesis import given
from hypothesis import strategies as st

from evenbreak import InputError
from evenbreak.games import Ahead, Race, Rack, alternate_breaks, winner_breaks
from evenbreak.matches import MatchFormat, match_format, win_probability
from rows import each_of

NUMBERS = st.integers(1, 1000)
BREAKS = st.sampled_from([None, "winner", "loser", "alternate", "player 1", "player 2"])


@st.composite
def formats(draw, sets=True):
    ahead = draw(st.booleans())
    return MatchFormat(
        draw(NUMBERS),
        draw(NUMBERS),
        ahead,
        1 if ahead else draw(st.integers(1, 5)),
        draw(st.none() | formats(sets=False)) if sets else None,
    )


@given(formats())
def test_what_is_printed_reads_back(played):
    assert match_format(str(played)) == played


@given(NUMBERS, NUMBERS, BREAKS)
def test_break_formats_read_back(m, n, breaks):
    assert match_format(str(MatchFormat(m, n, breaks=breaks))).breaks == breaks


@pytest.mark.parametrize(
    ("text", "match"),
    [
        ("9:5", Race(9, 5, Rack(0.6))),
        (" RACE  9:5 ", Race(9, 5, Rack(0.6))),
        ("7:7 win by 2", Race(7, 7, Rack(0.6), win_by=2)),
        ("7:7, win-by 2", Race(7, 7, Rack(0.6), win_by=2)),
        ("Ahead 5:3", Ahead(5, 3, Rack(0.6))),
        ("3:1 of 3:3", Race(3, 1, Race(3, 3, Rack(0.6)))),
        ("ahead 2:2 of 5:4 win by 2", Ahead(2, 2, Race(5, 4, Rack(0.6), win_by=2))),
        ("2:2 of 2:2 of 2:1", Race(2, 2, Race(2, 2, Race(2, 1, Rack(0.6))))),
    ],
)
def test_what_the_texts_mean(text, match):
    assert match_format(text).match(Rack(0.6)) == match


def test_a_format_that_says_who_breaks_is_heard_first():
    rack = Rack(0.7, 0.6)
    said = match_format("2:1 of 3:3, winner breaks").match(rack, breaks=alternate_breaks)
    assert said == Race(2, 1, Race(3, 3, rack, breaks=winner_breaks))
    assert match_format("3:3").match(rack, breaks=alternate_breaks).breaks is alternate_breaks
    with pytest.raises(InputError, match="breaks is missing"):
        match_format("3:3").match(rack)


@pytest.mark.parametrize(
    ("text", "p", "wins"),
    [("9:5", 2 / 3, 0.552), ("3:3", 2 / 3, 0.790), ("3:1 of 3:3", 2 / 3, 0.493)],
)
def test_negotiation_of_p5_8(text, p, wins):
    assert win_probability(match_format(text).match(Rack(p))) == pytest.approx(wins, abs=5e-4)


@each_of(
    "text, remedy",
    [
        ("", "Write 9:5"),
        ("9", "Write 9:5"),
        ("9:5 of", "Write 9:5"),
        ("of 9:5", "Write 9:5"),
        ("9:5 winner", "Write 9:5"),
        ("9_5", "Write 9:5"),
        ("race to 7 ahead", "Write 9:5"),
        ("ahead 7 ahead", "Write 9:5"),
        ("race", "Write 9:5"),
        ("race to", "Write 9:5"),
        ("race to 0", "isn't from 1 to 1000"),
        ("٩:5", "Write 9:5"),
        ("0:5", "isn't from 1 to 1000"),
        ("9:1001", "isn't from 1 to 1000"),
        ("9:5 win by 0", "isn't from 1 to 1000"),
        ("ahead 5:3 win by 2", "Leave one out"),
    ],
)
def test_wrong_texts_say_what_to_write(text, remedy):
    with pytest.raises(InputError, match=remedy):
        match_format(text)


@given(st.text(alphabet="0123456789:, ofwinbyahedrcs", max_size=30))
def test_no_text_makes_another_error(text):
    try:
        played = match_format(text)
    except InputError:
        return
    assert match_format(str(played)) == played


@each_of(
    "text, same",
    [
        ("best of 9", "5:5"),
        ("Best of 1", "1:1"),
        ("best of 5 of 3:2, winner breaks", "3:3 of 3:2 winner breaks"),
        ("3:1 of best of 7", "3:1 of 4:4"),
        ("7 : 5", "7:5"),
        ("ahead 5 :3", "ahead 5:3"),
        ("race 7", "7:7"),
        ("Race to 7", "7:7"),
        ("race_to 7-5", "7:5"),
        ("race-to-7", "7:7"),
        ("first to 7 win_by 2", "7:7 win by 2"),
        ("n-ahead 3", "ahead 3:3"),
        ("n_ahead 5:3", "ahead 5:3"),
        ("ahead by 3", "ahead 3:3"),
        ("9 ahead", "ahead 9:9"),
        ("3-ahead, alternate-breaks", "ahead 3:3 alternate breaks"),
        ("5:3 ahead", "ahead 5:3"),
        ("race to 2 of race to 3", "2:2 of 3:3"),
    ],
)
def test_other_ways_to_write_a_format(text, same):
    assert str(match_format(text)) == same


@pytest.mark.parametrize("text", ["best of 8", "3:1 of best of 2", "best of 0"])
def test_the_best_of_an_even_number_is_no_match(text):
    with pytest.raises(InputError, match=r"can end in a tie\. Give an odd number"):
        match_format(text)


def test_wrong_parameters():
    with pytest.raises(InputError, match="m must be"):
        MatchFormat(0, 3)
    with pytest.raises(
        InputError,
        match=(
            "breaks must be 'winner', 'loser', 'alternate', "
            "'player 1' or 'player 2'; "
            "you gave 'mine'"
        ),
    ):
        MatchFormat(3, 3, breaks="mine")
    with pytest.raises(InputError, match="n-ahead"):
        MatchFormat(3, 3, True, 2)
