"""Every command says the same in every face, and its text is the one kept in `golden`.

To take over new wording: EVENBREAK_GOLDEN=write python -m pytest tests/test_faces.py, then read the
difference.
"""

import contextlib
import csv
import io
import json
import os
import re
import shlex
import tempfile
from collections.abc import Callable
from functools import cache
from html.parser import HTMLParser
from pathlib import Path
from typing import NamedTuple
from unittest.mock import patch

import click
import jsonschema
import numpy as np
import pytest
from click.testing import CliRunner

from evenbreak.answers.faces.to_csv import to_csv
from evenbreak.answers.faces.to_json import to_json
from evenbreak.answers.faces.to_text import to_text
from evenbreak.answers.kit.answer import Answer
from evenbreak.answers.kit.parts import Quantities, Table
from evenbreak.cli.kit.faces import print_answer
from evenbreak.cli.program import program
from evenbreak.files.store.tokens import create_token
from evenbreak.files.store.tournament import new_tournament
from evenbreak.sheets.html_page import answer_page
from evenbreak.tournaments.evening import moves
from evenbreak.tournaments.evening.events import Entrant, Event, Opened, Plan, What
from evenbreak.tournaments.evening.fold import Evening, evening
from places import ROOT, SRC

GOLDEN = ROOT / "tests" / "golden"
SCHEMAS = json.loads((SRC / "answers" / "answers.schema.json").read_text("utf-8"))

