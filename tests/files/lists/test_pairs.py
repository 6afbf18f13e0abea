import pytest
from hypothesis import given
from hypothesis import strategies as st

from evenbreak.errors import DataError
from evenbreak.files.lists.season import read_pairs
from evenbreak.ratings.roster import Roster

CLUB = Roster(["Ann", "Bo Lee", "Cy", "cy", "Lee, Di"], [92, 71, 80, 60, 55])


@pytest.fixture(scope="session")
def read(tmp_path_factory):
    path = tmp_path_factory.mktemp("pairs") / "tonight.csv"

    def read_text(text):
        path.write_bytes(text if isinstance(text, bytes) else text.encode())
        return read_pairs(path, CLUB)

    return read_text


def test_places_in_the_order_of_the_file(read):
    file = read('Home;Away\nCy;Ann\n bo  lee ;cy\n"Lee, Di";Ann\n')
    assert file.pairs.tolist() == [[2, 0], [1, 3], [4, 0]]
    assert file.warnings == ()


def test_all_problems_at_once(read):
    with pytest.raises(DataError) as caught:
        read("player_a,player_b\nAnn,Bo Lea\nAnn,ann\nCY,Bo Lee\n,Ann\n")
    problems = [problem.partition("tonight.csv:")[2] for problem in caught.value.problems]
    expected = ["2: player_b 'Bo Lea'", "3: 'Ann'", "4: player_a 'CY'", "5: player_a"]
    assert [
        problem[: len(begin)] for problem, begin in zip(problems, expected, strict=True)
    ] == expected
    assert "did you mean 'Bo Lee'?" in problems[0]


@pytest.mark.parametrize(
    ("text", "problem"),
    [
        ("player_a,player_b\n", "has no pairs below its header"),
        ("player_a\nAnn\n", "there's no column 'player_b'"),
    ],
)
def test_nothing_to_read(read, text, problem):
    with pytest.raises(DataError, match=problem):
        read(text)


@given(st.binary(max_size=100))
def test_any_bytes_are_read_or_refused(read, content):
    try:
        found = read(b"player_a,player_b\n" + content)
    except DataError:
        return
    assert len(found.pairs) > 0
