"""Pictures of the bracket, score cards, payouts and the Calcutta from the command line."""

import json
import shutil

import pytest

from evenbreak.files.store.tournament import read_tournament

NAMES = ("Ann Lee", "Bo Diaz", "Cy Young", "Di Marsh", "Ed Poole")


@pytest.fixture(scope="module")
def file(run, tmp_path_factory):
    folder = tmp_path_factory.mktemp("night")
    entrants, place = folder / "entrants.csv", str(folder / "tonight.db")
    rows = [f"{name},{600 - 20 * k},fargo" for k, name in enumerate(NAMES)]
    entrants.write_text("\n".join(["player,rating,scale", *rows]))
    words = [str(entrants), "--format", "single", "--race", "5", "--tables", "1", "--out", place]
    assert run("tournament", "new", *words).exit_code == 0
    assert run("tournament", "draw", "--file", place).exit_code == 0
    return place


@pytest.mark.parametrize(
    ("name", "begins"),
    [
        ("b.svg", b"<svg xmlns="),
        ("b.png", b"\x89PNG"),
        ("b.pdf", b"%PDF"),
        ("b.html", b"<!doctype"),
    ],
)
def test_show_draws_the_bracket(run, file, tmp_path, name, begins):
    place = tmp_path / name
    result = run("tournament", "show", "--file", file, "--out", str(place))
    assert result.exit_code == 0, result.stderr
    assert place.read_bytes().lower().startswith(begins.lower())


def test_cards_are_printed_for_the_matches_that_can_be_played(run, file, tmp_path):
    place = tmp_path / "cards.pdf"
    result = run("tournament", "print", "cards", "--file", file, "--out", str(place), "--json")
    assert result.exit_code == 0, result.stderr
    draw = json.loads(result.stdout)["draw"]
    assert [row["name"] for row in draw] == list(NAMES)
    assert place.read_bytes().startswith(b"%PDF")
    late = run("tournament", "print", "cards", "--match", "F", "--file", file)
    assert late.exit_code != 0
    assert "match 4 isn't ready to be played" in late.stderr


def test_prizes_may_be_kept_with_the_tournament(run, file, tmp_path):
    file = shutil.copy(file, tmp_path)
    asked = ("prizes", "--fee", "20", "--house", "0.1", "--payout", "60,40")
    first = run("tournament", *asked, "--keep", "--file", file, "--json")
    assert first.exit_code == 0, first.stderr
    assert run("tournament", "prizes", "--file", file, "--json").stdout == first.stdout
    halves = run("tournament", "prizes", "--payout", "50,50", "--file", file, "--json")
    assert json.loads(halves.stdout)["pot"] == json.loads(first.stdout)["pot"]
    other = json.loads(run("tournament", "prizes", "--fee", "5", "--file", file, "--json").stdout)
    assert other["pot"] < json.loads(first.stdout)["pot"]


def test_prizes_are_the_pot(run, file):
    result = run("tournament", "prizes", "--fee", "20", "--added", "50", "--file", file, "--json")
    found = json.loads(result.stdout)
    assert found["pot"] == 150.0
    assert [row["money"] for row in found["places"]] == pytest.approx([105.0, 45.0])
    assert sum(row["prize_mean"] for row in found["players"]) == pytest.approx(150.0)


def test_the_calcutta_breaks_even_where_the_pot_is_shared_fairly(run, file):
    words = ("--calcutta", "--payout", "100", "--sold", "ann lee=60", "--file", file, "--json")
    lots = json.loads(run("tournament", "prizes", *words).stdout)["lots"]
    assert "Ann Lee" not in {lot["name"] for lot in lots}
    sold_share = 1.0 - sum(lot["fair_share"] for lot in lots)
    for lot in lots:
        assert lot["break_even"] == pytest.approx(lot["fair_share"] * 60.0 / sold_share)
        assert lot["half"] == pytest.approx(lot["break_even"] / 2.0)


@pytest.mark.parametrize(
    ("words", "what"),
    [
        (("prizes",), "--fee"),
        (("prizes", "--fee", "20", "--payout", "60,50"), "--payout: the payout '60/50'"),
        (
            ("prizes", "--fee", "20", "--payout", "lots"),
            "--payout: there's no payout table 'lots'",
        ),
        (("prizes", "--calcutta", "--sold", "Nobody=5"), "Nobody"),
        (("prizes", "--calcutta", "--sold", "Ann Lee"), "Ann Lee"),
        (("print", "cards", "--out", "cards.doc"), "cards.doc"),
        (("show", "--out", "b.gif"), "b.gif"),
    ],
)
def test_what_cannot_be_is_refused(run, file, words, what):
    result = run("tournament", *words, "--file", file)
    assert result.exit_code in (1, 2, 3)
    assert what in result.stderr.splitlines()[-1]


@pytest.mark.slow
def test_the_best_runner_up_is_seen_on_the_screen_and_in_print(run, tmp_path):
    names = tmp_path / "names.csv"
    names.write_text("player,rating\n" + "".join(f"P{k},{600 - 10 * k}\n" for k in range(1, 13)))
    file = str(tmp_path / "cup.db")
    asked = ("--format", "groups", "--groups", "3", "--knockout-size", "4", "--race", "3")
    for words in (("new", str(names), *asked, "--out", file), ("draw", "--file", file)):
        assert run("tournament", *words).exit_code == 0
    assert "best 2nd" in run("tournament", "show", "--file", file).stdout
    wall = tmp_path / "wall.html"
    assert run("tournament", "show", "--file", file, "--out", str(wall)).exit_code == 0
    assert "best 2nd" in wall.read_text()
    paper = tmp_path / "wall.pdf"
    made = run("tournament", "print", "bracket", "--file", file, "--out", str(paper))
    assert (made.exit_code, paper.stat().st_size > 1000) == (0, True)
    state = read_tournament(file)
    assert (state.plan.knockout_size, state.bracket.runners_up.rank) == (4, 2)