ASKED = {
    "demo": "demo",
    "odds": "odds 612 521 --scale fargo --race 7:5",
    "odds_sets": "odds --p 0.66 --race 3:1 --set 3:3 --score 1:0",
    "odds_exact": "odds --p 0.6 --ahead 3:2 --exact",
    "odds_via": "odds --p 0.6 --race 5:4 --via eigen",
    "fair": "fair 612 521 --scale fargo --race-to 7 --top 3",
    "live": "live --p 0.6 --race 7:5 --racks abbab",
    "live_table": "live --p 0.6 --set 4:3 --race 3:3 --score 1:1 --set-score 2:2 --comebacks",
    "compare": "compare --p 0.6667 9:5 '3:1 of 3:3' 'ahead 5:3'",
    "physics_speed": "physics speed --lag-time 7.0",
    "physics_throw": "physics throw --cut 30 --side -0.3",
    "physics_throw_speed": "physics throw --cut 30 --topspin 0 --speed 150",
    "physics_aim": "physics aim --cut 14.5 --distance 36",
    "physics_deflect": "physics deflect --cut 30",
    "physics_strike": "physics strike --offset -0.3 --stick-speed 60 --distance 24",
    "physics_breakcue": "physics breakcue --forearm 36 --stick 19",
    "physics_shot": "physics shot --cut 30 --distance 20 --speed 45 --side-offset 0.1",
    "physics_shot_pocket": "physics shot --cue-ball 30,15 --object-ball 50,15 "
    "--pocket foot-right --speed 80 --offset -0.4",
    "systems": "systems",
    "chart_list": "chart list",
    "chart_show": "chart show npl_8",
    "chart_show_levels": "chart show apa_8ball",
    "chart_audit": "chart audit npl_10",
    "chart_audit_house": "chart audit data/house_chart.csv --scale npl",
    "chart_audit_levels": "chart audit apa_8ball",
    "chart_audit_favors": "chart audit fargo_r6_hot --scale fargo",
    "chart_audit_points": "chart audit apa_9ball",
    "chart_show_points": "chart show apa_9ball",
    "chart_team": "chart team 417 447",
    "chart_design_wishes": "chart design --games 5..15 --scale fargo --tilt 0",
    "chart_design": "chart design --games 5..7 --least 1:2 --beside npl_8",
    "drill": "drill --p 0.8",
    "drill_8_ball": "drill --p 0.8 --game 8-ball",
    "drill_log": "drill --log data/drill_log.csv",
    "practice": "practice data/practice_scores.csv",
    "practice_new": "practice data/practice_scores.csv --new 53",
    "practice_shots": "practice data/practice_shots.csv",
    "practice_versus": "practice data/practice_scores.csv --versus data/practice_scores_after.csv",
    "runs": "runs --mean 24 --at-least 100 --over 20",
    "runs_innings": "runs --p 0.96 --safety 0.8 --innings 5 --between 50..100",
    "compare_breaks": "compare --p1 0.6 --p2 0.55 --breaks winner 9:7 '9:7 alternate breaks'",
    "straight": "straight --averages 24:19 --points 150",
    "breaks": "breaks --p1 0.9 --p2 0.5 --win 1 --lose 2",
    "oneball": "oneball --shot 0.1:0.05 --shot 0.5:0.8",
    "oneball_alone": "oneball --shot 0.4:0.8",
    "oneball_later": "oneball --shot 0.4:0.8:0.6:0.5 --shot 0.3:0.3:0.2:0.4",
    "graph": "graph one-ball --p1 0.4 --p2 0.8 --out OUT",
    "graph_race": "graph 7:5 --p 0.6 --out OUT",
    "graph_ladder": "graph npl_10 --out OUT",
    "chain": "chain data/safety_battle.csv",
    "chain_steps": "chain data/safety_battle.csv --steps 4",
    "chain_via": "chain data/safety_battle.csv --via eigen",
    "rate": "rate data/demo_league.csv --scale fargo",
    "rate_asked": "rate data/demo_league.csv --prior best --half-life 180 --break-advantage fit "
    "--anchor 'Zoë Kestleman=100'",
    "rate_pair": "rate data/demo_league.csv --pair 'Zoë Kestleman' 'Ines Valbrecht'",
    "rate_system": "rate --system npl --roster data/demo_roster.csv --chart npl_10 "
    "--aliases data/demo_aliases.csv data/demo_night.csv",
    "rate_newcomers": "rate --system npl --roster data/demo_newcomers.csv "
    "data/demo_newcomers_night.csv",
    "validate": "validate data/demo_league.csv",
    "validate_prior": "validate data/demo_league.csv --prior 200",
    "report": "report data/demo_league.csv --out OUT --top 6",
    "report_lengths": "report data/demo_league.csv --out OUT --scale fargo --games 7..13 --top 14",
    "publish": "publish data/demo_league.csv --out OUT --scale fargo --title 'Tuesday league'",
    "why": "why 'Zoë Kestleman' 'Petra Nowicz-Hale' --results data/demo_league.csv",
    "why_begin": "why 'Zoë Kestleman' 'Petra Nowicz-Hale' --results data/demo_league.csv --begin "
    "data/demo_league_roster.csv",
    "odds_named": "odds 'Keiko Amasuda' 'Noor Al-Beyrati' --from data/demo_roster.csv --race 7:5",
    "fair_named": "fair 'Keiko Amasuda' 'Noor Al-Beyrati' --from data/demo_roster.csv --race-to 7",
    "live_named": "live 'Keiko Amasuda' 'Noor Al-Beyrati' --from data/demo_roster.csv --race 7:5 "
    "--racks abb",
    "matchups": "matchups data/demo_roster.csv --pairs data/demo_pairs.csv --chart npl_10",
    "matchups_levels": "matchups data/apa_roster.csv --chart apa_8ball",
    "matchups_points": "matchups data/apa_roster.csv --chart apa_9ball",
    "odds_levels": "odds 5 3 --chart apa_8ball",
    "odds_points": "odds 5 3 --chart apa_9ball",
    "matchups_both": "matchups data/demo_roster.csv --pairs data/demo_pairs.csv --chart npl_10 "
    "--games 7..13 --minutes-per-game 8 --tables 2",
    "matchups_uneven": "matchups data/demo_roster.csv --race-to 3",
    "ladder": "ladder --chart npl_10 --equal-skill --start-error -20 --newcomer",
    "ladder_via": "ladder --chart npl_8 --via elimination",
    "ladder_drift": "ladder --league data/demo_roster.csv --day-sd 5 --drift 0.1",
    "ladder_inflation": "ladder --system 'step 2 1'",
    "ladder_compare": "ladder --compare",
    "sandbag_pay": "sandbag pay --dumped 6 --in-a-row 4 --prize 500",
    "sandbag_charts": "sandbag pay --compare --stake 100 --dumped-stake 5",
    "sandbag_watch": "sandbag watch data/demo_sandbag.csv --roster data/demo_sandbag_roster.csv "
    "--dumps-in 'League night'",
    "sandbag_events": "sandbag watch data/demo_sandbag.csv --roster data/demo_sandbag_roster.csv "
    "--verbose",
    "sandbag_player": "sandbag watch data/demo_sandbag.csv --roster data/demo_sandbag_roster.csv "
    "--player 'Vito Drago'",
    "reproduce": "reproduce --out OUT",
    "lineup": "lineup data/demo_team.csv data/demo_opponents.csv --race 5 --order ABABA",
    "lineup_blind": "lineup data/demo_team.csv data/demo_opponents.csv --race-to 7 --sets 3 "
    "--order blind --sure",
    "lineup_sealed": "lineup data/demo_team.csv data/demo_opponents.csv --race 5 --order sealed "
    "--cap 23 --sure",
    "round": "round data/demo_team.csv data/demo_opponents.csv --single-games 1 --everybody",
    "caps": "caps data/demo_team_rosters.csv --race 5 --sets 3 --cap 15",
    "season": "season data/demo_team_results.csv data/demo_team_schedule.csv --up 2 --down 1",
    "tournament_odds": "tournament odds data/demo_entrants.csv --race 7 --losers-race 5 "
    "--final-race 9 --prizes 400,240,120,80",
    "tournament_odds_sure": "tournament odds data/demo_entrants.csv --format single --third-place "
    "--race-to 5 --sure",
    "tournament_odds_large": "tournament odds data/demo_league_roster.csv --format round-robin "
    "--race 3",
    "tournament_before_draw": "tournament odds data/demo_entrants.csv --format single --race 5 "
    "--before-draw --sure",
    "chips_odds": "chips odds data/demo_entrants.csv --left "
    "'Mei-Lin Oduya=2,Aiko Tanabe=5,Ruben Castellan=1'",
    "chips_audit": "chips audit hoboken",
    "chips_design": "chips design data/demo_entrants.csv --bands 560 --most 6",
    "tournament_time": "tournament time data/demo_entrants.csv --race 5 --tables 4 "
    "--discipline 9-ball",
    "tournament_time_of_day": "tournament time data/demo_entrants.csv --format single "
    "--seeding rating --chart fargo_r6_hot --tables 4 --minutes-per-game 7 --start 18:30",
    "tournament_next": "tournament next --at 20:10 --prizes 60,40",
    "tournament_odds_under_way": "tournament odds --at 20:10",
    "tournament_time_under_way": "tournament time --at 20:10",
    "tournament_show": "tournament show --at 20:10",
    "tournament_token": "tournament token",
    "simulate": "simulate data/demo_league_roster.csv --weeks 10 --replicas 40 --no-matches "
    "--out OUT",
    "simulate_compare": "simulate data/demo_league_roster.csv --compare npl --compare none "
    "--weeks 10 --replicas 40",
}
"""A question for each command, and for each kind of answer that it has."""

