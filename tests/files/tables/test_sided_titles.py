"""Titles that stand twice, once a side, belong to the side whose player or team they follow."""

import random

import pytest

from evenbreak.files.league.folder import seen_files
from evenbreak.files.results.results_file import read_results
from evenbreak.files.tables.sided_titles import told_apart
from rows import each_of

ROW = {
    "Home Player": "Ann", "Away Player": "Bo", "Player 1": "Ann", "Player 2": "Bo",
    "Heim": "Ann", "Gast": "Bo",
}  # fmt: skip


@each_of(
    "header",
    [
        "Date,Home Player,SL,Score,Away Player,SL,Score,Innings",
        "Player 1,Race,Games Won,Player 2,Race,Games Won",
        "Race,Games Won,Player 1,Race,Games Won,Player 2",
        "Player 1,Race,Games Won,Player 2,Race.1,Games Won.1",
        "Player 1,Player 2,Race,Race,Games Won,Games Won",
        "Away Player,SL,Score,Home Player,SL,Score",
        "Heim,Distanz,Ergebnis,Gast,Distanz,Ergebnis",
        "Player,SL,Score,Player,SL,Score",
        "Home Team,Home Player,Race,Score,Away Team,Away Player,Race,Score",
    ],
)
def test_every_order_of_repeated_columns_reads_the_same(tmp_path, header):
    titles = header.split(",")
    seen, cells = {"Player": 0}, []
    own = {"Race": "54", "Distanz": "54", "SL": "63", "Score": "52", "Games Won": "52",
           "Ergebnis": "52", "Player": ("Ann", "Bo")}  # fmt: skip
    turned = titles[0] == "Away Player"
    for title in titles:
        bare = title.removesuffix(".1")
        place = seen.get(bare, 0)
        seen[bare] = place + 1
        cells.append(ROW.get(title) or own[bare][1 - place if turned else place]
                     if bare in own or title in ROW else "")  # fmt: skip
    (tmp_path / "r.csv").write_text(f"{header}\n{','.join(cells)}\n")
    results = read_results(tmp_path / "r.csv").results
    assert results.players[results.player_a[0]] == "Ann"
    assert (results.score_a[0], results.score_b[0]) == (5, 2)
    if results.race_a is not None:
        assert (results.race_a[0], results.race_b[0]) == (5, 4)
    if results.level_a is not None:
        assert (results.level_a[0], results.level_b[0]) == ("6", "3")


@pytest.mark.parametrize(
    "titles",
    [["Name", "Rating", "Rating"], ["Home", "Away", "x", "x", "x"], ["Player", "SL", "Wins"]],
)
def test_titles_whose_side_is_open_stay(titles):
    assert told_apart(titles) == titles


def test_innings_and_defensive_shots_are_never_a_score(tmp_path):
    rows = ["Date,Home Player,SL,Wins,Away Player,SL,Wins,Innings,Defensive Shots"]
    draw = random.Random(1)
    for k in range(24):
        a, b = f"P{k % 6} Lee", f"P{(k + 1 + k % 5) % 6} Lee"
        won, lost = draw.choice([(5, draw.randrange(4)), (draw.randrange(5), 4)])
        rows.append(
            f"2026-09-{k + 1:02},{a},{k % 4 + 3},{won},{b},{k % 3 + 3},{lost},{9 + k},{k % 7}"
        )
    (tmp_path / "sheets.csv").write_text("\n".join(rows))
    (seen,) = seen_files(tmp_path)
    assert seen.what == "results"
    assert seen.columns == {"score_a": "Home Wins", "score_b": "Away Wins"}
