"""Games in place of errors: every command takes the same error from them."""

from __future__ import annotations

import json
import math
from pathlib import Path
from typing import Any

import pytest
from click.testing import CliRunner

from evenbreak.cli.program import program
from evenbreak.files.store.tournament import read_tournament

NAMES = ("Ann", "Bo", "Cy", "Di")
RATINGS = (612, 540, 500, 480)
GAMES = (12, 0, 400, 1)
ERRORS = tuple(min(100.0, 2 * 100 / math.log(2) / math.sqrt(max(n, 1))) for n in GAMES)
COMMANDS = (
    "odds Ann Bo --race 7 --from {list}",
    "odds Cy Di --race 7 --from {list}",
    "matchups {list} --race-to 7",
    "tournament odds {list} --race 5",
    "lineup {list} {list2} --race 5",
    "round {list} {list2} --race 5",
)


def written(path: Path, column: str, values: tuple[float | None, ...]) -> dict[str, str]:
    """Write a list with a column besides the ratings, None for an empty cell, and another list."""
    found = {}
    for key, prefix in (("list", ""), ("list2", "Other ")):
        rows = zip(NAMES, RATINGS, values, strict=True)
        lines = [
            f"{prefix}{name},{rating},{'' if value is None else value}"
            for name, rating, value in rows
        ]
        file = path / f"{column}{key}{values.count(None)}.csv"
        file.write_text("\n".join([f"player,rating,{column}", *lines]))
        found[key] = str(file)
    return found


def numbers(value: Any) -> list[float]:
    """Return all numbers of an answer, in its order."""
    if isinstance(value, dict):
        return [n for one in value.values() for n in numbers(one)]
    if isinstance(value, list):
        return [n for one in value for n in numbers(one)]
    return [value] if isinstance(value, float) else []


def run(words: str) -> Any:
    result = CliRunner().invoke(program, words.split())
    assert result.exit_code == 0, result.output
    return json.loads(result.stdout)


@pytest.mark.slow
@pytest.mark.parametrize("command", COMMANDS)
def test_games_mean_the_same_error_in_every_command(tmp_path: Path, command: str) -> None:
    by_games = run(f"{command} --json".format(**written(tmp_path, "games", GAMES)))
    by_errors = run(f"{command} --json".format(**written(tmp_path, "standard_error", ERRORS)))
    assert len(numbers(by_games)) > 5
    # In lists with games those with too few come last.
    found, wanted = sorted(numbers(by_games)), sorted(numbers(by_errors))
    assert found == pytest.approx(wanted, abs=1e-9)


@pytest.mark.slow
@pytest.mark.parametrize("command", COMMANDS)
def test_a_rating_without_a_number_of_games_is_none_that_rests_on_any_number(
    tmp_path: Path, command: str
) -> None:
    silent = written(tmp_path, "games", (12, None, 400, 1))
    by_none = run(f"{command} --json".format(**written(tmp_path, "games", GAMES)))
    answer = run(f"{command} --json".format(**silent))
    assert numbers(answer) == pytest.approx(numbers(by_none), abs=1e-12)
    if "Cy Di" not in command:
        said = CliRunner().invoke(program, [*command.format(**silent).split(), "--text", "-v"])
        text = " ".join(said.output.split())
        assert "(Bo" in text or "Bo:" in text, text
        assert "as uncertain as a new player's, ± 100" in text


def test_games_mean_the_same_error_in_a_tournament_begun(tmp_path: Path) -> None:
    lists = written(tmp_path, "games", GAMES)
    words = f"tournament new {lists['list']} --race 5 --tables 2 --out {tmp_path / 'tonight.db'}"
    result = CliRunner().invoke(program, words.split())
    assert "The errors of 4 ratings were worked out from the number of games" in result.output
    entrants = read_tournament(tmp_path / "tonight.db").entrants.values()
    assert [one.standard_error for one in entrants] == pytest.approx(ERRORS)


def test_more_games_make_the_favorite_surer(tmp_path: Path) -> None:
    titles = []
    for games in (0, 1, 12, 50, 200, 1000):
        lists = written(tmp_path, "games", (games,) * 4)
        found = run(f"tournament odds {lists['list']} --race 5 --seed 3 --json")
        titles.append(next(one["p_title"] for one in found["players"] if one["name"] == "Ann"))
    assert titles == sorted(titles)
    assert titles[0] == titles[1]
