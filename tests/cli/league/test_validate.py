"""`evenbreak validate`, as a person, a spreadsheet and a program meet it."""

import csv
import io
import json
import random

import pytest

from places import DATA
from rows import each_of

DEMO = str(DATA / "demo_league.csv")
SD = ("--prior", "22")


def test_a_pipe_gets_one_tidy_table(run):
    found = run("validate", DEMO, *SD)
    assert found.exit_code == 0
    rows = list(csv.DictReader(io.StringIO(found.stdout)))
    assert ",".join(rows[0]) == "part,of,item,count,expected,value,low,high,p_value"
    parts = {row["part"] for row in rows}
    assert {"log_loss", "brier", "slope", "gain", "calibration", "dispersion", "spot"} <= parts
    (every,) = (row for row in rows if (row["part"], row["item"]) == ("spot", "all"))
    assert (every["count"], every["value"]) == ("351", f"{186 / 351:.6f}")


def test_only_racks_with_a_known_breaker_count_for_the_break(run, tmp_path):
    rng = random.Random(1)
    lines = ["date,player_a,player_b,score_a,score_b,racks,first_break,break_format"]
    for day in range(1, 21):
        racks = "".join(rng.choice("ab") for _ in range(8)) + "a" * 8
        for row in (f"{racks},a,alternate", ",,"):
            score = f"{racks.count('a')},{racks.count('b')}"
            lines.append(f"2024-09-{day:02d},Ann,Bo,{score},{row}")
    place = tmp_path / "results.csv"
    place.write_text("\n".join(lines) + "\n")
    found = run("validate", str(place), *SD)
    rows = {row["part"]: row for row in csv.DictReader(io.StringIO(found.stdout))}
    assert (rows["breaker"]["count"], rows["side"]["count"]) == ("320", "640")


def test_best_is_a_word_for_the_default_prior(run, tmp_path):
    place = tmp_path / "results.csv"
    place.write_text(
        "date,player_a,player_b,score_a,score_b\n2024-09-03,A,B,7,5\n2024-09-04,A,B,7,2\n"
    )
    named, plain = run("validate", str(place), "--prior", "best"), run("validate", str(place))
    assert named.exit_code == 0
    assert named.stdout == plain.stdout


def test_json_has_the_verdict_too(run):
    found = json.loads(run("validate", DEMO, *SD, "--json").stdout)
    assert found["verdict"] == found["sentences"][0]
    assert (found["matches_read"], found["forfeits"], found["empty"]) == (395, 11, 2)
    assert found["schema_version"] == 1


@pytest.mark.slow
def test_a_picture_is_written(run, tmp_path):
    place = tmp_path / "calibration.svg"
    assert run("validate", DEMO, *SD, "--plot", str(place)).exit_code == 0
    assert place.read_bytes().startswith(b"<?xml")


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("player_a,player_b,score_a,score_b\nA,B,7,5\n", "no dates"),
        ("date,player_a,player_b,score_a,score_b\n2024-09-03,A,B,7,5\n", "1 date"),
    ],
)
def test_a_file_without_an_order_in_time_is_refused(run, tmp_path, text, words):
    place = tmp_path / "results.csv"
    place.write_text(text)
    found = run("validate", str(place))
    assert found.exit_code == 3
    assert words in found.stderr


@each_of("option", ["--prior", "--half-life"])
@each_of("value", ["0", "-1", "much", "nan", "1e9", "0.001"])
def test_numbers_out_of_range_are_refused(run, option, value):
    found = run("validate", DEMO, option, value)
    assert found.exit_code == 2
    assert option in found.stderr


@pytest.mark.parametrize(
    ("options", "words"),
    [
        (("--jobs", "2", "--dask", "tcp://x:1"), "--dask and --jobs can't be used together;"),
        (("--dask", " "), "--dask must not be empty"),
        (("--jobs", "0"), "'0'"),
    ],
)
def test_two_kinds_of_workers_are_refused(run, options, words):
    found = run("validate", DEMO, *options)
    assert found.exit_code == 2
    assert words in found.stderr


@pytest.mark.slow
def test_two_processes_write_the_same_bytes(run):
    alone, shared = (run("validate", DEMO, "--json", "--jobs", jobs) for jobs in "12")
    assert alone.stdout == shared.stdout
