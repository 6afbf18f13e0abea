"""`evenbreak publish`: from a league's folder, by its file or by options."""

from __future__ import annotations

import json
from pathlib import Path

import pandas as pd
import pytest

from evenbreak.files.csv_writer import to_csv
from evenbreak.files.store.tournament import new_tournament
from evenbreak.ratings import Results
from published_leagues import season
from tournament_nights import night

LEAGUE = """name = "Tuesday 8-Ball"
chart = "apa_8ball"
[files]
fixtures = "fixtures.csv"
[[results]]
file = "fall.csv"
columns = { player_a = "Heim", player_b = "Gast" }
[aliases]
"Zeb Q" = "Zebulon Quackenbush"
[standings]
points = [3, 1, 0]
[publish]
color = "#ffee00"
logo = "logo.png"
[publish.players]
"Zeb Q" = "initials"
"Bo Diaz" = "hidden"
"""


def results_csv(results: Results, a: str = "player_a", b: str = "player_b") -> bytes:
    seats = results.player_a.tolist(), results.player_b.tolist()
    first, second = ([results.players[k] for k in seat] for seat in seats)
    names = ["date", "score_a", "score_b", "race_a", "race_b", "level_a", "level_b"]
    columns = {name: getattr(results, name) for name in names}
    made = {name: column for name, column in columns.items() if column is not None}
    return to_csv(pd.DataFrame({a: first, b: second, **made}))


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    many = len(season())
    levels = {"level_a": ["4"] * many, "level_b": ["5"] * many}
    (tmp_path / "fall.csv").write_bytes(results_csv(season(**levels), "Heim", "Gast"))
    (tmp_path / "league.toml").write_text(LEAGUE)
    (tmp_path / "fixtures.csv").write_text(
        "home,away,date,table\nAnn Lee,Zeb Q,2025-09-09,1\n"
        "Ann Lee,Zebulon Quackenbush,2025-09-23,2\nZebulon  Qackenbush,Bo Diaz,2025-09-23,3\n"
    )
    (tmp_path / "logo.png").write_bytes(b"\x89PNG\r\n\x1a\n")
    monkeypatch.chdir(tmp_path)
    return tmp_path


def content_of(folder: Path) -> dict[str, bytes]:
    return {
        str(path.relative_to(folder)): path.read_bytes()
        for path in sorted(folder.rglob("*"))
        if path.is_file()
    }


def test_a_leagues_folder_is_published_without_a_word(run, folder: Path) -> None:
    done = run("publish")
    assert done.exit_code == 0, done.stderr
    assert "#ffee00 is too light" in done.stdout
    assert "2 players are not named in full" in done.stdout
    site = content_of(folder / "site")
    index = site["index.html"].decode()
    assert "<title>Tuesday 8-Ball</title>" in index
    assert "3 points for a win" in index
    assert site["logo.png"] == b"\x89PNG\r\n\x1a\n"
    assert b"Sep 23, 2025" in site["fixtures.html"]
    assert b"Sep 9, 2025" not in site["fixtures.html"]
    for name, content in site.items():
        for word in (b"quackenbush", b"qackenbush", b"zeb", b"diaz"):
            assert word not in content.lower() + name.encode(), (name, word)
    run("publish")
    assert content_of(folder / "site") == site


def test_a_player_who_wants_to_be_hidden_loses_the_page(run, folder: Path) -> None:
    (folder / "site").mkdir()
    (folder / "site" / "mine.html").write_text("kept")
    run("publish")
    assert (folder / "site" / "players" / "ann-lee.html").exists()
    text = (folder / "league.toml").read_text()
    (folder / "league.toml").write_text(text + '"Ann Lee" = "hidden"\n')
    run("publish")
    site = content_of(folder / "site")
    assert not any(b"Ann Lee" in content or "ann-lee" in name for name, content in site.items())
    assert site["mine.html"] == b"kept"


def test_the_standings_have_the_deductions_of_the_leagues_table(run, folder: Path) -> None:
    text = (folder / "league.toml").read_text()
    (folder / "league.toml").write_text(text.replace("[files]", '[files]\nteams = "teams.csv"'))
    (folder / "teams.csv").write_text("name,points\nAnn  LEE,-90\n")
    assert run("publish").exit_code == 0
    last = (folder / "site/data/standings.csv").read_text().splitlines()[-1].split(",")
    rows = json.loads(run("league", "table", "--json").stdout)["table"]
    assert (last[1], float(last[-1])) == ("Ann Lee", rows[-1]["points"])


