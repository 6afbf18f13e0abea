"""--via on every command that answers for a chain: one answer, and how far apart the ways are."""

import json

import pytest

from evenbreak.chains.ways import WAYS

ROADS = ("elimination", "eigen")
COMMANDS = (
    "odds --p 0.6 --race 7:5",
    "odds 612 521 --scale fargo --race 5:4 --score 2:1",
    "odds --p1 0.6 --p2 0.5 --breaks winner --ahead 3:2",
    "odds --p 0.66 --race 3:1 --set 3:3",
    "odds --p1 0.55 --p2 0.5 --breaks winner --race 150:150",
    "odds --p 0.5001 --ahead 100:100",
    "fair --p1 0.6 --p2 0.5 --breaks alternate --games 5..9",
    "oneball --shot 0.4:0.8:0.5:0.2 --shot 0.3:0.3",
    "breaks --p1 0.9 --p2 0.5 --win 1 --lose 2",
    "breaks --p1 0.5 --p2 1 --first-break b",
    "drill --p 0.8",
    "drill --p 0.8 --game 8-ball",
    *(f"ladder --chart {name}" for name in ("npl_8", "npl_10", "npl_12", "npl_20")),
    "ladder --step 3 --equal-skill --drift 0.1",
)


@pytest.fixture(scope="session")
def ask(run):
    def answer(*words):
        result = run(*words, "--json")
        assert (result.exit_code, result.stderr) == (0, "")
        return json.loads(result.stdout)

    return answer


def numbers(value):
    """Yield the numbers of a JSON, in order."""
    if isinstance(value, dict):
        value = list(value.values())
    if isinstance(value, list):
        for one in value:
            yield from numbers(one)
    elif isinstance(value, (int, float)):
        yield value


@pytest.mark.slow_after(5)
@pytest.mark.parametrize("via", WAYS)
@pytest.mark.parametrize("line", COMMANDS)
def test_the_answer_is_the_same_by_every_way(ask, line, via) -> None:
    usual, found = ask(*line.split()), ask(*line.split(), "--via", via)
    assert found.pop("via") == via
    apart = found.pop("kernel_difference")
    assert apart is None if via == "kernel" else 0.0 <= apart <= 1e-12
    for words in ("sentences", "details"):
        usual.pop(words)
        found.pop(words)
    assert found.keys() == usual.keys()
    assert list(numbers(found)) == pytest.approx(list(numbers(usual)), rel=1e-9, abs=1e-11)


@pytest.mark.parametrize("via", ROADS)
def test_a_chain_from_a_file(ask, via, tmp_path) -> None:
    line, battle = tmp_path / "line.csv", tmp_path / "battle.csv"
    line.write_text("source,target,probability\nA,A,0.5\nA,B,0.5\nB,A,0.5\nB,C,0.5\nC,B,1\n")
    battle.write_text("source,target,probability\nA,W,0.5\nA,B,0.5\nB,W,0.25\nB,L,0.25\nB,A,0.5\n")
    found = ask("chain", str(line), "--via", via)
    assert found["limit"] == pytest.approx({"A": 0.4, "B": 0.4, "C": 0.2}, rel=1e-14)
    assert found["kernel_difference"] <= 1e-15
    found = ask("chain", str(battle), "--via", via)
    assert found["limit"]["W"] == pytest.approx(5 / 6, rel=1e-14)
    apart = found["elimination_difference"]
    assert apart is None if via == "elimination" else apart <= 1e-15


def test_a_chain_without_a_closed_form_names_the_way_that_answers(run, tmp_path) -> None:
    battle = tmp_path / "battle.csv"
    battle.write_text("source,target,probability\nA,W,0.5\nA,B,0.5\nB,W,0.25\nB,L,0.25\nB,A,0.5\n")
    result = run("chain", str(battle), "--via", "kernel")
    assert result.exit_code == 1
    assert "Use elimination" in result.stderr


def test_a_race_is_defective_and_a_single_rack_is_not(ask) -> None:
    answer = ask("odds", *["--p", "0.6", "--race", "2:1", "--via", "eigen"])
    assert "defective" in answer["sentences"][-1]
    for line in ("--p 0.6 --race 1 --via eigen", "--p 0.6 --race 2:1 --via elimination"):
        assert "defective" not in json.dumps(ask("odds", *line.split())["sentences"])


@pytest.mark.parametrize(
    ("line", "named"),
    [
        ("odds --p 0.6 --race 5:4 --exact --via eigen", "--exact"),
        ("odds --p 0.6 --race 5:4 --via power", "'power'"),
        ("odds --p 0.6 --race 200 --via eigen", "25,000"),
        ("odds --p 0.6 --race 101 --win-by 2 --via eigen", "10,000"),
        ("fair --p 0.6 --race-to 60 --via eigen", "99"),
        ("drill --log data/drill_log.csv --via eigen", "--log"),
        ("ladder --compare --via eigen", "--via"),
    ],
)
def test_what_has_one_way_only_is_refused(run, line, named) -> None:
    result = run(*line.split())
    assert result.exit_code == 2
    assert named in result.stderr
