"""Files as an accident or an attacker may leave them: each is read right, or refused in words."""

from __future__ import annotations

import csv
import io
import json
import random
import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from click.testing import CliRunner, Result

from evenbreak.cli.program import program
from evenbreak.errors import DataError
from evenbreak.files.results.results_file import read_results
from files.foreign.test_saved_tournament import challonge, cuescore
from files.mutants import VALUES
from places import ROOT
from tournament_nights import SAVED, night
from tries import tries

DATA = ROOT / "data"
TAMPERED = tries("files for a command", 20)
CHANGED = tries("files with a changed cell", 20)


def first(name: str, rows: int = 25) -> str:
    return "".join((DATA / name).read_text("utf-8").splitlines(keepends=True)[:rows])


def bracket(path: Path) -> str:
    """Return the event list of a small tournament."""
    asked = ["tournament", "import", str(SAVED / "brackets_manager_single8.json")]
    asked += ["--race", "5"]
    base = str(path / "made.db")
    assert CliRunner().invoke(program, [*asked, "--out", base]).exit_code == 0
    listed = CliRunner().invoke(program, ["tournament", "export", "--events", "--file", base])
    assert listed.exit_code == 0
    return listed.stdout


def saved(make: Callable[[Any], object], form: str, results: int) -> Callable[[Path], str]:
    return lambda _: json.dumps(make(night(8, form, results)))


LIST = "Ann Lee 612\nBo, 540\nCy\t500\nDi 480\n"
CHIPS = "rating_from,chips\n,8\n400,6\n550,4\n650,3\n"
TEAM = "player,rating,standard_error\nAnn,560,40\nBo,550,40\nCy,530,\n"
LEVELS = "level,opponent_level,needs,opponent_needs\n1,1,2,2\n1,2,2,3\n2,2,3,3\n"
GOOD: dict[str, Callable[[Path], str]] = {
    "rate {}": lambda _: first("demo_league.csv"),
    "rate {} --scale npl": lambda _: first("demo_winners.csv"),
    "matchups {} --race-to 4 --scale npl": lambda _: first("demo_roster.csv", 6),
    "matchups ROSTER --pairs {} --race-to 4 --scale npl": lambda _: first("demo_pairs.csv", 3),
    "rate LEAGUE --aliases {}": lambda _: first("demo_aliases.csv"),
    "tournament new {} --race 3 --tables 2 --out OUT": lambda _: first("demo_entrants.csv", 9),
    "tournament odds {} --race 3 --format single": lambda _: LIST,
    "chips odds FIELD --chips {}": lambda _: CHIPS,
    "chart audit {}": lambda _: first("house_chart.csv"),
    "chart show {}": lambda _: LEVELS,
    "drill --log {}": lambda _: first("drill_log.csv"),
    "practice {}": lambda _: first("practice_scores.csv"),
    "chain {}": lambda _: first("safety_battle.csv"),
    "season {} --meetings 1 --seasons 1000": lambda _: first("demo_team_results.csv", 12),
    "lineup {} US --race 2 --sets 2": lambda _: TEAM,
    "tournament import {} --out OUT": bracket,
    "tournament import {} --out OUT --race 5": saved(challonge, "double", 4),
    "tournament import {} --out OUT --race 6": saved(cuescore, "double", 9),
    "tournament import {} --out OUT --race 7": (
        lambda _: (SAVED / "brackets_manager_double8_all.json").read_text("utf-8")
    ),
    "rate {} --scale fargo": saved(cuescore, "single", 7),
}
CELLS = (
    *("", " ", "0", "-1", "1e999", "nan", "inf", "9" * 40, "1e-400", "0x10", "1,5", "½", "٣"),
    *("=cmd()", "\u202e", "🎱" * 50, "x" * 40_000, '"', '""', "\t", "\0", "2026-13-40", "yes"),
    *("Ann", "a", "b", "TRUE", "#REF!", "1/2", "7:5", "01.02.03", "-0", "+5", "5.0", "7-5", "1_0"),
)
BYTES = (b"", b",", b";", b'"', b"\n", b"\r", b"\xff", b"\0", b"\xef\xbb\xbf", b"\x1a", b"{", b"\t")


def tampered(text: str, luck: random.Random) -> bytes:
    """Return a file with something wrong in it, in one to three places."""
    if text.startswith("{"):
        return in_json(text, luck)
    content = text.encode()
    for _ in range(luck.randrange(1, 4)):
        how = luck.randrange(7)
        lines = content.split(b"\n")
        at = luck.randrange(len(lines))
        if how == 0:
            start = luck.randrange(len(content) + 1)
            content = content[:start] + luck.choice(BYTES) + content[start + luck.randrange(4) :]
        elif how == 1:
            content = b"\n".join(
                lines[:at] + [lines[at]] * luck.choice((0, 2, 30)) + lines[at + 1 :]
            )
        elif how == 2:
            cells = lines[at].split(b",")
            place = luck.randrange(len(cells))
            cells[place] = luck.choice(CELLS).encode("utf-8", "replace")
            content = b"\n".join([*lines[:at], b",".join(cells), *lines[at + 1 :]])
        elif how == 3:
            content = content[: luck.randrange(len(content) + 1)]
        elif how == 4:
            content = content.replace(b",", luck.choice((b";", b"\t", b",,", b"|")))
        elif how == 5:
            luck.shuffle(lines)
            content = b"\n".join(lines)
        else:
            coded = luck.choice(("utf-16", "utf-8-sig", "cp1252", "utf-32", "cp037"))
            content = content.decode("utf-8", "replace").encode(coded, "replace")
        if not content:
            break
    return content


