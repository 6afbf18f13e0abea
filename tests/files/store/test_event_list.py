"""The events of a tournament as CSV: out and in again they are the same."""

import csv
from pathlib import Path

import pytest

from evenbreak.answers.faces.to_csv import to_csv
from evenbreak.answers.tournament.printed import tournament_events_answer
from evenbreak.errors import DataError
from evenbreak.files.store.tournament import (
    event_rows,
    is_event_list,
    new_tournament,
    read_event_list,
    read_events,
)
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
    by = "director's page", "phone: Ann, the «first»", "phones: Ann and Bo", ""
    events = [Event(AT, what, by[k % len(by)]) for k, what in enumerate(HAPPENED)]
    path = tmp_path / "events.csv"
    path.write_text("".join(to_csv(tournament_events_answer(events, "tonight"))))
    assert is_event_list(path)
    assert read_event_list(path) == events
    new_tournament(tmp_path / "again.db", read_event_list(path))
    assert read_events(tmp_path / "again.db") == events


def test_a_list_of_an_earlier_version_has_no_authors(tmp_path: Path) -> None:
    path = tmp_path / "events.csv"
    rows = event_rows([Event(AT, what) for what in HAPPENED])
    with path.open("w", newline="") as file:
        csv.writer(file).writerows([("number", "at", "kind", "what"), *(r[:4] for r in rows)])
    assert is_event_list(path)
    assert read_event_list(path) == [Event(AT, what) for what in HAPPENED]


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
        (
            '1,late,dropped,"{""name"": ""Bo""}"\n',
            "events.csv:2: .* at must be a time such as .*; you gave 'late'",
        ),
        ("1,x,opened,{},Ann,Bo\n", "events.csv:2"),
        (f"1,{AT},undone,{{}}\n", "nothing to undo"),
        ("", "doesn't start"),
    ],
)
def test_other_rows_are_one_problem(tmp_path: Path, rows: str, said: str) -> None:
    path = tmp_path / "events.csv"
    path.write_text(f"number,at,kind,what\n{rows}")
    with pytest.raises(DataError, match=said):
        read_event_list(path)
