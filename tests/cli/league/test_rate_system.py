import json

import pytest
from hypothesis import given
from hypothesis import strategies as st

LAST = 'player,rating,games\n"Diaz, Bo",80,120\nAnn,92,140\nCy,71,\n=cmd(),60,0\n'
ELO = "".join(f"{row},{'elo' if k else 'scale'}\n" for k, row in enumerate(LAST.splitlines()))
NIGHT = (
    "date,player_a,player_b,score_a,score_b,forfeit\n"
    '2026-11-20,Ann,"Diaz, Bo",5,3,\n2026-11-20,Cy,Annie,2,6,\n2026-11-20,Cy,=cmd(),,,yes\n'
)
LIST = (
    "player,rating,standard_error,games,component,provisional,matches,rating_before,change,"
    "matches_won,matches_lost,why,scale\n"
    'Ann,94,,156,,no,,92,2,2,0,"beat Diaz, Bo 5-3 (race 5:4); beat Cy 6-2 (race 6:4)",\n'
    '"Diaz, Bo",79,,128,,no,,80,-1,0,1,lost to Ann 3-5 (race 4:5),\n'
    "Cy,70,,,,yes,,71,-1,0,1,lost to Ann 2-6 (race 4:6),\n"
    "'=cmd(),60,,0,,yes,,60,0,0,0,,\n"
)


