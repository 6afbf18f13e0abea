"""The small pictures of the landing page's doors: real answers, in letters that a card can show."""

from __future__ import annotations

import csv
import itertools
import json
from collections.abc import Iterable
from html import escape
from pathlib import Path

from at_work import run

EVENING = """\
new entrants.csv --race 5 --losers-race 4 --tables 2 --seeding rating --at 18:50 --out lesson.db
draw --at 19:00 --file lesson.db
call --at 19:05 --file lesson.db
call --at 19:05 --file lesson.db
result 1 5-4 --at 19:40 --file lesson.db
"""
"""The lesson's evening, as page_pictures.py has it, until the page shows who wins."""

WIDTH, HEIGHT, LINE = 240, 136, 19
INK, GRAY, BLUE = "#222", "#aaa", "#0072b2"
TEAMS = "lineup data/demo_team.csv data/demo_opponents.csv --race 5 --sets 5 --order ABABA"


def _text(x: float, y: float, words: str, *, end: str = "start", strong: bool = False) -> str:
    weight = ' font-weight="bold"' if strong else ""
    return f'<text x="{x:g}" y="{y:g}" text-anchor="{end}"{weight}>{escape(words)}</text>\n'


def _box(x: float, y: float, width: float, height: float, color: str) -> str:
    return f'<rect x="{x:g}" y="{y:g}" width="{width:.1f}" height="{height:.1f}" fill="{color}"/>\n'


def _picture(heading: str, parts: Iterable[str]) -> str:
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{WIDTH}" height="{HEIGHT}" '
        f'viewBox="0 0 {WIDTH} {HEIGHT}" '
        f'font-family="system-ui, sans-serif" font-size="12.5" fill="{INK}">\n'
        f"{_text(10, 22, heading, strong=True)}{''.join(parts)}</svg>\n"
    )


def director() -> str:
    """Draw who wins the tournament of the lesson, after its first result."""
    with Path("data", "demo_entrants.csv").open(encoding="utf-8") as file:
        rows = [[*row[:2], row[-1]] for row in itertools.islice(csv.reader(file), 8)]
    Path("entrants.csv").write_text("\n".join(map(",".join, rows)), encoding="utf-8")
    for line in EVENING.splitlines():
        run(f"tournament {line}")
    odds = json.loads(run("tournament odds lesson.db --json"))["players"]
    first = sorted(((one["name"], one["p_title"]) for one in odds), key=lambda one: -one[1])
    parts = []
    for k, (name, p) in enumerate(first[:4]):
        y = 46 + LINE * 1.25 * k
        parts += [
            _text(10, y, name, strong=not k),
            _box(140, y - 10, max(1.0, 74 * p), 12, GRAY if k else BLUE),
            _text(WIDTH - 8, y, f"{100 * p:.0f}%", end="end", strong=not k),
        ]
    return _picture("Who wins tonight", parts)


def captain() -> str:
    """Draw who to put up, and what each other choice costs."""
    best, *others = json.loads(run(f"{TEAMS} --json"))["options"]
    lost = [(one["name"].split()[0], 100 * (best["p_win"] - one["p_win"])) for one in others]
    parts = []
    for k, (name, points) in enumerate(lost):
        y = 46 + LINE * k
        parts += [
            _text(10, y, f"or {name}"),
            _box(76, y - 9, max(1.0, 108 * points / lost[-1][1]), 11, GRAY),
            _text(WIDTH - 8, y, f"\N{MINUS SIGN}{points:.1f}%", end="end"),
        ]
    return _picture(f"Put up {best['name'].split()[0]}: you win {100 * best['p_win']:.0f}%", parts)


def operator() -> str:
    """Draw a corner of the sheet of fair races."""
    run("report data/demo_league.csv --out sheet --top 5")
    pairs = list(csv.DictReader(Path("sheet", "matchups.csv").read_text("utf-8").splitlines()))
    names = list(dict.fromkeys(one["player_a"] for one in pairs))[:4]
    parts = [_text(114 + 36 * k, 46, str(k + 1), end="middle") for k in range(len(names))]
    races = {(one["player_a"], one["player_b"]): (one["race_a"], one["race_b"]) for one in pairs}
    for i, name in enumerate(names):
        y = 67 + LINE * i
        parts.append(_text(10, y, f"{i + 1} {name.split()[0]}"))
        for j, other in enumerate(names):
            race = races.get((name, other)) or races.get((other, name), ())[::-1]
            parts.append(_text(114 + 36 * j, y, ":".join(race), end="middle"))
    return _picture("Fair races", parts)


def player() -> str:
    """Draw how often each level of a drill was made, and the one to practice."""
    levels = json.loads(run("drill --log data/drill_log.csv --json"))["drill_levels"]
    best = max(levels, key=lambda one: one["p_best"])["level"]
    parts = []
    for k, one in enumerate(levels):
        height, x = 66 * one["p_success"], 12 + 24.5 * k
        color = BLUE if one["level"] == best else GRAY
        parts += [
            _box(x, 110 - height, 18, max(1.0, height), color),
            _text(x + 9, 126, str(one["level"]), end="middle", strong=one["level"] == best),
        ]
    return _picture(f"Practice level {best}", parts)


DOORS = {one.__name__: one for one in (director, operator, captain, player)}