SLOW = (
    *("graph_ladder", "lineup", "graph_race", "matchups_both", "report_lengths", "rate_asked"),
    *("why_begin", "why", "simulate", "tournament_odds_large", "caps", "ladder_drift"),
    *("validate_prior", "rate_pair", "ladder_compare", "chips_design", "matchups_uneven"),
    *("sandbag_charts", "sandbag_events", "sandbag_player", "publish"),
)
"""Questions that take long, beside a quicker one of the same command or kind."""

NO_PAGE = ("report", "publish", "matchups", "reproduce", "graph")
"""Commands without --html, or whose --html writes another page; theirs is made from the answer."""

ASKS_THE_FACE = ("matchups",)
"""Commands some of whose faces hold less than others."""

OTHER_UNITS = ("validate", "tournament time")
"""Commands whose JSON has other units than the text."""

SENTENCES = ("heading", "sentences", "details", "warnings", "schema_version")

PLAYERS = ("Ann Lee", "Bo Diaz", "Cy Young", "Di Park", "Ed Moss", "Flo Hart")

WORDLESS = re.compile(r"\s+")
NUMBER = re.compile(r"(?<![\w.])[-+]?\d[\d,]*(?:\.\d+)?(?:e[-+]\d+)?%?")

FILES = dict.fromkeys(("index.md", "physics.md", "table_5_1.csv", "figure_5_1.png"), b"")
"""What `reproduce` writes here; elsewhere tests hold its files to the committed ones."""


@cache
def tonight() -> bytes:
    """Return the file of a tournament under way: two results and two matches on tables."""
    entrants = [Entrant(name, 640.0 - 40.0 * k, 30.0) for k, name in enumerate(PLAYERS)]
    plan = Plan("double", 5, losers_race=4, scale="fargo", tables=2)
    events = [Event("2025-03-01T18:50:00", Opened(plan, tuple(entrants)))]

    def happens(at: str, move: Callable[[Evening], What]) -> None:
        events.append(Event(f"2025-03-01T{at}:00", move(evening(events))))

    happens("19:00", lambda state: moves.draw(state, np.random.default_rng(1)))
    for table, (match, score) in enumerate([("W1.2", (5, 3)), ("W1.4", (2, 5))], 1):
        happens("19:00", lambda state, m=match, t=table: moves.call(state, m, t))
        happens("19:35", lambda state, m=match, s=score: moves.result(state, m, s))
    happens("19:40", lambda state: moves.call(state, "W2.1", 1))
    happens("19:45", lambda state: moves.call(state, "W2.2", 2))
    happens("20:05", lambda state: moves.score(state, "W2.2", (1, 3)))
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "tonight.db"
        new_tournament(str(file), sorted(events, key=lambda event: event.at))
        create_token(file, "scoreboard", "table:2", "2025-03-01T18:55:00")
        return file.read_bytes()


