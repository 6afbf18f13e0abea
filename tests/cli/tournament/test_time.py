"""`evenbreak tournament time`: when tonight's tournament ends."""

import csv
import json

import pytest

from evenbreak.files.store.tournament import add_events, read_tournament
from tournament_nights import timed_night

NAMES = "Ann\nBo\nCy\nDi\nEd\nFlo\nGus\nHal\n"


@pytest.fixture
def entrants(tmp_path):
    path = tmp_path / "entrants.txt"
    path.write_text(NAMES)
    return str(path)


@pytest.fixture
def times(run, entrants):
    def ask(*words):
        result = run("tournament", "time", entrants, "--race", "5", *words, "--json")
        assert result.exit_code == 0, result.stderr
        return json.loads(result.stdout)

    return ask


def test_the_finish_and_each_start(times):
    answer = times("--tables", "4", "--discipline", "9-ball")
    assert answer["finish_p10"] < answer["finish_p50"] < answer["finish_p90"]
    starts = {match["match"]: match for match in answer["matches"]}
    assert len(starts) == 15
    assert starts[1]["start_p50"] == 0.0
    assert starts[1]["player_1"] == "Ann"
    assert starts[14]["player_2"] == "winner of 13"
    assert starts[15]["p_played"] == pytest.approx(0.5, abs=0.05)
    assert starts[14]["start_p90"] < answer["finish_p90"]


@pytest.mark.slow
def test_tables_races_and_pace_matter(times):
    four = times("--tables", "4", "--discipline", "9-ball")
    two = times("--tables", "2", "--discipline", "9-ball")
    three = times("--tables", "3", "--discipline", "9-ball")
    assert two["finish_p50"] > four["finish_p50"]
    saved = two["minutes_saved_one_more_table"]
    assert saved == pytest.approx(two["finish_p50"] - three["finish_p50"], abs=15.0)
    assert four["minutes_saved_races_one_shorter"] > 10.0
    slow = times("--tables", "4", "--minutes-per-game", "12")
    idle = times("--tables", "4", "--discipline", "9-ball", "--turnover", "20")
    assert slow["finish_p50"] > four["finish_p50"]
    assert idle["finish_p50"] > four["finish_p50"] + 10.0


def test_rounds_of_a_swiss_that_are_not_paired_yet(times):
    answer = times("--tables", "4", "--discipline", "9-ball", "--format", "swiss", "--rounds", "2")
    assert len(answer["matches"]) == 8
    second = [match for match in answer["matches"] if match["match"] > 4]
    assert {match["player_1"] for match in second} == {"to be drawn"}
    assert min(match["start_p10"] for match in second) > 10.0


def test_times_of_day_are_for_people_alone(run, entrants):
    words = ("--race", "5", "--tables", "4", "--discipline", "9-ball", "--start", "18:30")
    shown = run("tournament", "time", entrants, *words, "--text").stdout
    assert "18:30" in shown
    rows = list(csv.DictReader(run("tournament", "time", entrants, *words).stdout.splitlines()))
    assert rows[0]["start_p50"] == "0.000000"


@pytest.mark.parametrize(
    ("words", "named"),
    [
        (("--tables", "4"), "--discipline"),
        (("--discipline", "9-ball"), "--tables"),
        (("--tables", "0", "--discipline", "9-ball"), "--tables"),
        (("--tables", "4", "--discipline", "9-ball", "--start", "25:00"), "25:00"),
        (("--tables", "4", "--discipline", "9-ball", "--minutes-per-game", "6"), "--discipline"),
    ],
)
def test_wrong_options_are_refused(run, entrants, words, named):
    result = run("tournament", "time", entrants, "--race", "5", *words)
    assert result.exit_code == 2
    assert named in result.stderr


@pytest.mark.slow
def test_earlier_nights_set_the_pace(run, times, entrants, tmp_path):
    last = str(tmp_path / "last.db")
    new = ("tournament", "new", entrants, "--race", "5", "--tables", "4")
    assert run(*new, "--out", last).exit_code == 0
    events = timed_night(list(read_tournament(last).events), "2025-03-01T19:30:00", slow=1.3)
    add_events(last, lambda state: events[len(state.events) :])
    ask = ("--tables", "4", "--discipline", "9-ball")
    usual, file, folder = (
        times(*ask, *more) for more in ((), ("--pace", last), ("--pace", str(tmp_path)))
    )
    assert file["finish_p50"] > 1.03 * usual["finish_p50"]
    assert file["finish_p50"] == folder["finish_p50"]
    said = run("tournament", "time", entrants, "--race", "5", *ask, "--pace", last, "--pace", last)
    assert "Your last night of 9-ball at this venue ran" in said.stdout + said.stderr
    tonight = run(*new, str(tmp_path / "tonight.db"), "--pace", last)
    assert "because part of the difference may be chance." in tonight.stderr
    assert f"evenbreak tournament draw --file {tmp_path / 'tonight.db'}" in tonight.stderr
    other = ("--tables", "4", "--discipline", "8-ball", "--pace", last)
    assert times(*other)["finish_p50"] == times(*other[:4])["finish_p50"]
    said = run("tournament", "time", entrants, "--race", "5", *other)
    assert "no finished 8-ball tournament there" in said.stderr
    gone = ("--tables", "4", "--discipline", "9-ball", "--pace", "gone.db")
    refused = run("tournament", "time", entrants, "--race", "5", *gone)
    assert (refused.exit_code, "doesn't exist" in refused.stderr) == (2, True)
    own = ("--tables", "4", "--minutes-per-game", "8", "--pace", last)
    assert run("tournament", "time", entrants, "--race", "5", *own).exit_code == 2
