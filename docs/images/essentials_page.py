"""The essentials: the commands for tonight, with their output, as one HTML file to print."""

from __future__ import annotations

import re
from html import escape
from typing import NamedTuple

from at_work import run
from shown import NIGHT


class Step(NamedTuple):
    """What is wanted, the command for it, and which paragraphs of its output are shown."""

    wanted: str
    command: str
    shown: tuple[int, ...]


class Page(NamedTuple):
    """A page: for whom, what to know before, steps with output, and more commands without."""

    title: str
    before: str
    steps: tuple[Step, ...]
    more: tuple[tuple[str, str], ...]


NEW, DRAW, CALL, RESULT = NIGHT.splitlines()
TEAMS = "lineup data/demo_team.csv data/demo_opponents.csv --race 5 --sets 5 --order ABABA --sure"
PAGES = (
    Page(
        "The director's evening",
        "List the players in a CSV file with the columns <code>player</code> and "
        "<code>rating</code>; a rating may be missing. The night is saved in "
        "<code>tonight.db</code>. Leave out <code>--at</code>, which only sets the clock for this "
        "page. To run everything from a phone instead, type "
        "<b><code>evenbreak serve tonight.db --lan</code></b> and scan the code that it prints.",
        (
            Step("Start: the list, the races, the tables", NEW, (0,)),
            Step("Make the draw", DRAW, (1,)),
            Step("Call the next matches", CALL, (1,)),
            Step("Enter a result", RESULT, (1, 2)),
        ),
        (
            ("The score was wrong", "tournament correct 3 4-5"),
            ("Take back the last entry", "tournament undo"),
            (
                "A late player takes an open bye",
                'tournament late "Wanda Late" --rating 60',
            ),
            ("Someone is going home", 'tournament drop "Otto Birnhuber"'),
            ("The bracket, and a picture of it", "tournament show --out bracket.pdf"),
            ("Odds for every place; prizes", "tournament odds; tournament prizes --fee 20"),
            ("Score cards, bracket or draw on paper", "tournament print cards"),
        ),
    ),
    Page(
        "League night",
        "Results are a CSV file or workbook with the columns <code>player_a</code>, "
        "<code>player_b</code>, <code>score_a</code> and <code>score_b</code>, one match per row. "
        "Put your own files in place of names such as <code>results.csv</code>.",
        (
            Step(
                "A sheet for the wall, from last season's results",
                "report data/demo_league.csv --out sheet --top 5",
                (1, 2, 3),
            ),
            Step(
                "Tonight's races, from ratings and a chart",
                "matchups data/demo_roster.csv --pairs data/demo_pairs.csv --chart npl_10",
                (1, 2),
            ),
            Step(
                "The fair race for two players",
                "fair 612 521 --scale fargo --race-to 7 --top 3",
                (1, 2),
            ),
        ),
        (
            ("What a race is worth", "odds 612 521 --scale fargo --race 7:5"),
            ("A page for phones", "report results.csv --out sheet --page"),
            ("Ratings alone", "rate results.csv"),
            ("Can the ratings be trusted?", "validate results.csv"),
            ("Is our chart fair?", "chart audit ours.csv"),
            ("Who may be losing on purpose?", "sandbag watch results.csv --roster start.csv"),
        ),
    ),
    Page(
        "The captain's night",
        "Each team is a CSV file with the columns <code>player</code> and <code>rating</code>, and "
        "<code>level</code> if there's a cap. In the order, A is you and B is them. "
        "<code>--sure</code> treats the ratings as exact; without it the answer allows for their "
        "uncertainty.",
        (
            Step("Who to put up when you name first", TEAMS, (1, 2, 3)),
            Step(
                "Who to answer with",
                f'{TEAMS} --used "Dario Pellengrino, Winston Peake" --score 1-0 '
                '--named "Tomáš Havrlant"',
                (1, 2),
            ),
        ),
        (
            ("A match is still on", 'lineup … --playing "Dario Pellengrino v Winston Peake 3-4"'),
            ("Blind picks", "lineup … --order blind"),
            ("A cap on the sum of the levels", "lineup … --cap 23"),
            (
                "A head start to make a round even",
                "round ours.csv theirs.csv --single-games 1 --everybody",
            ),
            ("How the season could end", "season results.csv schedule.csv --up 2 --down 1"),
        ),
    ),
    Page(
        "At the table",
        "Chances are between 0 and 1: <code>0.6</code> is 60%.",
        (
            Step("A match, game by game", "live --p 0.6 --race 7:5 --racks abbab", (1, 4)),
            Step("Which level of a drill to practice", "drill --log data/drill_log.csv", (1, 2)),
            Step("Which shot to take", "oneball --shot 0.4:0.8 --shot 0.3:0.3", (1,)),
            Step("Where to aim", "physics aim --cut 14.5 --distance 36", (1, 2)),
        ),
        (
            ("Was a good score luck?", "practice scores.csv --new 53"),
            ("How likely is a run of 50?", "runs --mean 12 --at-least 50"),
            ("A fair spot in straight pool", "straight --averages 24:19 --points 100"),
            ("What a command can do", "fair --help"),
            ("Any answer as a web page, a table or data", "fair … --html fair.html, --csv, --json"),
        ),
    ),
)