def ask(line: str, *options: str) -> str:
    with (
        tempfile.TemporaryDirectory() as folder,
        contextlib.chdir(folder),
        patch("evenbreak.source_text.reproduce.reproduction", return_value=FILES),
    ):
        # Files are named as a reader in the checkout names them.
        Path("data").symlink_to(ROOT / "data")
        Path("tonight.db").write_bytes(tonight())
        words = [word.replace("OUT", "out") for word in shlex.split(line)]
        result = CliRunner().invoke(program, [*words, *options])
    assert result.exit_code == 0, result.output
    return result.stdout


def squeezed(text: str) -> str:
    """Return text without blanks, which faces may set differently."""
    return WORDLESS.sub("", text)


class Cells(HTMLParser):
    """The texts of a page, a string for each element that holds text."""

    def __init__(self) -> None:
        super().__init__()
        self.texts: list[str] = []

    def handle_data(self, data: str) -> None:
        if data.strip():
            self.texts.append(data)


class Faces(NamedTuple):
    """The answer to one question in each face."""

    name: str
    answer: Answer
    text: str
    details: str
    json: str
    csv: str
    page: str


def faces_of(name: str) -> Faces:
    """Ask a question once, and return its answer in each face."""
    line = ASKED[name]
    command = line.split()[0]
    with (
        tempfile.TemporaryDirectory() as folder,
        patch("evenbreak.cli.kit.faces.print_answer", wraps=print_answer) as printed,
    ):
        page = Path(folder) / "answer.html"
        own = command in NO_PAGE
        text = ask(line, "--text", *(() if own else ("--html", str(page))))
        (answer, _), _ = printed.call_args
        html = (answer_page(answer) if own else page.read_bytes()).decode()
    details = to_text(answer, verbose=True)
    if command in ASKS_THE_FACE:
        as_json, as_csv = ask(line, "--json"), ask(line, "--csv")
    else:
        as_json, as_csv = to_json(answer), "".join(to_csv(answer))
    return Faces(name, answer, text, details, as_json, as_csv, html)


def command_of(name: str) -> str:
    """Return the command of a question: one word, or two of a group."""
    words = ASKED[name].split()
    command = program.get_command(click.Context(program), words[0])
    return " ".join(words[: 2 if isinstance(command, click.Group) else 1])


@pytest.fixture(
    scope="module",
    params=[pytest.param(name, marks=[pytest.mark.slow] * (name in SLOW)) for name in ASKED],
)
def faces(request):
    """The answer to one question, asked once."""
    return faces_of(request.param)


def test_a_column_has_numbers_of_one_kind(faces):
    for part in [*faces.answer.parts, *faces.answer.details, faces.answer.csv]:
        for at, name in enumerate(part.names if isinstance(part, Table) else ()):
            values = [record[at] for record in part.records()]
            kinds = {type(value) for value in values if value is not None}
            assert not {int, float} <= kinds or str in kinds, (name, values)  # words: settings


def test_every_face_has_the_same_sentences(faces):
    text, answer, page = faces.details, json.loads(faces.json), faces.page
    shown = Cells()
    shown.feed(page)
    on_page = squeezed("".join(shown.texts))
    assert answer["sentences"]
    for sentence in [answer["heading"], *answer["sentences"], *answer["details"]]:
        assert squeezed(sentence) in squeezed(text)
        for line in sentence.split("\n"):  # a page has a list where a text has dashes
            assert squeezed(line.removeprefix("- ")) in on_page


def test_json_is_as_the_schema_says(faces):
    """To take over new keys: python docs/reference/make_schemas.py, then read the difference."""
    shape = SCHEMAS["$defs"][command_of(faces.name)]
    jsonschema.Draft202012Validator(closed(shape)).validate(json.loads(faces.json))


def closed(shape):
    """Return a schema that allows no keys but those it names."""
    if isinstance(shape, list):
        return [closed(one) for one in shape]
    if not isinstance(shape, dict):
        return shape
    more = {"additionalProperties": False} if "properties" in shape else {}
    return {key: closed(value) for key, value in shape.items()} | more


