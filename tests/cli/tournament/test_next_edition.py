"""`tournament new --like`: next week's edition, and the night to take home."""

from dataclasses import replace
from pathlib import Path

import pytest
from click.testing import CliRunner

from evenbreak.cli.program import program
from evenbreak.files.store.prizes import kept_prizes
from evenbreak.files.store.tournament import read_tournament


@pytest.fixture
def said(tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    monkeypatch.chdir(tmp_path)
    pasted = "Players:\n1. Ann Lee 612\n2. Bo (540)\nCy - 500\nDi (unrated)\n"
    Path("list.txt").write_text(pasted, encoding="utf-8")

    def run(words: str, *more: str, code: int = 0) -> str:
        done = CliRunner().invoke(program, ["tournament", *words.split(), *more])
        assert done.exit_code == code, done.output
        return done.output

    run(
        "new list.txt --race 2 --losers-race 1 --tables 3 --scale fargo", "--name", "Tuesday 9-Ball"
    )
    run("prizes --fee 20 --house 0.1 --unit 5 --keep")
    return run


def test_the_next_edition_has_the_same_people_and_options(said) -> None:
    first = read_tournament("tonight.db")
    said("new --like tonight.db --out next.db --at 19:30")
    then = read_tournament("next.db")
    assert replace(then.plan, date="") == first.plan
    assert then.plan.date
    assert then.entrants == first.entrants
    assert kept_prizes("next.db") == kept_prizes("tonight.db")
    Path("others.txt").write_text("Ann Lee\nEd 480\nFay\n", encoding="utf-8")
    said("new others.txt --like tonight.db --out third.db")
    third = read_tournament("third.db")
    assert [one.rating for one in third.entrants.values()] == [612, 480, third.plan.starter]
    assert "Leave out --race" in said("new --like tonight.db --out x.db --race 5", code=2)
    assert "list of entrants: name the file," in said("new --race 5", code=2)
    said("new --race 5 --scale fargo --out empty.db")
    assert not read_tournament("empty.db").entrants


def test_a_doubtful_line_is_refused_with_its_remedy(said) -> None:
    Path("list.txt").write_text("Ann Lee 612\nBo Diaz 540 paid\nAnn Lee\n", encoding="utf-8")
    refused = said("new list.txt --race 5 --out x.db", code=3)
    assert "list.txt:2: 'Bo Diaz 540 paid': this may be more than a name" in refused
    assert "Write: Bo Diaz, 540" in refused
    assert "list.txt:3: player 'Ann Lee' is already in line 1" in refused
    assert not Path("x.db").exists()


@pytest.mark.slow
def test_the_night_is_one_page(said) -> None:
    said("draw")
    while (state := read_tournament("tonight.db")).standing.to_play:
        match = state.standing.to_play[0]
        said(f"result {state.number_of(match)} {state.needed(match, state.pair(match))[0]}:0")
    assert "night.html" in said("export --out night.html")
    page = Path("night.html").read_text(encoding="utf-8")
    assert "Tuesday 9-Ball" in page
    assert "Champion · 50" in page  # 70 % of 72, in fives
    assert all(name in page for name in state.entrants)
    assert "<script" not in page
