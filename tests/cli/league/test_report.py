import csv
import io
import itertools
import json
import os
import signal
import subprocess
import sys
from html import unescape

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from places import ROOT
from rows import posix
from tiers import examples

DEMO = ROOT / "data" / "demo_league.csv"
SEASON = ROOT.parent / "shared" / "data" / "snooker_2016_17_results.csv"
SHORT = "".join(DEMO.read_text(encoding="utf-8").splitlines(keepends=True)[:61])
"""Five nights of the demo league, for what does not depend on how many matches there were."""

FIXED = ("--prior", "30")  # where the choice of a prior, which takes a second, does not matter
FILES = ["matchups.csv", "ratings.csv", "sheet.pdf", "summary.csv"]
MORE_FILES = ["sheet.html", "sheet.xlsx"]
HEADER = "date,player_a,player_b,score_a,score_b\n"
SMALL = HEADER + "2024-09-03,Ann,Bo,7,5\n2024-09-10,Bo,Cy,7,4\n2024-09-17,Ann,Cy,7,2\n"


def rows(folder, name):
    return list(csv.DictReader(io.StringIO((folder / name).read_text(encoding="utf-8"))))


def summary(folder):
    return {row["key"]: row["value"] for row in rows(folder, "summary.csv")}


def content(folder):
    return {path.name: path.read_bytes() for path in folder.iterdir()}


@pytest.fixture(scope="module")
def demo(run, tmp_path_factory):
    """The report of the demo league in all its forms, and the folder where it is."""
    pytest.importorskip("xlsxwriter", reason="writes workbooks")
    folder = tmp_path_factory.mktemp("demo") / "sheet"
    return run("report", str(DEMO), "--out", str(folder), "--page", "--excel"), folder


def test_the_demo_league_gives_its_files_and_a_sheet(demo):
    result, folder = demo
    assert result.exit_code == 0
    assert sorted(path.name for path in folder.iterdir()) == sorted(FILES + MORE_FILES)
    assert "395 matches" in result.stdout
    assert all(len(line) <= 80 for line in result.stdout.splitlines())
    names = "ratings.csv, matchups.csv, summary.csv, sheet.pdf, sheet.html, sheet.xlsx"
    assert result.stderr.splitlines()[-1] == f"Wrote {names} to {folder}"


@pytest.mark.slow
def test_the_same_as_json(run, demo, tmp_path):
    _, folder = demo
    result = run("report", str(DEMO), "--out", str(tmp_path), "--json")
    assert sorted(path.name for path in tmp_path.iterdir()) == FILES
    sheet = json.loads(result.stdout)
    for name in ("ratings", "matchups"):
        written = rows(folder, f"{name}.csv")
        assert [list(row) for row in written] == [list(row) for row in sheet[name]]
        for row, numbers in zip(written, sheet[name], strict=True):
            for key, value in numbers.items():
                shown = (
                    {True: "yes", False: "no"}.get(value, value) if key == "provisional" else value
                )
                assert row[key] == (f"{shown:.6f}" if isinstance(shown, float) else str(shown))
    assert sheet["summary"]["matches_used"] == 395
    assert sheet["left_out"]


def test_the_columns_are_those_of_the_documentation(demo):
    _, folder = demo
    assert list(rows(folder, "ratings.csv")[0]) == (
        [
            "player",
            "rating",
            "standard_error",
            "quasi_error",
            "games",
            "won",
            "lost",
            "component",
            "provisional",
            "scale",
        ]
    )
    assert list(rows(folder, "matchups.csv")[0]) == (
        [
            "player_a",
            "player_b",
            "difference",
            "difference_error",
            "p_game_a",
            "p_game_a_plug_in",
            "race_a",
            "race_b",
            "p_win_a",
            "p_win_a_plug_in",
            "mean_games",
            "games_p90",
            "note",
        ]
    )
    facts = summary(folder)
    assert (facts["matches_read"], facts["matches_used"]) == ("408", "395")
    assert (facts["forfeits_left_out"], facts["empty_left_out"]) == ("11", "2")
    assert "NPL-like scale" in facts["scale"]
    assert "not an official rating" in facts["scale"]
    assert content(folder)["sheet.pdf"].startswith(b"%PDF")


