"""Exports as league programs write them, made up in their form: read, or refused for one reason.

What is public of each program's titles is in the program's own words; the files are ours.
"""

import json
import re

import pytest

from evenbreak.errors import DataError
from evenbreak.files import read_results, read_roster

PAIRS = [("Ann Lee", "Bo Diaz"), ("Cy Ng", "Di Roy"), ("Ann Lee", "Cy Ng"), ("Bo Diaz", "Di Roy")]
SCORES = [(5, 3), (2, 5), (5, 4), (5, 0)]


def read(tmp_path, text, reader=read_results, name="export", **how):
    path = tmp_path / name
    path.write_text(text, encoding="utf-8")
    return reader(path, **how)


def as_played(results):
    """Return each match: the two names and their scores, in the order of the file."""
    rows = zip(results.player_a, results.player_b, results.score_a, results.score_b, strict=True)
    return [(results.players[a], results.players[b], int(m), int(n)) for a, b, m, n in rows]


TRUTH = [(*pair, *score) for pair, score in zip(PAIRS, SCORES, strict=True)]


def test_records_of_a_division_with_each_match_from_both_sides(tmp_path):
    def record(a, b, m, n, home):
        return {
            "homeTeam": home,
            "awayTeam": "Cues",
            "homePlayer": a,
            "homeHCP": 55,
            "homeScore": m,
            "awayPlayer": b,
            "awayHCP": 61,
            "awayScore": n,
            "date": "January 29th",
            "forfeit": False,
            "winner": a if m > n else b,
            "winnerTeam": home,
            "winnerHCP": 55,
            "seasonId": 7,
            "seasonTitle": "Spring",
        }

    records = [record(*match, "Racks") for match in TRUTH]
    forfeit = record("Ann Lee", "Di Roy", 0, 0, "Racks") | {"forfeit": True}
    text = json.dumps([*records, forfeit])
    with pytest.raises(DataError, match="'January 29th' isn't a date"):
        read(tmp_path, text)
    file = read(tmp_path, text, columns={"date": "-"})
    assert as_played(file.results)[:4] == TRUTH
    assert file.results.forfeit.tolist() == [False] * 4 + [True]
    assert file.results.team_a[0] == "Racks"
    assert file.results.level_b[0] == "61"


def test_a_list_of_fargo_players_by_team_and_what_its_search_returns(tmp_path):
    players = read(
        tmp_path,
        'Player,Rating,Robustness\n"Lee, Ann",612,304\n"Diaz, Bo",540,88\n"Ng, Cy",488,120\n',
        read_roster,
    )
    assert players.roster.players == ("Ann Lee", "Bo Diaz", "Cy Ng")
    assert players.roster.games.tolist() == [304, 88, 120]
    found = [
        {"readableId": "1", "firstName": "Ann", "lastName": "Lee", "rating": "612"},
        {"readableId": "2", "firstName": "Bo", "lastName": "Diaz", "rating": "540"},
    ]
    with pytest.raises(DataError):  # a list of players is no list of results
        read(tmp_path, json.dumps(found))


@pytest.mark.parametrize(
    "header",
    [
        "date,home,away,game type,home race,away race,home wins,away wins",
        "Match,Date,Player 1,Race 1,Games 1,Player 2,Race 2,Games 2",
        "Datum;Spieler Heim;Spieler Gast;Spiele Heim;Spiele Gast",
        "data;gospodarz;gość;wynik",
        "Fecha;Local;Visitante;Resultado",
        "date;domicile;extérieur;score",
        "datum;thuis;uit;uitslag",
        "Start time,Player A,Player B,Race to,Score A,Score B,Discipline",
    ],
)
def test_tables_are_read_or_refused_with_one_error_that_can_be_pasted(tmp_path, header):
    sign = ";" if ";" in header else ","
    titles = header.split(sign)
    rows = []
    for k, (a, b, m, n) in enumerate(TRUTH):
        cells = []
        for title in titles:
            key = title.casefold()
            first = re.search(r"home|heim|1|\ba\b|gospodarz|local|domicile|thuis", key)
            if re.search("dat|fecha|start", key):
                cells.append("2024-09-03 19:30")
            elif re.search("race", key):
                cells.append("5")
            elif re.search("game type|discipline", key):
                cells.append("8-ball")
            elif key == "match":
                cells.append(str(k + 1))
            elif re.search("wynik|resultado|^score$|uitslag", key):
                cells.append(f"{m} - {n}")
            elif re.search("wins|games|spiele |score", key):
                cells.append(str(m if first else n))
            else:
                cells.append(a if first else b)
        rows.append(sign.join(cells))
    text = "\n".join([header, *rows, ""])
    problems: tuple[str, ...] = ()
    try:
        read(tmp_path, text)
    except DataError as error:
        problems = error.problems
    columns = {}
    for problem in problems:
        assert len(problems) == 1
        proposed = re.search(r'columns "([^"]*)"', problem)
        assert proposed, problem
        columns = dict(part.split("=") for part in proposed[1].split(","))
    assert as_played(read(tmp_path, text, columns=columns).results) == TRUTH


def test_an_apa_score_sheet_states_levels_and_games_to_win(tmp_path):
    header = "Match,Player A,SL A,GTW A,Games A,Player B,SL B,GTW B,Games B,Innings"
    text = f"{header}\n1,Ann Lee,5,4,4,Bo Diaz,3,2,1,18\n2,Cy Ng,4,3,1,Di Roy,4,3,3,22\n"
    file = read(tmp_path, text)
    assert file.results.level_a.tolist() == ["5", "4"]
    assert (file.results.race_a.tolist(), file.results.race_b.tolist()) == ([4, 3], [2, 3])


def test_a_cuescore_like_table_is_never_read_by_its_number_of_the_game(tmp_path):
    """628 games once became 2,165, by a proposal with the number of the game as a score."""
    rows = [
        f"{k + 1};{k % 4 + 1};{a};{b};{m};{n};5;finished"
        for k, (a, b, m, n) in enumerate(TRUTH * 20)
    ]
    text = "\n".join(
        ["Spiel;Tisch;Spieler A;Spieler B;Punkte A;Punkte B;Ausspielziel;Status", *rows]
    )
    with pytest.raises(DataError) as caught:
        read(tmp_path, text)
    assert "Spiel," not in caught.value.problems[0].partition("columns ")[2]
    columns = {"score_a": "Punkte A", "score_b": "Punkte B"}
    file = read(tmp_path, text, columns=columns)
    assert int(file.results.score_a.sum() + file.results.score_b.sum()) == 20 * sum(
        map(sum, SCORES)
    )


def test_an_apa_list_of_players_has_their_skill_levels(tmp_path):
    text = (
        "PlayerId,PlayerName,TeamId,GamesWon,GamesPlayed,TotalPoints,PPM,PA,BreakAndRun,MiniSlams,"
        "NineOnTheSnap,Shutouts,SkillLevel\n"
        '7,"Lee, Ann",1,5,9,88,9.8,.51,0,0,0,1,5\n8,"Diaz, Bo",1,2,9,60,6.7,.38,0,0,0,0,3\n'
    )
    file = read(tmp_path, text, read_roster)
    assert file.roster.players == ("Ann Lee", "Bo Diaz")
    assert file.roster.games.tolist() == [9, 9]
    assert file.roster.level.tolist() == [5, 3]
