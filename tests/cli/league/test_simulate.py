"""`evenbreak simulate`, as a person, a spreadsheet and a program meet it."""

import csv
import io
import json

import pytest

from places import DATA

ROSTER = str(DATA / "demo_league_roster.csv")
FIXTURES = ("--schedule", str(DATA / "demo_schedule.csv"))
FEW = ("--replicas", "40")

TABLES = ("standings.csv", "ratings_by_week.csv", "fairness.csv", "summary.csv")
SEASON = ("matches.csv", "truth.csv")
PICTURES = tuple(
    f"{name}.{kind}"
    for name in ("errors_by_week", "wins_by_gap", "standings")
    for kind in ("png", "svg")
)


def rows_of(path):
    return list(csv.DictReader(io.StringIO(path.read_text(encoding="utf-8"))))


@pytest.fixture
def no_pictures(monkeypatch):
    """Leave out what takes longest and is not asked about."""
    monkeypatch.setattr("evenbreak.cli.league.simulate._pictures", lambda *_: {})


@pytest.fixture(scope="module")
def season(run, tmp_path_factory):
    """Return what a season of the demo league wrote and printed."""
    folder = tmp_path_factory.mktemp("season") / "out"
    found = run("simulate", ROSTER, *FIXTURES, *FEW, "--out", str(folder))
    assert found.exit_code == 0
    return folder, found


@pytest.mark.slow
def test_all_files_are_written_and_named(season):
    folder, found = season
    assert {path.name for path in folder.iterdir()} == {*TABLES, *SEASON, *PICTURES}
    assert f"Wrote {', '.join((*TABLES, *SEASON, *PICTURES))} to {folder}" in found.stderr
    assert "15 of 16 players" in found.stderr


def test_a_pipe_gets_the_summary(season):
    folder, found = season
    assert found.stdout == (folder / "summary.csv").read_text(encoding="utf-8")
    told = {row["quantity"]: row["value"] for row in rows_of(folder / "summary.csv")}
    assert told["roster_file"] == "demo_league_roster.csv"
    assert (told["seed"], told["weeks"], told["replicas"]) == ("1", "15", "40")
    assert told["schedule"] == "list of 120 matches"


def test_tables_say_who_profits_and_how_wrong_ratings_are(season):
    folder, _ = season
    standings = rows_of(folder / "standings.csv")
    assert standings[0]["player"] == "Otto Birnhuber"  # rated 30 points too low
    assert len(standings) == 16
    weeks = rows_of(folder / "ratings_by_week.csv")
    assert [row["week"] for row in weeks] == [str(week) for week in range(16)]
    assert float(weeks[0]["error_sd"]) > float(weeks[-1]["error_sd"])
    assert {row["group"] for row in rows_of(folder / "fairness.csv")} == {"all", "gap", "fifth"}


@pytest.mark.slow
def test_the_season_in_full_is_read_by_rate_validate_and_report(run, season, tmp_path):
    matches = str(season[0] / "matches.csv")
    for words in (
        ("rate", matches),
        ("validate", matches, "--prior", "22"),
        ("report", matches, "--out", str(tmp_path / "sheet")),
    ):
        found = run(*words)
        assert found.exit_code == 0
        assert "Warning" not in found.stderr
    assert len(list(csv.DictReader(io.StringIO(run("rate", matches).stdout)))) == 16
    truth = str(season[0] / "truth.csv")
    again = run("simulate", truth, *FEW, "--no-matches", "--out", str(tmp_path / "again"))
    assert again.exit_code == 0
    assert "16 players is drawn" not in again.stderr


def test_the_league_moves_ratings_as_rate_does_with_the_season(run, season, tmp_path):
    """The first night, by `rate --system`: each winner a point up, newcomers three."""
    folder, _ = season
    lines = (folder / "matches.csv").read_text(encoding="utf-8").splitlines()
    night = tmp_path / "night.csv"
    night.write_text("\n".join([lines[0], *(line for line in lines if ",week 1," in line)]) + "\n")
    found = run("rate", str(night), "--system", "npl", "--roster", ROSTER, "--chart", "npl_10")
    assert found.exit_code == 0
    moved = {
        row["player"]: float(row["change"]) for row in csv.DictReader(io.StringIO(found.stdout))
    }
    assert abs(moved["Otto Birnhuber"]) == 3.0
    assert abs(moved["Keiko Amasuda"]) == 3.0  # 8 matches so far
    assert abs(moved["Liv Brandstätter"]) == 2.0  # 21
    assert abs(moved["Ines Valbrecht"]) == 1.0


