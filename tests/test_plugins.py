"""Systems, charts and games of other packages: one that is installed, and broken ones."""

import shutil
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from click.testing import CliRunner, Result

from evenbreak import games, handicaps, plugins
from evenbreak.cli.program import program
from places import DATA, ROOT
from rows import each_of

EXAMPLE = ROOT / "docs/how-to/league_rules"
BROKEN = """
from evenbreak.games import OneBall
from evenbreak.handicaps import Chart, System
from evenbreak.handicaps.systems.none import NoHandicap

class Lazy(System):
    name = "lazy"

class Nameless(NoHandicap):
    def __init__(self, games):
        pass

class OneSided(NoHandicap):
    def race(self, a, b):
        m, n = super().race(a, b)
        return m + 1, n

DIP = Chart("dip", [(0, 9, 5, 5), (10, 19, 5, 3), (20, None, 5, 4)])

def gap():
    return Chart("gap", [(0, 9, 5, 5), (12, None, 5, 3)])

class Leaky:
    start = 0
    def moves(self, state):
        return {} if state else {1: 0.5, 2: 0.4}
    def winner(self, state):
        return state or None

class Pieces(Leaky):
    moves = None

class Club(NoHandicap):
    pass

class Ended(NoHandicap):
    def __init__(self):
        raise SystemExit("no license")

class Unset(NoHandicap):
    def __init__(self):
        self.nobodys

class Importing(NoHandicap):
    def __init__(self):
        import nowhere

HOUSE = Chart("house", [(0, None, 5, 5)])
COIN = OneBall(0.4, 0.8)
"""
POINTS = """
[evenbreak.systems]
absent = nowhere:System
lazy = broken_rules:Lazy
nameless = broken_rules:Nameless
one-sided = broken_rules:OneSided
text = broken_rules:BROKEN
fine = evenbreak.handicaps.systems.none:NoHandicap
npl = broken_rules:OneSided
elo-club = broken_rules:Club

[evenbreak.charts]
dip = broken_rules:DIP
gap = broken_rules:gap
absent = nowhere:CHART
NPL-10 = broken_rules:HOUSE
wrong = broken_rules:Leaky
house = evenbreak.handicaps.charts.level_chart:level_chart

[evenbreak.games]
leaky = broken_rules:Leaky
pieces = broken_rules:Pieces
absent = nowhere:Game
coin = broken_rules:COIN
9-ball = broken_rules:COIN
"""


def run(*words: object) -> Result:
    return CliRunner().invoke(program, [str(word) for word in words])


def wrote(folder: Path, package: str, points: str, code: str = "") -> Path:
    """Write what an installation leaves of a package of one module."""
    module = package.replace("-", "_")
    about = folder / f"{module}-0.1.dist-info"
    about.mkdir(parents=True)
    (about / "METADATA").write_text(f"Metadata-Version: 2.1\nName: {package}\nVersion: 0.1\n")
    (about / "entry_points.txt").write_text(points)
    (folder / f"{module}.py").write_text(code)
    return folder


@pytest.fixture
def forgotten() -> Iterator[None]:
    """Forget the modules of packages afterward."""
    yield
    for name in ("broken_rules", "other_rules", "league_rules"):
        sys.modules.pop(name, None)


@pytest.fixture
def broken(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, forgotten: None) -> None:  # noqa: ARG001
    monkeypatch.syspath_prepend(wrote(tmp_path, "broken-rules", POINTS, f"BROKEN = 1{BROKEN}"))


@pytest.mark.usefixtures("broken")
@each_of(
    "kind, name, why",
    [
        ("system", "absent", "it failed with ModuleNotFoundError: No module named 'nowhere'"),
        (
            "system",
            "lazy",
            "the class has no initial and update. Add what's missing",
        ),
        ("system", "nameless", "it can't be made without arguments (missing a required"),
        ("system", "one-sided", "in the system none, the race is"),
        ("system", "text", "it isn't a System. Derive its class from System: class int(System)"),
        ("chart", "dip", "the race in row 3, 5:4, is easier for the stronger player than"),
        ("chart", "gap", "row 2 starts at 12, but row 1 ends at 9"),
        ("chart", "absent", "it failed with ModuleNotFoundError"),
        ("chart", "wrong", "it must be a Chart, a LevelChart or a PointsChart; it is a Leaky"),
        ("game", "leaky", "the moves from 0 have chances that sum to 0.9, not 1"),
        ("game", "pieces", "it failed with TypeError"),
        ("game", "absent", "it failed with ModuleNotFoundError"),
    ],
)
def test_what_breaks_a_law_is_refused_in_a_sentence_with_its_package(
    kind: str, name: str, why: str
) -> None:
    words = {
        "system": ("ladder", "--system", name),
        "chart": ("chart", "show", name),
        "game": ("graph", name, "--out", "nothing"),
    }[kind]
    done = run(*words)
    said = " ".join(done.stderr.split())
    assert done.exit_code == 2, done.output
    assert f"{kind} '{name}' of package broken-rules 0.1: {why}" in said
    assert not Path("nothing").exists()