def test_the_true_order_of_the_demo_league_is_found(demo):
    _, folder = demo
    players = [row["player"] for row in rows(folder, "ratings.csv")]
    assert players[0] == "Ines Valbrecht"
    assert set(players[-2:]) == {"Cosmo Dilworthy", "Pia Rautavuori"}


def test_all_players_are_paired_in_the_order_of_their_ratings(demo):
    _, folder = demo
    matchups = rows(folder, "matchups.csv")
    players = [row["player"] for row in rows(folder, "ratings.csv")]
    assert [(row["player_a"], row["player_b"]) for row in matchups] == (
        list(itertools.combinations(players, 2))
    )
    assert len(players) == 24
    assert {row["race_a"] for row in matchups} == {"7"}


def test_the_pairs_of_a_report_are_those_of_matchups_with_its_ratings(run, demo):
    _, folder = demo
    listed = run("matchups", str(folder / "ratings.csv"), "--race-to", "7", "--csv").stdout
    assert list(csv.DictReader(io.StringIO(listed))) == rows(folder, "matchups.csv")


def test_of_a_large_league_those_who_played_most_are_paired(run, tmp_path, monkeypatch):
    monkeypatch.setattr("evenbreak.cli.league.report.MOST_ON_SHEET", 10)
    result = run("report", str(DEMO), *FIXED, "--out", str(tmp_path))
    assert "--top" in result.stderr
    folder = tmp_path
    matchups = rows(folder, "matchups.csv")
    assert len(matchups) == 45
    paired = {row[side] for row in matchups for side in ("player_a", "player_b")}
    games = {row["player"]: int(row["games"]) for row in rows(folder, "ratings.csv")}
    assert len(paired) == 10
    assert min(games[name] for name in paired) >= max(
        count for name, count in games.items() if name not in paired
    )
    assert {row["race_a"] for row in matchups} == {"7"}


@pytest.mark.slow
def test_the_same_input_gives_the_same_bytes(demo, tmp_path):
    result, folder = demo
    words = ("report", str(DEMO), "--out", str(tmp_path), "--page", "--excel")
    again = subprocess.run(
        [sys.executable, "-m", "evenbreak", *words],
        env={**os.environ, "PYTHONHASHSEED": "1"},
        capture_output=True,
        check=True,
    )
    assert again.stdout.decode() == result.stdout
    assert content(tmp_path) == content(folder)


@pytest.mark.slow
def test_the_scale_only_rescales(run, demo, tmp_path):
    _, npl = demo
    result = run("report", str(DEMO), "--out", str(tmp_path), "--scale", "fargo")
    assert "Fargo-like" in result.stdout
    for one, other in zip(rows(npl, "matchups.csv"), rows(tmp_path, "matchups.csv"), strict=True):
        for name in ("player_a", "race_a", "race_b", "games_p90", "note"):
            assert other[name] == one[name]
        assert float(other["p_win_a"]) == pytest.approx(float(one["p_win_a"]), abs=2e-6)
    for one, other in zip(rows(npl, "ratings.csv"), rows(tmp_path, "ratings.csv"), strict=True):
        rescaled = 500 + (float(one["rating"]) - 80) * 100 / 30
        assert float(other["rating"]) == pytest.approx(rescaled, abs=1e-5)
        assert float(other["standard_error"]) == pytest.approx(
            float(one["standard_error"]) * 100 / 30, abs=1e-5
        )


def test_races_may_be_limited_in_length(run, tmp_path):
    result = run(
        *("report", "-", *FIXED, "--out", str(tmp_path), "--games", "5..9", "--top", "6"),
        stdin=SHORT,
    )
    assert result.exit_code == 0
    longest = {int(r["race_a"]) + int(r["race_b"]) - 1 for r in rows(tmp_path, "matchups.csv")}
    assert longest <= set(range(5, 10))
    assert (summary(tmp_path)["games_lo"], summary(tmp_path)["race_to"]) == ("5", "")


def test_players_may_be_named(run, tmp_path):
    result = run(
        *("report", "-", *FIXED, "--out", str(tmp_path), "--race-to", "9"),
        *("--players", "zoë kestleman, Finn O'Garrow", "--players", "Ines Valbrecht"),
        stdin=SHORT,
    )
    assert result.exit_code == 0
    pairs = {(row["player_a"], row["player_b"]) for row in rows(tmp_path, "matchups.csv")}
    named = ["Ines Valbrecht", "Finn O'Garrow", "Zoë Kestleman"]
    assert len(pairs) == 3
    assert {*map(frozenset, pairs)} == {*map(frozenset, itertools.combinations(named, 2))}


