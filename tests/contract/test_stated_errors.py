"""Every command that draws random numbers states an error, by which seeds differ."""

import json
import shlex
from collections.abc import Callable, Iterator
from functools import cache
from pathlib import Path
from typing import Any, NamedTuple

import click
import numpy as np
import pytest
from click.testing import CliRunner

from evenbreak.cli.program import program
from evenbreak.ratings.estimates import END_ERROR
from places import ROOT
from tries import tries

MOST = 1.7
"""Seeds may differ by so many times the stated error: four of them do so by luck once in 500."""

LEAST = 0.2
"""And by so many times at least: less once in 100."""

Figures = dict[str, tuple[float, float]]
"""The figures of an answer, each with its standard error."""


class Drawn(NamedTuple):
    """A question for a command that draws, how it states its errors, and what they are at least."""

    asked: str
    figures: Callable[[dict[str, Any]], Figures]
    least: float = LEAST


def table(name: str, column: str, error: str) -> Callable[[dict[str, Any]], Figures]:
    def figures(answer: dict[str, Any]) -> Figures:
        return {str(k): (row[column], row[error]) for k, row in enumerate(answer[name])}

    return figures


TITLES = table("players", "p_title", "p_title_error")


def stated(answer: dict[str, Any], words: str) -> float:
    """Return the standard error that a sentence states: half of what 19 seeds in 20 keep to."""
    (text,) = [one for one in answer["sentences"] if words in one]
    return float(text.partition(words)[2].split()[0]) / 200.0


def of_chips(answer: dict[str, Any]) -> Figures:
    # The worst of all players is stated; the rows of a chart are means over several of them.
    error = stated(answer, "would move no title odds by more than about ")
    rows = [row for row in answer["rows"] if row["players"] == 1]
    return {str(row["band_from"]): (row["p_title"], error) for row in rows}


def of_season(answer: dict[str, Any]) -> Figures:
    # The largest error is stated, that of the chances nearest to a half.
    return {row["team"]: (row["p_title"], answer["standard_error"]) for row in answer["teams"]}


def of_finish(answer: dict[str, Any]) -> Figures:
    later = table("what_if", "minutes_later", "minutes_later_error")(answer)
    return later | {"p90": (answer["finish_p90"], answer["finish_error"])}


def of_evening(answer: dict[str, Any]) -> Figures:
    (found,) = answer["evening"]
    return {key: (found[key], found[f"{key}_error"]) for key in ("mean_minutes", "minutes_p90")}


def of_league(answer: dict[str, Any]) -> Figures:
    return {
        row["quantity"]: (row["value"], row["standard_error"])
        for row in answer["summary"]
        if row["standard_error"] is not None
    }


def of_tests(answer: dict[str, Any]) -> Figures:
    tests = {name: answer[name] for name in ("difference", "memory", "model_test")}
    return {name: (test["p_value"], test["p_error"]) for name, test in tests.items()}


def of_intervals(answer: dict[str, Any]) -> Figures:
    """The ends of bootstrapped intervals."""
    ends: Figures = {}
    for row in answer["findings"]:
        if row["part"] in ("log_loss", "brier") and row["item"] == "plug-in":
            error = END_ERROR * (row["high"] - row["low"])
            name = f"{row['part']} {row['of']}"
            ends |= {f"{name} {end}": (row[end], error) for end in ("low", "high")}
    return ends


CASES = {
    "season": Drawn(
        # Strengths that are hardly known, and so many seasons that their luck is the most of it.
        "season TEAMS --meetings 3 --seasons 20000",
        of_season,
    ),
    "lineup": Drawn("lineup US THEM --race 2 --sets 1", table("options", "p_best", "p_best_error")),
    "tournament odds": Drawn("tournament odds FIELD --race 3 --format single", TITLES),
    "tournament odds, before the draw": Drawn(
        "tournament odds FIELD --race 3 --format single --before-draw", TITLES
    ),
    "tournament odds, Swiss": Drawn("tournament odds FIELD --race 3 --format swiss --sure", TITLES),
    # Evenings spread their luck evenly (a Latin hypercube): the error stated is the largest.
    "tournament time": Drawn(
        "tournament time FIELD --race 3 --tables 2 --minutes-per-game 8", of_finish, least=0.1
    ),
    "chips odds": Drawn("chips odds FIELD --chips hoboken", TITLES),
    "chips audit": Drawn("chips audit hoboken --entrants FIELD", of_chips),
    "chips design": Drawn("chips design FIELD --bands 600 --most 3", of_chips),
    "matchups": Drawn("matchups TRIO --race-to 4 --minutes-per-game 8 --tables 2", of_evening),
    "simulate": Drawn("simulate LEAGUE --weeks 3 --replicas 40 --no-matches --out OUT", of_league),
    "drill": Drawn("drill --log data/drill_log.csv", of_tests),
    "validate": Drawn("validate RESULTS", of_intervals),
}

