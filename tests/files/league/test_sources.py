"""The results of a league out of files that overlap, against the matches that were played."""

import json

import numpy as np
import pytest

from evenbreak.files.league.league_file import read_league
from evenbreak.files.league.sources import league_results
from evenbreak.files.results.seasons import read_seasons
from tries import tries

PLAYERS = ["Ann Lee", "Bo Diaz", "Cy Ng", "Di Żak", "Ed O'Neil", "Flo Roy", "Gus Poe", "Hal Kim"]


def league_of(folder, files, *, more="", columns=None):
    lines = ['name = "Test"']
    for name, text in files.items():
        (folder / name).write_text(text, encoding="utf-8")
        lines += ["[[results]]", f'file = "{name}"']
        lines += [f"columns = {{ {columns[name]} }}"] if columns and name in columns else []
    (folder / "league.toml").write_text("\n".join([*lines, more]), encoding="utf-8")
    return read_league(folder)


def matches_of(results):
    """Return each match by day, with its two players and their scores in whatever order."""
    rows = zip(
        results.date.astype(str).tolist(),
        *(getattr(results, f"player_{side}").tolist() for side in "ab"),
        *(getattr(results, f"score_{side}").tolist() for side in "ab"),
        strict=True,
    )
    name = results.players
    return sorted((day, *sorted([(name[a], m), (name[b], n)])) for day, a, b, m, n in rows)


def season(rng, many):
    """Return matches as played: day, two players, scores; some pairs meet twice a day."""
    found = []
    for k in range(many):
        a, b = rng.choice(len(PLAYERS), 2, replace=False)
        score = [5, int(rng.integers(0, 5))][:: rng.choice([1, -1])]
        found.append((f"2024-09-{1 + k // 4:02}", PLAYERS[a], PLAYERS[b], *score))
    return found


def as_csv(matches, rng):
    rows = [
        f"{day[8:]}.{day[5:7]}.{day[:4]};"
        + (f"{a};{b};{m}:{n}" if rng.random() < 0.5 else f"{b};{a};{n}:{m}")
        for day, a, b, m, n in matches
    ]
    return "\n".join(["Datum;Heim;Gast;Ergebnis", *rows, "1.9.2024;Ann Lee;spielfrei;", ""])


def as_last_first(matches):
    def turned(name):
        first, last = name.split(" ", 1)
        return f'"{last}, {first}"'

    rows = [f"{day},{turned(a)},{turned(b)},{m},{n},7" for day, a, b, m, n in matches]
    return "\n".join(["played on,Home Player,Away Player,Games A,Games B,Table", *rows, ""])


def as_records_from_both_sides(matches):
    def record(day, a, b, m, n):
        players = {"homePlayer": {"name": a}, "awayPlayer": {"name": b}}
        return {"date": day, **players, "homeScore": m, "awayScore": n, "forfeit": False}

    both = [
        one
        for day, a, b, m, n in matches
        for one in (record(day, a, b, m, n), record(day, b, a, n, m))
    ]
    return json.dumps(both)


@pytest.mark.slow_after(2)
@pytest.mark.parametrize("seed", range(tries("sources", 12)))
def test_every_match_counts_once_whichever_files_have_it(tmp_path, seed):
    rng = np.random.default_rng(seed)
    played = season(rng, int(rng.integers(12, 60)))
    in_file = rng.random((3, len(played))) < 0.5
    in_file[rng.integers(3, size=len(played)), np.arange(len(played))] = True
    parts = [[match for match, here in zip(played, row, strict=True) if here] for row in in_file]
    # Two alike on one day are two matches; whichever file has one of them has the other.
    parts = [[match for match in played if match in part] for part in parts]
    league = league_of(
        tmp_path,
        {
            "a.csv": as_csv(parts[0], rng),
            "b.csv": as_last_first(parts[1]),
            "c.json": as_records_from_both_sides(parts[2]),
        },
    )
    found = league_results(league)
    truth = sorted((day, *sorted([(a, m), (b, n)])) for day, a, b, m, n in played)
    assert matches_of(found.results) == truth
    kinds = [change.kind for change in found.changes]
    assert kinds.count("double") == sum(map(len, parts)) + len(parts[2]) - len(played)
    assert kinds.count("left out") == 1
    assert found.name_doubts == ()
    assert matches_of(read_seasons([league.path]).results) == truth