def test_a_name_with_a_comma_may_be_named_alone(run, tmp_path):
    season = HEADER + '2024-09-03,"Lee, Ann",Bo,7,5\n2024-09-10,Bo,Cy,7,5\n'
    result = run(
        *("report", "-", "--out", str(tmp_path), "--players", "Lee, Ann", "--players", "Cy"),
        stdin=season,
    )
    assert result.exit_code == 0
    assert [row["player_a"] for row in rows(tmp_path, "matchups.csv")] == ["Lee, Ann"]


def test_excel_gets_its_marks(run, tmp_path):
    words = ("--out", str(tmp_path), "--excel-csv", "--top", "6")
    assert run("report", "-", *FIXED, *words, stdin=SHORT).exit_code == 0
    for name, body in content(tmp_path).items():
        if name == "sheet.pdf":
            assert body.startswith(b"%PDF")
            continue
        assert body.startswith(b"\xef\xbb\xbf")
        assert body.count(b"\r\n") == body.count(b"\n") > 10


def test_aliases_mend_names_and_the_page_keeps_their_folder_to_itself(run, tmp_path):
    aliases = tmp_path / "private" / "aliases.csv"
    aliases.parent.mkdir()
    aliases.write_text("name,means\nAnnie,Ann\n", encoding="utf-8")
    season = SMALL + "2024-09-24,Annie,Bo,7,5\n"
    out = tmp_path / "sheet"
    words = ("report", "-", "--out", str(out), "--aliases", str(aliases), "--page")
    result = run(*words, stdin=season)
    assert result.exit_code == 0
    assert f"{aliases}: 'Annie' as 'Ann'" in result.stderr
    assert {row["player"] for row in rows(out, "ratings.csv")} == {"Ann", "Bo", "Cy"}
    page = content(out)["sheet.html"].decode()
    assert "aliases.csv: 'Annie' as 'Ann'" in unescape(page)
    assert "private" not in page


def test_without_xlsxwriter_a_workbook_is_refused_before_any_work(run, tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, "xlsxwriter", None)
    result = run("report", "-", "--out", str(tmp_path / "sheet"), "--excel", stdin=SMALL)
    assert result.exit_code == 2
    assert "pip install XlsxWriter" in result.stderr
    assert not (tmp_path / "sheet").exists()


def test_how_it_was_rated_is_said_on_the_sheet_the_page_and_in_the_summary(run, tmp_path):
    words = ("--prior", "15", "--half-life", "90", "--as-of", "10.9.2024", "--page")
    result = run("report", "-", "--out", str(tmp_path), *words, stdin=SMALL)
    assert result.exit_code == 0
    sheet = " ".join(result.stdout.split())
    page = (tmp_path / "sheet.html").read_text(encoding="utf-8")
    for text in (sheet, page):
        assert "80 ± 15" in text
        assert "half after 90 days, as of 2024-09-10" in text
        assert "2024-09-03 to 2024-09-10" in text
        assert "1 later match" in text
    facts = summary(tmp_path)
    assert float(facts["prior_sd_points"]) == pytest.approx(15)
    assert (float(facts["half_life_days"]), facts["as_of"]) == (90, "2024-09-10")
    assert (facts["matches_used"], facts["later_left_out"]) == ("2", "1")
    assert facts["last_date"] == "2024-09-10"


def test_the_ratings_of_a_report_are_those_of_rate(run, tmp_path):
    words = ("--prior", "best", "--half-life", "180", "--as-of", "2024-10-01")
    result = run("report", "-", "--out", str(tmp_path), *words, "--top", "6", stdin=SHORT)
    assert "of 12 values tried" in " ".join(result.stdout.split())
    listed = list(csv.DictReader(io.StringIO(run("rate", "-", *words, stdin=SHORT).stdout)))
    columns = ("player", "rating", "standard_error")
    assert [[row[name] for name in columns] for row in listed] == (
        [[row[name] for name in columns] for row in rows(tmp_path, "ratings.csv")]
    )


