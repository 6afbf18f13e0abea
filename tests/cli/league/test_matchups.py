import csv
import io
import json
from pathlib import Path

import click
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from evenbreak.cli.program import program
from evenbreak.files.charts import read_chart
from evenbreak.handicaps import audit_levels, level_skills, points_odds
from evenbreak.handicaps.charts.gap import Gap
from evenbreak.matches import Turnover
from evenbreak.questions.league import Matchups
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


def test_all_pairs_as_csv(run, roster):
    result = run("matchups", roster(), "--chart", "npl_10", *SURE)
    rows = table(result)
    assert [(row["player_a"], row["player_b"]) for row in rows] == [
        ("Ann", "Cy"), ("Ann", "Bo"), ("Ann", "Di"), ("Cy", "Bo"), ("Cy", "Di"), ("Bo", "Di"),
    ]  # fmt: skip
    assert list(rows[0]) == COLUMNS
    assert (rows[1]["chart_race_a"], rows[1]["chart_race_b"]) == ("6", "4")
    assert rows[1]["difference_error"] == ""
    assert "NPL scale" in result.stderr


def test_pairs_in_the_order_of_the_list(run, roster):
    pairs = roster("a,b\ndi,Ann\nBo,Cy\n", "tonight.csv")
    rows = table(run("matchups", roster(), *SURE, "--pairs", pairs))
    assert [(row["player_a"], row["player_b"]) for row in rows] == [("Di", "Ann"), ("Bo", "Cy")]


def test_chances_are_averaged_over_the_errors(run, roster):
    path = roster("player,rating,standard_error,games\nAnn,92,9,140\nBo,71,12,60\n")
    (row,) = answer(run, path, "--race-to", "7")["pairs"]
    assert row["difference_error"] == 15.0
    assert row["p_win_a"] == Gap(21.0, 15.0).win(row["race_a"], row["race_b"])
    assert row["p_win_a_plug_in"] == Gap(21.0).win(row["race_a"], row["race_b"])


def test_new_players_start_with_a_stated_prior(run, roster):
    path = roster("player,rating,games\nAnn,92,\nBo,,0\nCy,85,0\n")
    rows = answer(run, path, *SURE)["pairs"]
    assert [(row["difference"], row["difference_error"]) for row in rows] == [
        (7.0, 30.0), (12.0, 30.0), (5.0, pytest.approx(30.0 * 2**0.5)),
    ]  # fmt: skip
    rows = answer(run, path, *SURE, "--starter", "92", "--starter-sd", "20")["pairs"]
    assert (rows[0]["difference"], rows[0]["difference_error"]) == (0.0, 20.0)


def test_the_scale_is_that_of_the_chart(run, roster):
    path = roster("player,rating\nAnn,612\nBo,521\n")
    (row,) = answer(run, path, "--chart", "fargo_r6_hot")["pairs"]
    assert row["p_game_a"] == pytest.approx(1 / (1 + 2**-0.91))
    (row,) = answer(run, path, "--chart", "fargo_r6_hot", "--scale", "200")["pairs"]
    assert row["p_game_a"] == pytest.approx(1 / (1 + 2**-0.455))


@pytest.mark.parametrize(
    ("ratings", "words", "doubted"),
    [
        ((712, 421), SURE, False),
        ((712, 421), (*SURE, "--scale", "fargo"), False),
        ((92, 71), SURE, False),
        ((92, 710, 80), (*SURE, "--chart", "npl_10"), True),
    ],
)
def test_ratings_of_another_scale_are_doubted(run, roster, ratings, words, doubted):
    text = "".join(f"P{k},{rating}\n" for k, rating in enumerate(ratings))
    result = run("matchups", roster(f"player,rating\n{text}"), *words)
    assert ("Warning" in result.stderr) == doubted