def test_the_first_of_two_files_takes_what_only_the_other_states_from_its_own_side(tmp_path):
    league = league_of(
        tmp_path,
        {
            "a.csv": "date,home,away,score\n2024-09-03,Ann,Bo,7-5\n2024-09-04,Ann,Bo,2-7\n",
            "b.csv": "date,home,away,score,race_a,race_b,racks,team_a,first_break\n"
            "2024-09-03,Bo,Ann,5-7,6,7,aaaaabbbbbbb,Cues,a\n",
        },
    )
    results = league_results(league).results
    assert (results.race_a.tolist(), results.race_b.tolist()) == ([7, 0], [6, 0])
    assert results.racks[0] == "bbbbbaaaaaaa"
    assert (results.team_a[0], results.team_b[0], results.first_break[0]) == ("", "Cues", 2)


def test_what_is_doubtful_is_left_apart_and_listed_with_its_place(tmp_path):
    league = league_of(
        tmp_path,
        {
            "a.csv": "date,home,away,score\n2024-09-03,Big Al Peterson,Bo,7-5\n"
            "2024-09-04,Lisa Müller,Bo,7-1\n2024-09-05,Cy,Bo,7-2\n",
            "b.csv": 'date,home,away,score\n2024-09-03,Bo,"""Big Al"" Peterson",6-7\n'
            "2024-09-04,Lisa Mueller-Stone,Bo,x\n2024-09-05,Bo,Cy,3-7\n"
            ",Cy,Bo,7-2\n2024-09-06,Lisa Mueller-Stone,Bo,7-3\n",
        },
    )
    found = league_results(league)
    assert len(found.results) == 7
    told = [(change.kind, change.source, change.line) for change in found.changes]
    assert told == [("left out", "b.csv", 3), ("doubt", "b.csv", 4), ("doubt", "b.csv", 5)]
    doubts = [set(doubt.names) for doubt in found.name_doubts]
    assert {"Big Al Peterson", '"Big Al" Peterson'} in doubts
    assert {"Lisa Müller", "Lisa Mueller-Stone"} in doubts


def test_the_lines_of_a_doubt_settle_it_either_way(tmp_path):
    files = {
        "a.csv": "home,away,score\nBig Al Peterson,Bo,7-5\nLisa Müller,Bo,7-1\n"
        "Bo,Lisa Müller,7-1\n",
        "b.csv": 'home,away,score\n"""Big Al"" Peterson",Bo,7-6\nLisa Mueller-Stone,Bo,7-4\n',
    }
    doubts = league_results(league_of(tmp_path, files)).name_doubts
    assert len(doubts) == 2
    lines = [line for doubt in doubts for line in doubt.alias_lines()]
    settled = league_results(league_of(tmp_path, files, more="\n".join(["[aliases]", *lines])))
    assert settled.name_doubts == ()
    assert len(settled.results.players) == 3
    apart = ["[aliases]", *(f"'{name}' = '{name}'" for doubt in doubts for name in doubt.names)]
    kept = league_results(league_of(tmp_path, files, more="\n".join(apart)))
    assert kept.name_doubts == ()
    assert len(kept.results.players) == 5


def test_each_file_has_titles_of_its_own(tmp_path):
    league = league_of(
        tmp_path,
        {
            "a.csv": "X;Y;P;Q\nAnn;Bo;7;5\n",
            "b.csv": "Y;X;P;Q\nAnn;Bo;7;6\n",
        },
        columns={
            "a.csv": 'player_a = "X", player_b = "Y", score_a = "P", score_b = "Q"',
            "b.csv": 'player_a = "Y", player_b = "X", score_a = "P", score_b = "Q"',
        },
    )
    results = league_results(league).results
    assert [results.players[k] for k in results.player_a] == ["Ann", "Ann"]
