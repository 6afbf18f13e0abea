"""No list of ratings is headed by a player of a few games, on any face."""

import csv
import io
import json
import re
from pathlib import Path

import pytest
from click.testing import CliRunner

from evenbreak.cli.program import program

ROWS = [("Ann", "Bo", 7, 6), ("Bo", "Cy", 7, 5), ("Cy", "Di", 7, 6), ("Ann", "Di", 7, 4)] * 6
VISIT = [("Eve", "Ann", 7, 0)]


@pytest.fixture
def season(tmp_path: Path) -> str:
    lines = [",".join(map(str, row)) for row in ROWS + VISIT]
    file = tmp_path / "season.csv"
    file.write_text("\n".join(["player_a,player_b,score_a,score_b", *lines]))
    return str(file)


def run(*words: str) -> str:
    result = CliRunner().invoke(program, list(words))
    assert result.exit_code == 0, result.output
    return result.stdout


def rows_of(text: str) -> list[dict[str, str]]:
    return list(csv.DictReader(io.StringIO(text)))


def test_rate_lists_a_visitor_last_and_says_so(season: str) -> None:
    rows = rows_of(run("rate", season))
    assert [row["player"] for row in rows] == ["Ann", "Bo", "Cy", "Di", "Eve"]
    assert [row["provisional"] for row in rows] == ["no"] * 4 + ["yes"]
    assert max(rows, key=lambda row: float(row["rating"]))["player"] == "Eve"
    found = json.loads(run("rate", season, "--json"))
    assert found["players"][0]["provisional"] is False
    assert found["players"][-1]["provisional"] is True
    assert found["provisional_below_games"] > 7
    text = " ".join(run("rate", season, "--text").split())
    assert text.index("Ann is rated highest") < text.index("1 player with fewer than")
    assert "provisional" in text.split("Eve")[-1]
    unlisted = run("rate", season, "--provisional", "0", "--text")
    assert "Eve is rated highest" in unlisted
    assert "provisional" not in unlisted
    assert "No one is ranked yet" in run("rate", season, "--provisional", "500", "--text")


def test_a_saved_list_counts_all_games_and_next_season_goes_on_with_them(
    season: str, tmp_path: Path
) -> None:
    first, second = str(tmp_path / "first.csv"), str(tmp_path / "second.csv")
    run("rate", season, "--save", first)
    run("rate", season, "--begin", first, "--save", second)
    once, twice = (
        {row["player"]: int(row["games"]) for row in rows_of(Path(name).read_text())}
        for name in (first, second)
    )
    assert next(iter(once)) == "Ann"
    assert twice == {name: 2 * games for name, games in once.items()}


@pytest.mark.slow
def test_the_sheet_and_its_files_list_a_visitor_last(season: str, tmp_path: Path) -> None:
    out = tmp_path / "sheet"
    said = run("report", season, "--out", str(out), "--page")
    for name in ("ratings", "matchups"):
        first = rows_of((out / f"{name}.csv").read_text())[0]
        assert first["player" if name == "ratings" else "player_a"] == "Ann"
    summary = dict(csv.reader((out / "summary.csv").read_text().splitlines()))
    assert summary["players_provisional"] == "1"
    page = (out / "sheet.html").read_text()
    ratings = page[page.index('<table class="ratings">') :]
    assert ratings.index("Di</bdi>") < ratings.index("Provisional") < ratings.index("Eve</bdi>")
    assert re.search(r"~\d+", ratings)
    assert re.search(r"P1 +Eve", said)
    assert "1 player (P1) with fewer than" in " ".join(said.split())


def test_a_list_read_back_keeps_who_is_provisional(season: str, tmp_path: Path) -> None:
    ratings = tmp_path / "ratings.csv"
    ratings.write_text(run("rate", season))
    rows = rows_of(run("matchups", str(ratings), "--race-to", "7"))
    assert rows[0]["player_a"] == "Ann"
    assert {row["player_a"] for row in rows if float(row["difference"]) < 0.0} == set()
    page = tmp_path / "round.html"
    run("matchups", str(ratings), "--race-to", "7", "--html", str(page))
    listed = page.read_text()
    assert listed.index("Provisional") < listed.rindex("Eve</bdi>")
    # Lists of earlier versions lack the column: the games say it.
    old = [
        {k: v for k, v in row.items() if k != "provisional"} for row in rows_of(run("rate", season))
    ]
    text = io.StringIO()
    writer = csv.DictWriter(text, old[0])
    writer.writeheader()
    writer.writerows(old)
    ratings.write_text(text.getvalue())
    assert rows_of(run("matchups", str(ratings), "--race-to", "7")) == rows