@pytest.mark.slow
def test_the_same_seed_gives_the_same_bytes_for_any_number_of_jobs(run, season, tmp_path):
    folder, _ = season
    again = tmp_path / "jobs"
    words = ("simulate", ROSTER, *FIXTURES)
    assert run(*words, *FEW, "--jobs", "2", "--out", str(again)).exit_code == 0
    for name in (*TABLES, *SEASON, *PICTURES):
        assert (again / name).read_bytes() == (folder / name).read_bytes()
    other = tmp_path / "seed"
    assert run(*words, *FEW, "--jobs", "1", "--seed", "2", "--out", str(other)).exit_code == 0
    assert (other / "standings.csv").read_bytes() != (folder / "standings.csv").read_bytes()
    assert (other / "matches.csv").read_bytes() != (folder / "matches.csv").read_bytes()


@pytest.mark.slow_after(6)
@pytest.mark.parametrize(
    ("options", "told"),
    [
        ((), {"schedule": "round robin, 1 a week", "weeks": "30", "chart": "npl_10"}),
        (("--round-robin", "--matches", "2"), {"schedule": "round robin, 2 a week"}),
        (("--random", "--rack-by-rack"), {"schedule": "random, 1 a week", "play": "racks"}),
        (("--chart", "NPL-8", "--weeks", "3"), {"chart": "npl_8", "weeks": "3"}),
        (("--system", "step 2", "--weeks", "5"), {"system": "step 2"}),
        (("--scale", "45", "--weeks", "2"), {"points_per_doubling": "45.000000"}),
        (("--day-sd", "7.5", "--weeks", "2"), {"day_sd": "7.500000"}),
        (("--weeks", "4", *FIXTURES), {"weeks": "4"}),
    ],
)
@pytest.mark.usefixtures("no_pictures")
def test_a_season_is_played_as_it_is_asked_for(run, tmp_path, options, told):
    words = ("simulate", ROSTER, *options, "--replicas", "10", "--no-matches")
    found = run(*words, "--out", str(tmp_path / "out"))
    assert found.exit_code == 0
    rows = {row["quantity"]: row["value"] for row in csv.DictReader(io.StringIO(found.stdout))}
    assert {name: rows[name] for name in told} == told
    assert not (tmp_path / "out" / "matches.csv").exists()


@pytest.mark.usefixtures("no_pictures")
def test_json_has_every_quantity_and_its_error(run, tmp_path):
    found = run("simulate", ROSTER, *FEW, "--weeks", "2", "--json", "--out", str(tmp_path / "out"))
    told = json.loads(found.stdout)
    assert (told["replicas"], told["weeks"], told["schema_version"]) == (40, 2, 1)
    assert 0 < told["standard_errors"]["p_stronger_wins"] < 0.05
    assert {row["quantity"]: row["value"] for row in told["summary"]}["weeks"] == 2
    assert told["evenbreak_version"]


@pytest.mark.usefixtures("no_pictures")
@pytest.mark.parametrize(
    ("options", "warnings"),
    [
        (("--weeks", "2"), []),
        (("--weeks", "2", "--scale", "fargo"), ["npl_10", "Fargo"]),
        (("--weeks", "4", *FIXTURES), ["week 4"]),
        (("--weeks", "20", *FIXTURES), ["week 15"]),
    ],
)
def test_what_may_be_wrong_is_a_warning(run, tmp_path, options, warnings):
    words = ("simulate", ROSTER, *FEW, *options, "--no-matches", "--out", str(tmp_path / "out"))
    found = json.loads(run(*words, "--json").stdout)["warnings"]
    assert len(found) == len(warnings)
    for text, word in zip(found, warnings, strict=True):
        assert word in text


