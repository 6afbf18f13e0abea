"""The demo: its files are in the wheel, its commands work as printed, its evening is under way."""

import re
import shlex
import shutil
import tomllib
from datetime import datetime, timedelta
from pathlib import Path
from unittest.mock import patch

import pytest
from click.testing import CliRunner

from evenbreak.cli.program import program
from evenbreak.errors import DataError
from evenbreak.files import demo
from evenbreak.files.demo import DEMO, EVENING, write_demo, write_demo_evening
from evenbreak.files.store.tournament import read_tournament
from places import DATA, ROOT
from web.phones import Phone, running


def test_the_wheel_holds_the_files_of_the_demo_and_no_others() -> None:
    project = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))
    included = project["tool"]["hatch"]["build"]["targets"]["wheel"]["force-include"]
    assert included == {f"data/{name}": f"evenbreak/demo_data/{name}" for name in (*DEMO, EVENING)}


def test_the_files_are_those_of_the_checkout() -> None:
    assert all(demo._place(name) == DATA / name for name in (*DEMO, EVENING))


def test_an_installed_package_has_them(tmp_path: Path) -> None:
    shutil.copytree(DATA, tmp_path / "package" / "demo_data")
    with patch.object(demo, "files", lambda _: tmp_path / "package"):
        assert demo._place("demo_pairs.csv") == tmp_path / "package/demo_data/demo_pairs.csv"


def test_writing_twice_is_writing_once_and_what_is_missing_comes_back(tmp_path: Path) -> None:
    assert write_demo(tmp_path) == list(DEMO)
    assert write_demo(tmp_path) == []
    (tmp_path / "demo_team.csv").unlink()
    assert write_demo(tmp_path) == ["demo_team.csv"]
    assert (tmp_path / "demo_team.csv").read_bytes() == (DATA / "demo_team.csv").read_bytes()


@pytest.mark.parametrize("name", DEMO)
def test_a_file_of_the_reader_is_never_replaced(tmp_path: Path, name: str) -> None:
    (tmp_path / name).write_text("player\nAnn Lee\n")
    with pytest.raises(DataError, match=f"{name} already exists"):
        write_demo(tmp_path)
    assert [one.name for one in tmp_path.iterdir()] == [name]
    assert (tmp_path / name).read_text() == "player\nAnn Lee\n"


@pytest.mark.slow
def test_the_commands_work_as_printed(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path))
    shown = CliRunner().invoke(program, ["demo", f"a folder {'far ' * 20}away"])
    commands = re.findall(r"  evenbreak (.+)$", shown.stdout, re.MULTILINE)
    assert len(commands) == 3
    for line in commands:
        with patch("evenbreak.web.command._taken", return_value=""), patch("uvicorn.Server.run"):
            result = CliRunner().invoke(program, shlex.split(line))
        assert result.exit_code == 0, result.output
        assert result.output


@pytest.mark.slow
def test_the_evening_is_in_the_middle(tmp_path: Path) -> None:
    now = datetime.now().replace(microsecond=0)
    write_demo_evening(tmp_path / "evening.db", now)
    state = read_tournament(tmp_path / "evening.db")
    times = [datetime.fromisoformat(event.at) for event in state.events]
    assert times == sorted(times)
    assert timedelta() < now - times[-1] < timedelta(minutes=5)
    assert len(state.counted) == 13
    assert any(sum(score.what.score) for score in state.live.values())
    assert set(state.standing.to_play) - set(state.on_tables)  # there is a match to call
    with running(tmp_path / "evening.db") as site:
        director = Phone(site, director=True)
        for path in ("/", "/desk", "/bracket", "/screen"):
            assert director.open(path).status == 200


def test_serving_the_demo_touches_nothing_else(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "mine").mkdir()
    monkeypatch.chdir(tmp_path / "mine")
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path))
    with patch("evenbreak.web.command._taken", return_value=""), patch("uvicorn.Server.run"):
        result = CliRunner().invoke(program, ["serve", "--demo"])
    assert result.exit_code == 0, result.output
    (place,) = re.findall(r"The demo: (.+?\.db)", result.output)
    assert Path(place).parent.parent == tmp_path
    assert read_tournament(place).counted
    assert not any(Path().iterdir())
    assert CliRunner().invoke(program, ["serve", "tonight.db", "--demo"]).exit_code == 2


def test_in_its_folder_the_commands_take_their_defaults_from_the_leagues_file(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    write_demo(tmp_path)
    monkeypatch.chdir(tmp_path)
    for words in (
        "matchups --pairs demo_pairs.csv -v",
        "league table",
        'odds "Ines Valbrecht" "Søren Lindqvall"',
    ):
        shown = CliRunner().invoke(program, shlex.split(words))
        assert shown.exit_code == 0, shown.output
    assert "From league.toml: " in CliRunner().invoke(program, ["chart", "audit", "-v"]).stderr