def test_ratings_that_look_like_another_scale_than_the_charts_are_refused(run, roster):
    path = roster("player,rating\nAnn,92\nBo,71\n")
    result = run("matchups", path, "--chart", "fargo_r6_hot")
    assert (result.exit_code, result.stdout) == (2, "")
    assert (
        "the scale of the chart fargo_r6_hot): Ann wins a game against Bo 54% of the "
        "time by Fargo ratings, 62% by NPL ratings. Add --scale"
    ) in result.stderr
    assert run("matchups", path, "--chart", "fargo_r6_hot", "--scale", "fargo").exit_code == 0


@pytest.mark.parametrize(
    ("words", "doubted"), [(("--scale", "fargo"), True), ((), False), (("--starter", "80"), False)]
)
def test_a_middle_far_from_all_ratings_is_no_starter(run, roster, words, doubted):
    path = roster("player,rating,games\nAnn,92,140\nBo,,0\n")
    assert ("--starter" in run("matchups", path, *SURE, *words).stderr) == doubted


LEVELS = "player,skill level\nAnn,7\nBo,4\nCy,2\n"


def test_levels_of_an_own_chart_are_as_strong_as_it_makes_them(run, roster):
    text = run("chart", "show", "apa_8ball", "--csv").stdout.replace("7,2,7,2", "7,2,8,2")
    chart = roster(text.replace("2,7,2,7", "2,7,2,8"), "ours.csv")
    found = answer(run, roster(LEVELS), "--chart", chart)
    audited = audit_levels(read_chart(chart)).cells
    cells = {(cell.level, cell.opponent_level): cell for cell in audited}
    for row, levels in zip(found["pairs"], [(7, 4), (7, 2), (4, 2)], strict=True):
        cell = cells[levels]
        assert (row["chart_race_a"], row["chart_race_b"]) == (cell.needs, cell.opponent_needs)
        assert row["chart_p_win_a"] == pytest.approx(cell.p_win_middle, rel=1e-9)
    assert found["levels"]["source"] == "chart"
    assert "assumed, not measured" in run("matchups", roster(LEVELS), "--chart", chart).stderr


def test_levels_are_as_strong_as_elsewhere_unless_own_results_show_it(run, roster):
    path, page = roster(LEVELS), roster("", "tonight.html")
    words = (path, "--chart", "apa_8ball")
    usual = answer(run, *words)
    assert usual["levels"]["source"] == "measured"
    assert run("matchups", *words, "--html", page).exit_code == 0
    assert "about 40,000 matches" in Path(page).read_text(encoding="utf-8")
    rows = "".join(f"P{k % 9},Q{k % 7},{2 + k % 2},{3 - k % 3},5,4\n" for k in range(120))
    results = roster("player_a,player_b,score_a,score_b,level_a,level_b\n" + rows, "season.csv")
    own = answer(run, *words, "--results", results)
    assert (own["levels"]["source"], own["levels"]["matches"]) == ("results", 120)
    assert own["pairs"] != usual["pairs"]


def test_ratings_beside_levels_give_the_chances(run, roster):
    text = "player,Fargo rating,level\nAnn,600,5\nBo,500,3\n"
    (row,) = answer(run, roster(text), "--chart", "apa_8ball")["pairs"]
    assert (row["chart_race_a"], row["chart_race_b"]) == (4, 2)
    assert row["p_game_a"] == pytest.approx(2 / 3)
    assert answer(run, roster(text), "--race-to", "5")["levels"] is None


def test_a_chart_of_points_gives_the_points_of_each_pair(run, roster):
    path = roster("player,SL\nAnn,7\nBo,4\nCy,\n")
    words = (path, "--chart", "apa_9ball")
    rows = answer(run, *words, "--starter", "2")["pairs"]
    odds = points_odds("apa_9ball", 7, 4)
    assert [(row["player_a"], row["needs_a"], row["needs_b"]) for row in rows] == [
        ("Ann", 55, 31),
        ("Ann", 55, 19),
        ("Bo", 31, 19),
    ]
    assert rows[0]["p_win_a"] == pytest.approx(odds.p_win_1)
    assert rows[0]["match_points_b"] == pytest.approx(odds.share_2)
    assert "'Cy' has no skill level" in run("matchups", *words).stderr
    assert "no race in games" in run("matchups", *words, "--race-to", "5").stderr


