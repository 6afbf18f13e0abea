"""What a shell is offered, asked as a shell asks."""

import os
import subprocess
import sys

import pytest
from click.shell_completion import ShellComplete

from evenbreak.cli.program import program
from places import DATA
from rows import each_of

ROSTER = str(DATA / "demo_roster.csv")
SEASON = str(DATA / "demo_league.csv")


def offered(*words):
    *before, typed = words
    found = ShellComplete(program, {}, "evenbreak", "_EVENBREAK_COMPLETE")
    return [(one.type, one.value) for one in found.get_completions(before, typed)]


@each_of(
    "words, values",
    [
        (("matc",), ["matchups"]),
        (("odds", "--scale", "f"), ["fargo"]),
        (("simulate", "--system", "np"), ["npl"]),
        (("matchups", "--chart", "npl_10"), ["npl_10"]),
        (("chart", "show", "apa_"), ["apa_8ball", "apa_9ball"]),
        (("odds", "--from", ROSTER, "kei"), ["Keiko Amasuda"]),
        (("live", "--from", ROSTER, "Keiko Amasuda", "al-b"), ["Noor Al-Beyrati"]),
        (("fair", "--from", ROSTER, "Keiko Amasuda", "noor"), ["Noor Al-Beyrati"]),
        (("compare", "--from", ROSTER, "amas"), ["Keiko Amasuda"]),
        (("why", "--results", SEASON, "Petra Nowicz-Hale", "Zo"), ["Zoë Kestleman"]),
        (("odds", "Keik"), []),
        (("odds", "--from", "no such file", "Keik"), []),
    ],
)
def test_words_are_offered(words, values):
    assert [value for _, value in offered(*words)] == values


@pytest.mark.parametrize(
    "words",
    [("report", "da"), ("odds", "--from", "ra"), ("matchups", "--chart", "ours"), ("rate", "x")],
)
def test_files_are_left_to_the_shell(words):
    assert offered(*words) == [("file", words[-1])]


@pytest.mark.slow_after(1)
@pytest.mark.parametrize(
    ("typed", "value"), [("kei", '"Keiko Amasuda"'), ('"Kei', "Keiko Amasuda")]
)
def test_bash_gets_names_with_blanks_in_quotes(typed, value):
    words = ["evenbreak", "odds", "--from", ROSTER, typed]
    asked = {"_EVENBREAK_COMPLETE": "bash_complete", "COMP_WORDS": "\n".join(words)}
    done = subprocess.run(
        [
            sys.executable,
            "-c",
            "from evenbreak.cli.program import program; program(prog_name='evenbreak')",
        ],
        env={**os.environ, **asked, "COMP_CWORD": "4"},
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.stdout == f"plain,{value}\n"
