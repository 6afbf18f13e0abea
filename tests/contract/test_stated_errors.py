"""Every command that draws random numbers states an error, by which seeds differ.

Each figure that seeds move has an error beside it, or is named here with what bounds it.
"""

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
from scipy.stats import chi2

from evenbreak.arrays import Floats
from evenbreak.cli.program import program
from evenbreak.ratings.estimates import END_ERROR
from places import ROOT, SRC
from tries import tries

MOST = 1.7
"""Seeds may differ by so many times the stated error: four of them do so by luck once in 500."""

LEAST = 0.2
"""And by so many times at least: less once in 100."""

UNLIKELY = 1e-4
"""The chance below which luck does not explain how far one figure differs between seeds."""

Figures = dict[str, tuple[float, float]]
"""The figures of an answer, each with its standard error."""


class Drawn(NamedTuple):
    """A question for a command that draws, how it states its errors, and what they are at least."""

    asked: str
    figures: Callable[[dict[str, Any]], Figures]
    least: float = LEAST
    beside: str = ""
    """Figures without an error of their own: those of `figures`, and what depends on them."""


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
    error = stated(answer, "no title odds would move by more than about ")
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


ENDS = (
    *("findings", "gain.game", "gain.match", "scored.brier", "scored.log_loss", "skill"),
    *("usual.brier", "usual.log_loss"),
)
"""Intervals of `validate`, which are bootstrapped."""

CHIPS = "racks_mean spread rows.p_title rows.times_equal_share"
"""A sentence bounds how far title odds move; rows are means of them, and the spread is theirs."""

