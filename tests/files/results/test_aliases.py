import pytest
from hypothesis import given
from hypothesis import strategies as st

from evenbreak.errors import DataError
from evenbreak.files.results.aliases import read_aliases


@pytest.fixture
def read(tmp_path):
    def read_text(text):
        path = tmp_path / "aliases.csv"
        path.write_bytes(text.encode())
        return read_aliases(path)

    return read_text


def problems(read, text):
    with pytest.raises(DataError) as caught:
        read(text)
    return [problem.rpartition("aliases.csv")[2] for problem in caught.value.problems]


def test_names_are_cleaned_as_those_of_results_are(read):
    file = read("Written;Player\n Bob  S. ;Zoe\u0308\nAnn;Ann\n")
    assert file.means == {"Bob S.": "Zoë"}
    assert file.warnings == ()


def test_names_of_any_kind(read):
    text = 'name,means\n"Lee, ""Ann""",Ann Lee\n=cmd(),דנה\n🎱,"Bo\nDiaz"\n'
    assert read(text).means == {'Lee, "Ann"': "Ann Lee", "=cmd()": "דנה", "🎱": "Bo Diaz"}


def test_the_same_line_twice_does_no_harm(read):
    assert read("name,means\nBob,Rob\nBob,Rob\n").means == {"Bob": "Rob"}


def test_all_that_is_wrong_is_told_at_once(read):
    told = problems(read, "name,means\nBob,Rob\n,Rob\nBob,Robert\nCy,\nRob,Robin\n")
    assert [text.partition(";")[0] for text in told] == [
        (
            ":2: 'Bob' means 'Rob', which means 'Robin' in line 6. Write the player's "
            "real name in both lines, and keep only one of two names that mean each "
            "other."
        ),
        ":3: name is empty. Write a name, or delete the line.",
        ":4: 'Bob' means 'Robert' here, but 'Rob' in line 2. Keep one of the two.",
        ":5: means is empty. Write a name, or delete the line.",
    ]


def test_names_that_mean_each_other_are_refused(read):
    assert len(problems(read, "name,means\nBob,Rob\nRob,Bob\n")) == 2


def test_missing_columns_and_rows(read):
    assert problems(read, "name\nBob\n")[0].startswith(":1: there's no column 'means'")
    assert problems(read, "name,means\n")[0].startswith(": has no names")


NAMES = st.text(alphabet="ab ", max_size=2)


@given(st.lists(st.tuples(NAMES, NAMES), min_size=1, max_size=5))
def test_whoever_is_meant_means_nobody_else(tmp_path_factory, pairs):
    path = tmp_path_factory.getbasetemp() / "aliases.csv"
    path.write_text("name,means\n" + "".join(f"{a},{b}\n" for a, b in pairs))
    try:
        means = read_aliases(path).means
        told = ()
    except DataError as error:
        means, told = {}, error.problems
    assert all(line.startswith(str(path)) for line in told)
    assert all(means.get(name) is None for name in means.values())
    for name, meant in () if told else pairs:
        clean, clean_meant = " ".join(name.split()), " ".join(meant.split())
        assert means.get(clean, clean) == clean_meant
