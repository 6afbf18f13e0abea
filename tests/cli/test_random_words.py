"""Whatever words are typed behind a command, it answers, or says in one line what is wrong."""

from __future__ import annotations

import random
import re
from pathlib import Path

import click
import pytest
from click.testing import CliRunner

from contract.test_stated_errors import commands
from evenbreak.cli.program import program
from files.test_mutated_files import CHIPS, LEVELS, TEAM, first
from tries import tries

WORDS = tries("words of a command", 30)
LEFT_OUT = ("serve", "reproduce", "demo", "report", "publish")
"""Those that run on, take long, or write more than a file."""

SLOW = {
    *("--replicas", "--seasons", "--evenings", "--weeks", "--matches", "--racks", "--tries"),
    *("--samples", "--draws", "--simulations", "--workers", "--plot", "--html", "--pdf", "--help"),
    *("--out", "--save", "--cards", "--dask", "--jobs"),
}
"""Options whose large values take long, or that write files."""

ODD = (
    *("", " ", "0", "-1", "1", "2", "7", "0.5", "1.5", "1e-300", "1e308", "1e999", "nan", "inf"),
    *("-inf", "9" * 25, "7:5", "5:7", "0:0", "1:1:1", ":", "a", "A=B", "=", "600", "--", "-", "²"),
    *("nothing.csv", "/", ".", "fargo", "npl", "elo", "x" * 300, "é", "\u202e", "50/30/20", "1,2"),
    *("9-ball", "winner", "alternate", "2026-13-01", "25:61", "20:00", "{}", "[1]", "%s", "\n"),
)
FILES = {
    "field.csv": first("demo_entrants.csv", 7), "league.csv": first("demo_league.csv"),
    "team.csv": TEAM, "levels.csv": LEVELS, "chips.csv": CHIPS,
    "nights.csv": first("demo_team_results.csv", 12), "arcs.csv": first("safety_battle.csv"),
    "scores.csv": first("practice_scores.csv"), "pairs.csv": first("demo_pairs.csv", 3),
}  # fmt: skip


def value(luck: random.Random, parameter: click.Parameter) -> list[str]:
    """Return a value for an option or an argument, which may well be wrong."""
    if isinstance(parameter.type, click.Choice) and luck.random() < 0.7:
        return [str(luck.choice(list(parameter.type.choices)))]
    if luck.random() < 0.35:
        return [luck.choice(list(FILES))]
    return [luck.choice(ODD) for _ in range(max(1, parameter.nargs))]


def words(luck: random.Random, command: click.Command) -> list[str]:
    asked: list[str] = []
    for one in command.params:
        if isinstance(one, click.Argument):
            if one.required or luck.random() < 0.5:
                asked += value(luck, one)
        elif (
            isinstance(one, click.Option)
            and not SLOW & {*one.opts}
            and luck.random() < (0.9 if one.required else 0.15)
        ):
            asked.append(luck.choice([*one.opts, *one.secondary_opts]))
            if not (one.is_flag or one.count):
                asked += value(luck, one)
    if luck.random() < 0.1:
        asked.insert(luck.randrange(len(asked) + 1), luck.choice(("--nothing", "-x", *ODD)))
    return asked


def test_any_words_are_answered_or_refused(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    every = [(name, one) for name, one in commands() if name not in LEFT_OUT]
    for seed in range(WORDS):
        for name, text in FILES.items():
            Path(name).write_text(text, encoding="utf-8")
        luck = random.Random(seed)
        name, command = every[seed % len(every)]
        asked = [*name.split(), *words(luck, command)]
        ran = CliRunner().invoke(program, asked, input="")
        said = f"seed {seed}, {asked}: {ran.exit_code} {ran.exception!r} {ran.stderr[-400:]}"
        assert isinstance(ran.exception, SystemExit | None), said
        assert ran.exit_code in (0, 1, 2, 3), said
        if ran.exit_code == 1:  # there are only answers too large, and files that cannot be opened
            assert re.search("Is a directory|larger than the largest|No such file", said), said
        if ran.exit_code:
            errors = [line for line in ran.stderr.splitlines() if line.startswith("Error: ")]
            assert errors, said
            assert not re.search(r"Error\(|object at 0x|<class|Traceback", ran.stderr), said