def test_a_match_that_was_not_played_on_its_day_is_postponed(run, folder: Path) -> None:
    with (folder / "fixtures.csv").open("a") as more:
        more.write("Bo Diaz,Newcomer,2025-09-09,4\nAnn Lee,Bo Diaz,2025-09-09,5\n")
    run("publish")
    page = (folder / "site/fixtures.html").read_text()
    assert "Sep 9, 2025, postponed" in page
    assert "table\N{NO-BREAK SPACE}4" in page
    assert "table\N{NO-BREAK SPACE}5" not in page


@pytest.mark.parametrize("manifest", ["[]", '{"pages": null, "files": [3]}', '{"pages": 4}'])
def test_a_manifest_of_another_kind_is_no_reason_to_replace(run, folder: Path, manifest) -> None:
    (folder / "site/data").mkdir(parents=True)
    (folder / "site/data/manifest.json").write_text(manifest)
    assert "wasn't made by an earlier run" in " ".join(run("publish").stderr.split())


def test_a_page_of_somebody_elses_is_not_replaced(run, folder: Path) -> None:
    (folder / "site").mkdir()
    (folder / "site" / "index.html").write_text("my own")
    done = run("publish")
    assert done.exit_code == 2
    assert "wasn't made by an earlier run" in " ".join(done.stderr.split())
    assert content_of(folder / "site") == {"index.html": b"my own"}


def test_a_slip_in_a_name_leaves_the_site_as_it_was(run, folder: Path) -> None:
    run("publish")
    site = content_of(folder / "site")
    text = (folder / "league.toml").read_text()
    (folder / "league.toml").write_text(text + '"An Lee" = "hidden"\n')
    done = run("publish")
    assert done.exit_code == 3
    assert "did you mean 'Ann Lee'?" in done.stderr
    assert content_of(folder / "site") == site


def test_a_disk_that_fails_leaves_the_site_as_it_was(run, folder, monkeypatch) -> None:
    run("publish")
    site = content_of(folder / "site")
    moved = Path.replace

    def fails(self: Path, target: Path) -> Path:
        if target.name == "races.html":
            raise OSError(28, "no space left")
        return moved(self, target)

    monkeypatch.setattr(Path, "replace", fails)
    assert run("publish", "--title", "Another").exit_code == 1
    monkeypatch.undo()
    assert content_of(folder / "site") == site


def test_finished_tournaments_have_their_brackets(run, tmp_path: Path) -> None:
    whole, part = night(8, "double", 99), night(8, "double", 3)
    (tmp_path / "nights").mkdir()
    new_tournament(tmp_path / "nights" / "fall-open.db", whole.events)
    new_tournament(tmp_path / "nights" / "tonight.db", part.events)
    (tmp_path / "nights" / "other.db").write_bytes(b"something else")
    (tmp_path / "fall.csv").write_bytes(results_csv(season(rounds=1)))
    out = tmp_path / "site"
    done = run(
        *("publish", str(tmp_path / "fall.csv"), "--out", str(out)),
        *("--tournaments", str(tmp_path / "nights")),
    )
    assert done.exit_code == 0, done.stderr
    assert [path.name for path in out.glob("tournament-*")] == ["tournament-fall-open.html"]
    assert "won by" in (out / "tournaments.html").read_text()


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (("--chart", "npl_10", "--race-to", "7"), "can't be used together."),
        (("--logo", "fall.csv"), "Save it as one"),
        (("--color", "red"), "'red' isn't a color"),
        (("--chart", "house.csv"), "--scale is missing"),
        (("--chart", "apa_8ball"), "no skill levels"),
    ],
)
def test_what_cannot_be_published_is_refused(run, tmp_path, monkeypatch, words, said) -> None:
    (tmp_path / "fall.csv").write_bytes(results_csv(season()))
    (tmp_path / "house.csv").write_text(
        "difference_from,difference_to,stronger_needs,weaker_needs\n0,50,5,5\n51,,5,4\n"
    )
    monkeypatch.chdir(tmp_path)
    done = run("publish", "fall.csv", *words)
    assert done.exit_code in (2, 3)
    assert said in " ".join(done.stderr.split())
    assert not (tmp_path / "site").exists()