@pytest.fixture
def rate(run, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    files = {
        "last.csv": LAST,
        "night.csv": NIGHT,
        "open.csv": NIGHT.replace("5,3", "5,4"),  # the end of no chart's race, beside 6-2
        "aliases.csv": "name,means\nAnnie,Ann\n",
    }
    for name, text in files.items():
        (tmp_path / name).write_text(text, encoding="utf-8")

    def ask(*words, stdin=None):
        usual = {"--system": "npl", "--roster": "last.csv", "--aliases": "aliases.csv"}
        line = [word for one in usual.items() if one[0] not in words for word in one]
        return run("rate", *line, *words, stdin=stdin)

    return ask


def test_next_weeks_list_into_a_pipe(rate):
    result = rate("night.csv", "--chart", "npl_10")
    assert (result.exit_code, result.stdout) == (0, LIST)
    assert "1 forfeit" in result.stderr
    assert "'Annie' as 'Ann'" in result.stderr


def test_in_text_who_gained_and_why_and_the_list(rate):
    result = rate("night.csv", "--chart", "npl_10", "--text")
    assert result.exit_code == 0
    lines = [" ".join(line.split()) for line in result.stdout.splitlines()]
    start = lines.index("player was now change why")
    assert lines[start + 1 : start + 5] == [
        "Ann 92 94 +2 beat Diaz, Bo 5-3 (race 5:4)",
        "beat Cy 6-2 (race 6:4)",
        "Diaz, Bo 80 79 -1 lost to Ann 3-5 (race 4:5)",
        "Cy 71 70 -1 lost to Ann 2-6 (race 4:6)",
    ]
    assert lines[-4:] == ["1 Ann 94 156", "2 Diaz, Bo 79 128", "P1 Cy 70", "P2 =cmd() 60 0"]


def test_json(rate):
    result = rate("night.csv", "--chart", "NPL-10", "--json")
    answer = json.loads(result.stdout)
    assert (answer["system"], answer["chart"], answer["forfeits_left_out"]) == ("npl", "npl_10", 1)
    assert [(p["player"], p["rating"], p["change"]) for p in answer["players"]] == [
        ("Ann", 94, 2),
        ("Diaz, Bo", 79, -1),
        ("Cy", 70, -1),
        ("=cmd()", 60, 0),
    ]
    assert answer["matches"][1] == {
        "winner": "Ann",
        "loser": "Cy",
        "games": [6, 2],
        "race": [6, 4],
        "race_by_chart": [6, 4],
        "points": [1, -1],
    }
    assert answer["schema_version"] == 1


def test_the_night_may_come_through_a_pipe(rate):
    assert rate("-", "--chart", "npl_10", stdin=NIGHT).stdout == LIST


def test_newcomers_move_further_and_their_matches_are_counted(rate, tmp_path):
    (tmp_path / "last.csv").write_text("player,rating,matches\nAnn,92,9\nDiaz,80,29\nCy,71,\n")
    (tmp_path / "night.csv").write_text(
        "player_a,player_b,score_a,score_b,winner\nAnn,Diaz,5,3,Ann\nDiaz,Ann,5,3,Diaz\n"
        "Diaz,Cy,5,1,Diaz\n"
    )
    result = rate("night.csv")
    assert result.exit_code == 0
    assert [line.split(",")[:8] for line in result.stdout.splitlines()[1:]] == [
        ["Ann", "93", "", "", "", "11", "92", "1"],  # 3 up, then 2 down
        ["Diaz", "80", "", "", "", "32", "80", "0"],  # 2 down, then up 1 and 1
        ["Cy", "70", "", "", "", "", "71", "-1"],
    ]
    assert "newcomers move 3 times as far in their first 10 matches" in result.stderr


def test_a_league_without_newcomers_hears_nothing_about_them(rate, tmp_path):
    (tmp_path / "last.csv").write_text("player,rating,matches\nAnn,92,30\n'Diaz, Bo',80,\nCy,71,\n")
    (tmp_path / "night.csv").write_text(
        "player_a,player_b,score_a,score_b,winner\nAnn,Cy,5,3,Ann\n"
    )
    assert "newcomers" not in rate("night.csv").stderr


@pytest.mark.parametrize(
    ("system", "change"),
    [("step 3", (3, -3)), ("step-2-1", (2, -1)), ("margin", (2, -2)), ("elo 16", (11, -11))],
)
def test_other_systems_move_by_their_own_rules(rate, tmp_path, system, change):
    scale = "elo" if system.startswith("elo") else "npl"
    (tmp_path / "last.csv").write_text(f"player,rating,scale\nAnn,120,{scale}\nCy,0,{scale}\n")
    (tmp_path / "night.csv").write_text(
        "player_a,player_b,score_a,score_b,race_a,race_b\nAnn,Cy,4,1,4,3\n"
    )
    result = rate("night.csv", "--system", system)
    rows = [line.split(",") for line in result.stdout.splitlines()[1:]]
    assert [int(row[7]) for row in rows] == list(change)


def test_a_system_that_moves_by_the_score_asks_for_it(rate, tmp_path):
    (tmp_path / "last.csv").write_text(ELO)
    (tmp_path / "night.csv").write_text(
        "player_a,player_b,race_a,race_b,winner\nAnn,Cy,6,4,Ann\nCy,Ann,4,6,Cy\n"
    )
    result = rate("night.csv", "--system", "elo 16")
    assert result.exit_code == 3
    assert "night.csv:2: the score is missing, and the system elo 16 uses it" in result.stderr
    assert "night.csv:3: the score is missing" in result.stderr


def test_a_system_that_moves_by_the_race_asks_for_it(rate, tmp_path):
    (tmp_path / "night.csv").write_text(
        "player_a,player_b,score_a,score_b,winner\nAnn,Cy,6,2,Ann\n"
    )
    result = rate("night.csv", "--system", "margin", "--chart", "npl_10")
    assert result.exit_code == 0
    (tmp_path / "night.csv").write_text(
        "player_a,player_b,score_a,score_b,winner\nAnn,Cy,9,2,Ann\n"
    )
    result = rate("night.csv", "--system", "margin")
    assert result.exit_code == 3
    assert (
        "night.csv:2: the race is missing, and the system margin 2 uses it to "
        "move ratings. Add the chart that was used (npl_8, npl_10, npl_12 or npl_20), or "
        "the columns race_a and race_b"
    ) in result.stderr


def test_the_chart_of_a_fixed_length_system_is_taken_by_itself(rate):
    result = rate("night.csv", "--system", "fixed 9")
    assert result.exit_code == 3  # 5-3 and 6-2 are the ends of no races of nine games at once
    assert "5-3). Add the chart that was used, or the columns race_a and race_b" in result.stderr


@pytest.mark.parametrize(
    ("system", "message"),
    [
        ("fide", "system must be npl, step UP [DOWN], margin [MOST]"),
        ("step", "system is 'step'. Write it as step UP [DOWN], in whole numbers"),
        ("elo 0", "system is 'elo 0': k must"),
        ("fixed 8", "system is 'fixed 8': games is 8"),
    ],
)
def test_a_system_that_there_is_not_is_refused(rate, system, message):
    result = rate("night.csv", "--system", system)
    assert result.exit_code == 2
    assert message in result.stderr


def test_a_race_beside_the_chart_is_warned_of(rate, tmp_path):
    (tmp_path / "night.csv").write_text(
        "player_a,player_b,score_a,score_b,race_a,race_b\nAnn,Cy,5,4,5,5\n"
    )
    result = rate("night.csv", "--chart", "npl_10")
    assert result.exit_code == 0
    assert (
        "night.csv:2: 'Ann' - 'Cy' played a race 5:5, but the chart npl_10 has 6:4" in result.stderr
    )


def test_without_a_chart_the_only_one_that_fits_is_used_and_named(rate):
    result = rate("night.csv")
    assert (result.exit_code, result.stdout) == (0, LIST)
    assert "npl_10" in result.stderr


@pytest.mark.parametrize(
    ("words", "code", "remedy"),
    [
        (["open.csv"], 3, "--chart NAME settles them all"),
        (["night.csv", "--chart", "npl_8"], 3, "5-3 doesn't finish the race 4:3"),
        (["night.csv", "--chart", "npl_9"], 3, "no chart or file with this name"),
        (["night.csv", "--chart", "apa_8ball"], 2, "Give a chart of rating differences"),
        (["none.csv", "--chart", "npl_10"], 3, "there's no such file"),
        (["night.csv", "--roster", "none.csv"], 3, "there's no such file"),
        (
            ["night.csv", "--system", "fide"],
            2,
            (
                "system must be npl, step UP [DOWN], margin [MOST], elo [K], fixed [GAMES], "
                "none [GAMES], fargo-like, level-review, apa-like, tap-like, level-steps "
                "[STEPS], averages, win-percent or napa-like; you gave 'fide'"
            ),
        ),
        (["-", "--roster", "-"], 2, "which can stand for only one file"),
        (["night.csv", "--roster", "night.csv"], 3, "there's no column 'player'"),
        (["night.csv", "--aliases", "last.csv"], 3, "there's no column 'name'"),
        (["-", "--chart", "-"], 2, "which can stand for only one file"),
        (["night.csv", "--half-life", "30"], 2, "Leave out --half-life"),
    ],
)
def test_wrong_use_says_how_to_correct_it(rate, words, code, remedy):
    result = rate(*words)
    assert (result.exit_code, result.stdout) == (code, "")
    assert remedy in result.stderr


def test_warnings_stand_beside_what_they_explain(rate, tmp_path):
    (tmp_path / "last.csv").write_text("player,rating\nAnn,92\nDiaz Bo,80\nCy,71\n")
    result = rate("night.csv", "--chart", "npl_10")
    assert result.exit_code == 3
    first, *_, error = result.stderr.splitlines()
    assert first.startswith("Warning: night.csv")
    assert "'Annie' as 'Ann'" in first
    assert error.startswith("Error: night.csv:2: 'Diaz, Bo' isn't on the list")
    assert "if 'Diaz Bo' is meant" in error


def test_players_who_are_not_on_the_list_are_named_in_one_error(rate, tmp_path):
    (tmp_path / "last.csv").write_text("player,rating\nNoor Ilves,92\nZed Quist,80\n")
    result = rate("night.csv", "--chart", "npl_10")
    assert result.exit_code == 3
    told = [line for line in result.stderr.splitlines() if "on the list" in line]
    assert len(told) == 1
    assert told[0].endswith(
        "aren't on the list. Add them with starting ratings, or correct the names."
    )


def test_a_roster_is_for_a_system(run):
    result = run("rate", "night.csv", "--roster", "last.csv")
    assert result.exit_code == 2
    assert "is for --system" in result.stderr


@given(st.text(max_size=40), st.text(max_size=40))
def test_no_text_makes_a_traceback(run, tmp_path_factory, rows, names):
    folder = tmp_path_factory.getbasetemp()
    (folder / "any_list.csv").write_text(f"player,rating\nAnn,90\n{names}", "utf-8", "replace")
    night = f"player_a,player_b,score_a,score_b\n{rows}"
    line = f"rate - --system npl --chart npl_10 --roster {folder}/any_list.csv"
    assert run(*line.split(), stdin=night.encode("utf-8", "replace")).exit_code in (0, 3)


def test_ratings_that_look_like_another_scale_than_the_systems_are_refused(rate, tmp_path):
    (tmp_path / "raced.csv").write_text(
        "player_a,player_b,score_a,score_b,race_a,race_b\nAnn,Cy,4,1,4,3\n"
    )
    refused = rate("raced.csv", "--system", "elo 16")
    assert (refused.exit_code, refused.stdout) == (2, "")
    assert "92 don't look like Elo ratings (the scale of the system elo 16)" in refused.stderr
    assert "by NPL ratings" in refused.stderr
    (tmp_path / "last.csv").write_text(ELO)
    assert rate("raced.csv", "--system", "elo 16").exit_code == 0


def test_several_dates_are_rated_night_by_night(rate, tmp_path):
    rows = ["2026-11-20,Ann,Cy,6,2", "2026-11-27,Cy,Ann,4,4", "2026-11-27,Ann,Cy,2,4"]
    header = "date,player_a,player_b,score_a,score_b,race_a,race_b"
    nights = [f"{row},{race}" for row, race in zip(rows, ("6,4", "4,6", "6,4"), strict=True)]
    (tmp_path / "season.csv").write_text("\n".join([header, *nights]))
    (tmp_path / "first.csv").write_text("\n".join([header, nights[0]]))
    (tmp_path / "second.csv").write_text("\n".join([header, *nights[1:]]))
    (tmp_path / "then.csv").write_text(rate("first.csv").stdout)
    by_hand = json.loads(rate("second.csv", "--roster", "then.csv", "--json").stdout)
    season = rate("season.csv", "--json")
    answer = json.loads(season.stdout)
    ratings = [{p["player"]: p["rating"] for p in a["players"]} for a in (answer, by_hand)]
    assert ratings[0] == ratings[1]
    assert len(answer["matches"]) == 3
    assert "one night" not in season.stderr
    # Elo's steps depend on the ratings of the night.
    (tmp_path / "last.csv").write_text(ELO)
    steps = [
        [
            m["points"]
            for m in json.loads(rate(*w, "--system", "elo 64", "--json").stdout)["matches"]
        ]
        for w in (["season.csv"], ["second.csv"])
    ]
    assert steps[0][1:] != steps[1]
    (tmp_path / "last.csv").write_text(LAST)
    wrong = nights[1].replace("Ann", "Dee")
    (tmp_path / "season.csv").write_text("\n".join([header, nights[0], wrong]))
    refused = rate("season.csv")
    assert refused.exit_code == 3
    assert "season.csv:3: 'Dee'" in refused.stderr