def test_a_level_rates_a_player_who_has_no_rating(run, roster):
    text = "player,fargo,SL\nAnn,600,6\nBo,400,4\nCy,,2\n"
    rows = answer(run, roster(text), "--chart", "apa_8ball")["pairs"]
    (row,) = (row for row in rows if {row["player_a"], row["player_b"]} == {"Ann", "Cy"})
    shift = 500 - np.mean(level_skills("apa_8ball").strength([6, 4]))
    assert row["difference"] == pytest.approx(600 - shift)
    assert "rated by skill level" in run("matchups", roster(text), "--chart", "apa_8ball").stderr


@pytest.mark.parametrize(
    ("text", "more", "words"),
    [
        (LEVELS, ("--scale", "2"), "--scale is for ratings"),
        (
            "player,level\nAnn,7\nBo,8\n",
            (),
            "roster.csv:3: 'Bo' has skill level 8; the chart apa_8ball has",
        ),
        ("player,level\nAnn,7\nBo,\n", (), "roster.csv:3: 'Bo' has no skill level (new players"),
        ("player,rating\nAnn,92\nBo,71\n", (), "needs skill levels"),
    ],
)
def test_what_is_no_list_of_levels_is_refused(run, roster, text, more, words):
    result = run("matchups", roster(text), "--chart", "apa_8ball", *more)
    assert result.exit_code in (2, 3)
    assert words in result.stderr


@pytest.mark.parametrize("chart", ["apa_9ball", "npl_10"])
def test_whoever_is_away_tonight_holds_up_nobody(run, roster, tmp_path, chart):
    pairs = tmp_path / "pairs.csv"
    column, error = ("rating", "1e6") if chart == "npl_10" else ("level", "")
    cy = f"Cy,1,{error}" if error else "Cy,,"
    away = roster(f"player,{column},standard_error\nAnn,7,1\nBo,4,1\n{cy}\n")
    pairs.write_text("player_a,player_b\nAnn,Bo\n")
    words = ("matchups", away, "--chart", chart, "--pairs", str(pairs))
    assert [(row["player_a"], row["player_b"]) for row in answer(run, *words[1:])["pairs"]] == [
        ("Ann", "Bo")
    ]
    pairs.write_text("player_a,player_b\nAnn,Cy\n")
    assert "roster.csv:4:" in run(*words).stderr


def test_own_results_are_for_levels(run, roster):
    for words in (("--race-to", "5"), ("--chart", "npl_10")):
        result = run("matchups", roster(LEVELS), *words, "--results", "season.csv")
        assert result.exit_code == 2
        assert "such as --chart apa_8ball" in result.stderr


def test_the_evening_is_in_every_face(run, roster):
    pairs = roster("a,b\nAnn,Bo\nCy,Di\n", "tonight.csv")
    words = (roster(), "--chart", "npl_10", "--pairs", pairs, "--minutes-per-game", "8")
    found = answer(run, *words, "--tables", "2")
    (end,) = found["evening"]
    assert (end["races"], end["exact"], end["matches"], end["tables"]) == ("chart", True, 2, 2)
    assert end["mean_minutes"] > max(row["chart_mean_minutes"] for row in found["pairs"])
    result = run("matchups", *words, "--tables", "2")
    assert "2 matches on 2 tables" in result.stderr
    assert len(table(result)) == 2
    assert "2 matches on 2 tables" in run("matchups", *words, "--tables", "2", "--text").stdout
    assert answer(run, *words)["evening"] == []