SEEDS = tries("seeds of a command", 4, parts=len(CASES))

LOTS = ("tournament new", "tournament draw", "tournament tiebreak")
"""Commands that draw lots, and estimate nothing."""


def commands(
    group: click.Command = program, path: tuple[str, ...] = ()
) -> Iterator[tuple[str, click.Command]]:
    if not isinstance(group, click.Group):
        yield " ".join(path), group
        return
    context = click.Context(group)
    for name in group.list_commands(context):
        command = group.get_command(context, name)
        assert command is not None
        yield from commands(command, (*path, name))


def test_every_command_with_a_seed_is_tried() -> None:
    seeded = {
        name for name, command in commands() if any(one.name == "seed" for one in command.params)
    }
    assert {name.partition(",")[0] for name in CASES} | {*LOTS} == seeded


def test_every_answer_that_plays_evenings_out_states_its_error() -> None:
    """Those under way have no seed, and draw all the same; `test_faces` holds them to this."""
    shapes = json.loads((ROOT / "docs" / "reference" / "answers.schema.json").read_text("utf-8"))
    names = {name: shape.get("required", []) for name, shape in shapes["$defs"].items()}
    drawn = {name for name, required in names.items() if "finish_p90" in required}
    assert drawn == {f"tournament {name}" for name in ("time", "next", "show")}
    assert {name for name, required in names.items() if "finish_error" in required} == drawn


@cache
def files(folder: Path) -> dict[str, str]:
    """Small files to ask about."""
    rows = {
        "FIELD": "A,620,30,fargo\nB,560,40,fargo\nC,530,30,fargo\nD,500,25,fargo\nE,480,25,fargo",
        "US": "A,560,40,fargo\nB,550,40,fargo",
        "THEM": "C,560,30,fargo\nD,500,25,fargo",
        "TRIO": "A,560,40,fargo\nB,550,40,fargo\nC,530,30,fargo",
        "LEAGUE": "A,100,8,npl\nB,90,9,npl\nC,80,6,npl\nD,70,7,npl\nE,60,6,npl\nF,50,9,npl",
    }
    found = {}
    for name, text in rows.items():
        found[name] = str(folder / f"{name}.csv")
        header = "player,rating,standard_error,scale\n"
        Path(found[name]).write_text(f"{header}{text}\n", encoding="utf-8")
    season = (ROOT / "data" / "demo_league.csv").read_text(encoding="utf-8").splitlines(True)
    texts = {
        "RESULTS": "".join(season[:80]),
        "TEAMS": "home,away,home_score,away_score\nA,B,3,2\nC,D,4,1\n",
    }
    for name, text in texts.items():
        found[name] = str(folder / f"{name}.csv")
        Path(found[name]).write_text(text, encoding="utf-8")
    return found


def figures(name: str, folder: Path) -> list[Figures]:
    found = []
    for seed in range(1, SEEDS + 1):
        line = CASES[name].asked
        for key, path in {**files(folder), "OUT": str(folder / "out")}.items():
            line = line.replace(key, path)
        asked = [*shlex.split(line), "--seed", str(seed), "--json"]
        result = CliRunner().invoke(program, asked, catch_exceptions=False)
        assert result.exit_code == 0, result.output
        found.append(CASES[name].figures(json.loads(result.stdout)))
    return found


@pytest.mark.slow
@pytest.mark.parametrize("name", CASES)
def test_seeds_differ_by_the_error_stated(
    name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(ROOT)
    # Pictures take longer than all the rest.
    monkeypatch.setattr("evenbreak.cli.league.simulate._pictures", lambda _: {})
    # Fewer draws have larger errors, which must be the ones stated.
    monkeypatch.setattr("evenbreak.answers.team.lineup.MOST_DRAWS", 50)
    found = figures(name, tmp_path)
    keys = [key for key in found[0] if all(key in each for each in found)]
    values, errors = (
        np.array([[each[key][side] for key in keys] for each in found]) for side in (0, 1)
    )
    assert errors.any()
    spread = np.sqrt(values.var(axis=0, ddof=1).sum() / (errors**2).mean(axis=0).sum())
    assert CASES[name].least < spread < MOST