STYLE = """\
@page { margin: 10mm 14mm; }
body { font: 10pt/1.3 system-ui, sans-serif; margin: 2rem auto; max-width: 44rem;
  padding: 0 1rem; }
.head { color: #555; font-weight: bold; margin: 0; }
h1 { font-size: 1.5rem; margin: .1rem 0 .5rem; }
h2 { font-size: 1rem; margin: .7rem 0 .2rem; }
code, pre { font-family: ui-monospace, "DejaVu Sans Mono", monospace; }
pre { background: #f4f4f4; border-radius: 4px; font-size: 8pt; line-height: 1.2; margin: .2rem 0;
  overflow-x: auto; padding: .4rem .6rem; }
pre b { white-space: pre-wrap; }
pre span, td span { white-space: nowrap; }
table { border-collapse: collapse; margin-top: 1rem; width: 100%; }
td { border-top: 1px solid #ccc; padding: .2rem .6rem .2rem 0; vertical-align: top; }
td code { font-size: 8.5pt; font-weight: bold; }
section + section { border-top: 2px solid #888; margin-top: 2rem; padding-top: 1rem; }
h2, pre, tr { break-inside: avoid; }
h2 { break-after: avoid; }
@media (prefers-color-scheme: dark) { @media screen {
  body { background: #131416; color: #ddd; } pre { background: #222; } .head { color: #aaa; } } }
@media print {
  body { margin: 0; max-width: none; padding: 0; }
  section + section { border: 0; break-before: page; margin: 0; padding: 0; } }
"""


def _command(text: str) -> str:
    """Return a command whose options are not broken at their hyphens."""
    return re.sub(r"--[a-z-]+", r"<span>\g<0></span>", escape(text))


def _step(step: Step) -> str:
    paragraphs = run(step.command).strip("\n").split("\n\n")
    output = "\n\n".join(paragraphs[i] for i in step.shown)
    return (
        f"<h2>{escape(step.wanted)}</h2>\n"
        f"<pre><b>evenbreak {_command(step.command)}</b>\n{escape(output)}</pre>\n"
    )


def _row(wanted: str, command: str) -> str:
    several = "<br>".join(f"evenbreak {_command(one)}" for one in command.split("; "))
    return f"<tr><td>{escape(wanted)}</td><td><code>{several}</code></td></tr>\n"


def _section(page: Page) -> str:
    steps, rows = "".join(map(_step, page.steps)), "".join(_row(*row) for row in page.more)
    return (
        f'<section>\n<p class="head">evenbreak: the essentials</p>\n<h1>{page.title}</h1>\n'
        f"<p>{page.before}</p>\n{steps}<table>\n{rows}</table>\n</section>\n"
    )


def essentials_page() -> str:
    """Return the page; its commands run where the sample data is."""
    return (
        '<!DOCTYPE html>\n<html lang="en">\n<head>\n<meta charset="utf-8">\n'
        '<meta name="viewport" content="width=device-width, initial-scale=1">\n'
        f"<title>evenbreak: the essentials</title>\n<style>\n{STYLE}</style>\n</head>\n<body>\n"
        f"{''.join(map(_section, PAGES))}</body>\n</html>\n"
    )