@pytest.mark.usefixtures("broken")
def test_a_broken_package_stops_nothing_that_does_not_name_it() -> None:
    assert handicaps.system_of("npl").name == "npl"  # ours, whoever else takes the name
    assert run("odds", "--p", "0.6", "--race", "7:5").exit_code == 0
    assert run("chart", "show", "npl_8").exit_code == 0
    assert handicaps.system_of("Fine") == handicaps.NoHandicap()
    assert "broken_rules" not in sys.modules
    listed = run("systems", "--csv")
    assert listed.exit_code == 0
    assert "broken-rules 0.1" in next(row for row in listed.stdout.split("\n") if "fine" in row)
    assert "'lazy' of package broken-rules 0.1" in " ".join(listed.stderr.split())
    assert [row[:21] for row in listed.stdout.split("\n") if row[:4] == "npl,"] == [
        "npl,npl_10,evenbreak,"
    ]
    hidden = "in package broken-rules 0.1 is hidden by evenbreak's own"
    assert f"system 'npl' {hidden}" in " ".join(listed.stderr.split())
    charts = run("chart", "list", "--csv")
    assert charts.exit_code == 0
    assert "dip" not in charts.stdout
    assert "broken-rules" not in charts.stdout
    assert f"chart 'NPL-10' {hidden}" in " ".join(charts.stderr.split())
    assert "'dip' of package broken-rules 0.1" in " ".join(charts.stderr.split())


