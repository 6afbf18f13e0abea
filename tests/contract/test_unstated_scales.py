"""No command reads a list of ratings on a scale that they contradict.

Every command that takes such a list is given one of Fargo ratings that does not say so.
"""

from __future__ import annotations

import shlex
from collections.abc import Iterator
from pathlib import Path

import click
import pytest
from click.testing import CliRunner

from evenbreak.cli.program import program

RATED = {"Ann Lee": 656, "Bo Diaz": 375, "Cy Brown": 590, "Di Evans": 512, "Ed Ford": 530}

LISTS = {
    "plain.csv": ["player,rating", *(f"{name},{rating}" for name, rating in RATED.items())],
    "other.csv": ["player,rating", *(f"{name} Jr,{rating}" for name, rating in RATED.items())],
    "says_npl.csv": [
        "player,rating,scale",
        *(
            "Flo Gray,85,npl",
            "Gus Hill,71,npl",
            "Hal Ives,80,npl",
            "Io Jones,60,npl",
            "Ky Low,90,npl",
        ),
    ],
    "results.csv": [
        "date,player_a,player_b,score_a,score_b,race_a,race_b",
        "2026-01-07,Ann Lee,Cy Brown,7,5,7,7",
        "2026-01-07,Bo Diaz,Di Evans,4,7,7,7",
        "2026-01-14,Ed Ford,Ann Lee,4,7,7,7",
        "2026-01-14,Cy Brown,Bo Diaz,7,2,7,7",
        "2026-01-21,Di Evans,Ed Ford,7,6,7,7",
    ],
    "cup.json": ["{}"],
}
TEAMS = [
    "team,player,rating,level",
    *(f"{team},{name} {team},{RATED[name]},3" for team in ("Racks", "Cues") for name in RATED),
]

LINES: dict[tuple[str, str], list[str]] = {
    ("odds", "--from"): ["odds 'Ann Lee' 'Bo Diaz' --from plain.csv --race 7"],
    ("live", "--from"): ["live 'Ann Lee' 'Bo Diaz' --from plain.csv --race 7 --score 2-3"],
    ("fair", "--from"): ["fair 'Ann Lee' 'Bo Diaz' --from plain.csv --race-to 7"],
    ("compare", "--from"): ["compare 'Ann Lee' 'Bo Diaz' --from plain.csv 7:5 7:6"],
    ("tournament new", "entrants"): [
        "tournament new plain.csv --race 7 --out a.db --tables 2",
        "tournament new plain.csv --chart npl_10 --out b.db --tables 2",
    ],
    ("tournament odds", "entrants"): [
        "tournament odds plain.csv --race 7",
        "tournament odds plain.csv --chart npl_10",
        "tournament odds plain.csv --race-to 7 --format single",
    ],
    ("tournament time", "entrants"): [
        "tournament time plain.csv --race 7 --tables 2 --discipline 9-ball",
        "tournament time plain.csv --chart npl_10 --tables 2 --discipline 9-ball",
    ],
    ("chips odds", "entrants"): ["chips odds plain.csv --chips hoboken"],
    ("chips audit", "--entrants"): ["chips audit hoboken --entrants plain.csv"],
    ("chips design", "entrants"): ["chips design plain.csv"],
    ("lineup", "ours"): [
        "lineup plain.csv other.csv --race 5",
        "lineup plain.csv other.csv --chart npl_10",
        "lineup plain.csv says_npl.csv --race 5",
    ],
    ("lineup", "theirs"): ["lineup says_npl.csv plain.csv --race 5"],
    ("round", "ours"): [
        "round plain.csv other.csv --race 5",
        "round plain.csv other.csv --chart npl_10",
        "round plain.csv says_npl.csv --race 5",
    ],
    ("round", "theirs"): ["round says_npl.csv plain.csv --race 5"],
    ("caps", "roster"): [
        "caps teams.csv --race 5 --cap 23",
        "caps teams.csv --chart npl_10 --cap 23",
    ],
    ("report", "--begin"): ["report results.csv --begin plain.csv --out sheets"],
    ("rate", "--begin"): ["rate results.csv --begin plain.csv"],
    ("rate", "--roster"): [
        "rate results.csv --roster plain.csv --system npl",
        "rate results.csv --roster plain.csv --system 'step 2'",
        "rate results.csv --roster plain.csv --system margin",
        "rate results.csv --roster plain.csv --system elo",
        "rate results.csv --roster plain.csv --system fixed",
    ],
    ("publish", "--roster"): ["publish results.csv --roster plain.csv --out site"],
    ("rate", "--anchor"): [
        "rate results.csv --anchor 512",
        "rate results.csv --anchor 'Ann Lee=656'",
    ],
    ("why", "--begin"): ["why 'Ann Lee' 'Bo Diaz' --results results.csv --begin plain.csv"],
    ("validate", "--begin"): ["validate results.csv --begin plain.csv"],
    ("matchups", "roster"): [
        "matchups plain.csv --chart npl_10",
        "matchups plain.csv --chart npl_10 --race-to 7",
        "matchups plain.csv --race-to 7",
        "matchups plain.csv --games 7..13",
    ],
    ("matchups", "--players-file"): ["matchups says_npl.csv --race-to 7 --players-file plain.csv"],
    ("simulate", "roster"): [
        "simulate plain.csv --replicas 10 --weeks 3 --out season",
        "simulate plain.csv --replicas 10 --weeks 3 --out season --chart npl_10",
        "simulate plain.csv --replicas 10 --weeks 3 --out season --system 'step 2'",
        "simulate plain.csv --replicas 10 --weeks 3 --out season --system elo",
    ],
    ("simulate", "--players-file"): [
        "simulate says_npl.csv --replicas 10 --weeks 3 --out season --players-file plain.csv"
    ],
    ("ladder", "--league"): [
        "ladder --league plain.csv",
        "ladder --league plain.csv --system 'step 2'",
        "ladder --league plain.csv --chart npl_10",
        "ladder --league plain.csv --compare",
    ],
    ("sandbag watch", "--roster"): [
        "sandbag watch results.csv --roster plain.csv",
        "sandbag watch results.csv --roster plain.csv --chart npl_10",
        "sandbag watch results.csv --roster plain.csv --system elo",
    ],
}
"""The ways to give each command a list of ratings."""

