"""The events of a tournament as CSV: out and in again they are the same."""

from pathlib import Path

import pytest

from evenbreak.answers.faces.to_csv import to_csv
from evenbreak.answers.tournament_matches import tournament_events_answer
from evenbreak.errors import DataError
from evenbreak.files.event_list import is_event_list, read_event_list
from evenbreak.handicaps import chart
from evenbreak.tournaments.brackets.bracket import Source
from evenbreak.tournaments.brackets.drafts import Draft
from evenbreak.tournaments.evening.events import (
    Called,
    Changed,
    Drawn,
    Entrant,
    Event,
    Opened,
    Plan,
    Result,
    Scored,
    Undone,
)

AT = "2025-03-01T19:30:00"
PAIR = "Ann, the «first»", '=Bo "B" O\'Hara'
HAPPENED = (
    Opened(Plan("single", 5, chart=chart("npl_10")), tuple(Entrant(name, 80.5) for name in PAIR)),
    Drawn(PAIR, (0, 1)),
    Called("F", 2, PAIR),
    Scored("F", PAIR, (1, 0)),
    Undone(),
    Changed(tables=3),
    Result("F", PAIR, (5, 3), PAIR[0]),
)


def test_out_and_in_again(tmp_path: Path) -> None:
    events = [Event(AT, what) for what in HAPPENED]
    path = tmp_path / "events.csv"
    path.write_text("".join(to_csv(tournament_events_answer(events, "tonight"))))
    assert is_event_list(path)
    assert read_event_list(path) == events


def test_a_bracket_of_another_program_is_kept(tmp_path: Path) -> None:
    layout = (
        Draft("W1.1", "winners", 1, (0, 1)),
        Draft("F", "final", 2, (Source("W1.1", "winner"), 2)),
    )
    plan = Plan("single", 5, layout=layout, by_match={"F": 7})
    names = "Ann", "Bo", "Cy"
    opened = Opened(plan, tuple(Entrant(name, 80.0) for name in names))
    events = [Event(AT, opened), Event(AT, Drawn(names, None))]
    path = tmp_path / "events.csv"
    path.write_text("".join(to_csv(tournament_events_answer(events, "tonight"))))
    assert read_event_list(path) == events


@pytest.mark.parametrize(
    ("rows", "said"),
    [
        ("1,x,opened,{}\n", "events.csv:2"),
        ("1,x,opened\n", "events.csv:2"),
        ("1,x,undone,{}\n", "nothing to undo"),
        ("", "does not open"),
    ],
)
def test_other_rows_are_one_problem(tmp_path: Path, rows: str, said: str) -> None:
    path = tmp_path / "events.csv"
    path.write_text(f"number,at,kind,what\n{rows}")
    with pytest.raises(DataError, match=said):
        read_event_list(path)
