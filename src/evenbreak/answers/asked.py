"""From a question to its answer: one table for the terminal, the page's API and Python.

A command reads its options as a question and prints what `answer_to` returns; `POST /api/v1/odds`
reads JSON as the same question and sends the same answer. A question is in the table if it does
nothing but answer: anything that writes files, or runs a tournament, is a command of its own.
"""

from __future__ import annotations

from functools import cache
from importlib import import_module
from importlib.resources import files
from typing import Any, NamedTuple

from evenbreak.answers.kit.answer import Answer


class Place(NamedTuple):
    """The module and name of each question and its answer; imported when asked."""

    question: str
    answer: str


ASKED = {
    "odds": Place("match:Odds", "match.asked:odds"),
    "live": Place("match:Live", "match.asked:live"),
    "fair": Place("match:Fair", "match.asked:fair"),
    "compare": Place("match:Compare", "match.asked:compare"),
    "breaks": Place("games:Breaks", "match.formats:breaks"),
    "straight": Place("games:Straight", "match.shot_games:straight"),
    "oneball": Place("games:OneBall", "match.shot_games:oneball"),
    "chips odds": Place("chips:ChipOdds", "chips:chip_odds"),
    "chips audit": Place("chips:ChipAudit", "chips:chip_audit"),
    "chips design": Place("chips:ChipDesign", "chips:chip_design"),
    "systems": Place("charts:Systems", "chart.show:system_list_answer"),
    "chart list": Place("charts:ChartList", "chart.show:chart_list_answer"),
    "chart show": Place("charts:ChartShow", "chart.show:show"),
    "chart audit": Place("charts:ChartAudit", "chart.audit:audit"),
    "chart design": Place("charts:ChartDesign", "chart.design:design"),
    "chart team": Place("charts:ChartTeam", "chart.show:team"),
    "ladder": Place("ladders:LadderErrors", "ladder.asked:ladder"),
    "sandbag pay": Place("ladders:SandbagPay", "sandbag.played:pay"),
    "practice": Place("practice:Scores", "practice.shots:scores"),
    "drill": Place("practice:DrillPlayed", "practice.drill:drill"),
    "runs": Place("practice:Runs", "practice.runs:runs"),
    "physics speed": Place("physics:TableSpeed", "physics.asked:speed"),
    "physics throw": Place("physics:Throw", "physics.asked:throw"),
    "physics aim": Place("physics:Aim", "physics.asked:aim"),
    "physics deflect": Place("physics:Deflect", "physics.asked:deflect"),
    "physics strike": Place("physics:Strike", "physics.asked:strike"),
    "physics breakcue": Place("physics:BreakCue", "physics.asked:breakcue"),
    "physics shot": Place("physics:Shot", "physics.asked:shot"),
}
"""The questions by command name."""


def question_of(command: str) -> Any:
    """Return a command's question class.

    >>> question_of("odds").__name__
    'Odds'
    """
    return _named("questions", ASKED[command].question)


def answer_to(command: str, asked: Any) -> Answer:
    """Return the answer to a question; raise AskedError if the question contradicts itself.

    >>> odds = question_of("odds")(p=0.6, race=(7, 5))
    >>> print(answer_to("odds", odds).sentences[0])
    A wins the match 53% of the time.
    It lasts 9.3 games on average, and 9 out of 10 such matches end within 11.
    """
    answer: Answer = _named("answers", ASKED[command].answer)(asked)
    return answer


@cache
def schemas() -> dict[str, Any]:
    """Return the JSON schema of each command's answers, by command name."""
    import json

    text = files("evenbreak.answers").joinpath("answers.schema.json").read_text("utf-8")
    found: dict[str, Any] = json.loads(text)["$defs"]
    return found


def _named(room: str, place: str) -> Any:
    module, _, name = place.partition(":")
    return getattr(import_module(f"evenbreak.{room}.{module}"), name)