def test_minutes_go_by_the_discipline_and_the_turnover(run, roster):
    words = (roster(), "--chart", "npl_10", "--tables", "1")
    nine, eight, quick = (
        answer(run, *words, *more)
        for more in (
            ("--discipline", "9-ball"),
            ("--discipline", "8-ball"),
            ("--discipline", "9-ball", "--turnover", "0"),
        )
    )
    for row in nine["pairs"]:
        assert row["chart_mean_minutes"] == pytest.approx(3.8 + 5.58 * row["chart_mean_games"])
    assert nine["pace"]["discipline"] == "9-ball"
    assert nine["pace"]["turnover"] == 10.8
    ends = [found["evening"][0]["mean_minutes"] for found in (eight, nine, quick)]
    assert ends == sorted(ends, reverse=True)
    assert ends[1] - ends[2] == pytest.approx(10.8 * (len(nine["pairs"]) - 1))
    assert answer(run, roster(), "--chart", "npl_10")["pace"] is None


@pytest.mark.slow
def test_the_seed_decides_an_evening_that_is_simulated(run, roster):
    words = (roster(), *SURE, "--minutes-per-game", "8", "--tables", "2")
    first, again, other = (
        answer(run, *words, *seed)["evening"] for seed in ((), ("--seed", "0"), ("--seed", "1"))
    )
    assert first == again != other
    assert not first[0]["exact"]


def test_names_do_no_harm(run, roster):
    path = roster('player,rating\n"=cmd()",92\n"Lee, ""Ann""\nB",71\n"שרה\u202e🎱",60\n')
    text = run("matchups", path, *SURE, "--text").stdout
    assert "\u202e" not in text
    assert 'Lee, "Ann" B' in text


def test_names_in_csv_are_defused(run, roster):
    path = roster('player,rating\n"=cmd()",92\n"Lee, ""Ann""",71\n')
    (row,) = table(run("matchups", path, *SURE))
    assert (row["player_a"], row["player_b"]) == ("'=cmd()", 'Lee, "Ann"')


@pytest.mark.slow
def test_too_many_pairs_are_refused_with_advice(run, roster):
    path = roster("player,rating\n" + "".join(f"P{k},{k % 97}\n" for k in range(10_000)))
    result = run("matchups", path, *SURE)
    assert (result.exit_code, result.stdout) == (2, "")
    assert "49,995,000 pairs" in result.stderr
    assert "--pairs PAIRS.csv" in result.stderr
    pairs = roster("a,b\nP1,P9999\nP5,P77\n", "tonight.csv")
    assert len(table(run("matchups", path, *SURE, "--pairs", pairs))) == 2


@pytest.mark.parametrize(
    ("words", "remedy"),
    [
        (("--json",), "--csv"),
        (("--text",), "--csv"),
        (("--minutes-per-game", "8", "--tables", "9"), "1,000"),
    ],
)
def test_more_than_a_screen_is_refused(run, roster, words, remedy):
    path = roster("player,rating\n" + "".join(f"P{k},{k % 97}\n" for k in range(250)))
    result = run("matchups", path, *SURE, *words)
    assert (result.exit_code, result.stdout) == (2, "")
    assert remedy in result.stderr


@pytest.mark.slow
def test_many_pairs_are_written_as_csv(run, roster):
    path = roster("player,rating\n" + "".join(f"P{k},{k % 97}\n" for k in range(202)))
    assert len(table(run("matchups", path, *SURE))) == 202 * 201 / 2 > 20_000


def test_stdin(run):
    result = run("matchups", "-", *SURE, stdin=CLUB)
    assert len(table(result)) == 6


@pytest.mark.parametrize(
    ("words", "remedy"),
    [
        ((), "--race-to N"),
        (("--race-to", "7", "--games", "5..9"), "Leave one out"),
        (("--race-to", "7", "--tables", "2"), "--minutes-per-game"),
        (("--race-to", "7", "--tables", "0", "--minutes-per-game", "8"), "from 1 to 1000"),
        (("--race-to", "7", "--minutes-per-game", "0"), "'0'"),
        (("--race-to", "7", "--discipline", "snooker"), "snooker"),
        (("--race-to", "7", "--discipline", "8-ball", "--minutes-per-game", "8"), "--discipline"),
        (("--race-to", "7", "--discipline", "8-ball", "--turnover", "5"), "--tables"),
        (("--race-to", "7", "--minutes-per-game", "nan"), "'nan'"),
        (("--race-to", "7", "--starter", "x"), "'x'"),
        (("--race-to", "7", "--starter-sd", "-1"), "'-1'"),
        (("--race-to", "7", "--starter-sd", "151"), "150"),
        (("--race-to", "7", "--scale", "x"), "npl, fargo, elo"),
        (("--race-to", "7", "--pairs", "-", "--chart", "-"), "standard input"),
    ],
)
def test_wrong_use_says_how_to_mend_it(run, roster, words, remedy):
    result = run("matchups", roster(), *words)
    assert (result.exit_code, result.stdout) == (2, "")
    assert remedy in result.stderr