@pytest.mark.parametrize(
    ("options", "words"),
    [
        (("--random", "--round-robin"), "--round-robin and --random can't be used together."),
        (("--random", *FIXTURES), "--schedule and --random can't be used together."),
        (("--matches", "2", *FIXTURES), "--schedule and --matches can't be used together;"),
        (("--jobs", "2", "--dask", "tcp://x:1"), "--dask and --jobs can't be used together;"),
        (("--dask", " "), "--dask must not be empty"),
        (("--out", " "), "'--out': the name is empty"),
        (("--weeks", "0"), "'0'"),
        (("--replicas", "many"), "'many'"),
        (("--day-sd", "-1"), "'-1'"),
        (("--day-sd", "5,5"), "5.5"),
        (("--seed", "-1"), "'-1'"),
        (("--scale", "big"), "'big'"),
        (("--system", "elo 16", "--scale", "npl"), "Leave --scale out"),
        (("--system", "gut feeling"), "'gut feeling'"),
        (("--chart", "apa_9ball"), "counts points"),
    ],
)
def test_wrong_use_is_refused_and_nothing_is_written(run, tmp_path, options, words):
    out = tmp_path / "out"
    folder = () if "--out" in options else ("--out", str(out))
    found = run("simulate", ROSTER, *folder, *options)
    assert found.exit_code == 2
    assert words in found.stderr
    assert not out.exists()


def test_a_folder_that_cannot_be_written_is_refused_before_the_work(run, tmp_path, monkeypatch):
    def never(*_):
        raise AssertionError

    monkeypatch.setattr("evenbreak.cli.league.simulate._simulated", never)
    (tmp_path / "afile").write_text("")
    found = run("simulate", ROSTER, "--out", str(tmp_path / "afile" / "x"))
    assert found.exit_code == 1
    assert "afile is a file" in found.stderr


@pytest.mark.slow
def test_a_match_that_is_listed_twice_in_a_week_is_a_warning(run, tmp_path):
    fixtures = tmp_path / "fixtures.csv"
    fixtures.write_text("week,player_a,player_b\n1,Ann,Bo\n2,Ann,Bo\n1,bo,ann\n")
    words = ("simulate", "-", "--schedule", str(fixtures), *FEW, "--no-matches")
    text = "player,rating\nAnn,80\nBo,70\n"
    found = run(*words, "--out", str(tmp_path / "out"), stdin=text)
    assert found.exit_code == 0
    assert "fixtures.csv:4:" in found.stderr
    assert found.stderr.count("Warning") == 1


def test_two_files_cannot_both_be_standard_input(run, tmp_path):
    found = run("simulate", "-", "--schedule", "-", "--out", str(tmp_path / "out"))
    assert found.exit_code == 2
    assert "can stand for only one file" in found.stderr


@pytest.mark.parametrize(
    ("roster", "schedule", "words"),
    [
        ("player,rating\nAnn,high\nAnn,80\n", None, ":2: rating 'high'"),
        ("player,rating\nAnn,80\nBo,70\n", "week,player_a,player_b\n1,Ann,Cy\n", "'Cy'"),
        ("player,rating\nAnn,80\n", None, "roster.csv"),
        ("", None, "is empty"),
    ],
)
def test_bad_files_are_refused_and_nothing_is_written(run, tmp_path, roster, schedule, words):
    place, out = tmp_path / "roster.csv", tmp_path / "out"
    place.write_text(roster)
    options = []
    if schedule is not None:
        (tmp_path / "fixtures.csv").write_text(schedule)
        options = ["--schedule", str(tmp_path / "fixtures.csv")]
    found = run("simulate", str(place), *options, "--out", str(out))
    assert found.exit_code == 3
    assert words in found.stderr
    assert not out.exists()


@pytest.mark.usefixtures("no_pictures")
def test_a_roster_can_come_in_by_a_pipe(run, tmp_path):
    text = "player,rating\nAnn,80.5\nBo,70\n"
    found = run("simulate", "-", *FEW, "--weeks", "2", "--out", str(tmp_path / "o"), stdin=text)
    assert found.exit_code == 0
    assert "1 rating was rounded" in found.stderr
    assert "2 of 2 players" in found.stderr