def test_a_page_has_the_numbers_of_the_text(faces):
    text, answer, page = faces.details, json.loads(faces.json), faces.page
    shown = Cells()
    shown.feed(page.partition("<main>")[2].partition("<footer>")[0])
    everything = squeezed("".join([text, *answer["warnings"]]))
    missing = [one for one in shown.texts if squeezed(one) not in everything and one != "Details"]
    assert shown.texts
    assert missing == []


def test_csv_has_the_numbers_of_json(faces):
    answer, table = json.loads(faces.json), faces.csv
    header, *rows = csv.reader(io.StringIO(table))
    if header == ["quantity", "value"]:
        records = {name: answer[name] for name, _ in rows}
        assert [value for _, value in rows] == [as_csv(records[name]) for name, _ in rows]
        return
    tables = [
        value
        for value in answer.values()
        if isinstance(value, list) and value and isinstance(value[0], dict)
    ]
    (records,) = [one for one in tables if set(header) <= set(one[0]) and len(one) == len(rows)]
    for row, record in zip(rows, records, strict=True):
        for name, cell in zip(header, row, strict=True):
            if isinstance(record[name], bool):
                assert (cell in ("yes", "1")) is record[name]
                continue
            # A spreadsheet must not take words such as 9:5 for a time of day.
            assert isinstance(record[name], str) or cell in (
                as_csv(record[name]),
                repr(record[name]),
            )


def test_the_text_has_the_numbers_of_json(faces):
    if ASKED[faces.name].startswith(OTHER_UNITS):
        pytest.skip("its text has points or hours, its JSON log-odds or minutes")
    known = list(numbers_of(json.loads(faces.json)))
    for cell in cells(faces.answer):
        for number in NUMBER.findall(cell):
            assert any(is_rounded(number, value) for value in known), (number, cell)


def cells(answer):
    """Yield what a person reads in quantities and tables."""
    for part in (*answer.parts, *answer.details):
        if isinstance(part, Quantities):
            for one in part.shown(verbose=True):
                yield f"{one.text} {one.note}"
        elif isinstance(part, Table):
            shown = part.shown(verbose=True)
            yield from (column.text(row[k]) for row in part.rows for k, column in shown)


def numbers_of(value):
    """Yield all numbers of a JSON, sentences left out, and the places of rows in lists."""
    if isinstance(value, dict):
        for key, one in value.items():
            if key not in SENTENCES:
                yield from numbers_of(key)
                yield from numbers_of(one)
    elif isinstance(value, list):
        yield from range(1, len(value) + 1)
        for one in value:
            yield from numbers_of(one)
    elif isinstance(value, str):
        yield from (float(number.replace(",", "").strip("%")) for number in NUMBER.findall(value))
    elif isinstance(value, int | float):
        yield value


def is_rounded(text, value):
    """Return whether a number that a person reads is this one, perhaps in percent or unsigned.

    >>> is_rounded("65.3%", 0.6527), is_rounded("1.2e-09", 1.234e-9), is_rounded("0.66", 0.6527)
    (True, True, False)
    """
    digits, _, power = text.replace(",", "").strip("%").partition("e")
    half = 0.5001 * 10.0 ** (int(power or 0) - len(digits.partition(".")[2]))
    read = abs(float(f"{digits}e{power or 0}"))
    return any(abs(one - read) <= half for one in (abs(value), abs(100.0 * value)))


def as_csv(value):
    if value is None:
        return ""
    if isinstance(value, bool):
        return "yes" if value else "no"
    if not isinstance(value, float):
        return str(value)
    text = f"{value:.6f}"
    return text.removeprefix("-") if float(text) == 0.0 else text


def test_the_text_is_the_one_that_was_read_and_kept(faces):
    place = GOLDEN / f"{faces.name}.txt"
    text = f"$ evenbreak {ASKED[faces.name]}\n{faces.text}"
    if os.environ.get("EVENBREAK_GOLDEN") == "write":
        place.parent.mkdir(exist_ok=True)
        place.write_text(text, encoding="utf-8")
    assert text == place.read_text(encoding="utf-8")


@pytest.mark.parametrize("name", ASKED)
def test_the_answer_comes_first_and_fits_a_terminal(name):
    lines = (GOLDEN / f"{name}.txt").read_text(encoding="utf-8").splitlines()[1:]
    blank = lines.index("")
    assert re.match(r"\S", lines[blank + 1]), "a paragraph follows the heading"
    assert max(map(len, lines)) <= 80
