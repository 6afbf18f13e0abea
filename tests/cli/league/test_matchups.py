import csv
import io
import json

import pytest
from hypothesis import given
from hypothesis import strategies as st

from evenbreak.cli.league import matchups as module
from evenbreak.cli.program import program
from evenbreak.handicaps.charts.given_ratings import win_given_ratings
from evenbreak.matches.evening import Length, evening
from evenbreak.matches.races import race_law
from places import DATA

CLUB = "player,rating\nAnn,92\nBo,71\nCy,80\nDi,60\n"
SURE = ("--race-to", "7")
COLUMNS = [
    *("player_a", "player_b", "difference", "difference_error", "p_game_a", "p_game_a_plug_in"),
    *("chart_race_a", "chart_race_b", "chart_p_win_a", "chart_p_win_a_plug_in"),
    *("chart_unfairness", "chart_mean_games", "chart_games_p90"),
    *("race_a", "race_b", "p_win_a", "p_win_a_plug_in", "mean_games", "games_p90", "note"),
]


@pytest.fixture
def roster(tmp_path):
    def write(text=CLUB, name="roster.csv"):
        path = tmp_path / name
        path.write_text(text, encoding="utf-8")
        return str(path)

    return write


def table(result):
    assert result.exit_code == 0, result.stderr
    return list(csv.DictReader(io.StringIO(result.stdout)))


def answer(run, *words):
    result = run("matchups", *words, "--json")
    assert result.exit_code == 0, result.stderr
    return json.loads(result.stdout)


@pytest.fixture
def terminal(monkeypatch, run):
    """Run a command as if a person read its output."""
    monkeypatch.setattr(module, "to_terminal", lambda: True)
    return run


def test_all_pairs_as_csv(run, roster):
    result = run("matchups", roster(), "--chart", "npl_10", *SURE)
    rows = table(result)
    assert [(row["player_a"], row["player_b"]) for row in rows] == [
        ("Ann", "Cy"), ("Ann", "Bo"), ("Ann", "Di"), ("Cy", "Bo"), ("Cy", "Di"), ("Bo", "Di"),
    ]  # fmt: skip
    assert list(rows[0]) == COLUMNS
    assert (rows[1]["chart_race_a"], rows[1]["chart_race_b"]) == ("6", "4")
    assert rows[1]["difference_error"] == ""
    assert "npl scale (30 points double the odds)" in result.stderr


def test_pairs_in_the_order_of_the_list(run, roster):
    pairs = roster("a,b\ndi,Ann\nBo,Cy\n", "tonight.csv")
    rows = table(run("matchups", roster(), *SURE, "--pairs", pairs))
    assert [(row["player_a"], row["player_b"]) for row in rows] == [("Di", "Ann"), ("Bo", "Cy")]


def test_many_pairs_are_written_in_parts(run, roster, monkeypatch):
    whole = run("matchups", roster(), *SURE).stdout
    monkeypatch.setattr(module, "AT_A_TIME", 4)
    assert run("matchups", roster(), *SURE).stdout == whole


def test_chances_are_averaged_over_the_errors(run, roster):
    path = roster("player,rating,standard_error,games\nAnn,92,9,140\nBo,71,12,60\n")
    (row,) = answer(run, path, "--race-to", "7")["pairs"]
    assert row["difference_error"] == 15.0
    assert row["p_win_a"] == win_given_ratings(21.0, 15.0, row["race_a"], row["race_b"])
    assert row["p_win_a_plug_in"] == win_given_ratings(21.0, 0.0, row["race_a"], row["race_b"])


def test_new_players_start_with_a_stated_prior(run, roster):
    path = roster("player,rating,games\nAnn,92,140\nBo,,0\nCy,85,0\n")
    result = run("matchups", path, *SURE, "--json")
    rows = json.loads(result.stdout)["pairs"]
    assert [(row["difference"], row["difference_error"]) for row in rows] == [
        (7.0, 30.0), (12.0, 30.0), (5.0, pytest.approx(30.0 * 2**0.5)),
    ]  # fmt: skip
    assert result.stderr.splitlines() == [
        "No rating yet, taken as 80 ± 30: Bo",
        "No games yet, rating taken as right to ± 30: Cy",
        "No standard_error, rating taken as exact: Ann",
    ]
    rows = answer(run, path, *SURE, "--starter", "92", "--starter-sd", "20")["pairs"]
    assert (rows[0]["difference"], rows[0]["difference_error"]) == (0.0, 20.0)


