"""The option --columns that a message proposes, and that it works as it stands."""

import re

import numpy as np
import pytest

from evenbreak.errors import DataError
from evenbreak.files.results.results_file import read_results
from rows import each_of
from tries import tries


@each_of(
    "content, hint",
    [
        (
            "Datum;Sp. H;Sp. G;Tore H;Tore G\n3.9.2024;Ann;Bo;7;5\n",
            "player_a=Sp. H,player_b=Sp. G,score_a=Tore H,score_b=Tore G",
        ),
        (
            "Teilnehmer 1,Teilnehmer 2,Stand\nAnn,Bo,7-5\n",
            "player_a=Teilnehmer 1,player_b=Teilnehmer 2,score=Stand",
        ),
        ("Home,Guestt,Stand\nAnn,Bo,7-5\n", "player_b=Guestt,score=Stand"),
        ("player_a,player_b,P1,P2\nAnn,Bo,7,5\n", "score_a=P1,score_b=P2"),
        ("P2,P1,player_b,player_a\n5,7,Bo,Ann\n", "score_a=P1,score_b=P2"),
        ("Gastpunkte,Heimpunkte,Gast,Heim\n5,7,Bo,Ann\n", "score_a=Heimpunkte,score_b=Gastpunkte"),
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


TRIES = tries("proposals", 90)
PLAYERS = [f"{a} {b}" for a in ("Ann", "Bo", "Cy", "Di", "Élodie") for b in ("Lee", "Ng", "Żak")]
CLUB = {name: ["Rot", "Blau", "Weiß", "Gold"][k % 4] for k, name in enumerate(PLAYERS)}
LEVEL = {name: 3 + k % 6 for k, name in enumerate(PLAYERS)}
SIDES = [
    *(("Heim", "Gast"), ("Akteur A", "Akteur B"), ("Xq", "Vw"), ("Wer", "Wen"), ("T1", "T2")),
    *(("Sp H", "Sp G"), ("player_a", "player_b"), ("thuis", "uit"), ("Wer", "Gast")),
]
POINTS = [
    *(("Punkte A", "Punkte B"), ("Tore H", "Tore G"), ("P1", "P2"), ("Heimpunkte", "Gastpunkte")),
    *(("Zlo", "Prak"), ("Points", "Plus"), ("Spiele A", "Spiele B"), ("score_a", "Rest")),
    *(("S1", "S2"), ("Punkte A", "Punkte B")),
]


def others_of(rng, k, a, b, score):
    """Return what else may stand in row k, by title."""
    won = score[0] > score[1]
    return {
        "Spiel": k + 1,
        "Tisch": rng.integers(1, 9),
        "Nr": 100 + 2 * k,
        "Woche": k // 4 + 1,
        "HC A": rng.integers(4, 9),
        "HC B": rng.integers(4, 9),
        "Klasse A": LEVEL[a],
        "Klasse B": LEVEL[b],
        "Liga 1": 3 if won else 0,
        "Liga 2": 0 if won else 3,
        "MP H": 14 + score[0] - score[1] if won else 6 + score[0] - score[1],
        "MP G": 6 + score[1] - score[0] if won else 14 + score[1] - score[0],
        "Bonus A": score[0] + 3 * won,
        "Bonus B": score[1] + 3 * (not won),
        "Dauer": rng.integers(20, 90),
        "Halle": rng.choice(["Nord", "Süd"]),
        "Klub 1": CLUB[a],
        "Klub 2": CLUB[b],
        "Schiri": rng.choice([name for name in PLAYERS if name not in (a, b)]),
        "Bester": a if won else b,
        "Kapitän A": PLAYERS[PLAYERS.index(a) % 4],
        "Kapitän B": PLAYERS[PLAYERS.index(b) % 4],
        "Anmerkungen dazu": rng.choice(["", "spät"]),
        "Beginn": f"{1 + k % 28}.3.2024",
        "Uhrzeit": f"{18 + k % 5}:30",
        "Blub": rng.integers(0, 1000),
        "Blub 2": rng.integers(0, 12),
        "Sätze": f"{2 * won + (not won)}:{2 * (not won) + won}",
    }


@pytest.mark.slow_after(50)
@pytest.mark.parametrize("seed", range(TRIES))
def test_a_proposal_reads_every_row_as_what_it_is_or_is_not_made(tmp_path, seed):
    """In whatever order the columns stand, whatever they are called, and whatever else is there."""
    rng = np.random.default_rng(seed)
    many = int(rng.choice([3, 12, 60]))
    sides, points = SIDES[rng.integers(len(SIDES))], POINTS[rng.integers(len(POINTS))]
    in_one, fixed = rng.random() < 0.3, rng.random() < 0.3
    truth, rows = [], []
    extra: list[str] = []
    for k in range(many):
        a, b = map(str, rng.choice(PLAYERS, 2, replace=False))
        race = 7 if fixed else int(rng.integers(4, 8))
        score = [race, int(rng.integers(0, race))][:: rng.choice([1, -1])]
        truth.append(sorted([(a, score[0]), (b, score[1])]))
        every, won = others_of(rng, k, a, b, score), {"Stand": f"{score[0]}-{score[1]}"}
        if not k:
            extra = rng.permutation(list(every))[: rng.integers(0, 8)].tolist()
        row = {sides[0]: a, sides[1]: b} | (
            won if in_one else dict(zip(points, score, strict=True))
        )
        rows.append(row | {name: every[name] for name in extra})
    titles = rng.permutation(list(rows[0])).tolist()
    lines = [";".join(titles), *(";".join(str(row[title]) for title in titles) for row in rows)]
    path = tmp_path / "r.csv"
    path.write_text("\n".join(lines))
    columns = {}
    try:
        read_results(path)
    except DataError as error:
        proposed = re.findall(r'"([^"]*=[^"]*)"', error.problems[0])
        if len(proposed) != 1:
            return
        columns = dict(part.split("=") for part in proposed[0].split(","))
    results = read_results(path, columns=columns).results
    read = [
        sorted([(results.players[a], int(m)), (results.players[b], int(n))])
        for a, b, m, n in zip(
            results.player_a, results.player_b, results.score_a, results.score_b, strict=True
        )
    ]
    assert read == truth, (columns, titles)


def test_two_readings_are_shown_and_none_is_proposed(tmp_path):
    path = tmp_path / "r.csv"
    path.write_text("Wer,Gegen wen,Stand\nAnn,Bo,7-5\n")
    with pytest.raises(DataError) as caught:
        read_results(path)
    assert 'columns "' not in caught.value.problems[0]
    ways = re.findall(r'"([^"]*=[^"]*)"', caught.value.problems[0])
    assert ways == [
        "player_a=Wer,player_b=Gegen wen,score=Stand",
        "player_a=Gegen wen,player_b=Wer,score=Stand",
    ]


def test_points_of_the_match_are_never_taken_for_games_nor_numbers_of_games_for_scores(tmp_path):
    """A file as a league program writes it: 60 matches by points, with the number of the game."""
    path = tmp_path / "r.csv"
    rows = [
        f"{k % 9 + 1};{'Ann;Bo' if k % 2 else 'Bo;Ann'};{20 - k % 7};{k % 7}" for k in range(60)
    ]
    path.write_text("\n".join(["Spiel;Spieler A;Spieler B;Punkte A;Punkte B", *rows]))
    with pytest.raises(DataError) as caught:
        read_results(path)
    assert "score_a=" not in caught.value.problems[0]


def test_a_proposal_is_made_where_titles_and_cells_say_what_they_are(tmp_path):
    path = tmp_path / "r.csv"
    pairs = ["Ann;{};{};Bo", "Bo;{};{};Ann"]
    rows = [
        f"{k + 1};{k % 8 + 1};" + pairs[k % 2].format(*(7, 4)[:: (-1) ** (k // 3)])
        for k in range(60)
    ]
    path.write_text("\n".join(["Spiel;Tisch;Spieler A;Punkte A;Punkte B;Spieler B", *rows]))
    wanted = 'columns "score_a=Punkte A,score_b=Punkte B"'
    with pytest.raises(DataError, match=wanted):
        read_results(path)
