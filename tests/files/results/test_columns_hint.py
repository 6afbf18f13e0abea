"""The option --columns that a message proposes, and that it works as it stands."""

import re

import numpy as np
import pytest

from evenbreak.errors import DataError
from evenbreak.files.results.results_file import read_results
from tries import tries


@pytest.mark.parametrize(
    ("content", "hint"),
    [
        (
            "Datum;Heim;Gast;Tore H;Tore G\n3.9.2024;Ann;Bo;7;5\n",
            "player_a=Heim,player_b=Gast,score_a=Tore H,score_b=Tore G,date=Datum",
        ),
        ("Wer,Gegen wen,Stand\nAnn,Bo,7-5\n", "player_a=Wer,player_b=Gegen wen,score=Stand"),
        ("Home,Gast,Stand\nAnn,Bo,7-5\n", "player_b=Gast,score=Stand"),
        ("player_a,player_b,P1,P2\nAnn,Bo,7,5\n", "score_a=P1,score_b=P2"),
        (
            "Club,X,Table,Y,Stand\nQ,Ann,Red,Bo,7-5\nR,Bo,Blue,Ann,7-4\n",
            "player_a=X,player_b=Y,score=Stand",
        ),
        ("winner,loser,Stand\nAnn,Bo,7-5\n", "score=Stand"),
    ],
)
def test_the_proposed_option_reads_the_file(tmp_path, content, hint):
    path = tmp_path / "r.csv"
    path.write_text(f"Our league\n{content}")
    with pytest.raises(DataError) as caught:
        read_results(path)
    (problem,) = caught.value.problems
    proposed = re.search(r'columns "(.*)"', problem)[1]
    assert proposed == hint
    columns = dict(part.split("=") for part in proposed.split(","))
    file = read_results(path, columns=columns)
    assert {*file.results.players} == {"Ann", "Bo"}
    assert (file.results.score_a[0], file.results.score_b[0]) == (7, 5)


@pytest.mark.parametrize("content", ["what,ever\n", "player_a,player_b\nAnn,Bo\n", "a,a\nx,y\n"])
def test_where_nothing_fits_no_option_is_proposed(tmp_path, content):
    path = tmp_path / "r.csv"
    path.write_text(content)
    with pytest.raises(DataError) as caught:
        read_results(path)
    assert 'columns "' not in caught.value.problems[0]


TRIES = tries("proposals", 60)
PLAYERS = [f"{a} {b}" for a in ("Ann", "Bo", "Cy", "Di", "Élodie") for b in ("Lee", "Ng", "Żak")]
SIDES = [
    *(("Heim", "Gast"), ("Spieler A", "Spieler B"), ("Xq", "Vw"), ("Name 1", "Name 2")),
    ("Wer", "Wen"),
]
POINTS = [
    *(("Punkte A", "Punkte B"), ("Tore H", "Tore G"), ("P1", "P2"), ("Heimpunkte", "Gastpunkte")),
    *(("Zlo", "Prak"), ("Points", "Plus"), ("Spiele", "Gegenspiele")),
]
ALIKE = {
    *((SIDES[0], POINTS[1]), (SIDES[0], POINTS[3]), (SIDES[1], POINTS[0]), (SIDES[3], POINTS[2])),
}
"""Titles that say whose score is whose, in whatever order the columns are."""

CLUBS = ["Rot", "Blau", "Weiß", "Gold"]


def others_of(rng, k):
    """Return what else stands in row k, by title."""
    return {
        "Spiel": k + 1,
        "Tisch": rng.integers(1, 9),
        "Nr": 100 + 2 * k,
        "Runde": k // 4 + 1,
        "Vorgabe A": rng.integers(4, 9),
        "Vorgabe B": rng.integers(4, 9),
        "Dauer": rng.integers(20, 90),
        "Halle": rng.choice(["Nord", "Süd"]),
        "Klub 1": rng.choice(CLUBS),
        "Klub 2": rng.choice(CLUBS),
        "Anmerkung": rng.choice(["", "spät"]),
        "Beginn": f"{1 + k % 28}.3.2024",
        "Uhrzeit": f"{18 + k % 5}:30",
        "Blub": rng.integers(0, 1000),
    }


def in_order(titles, pair):
    """Put two titles in their order, each where one of them was."""
    places = sorted(titles.index(one) for one in pair if one in titles)
    for place, one in zip(places, pair, strict=False):
        titles[place] = one


@pytest.mark.slow_after(34)
@pytest.mark.parametrize("seed", range(TRIES))
def test_a_proposal_reads_every_row_as_what_it_is_or_is_not_made(tmp_path, seed):
    rng = np.random.default_rng(seed)
    many = int(rng.choice([3, 12, 60]))
    sides, points = SIDES[rng.integers(len(SIDES))], POINTS[rng.integers(len(POINTS))]
    in_one = rng.random() < 0.3
    truth, rows = [], []
    others = rng.permutation(list(others_of(rng, 0)))[: rng.integers(0, 6)].tolist()
    for k in range(many):
        a, b = rng.choice(PLAYERS, 2, replace=False)
        score = [7, int(rng.integers(0, 7))][:: rng.choice([1, -1])]
        truth.append(frozenset({(str(a), score[0]), (str(b), score[1])}))
        every, won = others_of(rng, k), {"Stand": f"{score[0]}-{score[1]}"}
        row = {sides[0]: a, sides[1]: b} | {name: every[name] for name in others}
        rows.append(row | (won if in_one else dict(zip(points, score, strict=True))))
    titles = rng.permutation(list(rows[0])).tolist()
    if in_one or (sides, points) not in ALIKE:
        in_order(titles, sides)
        in_order(titles, points)
    lines = [";".join(titles), *(";".join(str(row[title]) for title in titles) for row in rows)]
    path = tmp_path / "r.csv"
    path.write_text("\n".join(lines))
    with pytest.raises(DataError) as caught:
        read_results(path)
    proposed = re.search(r'columns "(.*)"', caught.value.problems[0])
    if proposed is None:
        return
    columns = dict(part.split("=") for part in proposed[1].split(","))
    results = read_results(path, columns=columns).results
    read = [
        frozenset({(results.players[a], int(m)), (results.players[b], int(n))})
        for a, b, m, n in zip(
            results.player_a, results.player_b, results.score_a, results.score_b, strict=True
        )
    ]
    assert sorted(map(sorted, read)) == sorted(map(sorted, truth)), (proposed[1], titles)


def test_a_proposal_is_made_where_titles_and_cells_say_what_they_are(tmp_path):
    path = tmp_path / "r.csv"
    pairs = ["Ann;{};{};Bo", "Bo;{};{};Ann"]
    rows = [
        f"{k + 1};{k % 8 + 1};" + pairs[k % 2].format(*(7, 4)[:: (-1) ** (k // 3)])
        for k in range(60)
    ]
    path.write_text("\n".join(["Spiel;Tisch;Spieler A;Punkte A;Punkte B;Spieler B", *rows]))
    wanted = 'player_a=Spieler A,player_b=Spieler B,score_a=Punkte A,score_b=Punkte B"'
    with pytest.raises(DataError, match=wanted):
        read_results(path)