CASES = {
    "season": Drawn(
        # Strengths that are hardly known, and so many seasons that their luck is the most of it.
        "season TEAMS --meetings 3 --seasons 20000",
        of_season,
        # `standard_error` is the largest of all chances; a mean place is a sum of them.
        beside="teams.p_title teams.place_mean tonight.p_win tonight.p_if_won tonight.p_if_lost "
        "places.p_1 places.p_2 places.p_3 places.p_4",
    ),
    "lineup": Drawn("lineup US THEM --race 2 --sets 1", table("options", "p_best", "p_best_error")),
    "tournament odds": Drawn("tournament odds FIELD --race 3 --format single", TITLES),
    "tournament odds, before the draw": Drawn(
        "tournament odds FIELD --race 3 --format single --before-draw", TITLES
    ),
    "tournament odds, Swiss": Drawn("tournament odds FIELD --race 3 --format swiss --sure", TITLES),
    # Evenings spread their luck evenly (a Latin hypercube): the error stated is the largest.
    "tournament time": Drawn(
        "tournament time FIELD --race 3 --tables 2 --minutes-per-game 8",
        of_finish,
        least=0.1,
        # `finish_error` is the largest of the three; starts are rounded parts of such evenings.
        beside="finish_p10 finish_p50 finish_p90 minutes_saved_one_more_table "
        "minutes_saved_races_one_shorter matches.p_played matches.start_p10 matches.start_p50 "
        "matches.start_p90",
    ),
    "chips odds": Drawn("chips odds FIELD --chips hoboken", TITLES),
    "chips audit": Drawn("chips audit hoboken --entrants FIELD", of_chips, beside=CHIPS),
    "chips design": Drawn("chips design FIELD --bands 600 --most 3", of_chips, beside=CHIPS),
    "matchups": Drawn("matchups TRIO --race-to 4 --minutes-per-game 8 --tables 2", of_evening),
    "simulate": Drawn(
        "simulate LEAGUE --weeks 3 --replicas 40 --no-matches --out OUT",
        of_league,
        # Quantiles and spreads over the seasons describe how different those are.
        beside="points_sd_between_players points_sd_by_luck standings.points_p10 "
        "standings.points_p50 standings.points_p90 standings.points_sd standings.rating_p10 "
        "standings.rating_p50 standings.rating_p90 standings.rating_sd summary.value",
    ),
    "drill": Drawn(
        "drill --log data/drill_log.csv",
        of_tests,
        # A p-value has its error as `p_error`; ends of intervals have `END_ERROR`.
        beside="difference.by_chance difference.p_value drill_levels.expected drill_levels.lift "
        "drill_levels.lift_high drill_levels.lift_low drill_levels.p_best mean_high mean_low "
        "memory.by_chance memory.p_value model_test.by_chance model_test.p_value",
    ),
    "validate": Drawn(
        "validate RESULTS",
        of_intervals,
        # Ends of intervals have `END_ERROR`; a p-value of a simulated season is never quoted.
        beside=" ".join(
            [
                "dispersion.by_chance dispersion.p_value findings.expected findings.p_value",
                *(f"{of}.{end}" for of in ENDS for end in ("low", "high")),
            ]
        ),
    ),
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
    shapes = json.loads((SRC / "answers" / "answers.schema.json").read_text("utf-8"))
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


@pytest.fixture(scope="module")
def answers(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Callable[[str], list[Any]]]:
    """What each command says with each seed; a command is asked once for all tests."""
    folder = tmp_path_factory.mktemp("drawn")

    @cache
    def said(name: str) -> list[Any]:
        line = CASES[name].asked
        for key, path in {**files(folder), "OUT": str(folder / "out")}.items():
            line = line.replace(key, path)
        found = []
        for seed in range(1, SEEDS + 1):
            asked = [*shlex.split(line), "--seed", str(seed), "--json"]
            result = CliRunner().invoke(program, asked, catch_exceptions=False)
            assert result.exit_code == 0, result.output
            found.append(json.loads(result.stdout))
        return found

    with pytest.MonkeyPatch.context() as patch:
        patch.chdir(ROOT)
        # Pictures take longer than all the rest.
        patch.setattr("evenbreak.cli.league.simulate._pictures", lambda _: {})
        # Fewer draws have larger errors, which must be the ones stated.
        patch.setattr("evenbreak.answers.team.lineup.MOST_DRAWS", 50)
        yield said


QUICK = "tournament odds"
SLOW_BUT_ONE = [
    pytest.param(name, marks=[] if name == QUICK else pytest.mark.slow) for name in CASES
]


@pytest.mark.parametrize("name", SLOW_BUT_ONE)
def test_seeds_differ_by_the_error_stated(name: str, answers: Callable[[str], list[Any]]) -> None:
    found = [CASES[name].figures(answer) for answer in answers(name)]
    keys = [key for key in found[0] if all(key in each for each in found)]
    values, errors = (
        np.array([[each[key][side] for key in keys] for each in found]) for side in (0, 1)
    )
    assert errors.any()
    drawn, stated = values.var(axis=0, ddof=1), (errors**2).mean(axis=0)
    assert CASES[name].least < np.sqrt(drawn.sum() / stated.sum()) < MOST
    far = luck_of(drawn, stated)
    assert far.min() > UNLIKELY / len(keys), keys[int(far.argmin())]


def luck_of(drawn: Floats, stated: Floats) -> Floats:
    """Return how likely luck makes figures differ so much: their variances, drawn and stated."""
    ratio = np.divide(drawn, stated, out=np.where(drawn > 1e-12, np.inf, 0.0), where=stated > 0.0)
    return np.asarray(chi2.sf((SEEDS - 1) * ratio, SEEDS - 1))


@pytest.mark.parametrize("name", SLOW_BUT_ONE)
def test_what_seeds_move_has_an_error(name: str, answers: Callable[[str], list[Any]]) -> None:
    every = [dict(numbers(answer)) for answer in answers(name)]
    moved = [
        key for key, value in every[0].items() if any(one.get(key, value) != value for one in every)
    ]
    figures = [key for key in moved if not is_error(key)]
    known = {key: error for key in figures if (error := error_of(key, every[0]))}
    lacking = {pattern(key) for key in figures if key not in known}
    assert lacking <= {*CASES[name].beside.split()}
    both = [key for key, error in known.items() if all({key, error} <= {*one} for one in every)]
    drawn = np.array([[one[key] for one in every] for key in both]).reshape(len(both), SEEDS)
    error = np.array([[one[known[key]] for one in every] for key in both]).reshape(drawn.shape)
    far = luck_of(drawn.var(axis=1, ddof=1), (error**2).mean(axis=1))
    assert (far > UNLIKELY / max(len(both), 1)).all(), [both[k] for k in np.flatnonzero(far < 1e-3)]


ROW = ("name", "player", "team", "match", "quantity", "player_a")
"""What tells rows apart whose order seeds may change."""

ERRORS = ("error", "se", "standard_error")

Key = tuple[str, ...]


def numbers(answer: Any, key: Key = ()) -> Iterator[tuple[Key, float]]:
    """Yield each number of an answer, by the way to it; rows by whom they are about."""
    if isinstance(answer, dict):
        for name, one in answer.items():
            yield from numbers(one, (*key, name))
    elif isinstance(answer, list):
        for k, one in enumerate(answer):
            about = next((one[row] for row in ROW if row in one), k) if isinstance(one, dict) else k
            yield from numbers(one, (*key, f"[{about}]"))
    elif isinstance(answer, int | float) and not isinstance(answer, bool):
        yield key, answer


def pattern(key: Key) -> str:
    return ".".join(part for part in key if not part.startswith("["))


def error_of(key: Key, every: dict[Key, float]) -> Key | None:
    """Return where the error of a figure is; None: it has none."""
    *place, name = key
    beside = [f"{name}_{error}" for error in ERRORS]
    beside += ["standard_error", name.replace("_mean", "_se")]
    found = [(*place, one) for one in beside if one != name] + [("standard_errors", name)]
    return next((one for one in found if one in every), None)


def is_error(key: Key) -> bool:
    return key[-1] == "seed" or key[-1].endswith(ERRORS) or "standard_errors" in key
