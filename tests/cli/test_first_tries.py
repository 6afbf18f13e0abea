"""What a newcomer types first and slightly wrong: the error names what to type instead."""

from pathlib import Path

import pytest

from rows import each_of

APA = "player,rating\nAl,5\nBo,3\nCy,6\nDi,2\nEd,7\n"
RATED = "player,rating\nAl,85\nBo,83\nCy,86\nDi,82\nEd,87\n"


@pytest.fixture(autouse=True)
def _folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Be in a folder with a list of skill levels, one of ratings, and bare scores."""
    monkeypatch.chdir(tmp_path)
    for name, text in {"apa": APA, "us": RATED, "bare": "5\n6\n4\n7\n"}.items():
        (tmp_path / f"{name}.csv").write_text(text)


@each_of(
    "line, says",
    [
        ("lineup apa.csv apa.csv --race 5", "2 to 7 look like skill levels, not ratings. Add --ch"),
        ("fair Al Bo --from apa.csv", "apa.csv: 2 to 7 look like skill levels, not ratings. Add -"),
        ("tournament odds apa.csv --race 5", "Add --scale npl if they are ratings, otherwise --s"),
        ("lineup us.csv us.csv", "Add a race: one of --race, --race-to and --chart."),
        ("lineup us.csv us.csv --chart apa", "Did you mean apa_8ball or apa_9ball?"),
        ("lineup us.csv us.csv --race 5 --order foo", "winner, loser, sealed."),
        ("tournament result 2 Kev 5-5", "Write it like this: evenbreak tournament result 12 "),
        ("practice bare.csv", "bare.csv:1: no line names the columns. Write score above the scor"),
        ("serve tonight", "there's no file tonight. Name a .db file, such as tonight.db."),
    ],
)
def test_the_error_names_what_to_type(run, line: str, says: str) -> None:
    result = run(*line.split())
    assert result.exit_code in (1, 2, 3)
    assert result.stdout == ""
    assert says in result.stderr
    assert "Tonight's file is" not in result.stderr


def test_a_toss_that_shows_in_no_digit_makes_no_difference(run) -> None:
    result = run("lineup", "us.csv", "us.csv", "--race", "5", "--text")
    assert "The toss makes no difference." in result.stdout