def test_the_scale_is_that_of_the_chart(run, roster):
    path = roster("player,rating\nAnn,612\nBo,521\n")
    (row,) = answer(run, path, "--chart", "fargo_r6_hot")["pairs"]
    assert row["p_game_a"] == pytest.approx(1 / (1 + 2**-0.91))
    (row,) = answer(run, path, "--chart", "fargo_r6_hot", "--scale", "200")["pairs"]
    assert row["p_game_a"] == pytest.approx(1 / (1 + 2**-0.455))


def test_ratings_of_another_scale_are_doubted(run, roster):
    path = roster("player,rating,games\nAnn,712,900\nBo,421,88\nCy,,0\n")
    chart = roster("from,to,stronger,weaker\n0,50,5,5\n51,,6,4\n", "ours.csv")
    note = "Note: most npl ratings are from 20 to 130; for fargo ratings add --scale fargo"
    for races in (SURE, ("--chart", chart)):
        assert note in run("matchups", path, *races, "--starter", "500").stderr
        said = run("matchups", path, *races, "--scale", "fargo").stderr
        assert not any(word in said for word in ("Note", "Warning"))
    assert "Note" not in run("matchups", roster(), *SURE).stderr
    low = run("matchups", roster(), "--chart", "fargo_r6_hot").stderr
    assert "for npl ratings add --scale npl" in low


def test_one_slip_makes_no_other_scale(run, roster):
    path = roster("player,rating\nAnn,92\nBo,710\nCy,80\n")
    said = run("matchups", path, *SURE).stderr
    assert "double 21 times on the npl scale" in said
    assert "Note" not in said


def test_ratings_without_errors_are_taken_as_exact_and_that_is_said(run, roster):
    path = roster("player,rating,games\nAnn,92,5\nBo,71,900\nCy,80,19\nDi,60,20\n")
    result = run("matchups", path, *SURE)
    assert result.stderr.splitlines()[:2] == [
        "Nobody's standard_error is stated: all ratings are taken as exact",
        "Fewer than 20 games, rating taken as exact all the same: Ann, Cy",
    ]
    assert all(row["p_win_a"] == row["p_win_a_plug_in"] for row in table(result))
    stated = roster("player,rating,standard_error,games\nAnn,92,30,5\nBo,71,4,900\n")
    assert "exact" not in run("matchups", stated, *SURE).stderr


@pytest.mark.parametrize(("scale", "doubted"), [("fargo", True), ("elo", True), ("npl", False)])
def test_a_middle_far_from_all_ratings_is_no_starter(run, roster, scale, doubted):
    path = roster("player,rating,games\nAnn,92,140\nBo,,0\n")
    words = (path, *SURE, "--scale", scale)
    warning = f"is the middle of the {scale} scale, and the ratings here go from 92 to 92"
    assert (warning in run("matchups", *words).stderr) == doubted
    assert "is the middle" not in run("matchups", *words, "--starter", "80").stderr


def test_levels_need_a_scale(run, roster):
    path = roster("player,skill level\nAnn,5\nBo,3\n")
    result = run("matchups", path, "--chart", "apa_8ball")
    assert result.exit_code == 2
    assert "such as --scale 2" in result.stderr
    (row,) = answer(run, path, "--chart", "apa_8ball", "--scale", "2")["pairs"]
    assert (row["chart_race_a"], row["chart_race_b"]) == (4, 2)
    result = run("matchups", roster(), "--chart", "apa_8ball", "--scale", "2")
    assert (result.exit_code, result.stdout) == (3, "")
    assert "roster.csv:2: rating 92 of 'Ann' is no level" in result.stderr


def test_the_evening(run, roster):
    pairs = roster("a,b\nAnn,Bo\nCy,Di\n", "tonight.csv")
    words = (roster(), "--chart", "npl_10", "--pairs", pairs, "--minutes-per-game", "8")
    found = answer(run, *words, "--tables", "2")
    (end,) = found["evening"]
    laws = [
        race_law(row["chart_race_a"], row["chart_race_b"], row["p_game_a"])
        for row in found["pairs"]
    ]
    exact = evening([Length(law.games, law.probability) for law in laws], tables=2)
    assert end["mean_minutes"] == pytest.approx(8.0 * exact.mean)
    assert end["minutes_p90"] == 8.0 * exact.p90
    assert (end["exact"], end["matches"], end["tables"]) == (True, 2, 2)
    result = run("matchups", *words, "--tables", "2")
    assert "By the chart, 2 matches on 2 tables take" in result.stderr
    assert len(table(result)) == 2


def test_an_evening_that_is_played_out_says_so(run, roster):
    words = (roster(), *SURE, "--minutes-per-game", "8", "--tables", "2")
    (end,) = answer(run, *words)["evening"]
    assert not end["exact"]
    assert 0.0 < end["mean_minutes_error"] < 1.0
    assert answer(run, *words)["evening"] == [end]
    assert answer(run, *words, "--seed", "1")["evening"] != [end]
    assert end["minutes_p90"] % 8.0 == 0.0
    said = run("matchups", *words).stderr
    assert "by 50,000 evenings\nplayed out (standard error of the average 0.0" in said