def in_json(text: str, luck: random.Random) -> bytes:
    """Return JSON with other values in one to three places; now and then it is broken as a text."""
    data = json.loads(text)
    for _ in range(luck.randrange(1, 4)):
        where: Any = data
        while True:
            keys = list(where) if isinstance(where, dict) else list(range(len(where)))
            if not keys:
                break
            key = luck.choice(keys)
            if isinstance(where[key], dict | list) and luck.random() < 0.9:
                where = where[key]
                continue
            if luck.random() < 0.2:
                del where[key]
            else:
                where[key] = luck.choice((*VALUES, *CELLS, *range(-1, 12)))
            break
    content = json.dumps(data).encode("utf-8", "replace")
    return content[: luck.randrange(len(content))] if luck.random() < 0.05 else content


@pytest.fixture(scope="module")
def good(tmp_path_factory: pytest.TempPathFactory) -> dict[str, str]:
    folder = tmp_path_factory.mktemp("good")
    return {words: make(folder) for words, make in GOOD.items()}


def run(words: str, content: bytes, folder: Path) -> Result:
    """Let a command read a file; "OUT" is a new database, other capitals are good files."""
    kept = {"ROSTER": first("demo_roster.csv", 6), "LEAGUE": first("demo_league.csv"),
            "FIELD": first("demo_entrants.csv", 6), "US": TEAM}  # fmt: skip
    for name, text in kept.items():
        (folder / name).write_text(text, encoding="utf-8")
    file = folder / "given.csv"
    file.write_bytes(content)
    asked = words.format(file).split()
    asked = [str(folder / one) if one.isupper() and one.isalpha() else one for one in asked]
    asked = [str(folder / "out.db") if one.endswith("/OUT") else one for one in asked]
    return CliRunner().invoke(program, asked)


@pytest.mark.slow
def test_these_files_are_read(good: dict[str, str], tmp_path: Path) -> None:
    for words, text in good.items():
        ran = run(words, text.encode(), tmp_path)
        assert ran.exit_code == 0, (words, ran.output, ran.exception)
        (tmp_path / "out.db").unlink(missing_ok=True)


@pytest.mark.slow
def test_a_tampered_file_is_read_or_refused_in_words(good: dict[str, str], tmp_path: Path) -> None:
    for seed in range(TAMPERED):
        luck = random.Random(seed)
        words = list(good)[seed % len(good)]
        content = tampered(good[words], luck)
        ran = run(words, content, tmp_path)
        said = f"seed {seed}, {words}: {ran.exit_code} {ran.exception!r} {ran.stderr[-500:]}"
        assert ran.exit_code in (0, 2, 3), said
        assert isinstance(ran.exception, SystemExit | None), said
        if ran.exit_code:
            errors = re.findall(r"^Error: (.*)$", ran.stderr, re.MULTILINE)
            assert errors, said
            assert not re.search(r"Error\(|object at 0x|<class|Traceback", ran.stderr), said
            assert max(map(len, errors)) < 1000, said
            assert not (tmp_path / "out.db").exists(), said  # nothing half made
        if ran.exit_code == 3:
            assert any("given.csv" in line for line in errors), said
        (tmp_path / "out.db").unlink(missing_ok=True)


def test_a_changed_cell_changes_no_other_row(tmp_path: Path) -> None:
    header, *rows = csv.reader(io.StringIO(first("demo_league.csv")))
    path = tmp_path / "results.csv"
    for seed in range(CHANGED):
        luck = random.Random(seed)
        at, column = luck.randrange(len(rows)), luck.randrange(len(header))
        changed = [list(row) for row in rows]
        changed[at][column] = luck.choice(CELLS)
        with path.open("w", encoding="utf-8", newline="") as file:
            csv.writer(file).writerows([header, *changed])
        try:
            read = read_results(path)
        except DataError:  # in words, as above
            continue
        results = read.results
        names = [(results.players[a], results.players[b]) for a, b in
                 zip(results.player_a, results.player_b, strict=True)]  # fmt: skip
        found = [(*pair, int(a), int(b)) for pair, a, b in
                 zip(names, results.score_a, results.score_b, strict=True)]  # fmt: skip
        wanted = [(row[2], row[3], int(row[6]), int(row[7])) for row in rows]
        others = wanted[:at] + wanted[at + 1 :]
        here = (seed, header[column], changed[at][column], read.warnings)
        if len(found) == len(rows):
            assert found[:at] + found[at + 1 :] == others, here
            if header[column] not in ("player_a", "player_b", "score_a", "score_b"):
                assert found[at] == wanted[at] or read.warnings, here
        else:
            assert found == others, here
            assert read.warnings, here
