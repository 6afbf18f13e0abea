"""The results of a league: those that its file names, each file with its own titles."""

import pytest

from evenbreak.errors import DataError
from evenbreak.files.results.aliases import read_aliases
from evenbreak.files.results.seasons import read_seasons

LEAGUE = """\
[[results]]
file = "autumn.csv"
columns = { player_a = "Wer", player_b = "Gegen", score_a = "S1", score_b = "S2" }
dates = "dmy"
[[results]]
file = "spring.csv"
[aliases]
"Al P." = "Al Peterson"
"""


@pytest.fixture
def league(tmp_path):
    (tmp_path / "autumn.csv").write_text("date,Wer,Gegen,S1,S2\n9/3/2024,Al P.,Bo,7,5\n")
    (tmp_path / "spring.csv").write_text(
        "date,player_a,player_b,score_a,score_b\n2025-03-09,Al Peterson,Cy,7,2\n"
    )
    path = tmp_path / "league.toml"
    path.write_text(LEAGUE)
    return path


def test_each_file_is_read_by_its_own_titles_and_dates_and_all_by_the_aliases(league):
    results = read_seasons([league]).results
    assert results.players == ("Al Peterson", "Bo", "Cy")
    assert results.score_b.tolist() == [5, 2]
    assert [str(day)[:10] for day in results.date] == ["2024-03-09", "2025-03-09"]


def test_the_aliases_of_a_league_can_be_those_of_another_file(league):
    assert read_aliases(league).means == {"Al P.": "Al Peterson"}
    other = league.parent / "aliases.csv"
    other.write_text("name,means\nAl P.,Alan\n")
    assert "Alan" in read_seasons([league], aliases=other).results.players


def test_a_league_without_results_is_refused_with_what_to_write(tmp_path):
    (tmp_path / "league.toml").write_text("tables = 6\n")
    with pytest.raises(DataError, match=r"lists no results\. Add a \[\[results\]\] line"):
        read_seasons([tmp_path / "league.toml"])