def test_on_a_terminal(terminal, roster):
    path = roster("player,rating,standard_error,games\nAnn,92,9,140\nBo,71,12,60\nCy,,,0\n")
    text = terminal("matchups", path, "--chart", "npl_10").stdout
    assert "Chart npl_10, on the npl scale (30 points double the odds)" in text
    assert "  as if         9 of 10\n" in text
    assert "chart  A wins    sure  games   within\n" in text
    assert "The chart is least fair to " in text
    both = terminal(
        "matchups", path, "--chart", "npl_10", *SURE, "--minutes-per-game", "8", "--tables", "1"
    ).stdout
    assert "chart               fair\n" in both
    assert "race  A wins  min  race  A wins  min\n" in both
    assert "By the chart, 3 matches on 1 table take" in both
    assert "In the fairest races, 3 matches on 1 table take" in both
    assert max(map(len, (text + both).splitlines())) <= 80


def test_a_terminal_is_told_of_pairs_without_a_race(terminal, roster):
    path = roster("player,rating,component\nAnn,92,1\nBo,71,1\nCy,80,2\n")
    text = terminal("matchups", path, *SURE).stdout
    assert "Ann (A), Cy (B): no race: no chain of opponents links the two" in text


def test_names_do_no_harm(terminal, roster):
    path = roster('player,rating\n"=cmd()",92\n"Lee, ""Ann""\nB",71\n"שרה\u202e🎱",60\n')
    text = terminal("matchups", path, *SURE).stdout
    assert "\u202e" not in text
    assert 'Lee, "Ann" B' in text


def test_names_in_csv_are_defused(run, roster):
    path = roster('player,rating\n"=cmd()",92\n"Lee, ""Ann""",71\n')
    (row,) = table(run("matchups", path, *SURE))
    assert (row["player_a"], row["player_b"]) == ("'=cmd()", 'Lee, "Ann"')


def test_too_many_pairs_are_refused_with_advice(run, roster):
    path = roster("player,rating\n" + "".join(f"P{k},{k % 97}\n" for k in range(10_000)))
    result = run("matchups", path, *SURE)
    assert (result.exit_code, result.stdout) == (2, "")
    assert "10,000 players make 49,995,000 pairs" in result.stderr
    assert "--pairs PAIRS.csv" in result.stderr
    pairs = roster("a,b\nP1,P9999\nP5,P77\n", "tonight.csv")
    assert len(table(run("matchups", path, *SURE, "--pairs", pairs))) == 2


def test_more_than_a_screen(run, roster, monkeypatch):
    path = roster("player,rating\n" + "".join(f"P{k},{k % 97}\n" for k in range(250)))
    result = run("matchups", path, *SURE, "--json")
    assert result.exit_code == 2
    assert "too many for --json; leave out --json, or name those" in result.stderr
    monkeypatch.setattr(module, "to_terminal", lambda: True)
    result = run("matchups", path, *SURE, "--json")
    assert "leave out --json and write them to a file, as in > pairs.csv, or" in result.stderr
    result = run("matchups", path, *SURE)
    assert "too many to show; write them to a file, as in > pairs.csv, or" in result.stderr
    result = run("matchups", path, *SURE, "--minutes-per-game", "8", "--tables", "9")
    assert "1,000 are the most for one evening" in result.stderr


def test_stdin(run):
    result = run("matchups", "-", *SURE, stdin=CLUB)
    assert len(table(result)) == 6


@pytest.mark.parametrize(
    ("words", "remedy"),
    [
        ((), "give --chart NAME, --games LO..HI or --race-to N"),
        (("--race-to", "7", "--games", "5..9"), "leave one out"),
        (("--race-to", "7", "--tables", "2"), "add --minutes-per-game"),
        (("--race-to", "7", "--tables", "0", "--minutes-per-game", "8"), "1<=x<=1000"),
        (("--race-to", "7", "--minutes-per-game", "0"), "give one such as 8 or 7.5"),
        (("--race-to", "7", "--minutes-per-game", "nan"), "give one such as 8 or 7.5"),
        (("--race-to", "7", "--starter", "x"), "give one such as 80"),
        (("--race-to", "7", "--starter-sd", "-1"), "give 0 or more points"),
        (("--race-to", "7", "--starter-sd", "151"), "give 150 at most"),
        (("--race-to", "7", "--scale", "x"), "npl, fargo, elo"),
        (("--race-to", "7", "--pairs", "-", "--chart", "-"), "only one list can be on stdin"),
    ],
)
def test_wrong_use_says_how_to_mend_it(run, roster, words, remedy):
    result = run("matchups", roster(), *words)
    assert (result.exit_code, result.stdout) == (2, "")
    assert remedy in result.stderr