OF_RATINGS = ("ENTRANTS", "ROSTER", "RATINGS", "LAST", "OURS", "THEIRS", "NAME=POINTS")
"""Words of the metavars of lists of ratings."""

NAMED = ("--players-file", "--entrants")
"""Options that take them by another metavar."""

ELSEWHERE = {
    ("rate", "--save"): "is written",
    ("report", "--save"): "is written",
    ("report", "--players-file"): "says who comes; its ratings are not read",
    ("tournament import", "--ratings"): "takes a saved tournament too, and has a test of its own",
}


def of_ratings(command: click.Command, path: str = "") -> Iterator[tuple[str, str]]:
    """Yield each command and its option or argument that takes ratings."""
    if isinstance(command, click.Group):
        for name, inner in command.commands.items():
            yield from of_ratings(inner, f"{path} {name}".strip())
        return
    for option in command.params:
        metavar = option.metavar or ""
        if any(word in metavar for word in OF_RATINGS) or option.opts[0] in NAMED:
            yield path, option.opts[0]


def test_every_option_that_takes_ratings_is_tried() -> None:
    everything = set(of_ratings(loaded(program)))
    assert everything - LINES.keys() - ELSEWHERE.keys() == set()
    assert len(everything) > 25


def loaded(group: click.Group) -> click.Group:
    """Return a group with its commands, those that are imported when needed too."""
    context = click.Context(group)
    commands = {name: group.get_command(context, name) for name in group.list_commands(context)}
    return click.Group(
        commands={
            name: loaded(one) if isinstance(one, click.Group) else one
            for name, one in commands.items()
            if one is not None
        }
    )


@pytest.mark.slow_after(12)
@pytest.mark.parametrize("line", [line for lines in LINES.values() for line in lines])
def test_a_list_of_fargo_ratings_is_read_as_that_or_refused(
    line: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    for name, lines in {**LISTS, "teams.csv": TEAMS}.items():
        Path(name).write_text("\n".join(lines) + "\n", encoding="utf-8")
    done = CliRunner().invoke(program, [*shlex.split(line), "--text"])
    if "No such option" in done.stderr:  # one that writes files alone
        done = CliRunner().invoke(program, shlex.split(line))
    assert done.exception is None or isinstance(done.exception, SystemExit)
    if done.exit_code:
        assert done.exit_code in (2, 3), done.output
        assert "Fargo" in done.stderr or "fargo" in done.stderr, done.stderr
        assert any(own in done.stderr for own in ("NPL", "Elo", "npl")), done.stderr
    else:
        said = done.output + "".join(
            path.read_text(encoding="utf-8") for path in tmp_path.glob("sheets/*.csv")
        )
        assert "NPL" not in said.replace("npl_10", "") or "Fargo" in said, said