@pytest.mark.parametrize(
    ("words", "code", "remedy"),
    [
        (["--prior", "0"], 2, "--prior is 0"),
        (["--prior", "1e9"], 2, "--prior"),
        (["--half-life", "0"], 2, "'0'"),
        (["--as-of", "yesterday"], 2, "'yesterday'"),
        (["--as-of", "2020-01-01"], 3, "--as-of"),
        (["--players", "Ann,Boo"], 2, "'Boo'"),
    ],
)
def test_wrong_words_on_how_to_rate_write_nothing(run, tmp_path, words, code, remedy):
    result = run("report", "-", "--out", str(tmp_path / "sheet"), *words, stdin=SMALL)
    assert (result.exit_code, result.stdout) == (code, "")
    assert remedy in result.stderr
    assert not (tmp_path / "sheet").exists()


def test_warnings_go_to_stderr(run, tmp_path):
    season = SMALL + "2024-09-24,Zoë,Bo,7,5\n2024-09-24,Zoe,Bo,7,5\n"
    result = run("report", "-", "--out", str(tmp_path), stdin=season.replace("date", "when"))
    assert result.exit_code == 0
    unused, alike = [line for line in result.stderr.splitlines() if line.startswith("Warning: ")]
    assert "'when'" in unused
    assert "'Zoe' and 'Zoë'" in alike
    assert "Warning" not in result.stdout
    assert summary(tmp_path)["groups_of_similar_names"] == "1"


@pytest.mark.parametrize(
    "words",
    [
        ("--nope",),
        ("--scale", "furlong"),
        ("--scale", "0"),
        ("--games", "9..5"),
        ("--games", "five"),
        ("--race-to", "0"),
        ("--games", "5..9", "--race-to", "5"),
        ("--top", "1"),
        ("--top", "1001"),
        ("--top", "5", "--players", "Ann,Bo"),
        ("--players", "Ann"),
        ("--players", "Ann,Nobody"),
        ("--players", ""),
    ],
)
def test_wrong_usage_ends_with_2_and_writes_nothing(run, tmp_path, words):
    result = run("report", "-", "--out", str(tmp_path / "sheet"), *words, stdin=SMALL)
    assert result.exit_code == 2
    assert "Error: " in result.stderr
    assert result.stdout == ""
    assert not (tmp_path / "sheet").exists()