def test_what_a_roster_may_lack(run, roster):
    one = run("matchups", roster("player,rating\nAnn,92\n"), *SURE)
    assert one.exit_code == 2
    assert "it takes two for a match" in one.stderr
    unrated = run("matchups", roster("player,rating\nAnn,92\nBo,\n"), *SURE, "--scale", "50")
    assert "'Bo' has no rating; say with --starter" in unrated.stderr
    twice = run("matchups", roster("player,rating\nAnn,92\nAnn,71\n"), *SURE)
    assert (twice.exit_code, twice.stdout) == (3, "")
    assert "roster.csv:3: player 'Ann' stands in line 2 already" in twice.stderr


def test_examples_of_the_help_name_options_that_exist():
    command = program.get_command(None, "matchups")
    known = {name for option in command.params for name in option.opts}
    used = {word for word in module.EXAMPLES.split() if word.startswith("--")}
    assert used <= known


DEMO = str(DATA / "demo_roster.csv")
LINE = (
    "--games --race-to --chart --tables --minutes-per-game --scale --starter --json 7..9 3 npl_8 2"
)
words = st.sampled_from(LINE.split()) | st.text(max_size=4)


@given(st.lists(words, max_size=6))
def test_no_words_make_a_traceback(run, line):
    assert run("matchups", DEMO, *line).exit_code in (0, 2, 3)


CELLS = st.sampled_from(["Ann", "Bo", "80", "", "9.5", "-3", "0", '"', "x", "1e5", "999999"])
ROWS = st.lists(st.lists(CELLS | st.text(max_size=3), min_size=4, max_size=4), max_size=5)


@given(ROWS)
def test_no_roster_makes_a_traceback(run, rows):
    text = "player,rating,standard_error,games\n" + "\n".join(",".join(row) for row in rows)
    words = ("--chart", "npl_10", "--race-to", "5", "--minutes-per-game", "8", "--tables", "2")
    result = run("matchups", "-", *words, stdin=text.encode("utf-8", "replace"))
    assert result.exit_code in (0, 2, 3)
    assert bool(result.stdout) == (result.exit_code == 0)


@pytest.mark.parametrize("words", [(), ("--json",)])
def test_a_page_of_the_round_is_the_same_each_time(run, roster, tmp_path, words):
    pairs = roster("a,b\nDi,Ann\nBo,Cy\n", "tonight.csv")
    asked = ("matchups", roster(), *SURE, "--minutes-per-game", "8", "--tables", "1")
    first, again = tmp_path / "new" / "a.html", tmp_path / "b.HTML"
    plain = run(*asked, "--pairs", pairs, *words)
    result = run(*asked, "--pairs", pairs, "--html", str(first), *words)
    assert (result.exit_code, result.stdout) == (0, plain.stdout)
    assert result.stderr.splitlines()[-1] == f"Wrote {first}"
    assert run(*asked, "--pairs", pairs, "--html", str(again)).exit_code == 0
    page = first.read_bytes()
    assert page == again.read_bytes()
    assert b"2 matches on 1 table take" in page
    assert b"Who gives whom what" not in page
    assert run(*asked, "--html", str(first)).exit_code == 0
    assert b"Who gives whom what" in first.read_bytes()


def test_a_terminal_has_the_page_written_too(terminal, roster, tmp_path):
    page = tmp_path / "a.html"
    assert terminal("matchups", roster(), *SURE, "--html", str(page)).exit_code == 0
    assert page.read_bytes().startswith(b"<!doctype html>")


def test_more_than_a_page_holds_is_refused_with_the_remedy(run, roster, tmp_path):
    page = tmp_path / "a.html"
    club = roster("player,rating\n" + "".join(f"P{k},{k}\n" for k in range(49)))
    result = run("matchups", club, *SURE, "--html", str(page))
    assert result.exit_code == 2
    assert "all pairs of 48 at most; name those who meet with --pairs" in result.stderr
    pairs = roster("a,b\n" + "P1,P2\n" * 501, "tonight.csv")
    result = run("matchups", club, *SURE, "--pairs", pairs, "--html", str(page))
    assert result.exit_code == 2
    assert "make a list and a page for each part of the round" in result.stderr
    result = run("matchups", club, *SURE, "--html", "page.txt")
    assert "'page.txt'; name a file that ends in .html" in result.stderr
    assert not page.exists()