@pytest.mark.usefixtures("no_pictures")
def test_a_season_without_matches(run, tmp_path):
    text = "player,rating,absence\nAnn,80,1\nBo,70,\n"
    words = ("simulate", "-", *FEW, "--weeks", "2", "--out", str(tmp_path / "o"), "--json")
    told = json.loads(run(*words, stdin=text).stdout)
    assert told["matches_a_season"] == 0.0
    assert len(told["sentences"]) == 1


@pytest.mark.usefixtures("no_pictures")
@pytest.mark.parametrize(
    ("joins", "leaves", "gone", "words"),
    [
        (2, "", (0, 1), ("After week 2", "In 1 of 4 weeks", "weeks 2 to 4")),
        (1, 3, (4,), ("At the start", "In 1 of 4 weeks", "weeks 1 to 3")),
    ],
)
def test_weeks_in_which_nobody_is_there_are_left_empty(run, tmp_path, joins, leaves, gone, words):
    text = f"player,rating,joins,leaves\nAnn,80,{joins},{leaves}\nBo,70,{joins},{leaves}\n"
    out = tmp_path / "o"
    asked = ("simulate", "-", *FEW, "--weeks", "4", "--out", str(out), "--text")
    said = " ".join(run(*asked, stdin=text).stdout.split())
    for word in words:
        assert word in said
    assert "nan" not in said
    rows = rows_of(out / "ratings_by_week.csv")
    for week, row in enumerate(rows):
        told = {name: value for name, value in row.items() if name not in ("week", "players")}
        assert all(value == "" for value in told.values()) == (week in gone)
        assert (float(row["players"]) == 0.0) == (week in gone)
    summary = {row["quantity"]: row["value"] for row in rows_of(out / "summary.csv")}
    assert float(summary["error_sd_end"]) > 0.0


@pytest.mark.usefixtures("no_pictures")
def test_a_league_that_nobody_ever_joins_has_no_errors(run, tmp_path):
    text = "player,rating,joins\nAnn,80,9\nBo,70,9\n"
    words = ("simulate", "-", *FEW, "--weeks", "4", "--out", str(tmp_path / "o"), "--json")
    assert "error_sd_start" not in json.loads(run(*words, stdin=text).stdout)


@pytest.mark.usefixtures("no_pictures")
def test_one_season_has_no_standard_errors(run, tmp_path):
    asked = ("simulate", ROSTER, "--replicas", "1", "--no-matches", "--out", str(tmp_path / "out"))
    assert json.loads(run(*asked, "--json").stdout)["standard_errors"] == {}
    assert "±" not in run(*asked, "--text").stdout


@pytest.mark.usefixtures("no_pictures")
def test_much_to_play_is_said_and_jobs_advised_where_there_are_none(run, monkeypatch, tmp_path):
    monkeypatch.setattr("evenbreak.cli.league.simulate.LONG", 1)
    words = ("simulate", ROSTER, *FIXTURES, *FEW, "--no-matches", "--out", str(tmp_path / "out"))
    assert "4,800 matches will be played; --jobs" in run(*words).stderr
    assert "4,800 matches will be played\n" in run(*words, "--jobs", "2").stderr


@pytest.mark.slow
def test_entrants_play_and_strangers_are_new(run, tmp_path):
    entrants = tmp_path / "entrants.txt"
    roster = DATA / "demo_league_roster.csv"
    names = [line.split(",")[0] for line in roster.read_text(encoding="utf-8").splitlines()[1:4]]
    entrants.write_text("\n".join([*names, "A Stranger"]), encoding="utf-8")
    words = ("--weeks", "3", "--replicas", "10", "--out", str(tmp_path / "o"))
    result = run("simulate", str(roster), *words, "--players-file", str(entrants))
    assert result.exit_code == 0
    standings = (tmp_path / "o" / "standings.csv").read_text(encoding="utf-8").splitlines()[1:]
    assert {line.split(",")[0] for line in standings} == {*names, "A Stranger"}