@pytest.mark.usefixtures("broken")
def test_a_name_that_two_packages_have_is_refused_with_both(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    other = "[evenbreak.systems]\nFINE = evenbreak.handicaps.systems.none:NoHandicap\n"
    monkeypatch.syspath_prepend(wrote(tmp_path / "other", "other-rules", other))
    with pytest.raises(ValueError, match=r"both other-rules 0.1 and broken-rules 0.1 provide"):
        handicaps.system_of("fine")


def test_nobody_elses_name_is_refused_with_ours_and_theirs() -> None:
    with pytest.raises(ValueError, match="system must be npl, step"):
        handicaps.system_of("theirs")
    assert handicaps.named_chart("theirs") is None


@pytest.mark.usefixtures("broken")
def test_names_that_begin_as_ours_or_are_a_word_of_ours_are_reached() -> None:
    assert type(handicaps.system_of("Elo Club")).__name__ == "Club"
    assert handicaps.system_of("elo-10").name == "elo 10"
    with pytest.raises(ValueError, match=r"Write it as elo \[K\]"):
        handicaps.system_of("elo league")
    assert games.game_of_catalog("9-ball")[0] == "9-ball"
    assert games.game_of_catalog("drill 9-ball")[0] == "drill, progressive 9-ball"


@pytest.mark.usefixtures("broken")
def test_chances_for_a_game_that_takes_none_are_refused(tmp_path: Path) -> None:
    assert games.game_of_catalog("coin")[1] == games.OneBall(0.4, 0.8)
    done = run("graph", "coin", "--p", 0.7, "--out", tmp_path / "drawn")
    assert done.exit_code == 2
    assert "'coin' of package broken-rules 0.1: it's already complete and takes no chances" in (
        " ".join(done.stderr.split())
    )


@pytest.mark.usefixtures("broken")
@each_of(
    "name, why",
    [
        ("Ended", "it failed with SystemExit: no license"),
        ("Unset", "it failed with AttributeError: 'Unset' object has no attribute 'nobodys'"),
        ("Importing", "it failed with ModuleNotFoundError: No module named 'nowhere'"),
        ("Nobodys", "but broken_rules has no Nobodys. Name one of its classes"),
        ("Lazy", "the class has no initial and update. Add what's missing"),
    ],
)
def test_an_error_of_ones_own_class_is_told_as_its_own(name: str, why: str) -> None:
    done = run("ladder", "--system", f"broken_rules:{name}")
    assert done.exit_code == 2, done.output
    assert f"system is 'broken_rules:{name}'" in (said := " ".join(done.stderr.split()))
    assert why in said


@pytest.mark.slow
def test_no_package_is_looked_for_where_a_name_is_ours(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def nobody_looks(kind: str) -> None:
        pytest.fail(f"packages with a {kind} are looked for")

    monkeypatch.setattr(plugins, "_points", nobody_looks)
    assert handicaps.system_of("step-2").name == "step 2"
    assert handicaps.named_chart("NPL 10")
    for number, game in enumerate([("one-ball",), ("npl_8",), ("3:2", "--p", 0.6)]):
        done = run("graph", *game, "--out", tmp_path / str(number))
        assert done.exit_code == 0, done.output


@pytest.mark.parametrize("name", handicaps.EVERY_CHART)
def test_our_own_charts_hold_to_the_laws(name: str) -> None:
    assert handicaps.broken_chart_laws(handicaps.named_chart(name)) == []


class Coin:
    """A game in which each part can be broken."""

    start: Any = "start"
    chance = 0.5

    def moves(self, state: Any) -> dict[Any, float]:
        return {"1": self.chance, "2": 1 - self.chance} if state == self.start else {}

    def winner(self, state: Any) -> int | None:
        return {"1": 1, "2": 2}.get(state)


class Loud(Coin):
    start = "start " * 9


class Negative(Coin):
    chance = -0.5


class Winning(Coin):
    def winner(self, state: Any) -> int:
        return 1 + (state == "2")


class Nobody(Coin):
    def winner(self, state: Any) -> Any:
        return None if state == self.start else "Ann"


class Alike(Coin):
    def moves(self, state: Any) -> dict[Any, float]:
        return {"1": 0.5, 1: 0.5} if state == self.start else {}


class Fickle(Coin):
    def moves(self, state: Any) -> dict[Any, float]:
        self.chance /= 2
        return super().moves(state)


class Arrays(Coin):
    def arcs(self) -> Any:
        import numpy as np

        from evenbreak.game import ArcArrays

        return ArcArrays(["start", "1"], np.array([0]), np.array([1]), np.array([1.0]))


@pytest.mark.parametrize(
    ("game", "why"),
    [
        (Loud(), "doesn't print on one line"),
        (Negative(), "has probability -0.5. Give a number from 0 to 1"),
        (Winning(), "player 1 has won in 'start', but there are moves"),
        (Nobody(), "the winner in '1' must be 1, 2, ... or None; it is 'Ann'"),
        (Alike(), "two different states print as '1'"),
        (Fickle(), "differ the second time"),
        (Arrays(), "arrays don't match its moves"),
    ],
    ids=lambda value: type(value).__name__,
)
def test_each_law_of_games_is_found_broken(game: Any, why: str) -> None:
    assert why in " ".join(games.broken_laws(game))


@pytest.mark.slow
def test_the_example_of_the_docs_is_installed_and_judged(
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    forgotten: None,  # noqa: ARG001
) -> None:
    source, target = tmp_path / "source", tmp_path / "installed"
    shutil.copytree(EXAMPLE, source, ignore=shutil.ignore_patterns("__pycache__"))
    offline = ("--no-deps", "--no-build-isolation", "--no-index", "--disable-pip-version-check")
    install = ("-m", "pip", "install", "-q", *offline, "--target", str(target), str(source))
    subprocess.run([sys.executable, *install], check=True)
    monkeypatch.syspath_prepend(target)
    monkeypatch.chdir(tmp_path)

    assert handicaps.broken_laws(handicaps.system_of("last ten")) == []
    assert handicaps.broken_chart_laws(handicaps.chart_of("fargo house")) == []
    assert games.broken_laws(games.game_of_catalog("two in a row", 0.7)[1]) == []

    season = ("--weeks", 6, "--replicas", 3, "--seed", 1)
    both = ("--compare", "last-ten", "--compare", "fargo-like", "--json")
    judged = run("simulate", DATA / "demo_roster.csv", *season, *both)
    assert judged.exit_code == 0, judged.output
    assert "last ten" in judged.stdout
    assert "fargo-like" in judged.stdout

    races = run("chart", "show", "fargo-house", "--csv")
    assert races.stdout.split("\n")[2] == "40,89,5,4"
    house = ("--scale", "fargo", "--chart", "fargo-house")
    assert "6:4" in run("odds", 612, 502, *house, "--text").output
    assert (
        "the chart fargo_house"
        in run("matchups", DATA / "demo_roster.csv", *house, "--text").output
    )
    ladder = run("graph", "fargo house", "--out", "ladder")
    assert "The ladder of rating errors on the chart fargo_house" in ladder.output
    drawn = run("graph", "two-in-a-row", "--p", 0.7, "--out", "drawn")
    assert drawn.exit_code == 0, drawn.output
    assert "Two-in-a-row with p = 0.7" in drawn.output
    assert "league-rules 1.0" in run("systems", "--csv").stdout