def test_out_is_sheet_and_must_not_be_a_file(run, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert run("report", "-", stdin=SMALL).exit_code == 0
    assert (tmp_path / "sheet" / "sheet.pdf").exists()
    (tmp_path / "file").write_text("")
    assert run("report", str(DEMO), "--out", str(tmp_path / "file")).exit_code == 2


@pytest.mark.parametrize(
    ("season", "begins"),
    [
        ("", "stdin: "),
        (HEADER, "stdin: "),
        ("player_a,player_b,score_a\nAnn,Bo,7\n", "stdin:1: "),
        (HEADER + "2024-09-03,Ann,Bo,seven,5\n", "stdin:2: score_a 'seven'"),
        (HEADER + "2024-09-03,Ann,Bo,NaN,5\n", "stdin:2: score_a 'NaN'"),
        (HEADER + "2024-09-03,Ann,Bo,-7,5\n", "stdin:2: score_a '-7'"),
        (HEADER + "2024-09-03,Ann,Ann,7,5\n", "stdin:2: 'Ann'"),
        (HEADER + "2024-09-03,Ann,Bo,0,0\n", "stdin: "),
        (b"\x89PNG\r\n\x1a\n\0\0", "stdin: is a picture. "),
        (b"PK\x03\x04", "stdin: "),
    ],
)
def test_bad_data_ends_with_3_and_leaves_the_old_sheet(run, tmp_path, season, begins):
    (tmp_path / "ratings.csv").write_bytes(b"old")
    result = run("report", "-", "--out", str(tmp_path), stdin=season)
    assert result.exit_code == 3
    errors = [line for line in result.stderr.splitlines() if line.startswith("Error: ")]
    assert len(errors) == 1
    assert errors[0].startswith(f"Error: {begins}")
    assert result.stdout == ""
    assert content(tmp_path) == {"ratings.csv": b"old"}


@given(st.binary(max_size=100), st.booleans())
@settings(max_examples=examples(25))
def test_any_bytes_end_with_0_or_3(run, tmp_path_factory, junk, below_a_header):
    season = SMALL.encode() + junk if below_a_header else junk
    folder = tmp_path_factory.getbasetemp() / "any_report"
    result = run("report", "-", "--out", str(folder), stdin=season)
    assert result.exit_code in (0, 3)
    assert (result.exit_code == 0) == (result.stdout != "")


def test_of_many_problems_the_first_twenty_are_shown(run, tmp_path):
    season = HEADER + "2024-09-03,Ann,Bo,x,5\n" * 50 + "2024-09-03,Ann,Bo,7,5\n"
    result = run("report", "-", "--out", str(tmp_path / "sheet"), stdin=season)
    errors = [line for line in result.stderr.splitlines() if line.startswith("Error: ")]
    assert errors[0].startswith("Error: stdin:2: ")
    assert errors[19].startswith("Error: stdin:21: ")
    assert errors[20:] == ["Error: and 30 more problems"]


def test_a_missing_file_ends_with_3(run, tmp_path):
    result = run("report", "nowhere.csv", "--out", str(tmp_path / "sheet"))
    assert result.exit_code == 3
    assert "nowhere.csv: " in result.stderr


def test_a_place_that_cannot_be_written_ends_with_1_and_is_named(run, tmp_path):
    (tmp_path / "file").write_bytes(b"mine")
    result = run("report", "-", "--out", str(tmp_path / "file" / "sheet"), stdin=SMALL)
    assert result.exit_code == 1
    assert result.stderr.splitlines()[-1].startswith(f"Error: {tmp_path / 'file' / 'sheet'}: ")
    assert content(tmp_path) == {"file": b"mine"}


def test_players_who_cannot_be_compared_get_no_race(run, tmp_path):
    season = SMALL + "2024-09-24,Di,Ed,7,5\n"
    result = run("report", "-", "--out", str(tmp_path), stdin=season)
    assert "2 groups" in result.stdout
    matchups = rows(tmp_path, "matchups.csv")
    apart = [row for row in matchups if row["note"]]
    assert len(apart) == 6
    assert all(row["race_a"] == row["p_win_a"] == "" for row in apart)
    assert summary(tmp_path)["components"] == "2"
    assert summary(tmp_path)["pairs_without_race"] == "6"


def test_names_that_look_like_formulas_are_written_safely(run, tmp_path):
    season = HEADER + "2024-09-03,=HYPERLINK(1),@Bo,7,5\n"
    assert run("report", "-", "--out", str(tmp_path), stdin=season).exit_code == 0
    assert [row["player"] for row in rows(tmp_path, "ratings.csv")] == ["'=HYPERLINK(1)", "'@Bo"]


@pytest.mark.thorough
@pytest.mark.skipif(not SEASON.exists(), reason="the real season lies beside a checkout only")
def test_the_real_season(run, tmp_path):
    result = run("report", str(SEASON), "--out", str(tmp_path), "--scale", "fargo", "--top", "8")
    assert result.exit_code == 0
    facts = summary(tmp_path)
    assert (facts["matches_used"], facts["forfeits_left_out"]) == ("2412", "49")
    assert (facts["first_date"], facts["last_date"]) == ("2016-05-28", "2017-04-30")
    assert "'Mark Davies' and 'Mark Davis' may be the same player" in result.stderr
    best = [row["player"] for row in rows(tmp_path, "ratings.csv")[:5]]
    assert best[0] == "Mark Selby"


SLOW_REPORT = """
import sys, time
from pathlib import Path
from evenbreak.cli.program import program
replace = Path.replace
def slow(self, target):
    print("replacing", flush=True)
    time.sleep(0.1)
    return replace(self, target)
Path.replace = slow
program(["report", sys.argv[1], "--out", sys.argv[2]])
"""


def test_an_empty_folder_name_is_not_this_folder(run, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    result = run("report", str(DEMO), "--out", "")
    assert result.exit_code == 2
    assert "--out" in result.stderr
    assert list(tmp_path.iterdir()) == []


@pytest.mark.slow
@posix
@pytest.mark.parametrize(("ending", "code"), [("SIGINT", 130), ("SIGTERM", -signal.SIGTERM)])
def test_an_end_while_files_take_their_places_leaves_the_new_ones(run, tmp_path, ending, code):
    season, old, new = tmp_path / "season.csv", tmp_path / "old", tmp_path / "new"
    season.write_text(SMALL, encoding="utf-8")
    assert run("report", str(season), "--out", str(new)).exit_code == 0
    old.mkdir()
    for name in FILES:
        (old / name).write_bytes(b"old")
    with subprocess.Popen(
        [sys.executable, "-c", SLOW_REPORT, str(season), str(old)],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
    ) as process:
        assert process.stdout is not None
        assert process.stderr is not None
        assert process.stdout.readline() == b"replacing\n"
        process.send_signal(getattr(signal, ending))
        try:
            assert process.wait(timeout=30) == code
        finally:
            process.kill()
        assert b"Traceback" not in process.stderr.read()
    assert content(old) == content(new)


@pytest.mark.slow
@pytest.mark.parametrize("name", ["ratings.csv", "matchups.csv", "summary.csv"])
def test_the_results_are_never_overwritten(run, tmp_path, name):
    season = tmp_path / name
    season.write_bytes(SHORT.encode())
    result = run("report", str(season), *FIXED, "--out", str(tmp_path))
    assert result.exit_code == 2
    assert name in result.stderr
    assert [file.name for file in tmp_path.iterdir()] == [name]
    assert season.read_bytes() == SHORT.encode()


def test_a_page_never_takes_the_place_of_what_was_read(run, tmp_path):
    season = tmp_path / "season.html"
    season.write_bytes(SHORT.encode())
    assert run("rate", str(season), "--html", str(season)).exit_code == 2
    assert season.read_bytes() == SHORT.encode()
    other = str(tmp_path / "page.html")
    for _ in range(2):  # a page of last time may be written over
        assert run("rate", str(season), "--html", other).exit_code == 0


@pytest.mark.slow
def test_entrants_are_paired_and_strangers_start_at_the_mean(run, tmp_path):
    entrants = tmp_path / "entrants.txt"
    entrants.write_text("zoë kestleman\nA Stranger\nInes Valbrecht\n", encoding="utf-8")
    result = run(
        "report", str(DEMO), *FIXED, "--out", str(tmp_path / "o"), "--players-file", str(entrants)
    )
    pairs = [(row["player_a"], row["player_b"]) for row in rows(tmp_path / "o", "matchups.csv")]
    assert pairs == [
        ("Ines Valbrecht", "Zoë Kestleman"),
        ("Ines Valbrecht", "A Stranger"),
        ("Zoë Kestleman", "A Stranger"),
    ]
    (new,) = [row for row in rows(tmp_path / "o", "ratings.csv") if row["player"] == "A Stranger"]
    assert (float(new["rating"]), new["games"]) == (80, "0")
    prior = float(summary(tmp_path / "o")["prior_sd_points"])
    assert float(new["quasi_error"]) == pytest.approx(prior, rel=1e-4)
    assert "'A Stranger'" in result.stderr
    words = ("--players-file", str(entrants), "--page")
    assert run("report", str(DEMO), *FIXED, "--out", str(tmp_path / "q"), *words).exit_code == 0
    page = (tmp_path / "q" / "sheet.html").read_text(encoding="utf-8")
    assert "entrants.txt:2" in page
    assert str(tmp_path) not in page
    assert str(DEMO) not in page
    both = ("--players-file", str(entrants), "--top", "3")
    assert run("report", str(DEMO), *FIXED, "--out", str(tmp_path / "p"), *both).exit_code == 2


@pytest.mark.parametrize("words", [("--page", "page.html"), ("--excel", "page.xlsx")])
def test_a_name_after_an_option_without_one_gets_a_hint(run, tmp_path, words):
    result = run("report", "-", *words, "--out", str(tmp_path / "sheet"), stdin=SMALL)
    assert result.exit_code == 2
    assert f"{words[0]} takes no name" in result.stderr


@pytest.mark.slow
def test_a_prior_from_too_few_results_is_doubted(run, tmp_path):
    result = run("report", "-", "--out", str(tmp_path), "--prior", "best", stdin=SMALL)
    assert "aren't enough" in result.stderr
    result = run("report", str(DEMO), "--out", str(tmp_path), "--prior", "best")
    assert "Warning" not in result.stderr