def test_what_a_roster_may_lack(run, roster):
    one = run("matchups", roster("player,rating\nAnn,92\n"), *SURE)
    assert one.exit_code == 2
    assert "one player" in one.stderr
    unrated = run("matchups", roster("player,rating\nAnn,92\nBo,\n"), *SURE, "--scale", "50")
    assert "'Bo' has no rating" in unrated.stderr
    assert "--starter" in unrated.stderr
    twice = run("matchups", roster("player,rating\nAnn,92\nAnn,71\n"), *SURE)
    assert (twice.exit_code, twice.stdout) == (3, "")
    assert "roster.csv:3: player 'Ann'" in twice.stderr


def test_examples_of_the_help_name_options_that_exist():
    command = program.get_command(click.Context(program), "matchups")
    known = {name for option in command.params for name in option.opts}
    used = {word for word in Matchups.examples.split() if word.startswith("--")}
    assert used <= known


DEMO = str(DATA / "demo_roster.csv")
LINE = (
    "--games --race-to --chart --tables --minutes-per-game --discipline --turnover --scale "
    "--starter --json 7..9 3 npl_8 2 8-ball"
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


@pytest.mark.slow_after(1)
@pytest.mark.parametrize("face", ["--csv", "--json", "--text"])
def test_a_page_of_the_round_is_the_same_each_time(run, roster, tmp_path, face):
    pairs = roster("a,b\nDi,Ann\nBo,Cy\n", "tonight.csv")
    asked = ("matchups", roster(), *SURE, "--minutes-per-game", "8", "--tables", "1", face)
    first, again = tmp_path / "new" / "a.html", tmp_path / "b.HTML"
    plain = run(*asked, "--pairs", pairs)
    result = run(*asked, "--pairs", pairs, "--html", str(first))
    assert (result.exit_code, result.stdout) == (0, plain.stdout)
    assert f"Wrote {first}" in result.stderr
    assert run(*asked, "--pairs", pairs, "--html", str(again)).exit_code == 0
    page = first.read_bytes()
    assert page == again.read_bytes()
    assert b"2 matches on 1 table" in page
    assert b'id="races"' not in page
    assert run(*asked, "--html", str(first)).exit_code == 0
    assert b'id="races"' in first.read_bytes()


def test_more_than_a_page_holds_is_refused_with_the_remedy(run, roster, tmp_path):
    page = tmp_path / "a.html"
    club = roster("player,rating\n" + "".join(f"P{k},{k}\n" for k in range(49)))
    result = run("matchups", club, *SURE, "--html", str(page))
    assert result.exit_code == 2
    assert "at most 48" in result.stderr
    assert "--pairs" in result.stderr
    pairs = roster("a,b\n" + "P1,P2\n" * 501, "tonight.csv")
    result = run("matchups", club, *SURE, "--pairs", pairs, "--html", str(page))
    assert result.exit_code == 2
    assert "at most 500" in result.stderr
    result = run("matchups", club, *SURE, "--html", "page.txt")
    assert "'page.txt'" in result.stderr
    assert not page.exists()


@pytest.fixture
def fargo_list(run, tmp_path):
    """Return the list that `report --scale fargo` writes of the demo league."""
    assert run(
        *("report", str(DATA / "demo_league.csv"), "--out", str(tmp_path), "--scale", "fargo"),
        *("--prior", "100"),
    ).exit_code == 0  # fmt: skip
    return tmp_path / "ratings.csv"


@pytest.mark.slow
def test_a_list_keeps_its_scale(run, fargo_list):
    found = run("matchups", str(fargo_list), *SURE, "--csv")
    stated = run("matchups", str(fargo_list), *SURE, "--scale", "fargo", "--csv")
    assert table(found) == table(stated)
    unlike = run("matchups", str(fargo_list), "--chart", "npl_10")
    assert "npl_10 is made for ratings on the NPL scale" in unlike.stderr


@pytest.mark.slow
def test_another_scale_than_that_of_the_list_is_refused(run, fargo_list):
    refused = run("matchups", str(fargo_list), *SURE, "--scale", "elo")
    assert refused.exit_code == 2
    assert "Fargo scale" in refused.stderr
    assert "Elo scale" in refused.stderr


@pytest.mark.slow
@pytest.mark.parametrize("command", [
    ("rate", str(DATA / "demo_league.csv"), "--system", "npl", "--roster"),
    ("ladder", "--league"),
    ("ladder", "--compare", "--league"),
])  # fmt: skip
def test_a_system_of_another_scale_than_the_list_is_refused(run, fargo_list, command):
    refused = run(*command, str(fargo_list))
    assert refused.exit_code == 2
    assert "Fargo scale" in refused.stderr
    assert "NPL scale" in refused.stderr


@pytest.mark.slow
def test_a_season_on_another_scale_than_the_list_is_refused(run, fargo_list, tmp_path):
    words = ("--system", "npl", "--out", str(tmp_path / "season"))
    refused = run("simulate", str(fargo_list), *words)
    assert refused.exit_code == 2
    assert "Fargo scale" in refused.stderr


def test_of_a_list_only_the_entrants_meet(run, tmp_path):
    entrants = tmp_path / "entrants.txt"
    entrants.write_text("Søren Lindqvall\nNoor Al-Beyrati\nA Stranger\n", encoding="utf-8")
    words = (str(DATA / "demo_roster.csv"), "--race-to", "7", "--json")
    result = run("matchups", *words, "--players-file", str(entrants))
    page = tmp_path / "tonight.html"
    asked = ("--players-file", str(entrants), "--html", str(page))
    assert run("matchups", *words, *asked).exit_code == 0
    shown = page.read_text(encoding="utf-8")
    assert "A Stranger" in shown
    assert "/demo_roster.csv" not in shown
    assert str(tmp_path) not in shown
    pairs = json.loads(result.stdout)["pairs"]
    assert [(pair["player_a"], pair["player_b"]) for pair in pairs] == [
        ("Søren Lindqvall", "Noor Al-Beyrati"),
        ("Søren Lindqvall", "A Stranger"),
        ("A Stranger", "Noor Al-Beyrati"),
    ]
    assert pairs[1]["difference"] == 19
    assert pairs[1]["difference_error"] == pytest.approx((6.7**2 + 30**2) ** 0.5)
    assert "'A Stranger'" in result.stderr


def test_the_help_knows_the_usual_turnover(run):
    text = " ".join(run("matchups", "--help-all").stdout.split())
    assert f"on a table. [0 to 1440; default: {Turnover().mean:g}]" in text


def test_skill_levels_need_a_chart_of_levels_or_a_scale(run, tmp_path):
    (tmp_path / "apa.csv").write_text("Name,Skill Level\nAnn,7\nBob,4\n", encoding="utf-8")
    roster = str(tmp_path / "apa.csv")
    refused = run("matchups", roster, "--race-to", "7")
    assert refused.exit_code == 2
    assert "apa_8ball" in refused.stderr
    assert run("odds", "Ann", "Bob", "--from", roster, "--race", "7").exit_code == 2
    assert run("matchups", roster, "--race-to", "7", "--scale", "2").exit_code == 0
    assert run("matchups", roster, "--chart", "apa_8ball").exit_code == 0
