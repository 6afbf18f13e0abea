"""`evenbreak season`: how a season of team matches may end."""

from __future__ import annotations

from typing import Any

import click

from evenbreak import files, teams
from evenbreak.answers.kit.answer import Answer
from evenbreak.cli.kit.faces import faces
from evenbreak.cli.kit.options import seed_option
from evenbreak.cli.kit.progress import Progress
from evenbreak.cli.kit.values import Whole, numbers, refuse

EXAMPLES = """\b
Examples:
  evenbreak season results.csv schedule.csv --up 2 --down 1
  evenbreak season results.csv --round-robin 2 --points sets
  evenbreak season results.csv schedule.csv --points 3,1,0 --ties head-to-head,difference
"""

_POINTS: Any = numbers(
    ",",
    range(3, 4),
    0.0,
    100.0,
    "give the points of a win, a draw and a loss, such as 2,1,0, or sets",
)


@click.command("season", epilog=EXAMPLES)
@click.argument("results", metavar="RESULTS.csv")
@click.argument("schedule", metavar="[SCHEDULE.csv]", required=False)
@click.option(
    "--teams", "team_file", metavar="TEAMS.csv", help="All teams, with points they have besides."
)
@click.option(
    "--round-robin",
    type=Whole(1, 10),
    metavar="K",
    help="Instead of a schedule: every two teams meet K times; what is not played is to come.",
)
@click.option(
    "--points",
    default="2,1,0",
    metavar="W,D,L|sets",
    help="The points of a win, a draw and a loss, or a point for each set won.",
)
@click.option(
    "--ties",
    default="difference,scored",
    metavar="RULE,...",
    help="What separates teams with equal points: difference and scored (sets), wins, "
    "head-to-head; then lots.",
)
@click.option(
    "--sets",
    type=Whole(1, 100),
    metavar="N",
    help="A match has N sets, all of them played.  [default: as in the results]",
)
@click.option(
    "--race", type=Whole(1, 100), metavar="N", help="A match goes to the first to win N sets."
)
@click.option("--up", type=Whole(1, 100), metavar="K", help="The first K teams go up.")
@click.option("--down", type=Whole(1, 100), metavar="K", help="The last K teams go down.")
@click.option(
    "--sure", is_flag=True, help="Take the strengths as right, instead of averaging over them."
)
@click.option(
    "--seasons",
    type=Whole(1000, 10_000_000),
    default=100_000,
    metavar="N",
    help="How many seasons to simulate, unless --sure and few endings give exact chances.",
)
@click.option(
    "--jobs", type=Whole(1, 256), default=1, metavar="N", help="Simulate with N processes."
)
@seed_option()
@faces()
def command(
    results: str,
    schedule: str | None,
    team_file: str | None,
    round_robin: int | None,
    points: str,
    ties: str,
    sets: int | None,
    race: int | None,
    up: int | None,
    down: int | None,
    sure: bool,
    seasons: int,
    jobs: int,
    seed: int,
) -> Answer:
    """Find each team's chances of title, promotion and relegation, and what is at stake next.

    RESULTS.csv has the columns home, away, home_score and away_score (sets), SCHEDULE.csv home and
    away, and a round if you like. Without a schedule, the matches of RESULTS.csv without a score,
    or at 0:0, are to come. How strong the teams are comes from the sets they have won.
    """
    import numpy as np

    from evenbreak.answers.kit.wording import count_of
    from evenbreak.answers.team.season import team_season_answer

    if schedule is not None and round_robin is not None:
        refuse("a schedule and --round-robin exclude each other; give one")
    warnings: list[str] = []
    known, start = files.TeamNames([]), None
    if team_file is not None:
        known, start, lines = files.read_teams(team_file)
        warnings += lines
    played, ahead = files.read_team_results(results, known)
    warnings += played.warnings
    if schedule is not None:
        if unplayed := len(ahead.pairs):
            left = count_of(unplayed, "match without a score", "matches without a score")
            warnings.append(f"{results}: {left} left out; the schedule says what is to come")
        ahead = files.read_fixtures(schedule, known)
        warnings += ahead.warnings
    to_come, rounds = ahead.pairs, ahead.rounds
    if round_robin is not None:
        to_come, rounds = teams.still_to_play(known.names, round_robin, played.pairs), ()
    elif not len(to_come):
        refuse(
            "say which matches are to come: give a schedule, or --round-robin K, or list them "
            "in RESULTS.csv without a score"
        )
    count = len(known.names)
    for name, many in (("--up", up), ("--down", down)):
        if many is not None and many >= count:
            refuse(f"{name} is {many}, but there are {count} teams; give fewer")
    if (up or 0) + (down or 0) > count:
        refuse(f"--up {up} and --down {down} are more than the {count} teams; give fewer")
    length = _length(played.scores, sets, race)
    rows = np.hstack([played.pairs, played.scores])
    strengths, scores = teams.team_strengths(known.names, rows), teams.scores_of(**length)
    season = teams.TeamSeason(
        known.names,
        rows,
        to_come,
        scores,
        teams.score_chances(strengths.estimate[None], to_come, scores),
        rules=_rules(points, ties),
        head_start=start,
    )
    watched, words = _next(to_come, rounds)
    places = [1, *([up] if up else []), *([count - down] if down else [])]
    with Progress("seasons") as progress:
        found = teams.season_chances(
            season,
            places=tuple(dict.fromkeys(places)),
            matches=watched,
            strengths=None if sure else strengths,
            seasons=seasons,
            seed=seed,
            jobs=jobs,
            progress=progress,
        )
    return team_season_answer(found, up=up, down=down, rounds=words, known=sure, warnings=warnings)


def _rules(points: str, ties: str) -> Any:
    separate = tuple(part.strip() for part in ties.split(",") if part.strip())
    if points.strip().lower() == "sets":
        return teams.TableRules(0.0, 0.0, 0.0, 1.0, ties=separate)
    try:
        win, draw, loss = _POINTS(points)
    except click.BadParameter as error:
        refuse(f"--points is {error.message}")
    return teams.TableRules(win, draw, loss, ties=separate)


def _length(scores: Any, sets: int | None, race: int | None) -> dict[str, int]:
    """Return how long a match is, from the options or from the results."""
    if sets is not None and race is not None:
        refuse("--sets and --race exclude each other; give one")
    if sets is not None or race is not None:
        wrong = scores.sum(axis=1) != sets if sets is not None else scores.max(axis=1) != race
        if wrong.any():
            a, b = scores[int(wrong.argmax())].tolist()
            option = f"--sets {sets}" if sets is not None else f"--race {race}"
            refuse(f"{option} does not fit the score {a}:{b} in the results")
        return {"sets": sets} if sets is not None else {"race": race}  # type: ignore[dict-item]
    totals, most = set(scores.sum(axis=1).tolist()), set(scores.max(axis=1).tolist())
    if len(totals) == 1:
        return {"sets": totals.pop()}
    if len(most) != 1:
        refuse(
            "the results have matches of different lengths; say with --sets or --race how long the "
            "matches to come are, and leave out what was not played to the end"
        )
    return {"race": most.pop()}


def _next(to_come: Any, rounds: tuple[str, ...]) -> tuple[tuple[int, ...], str]:
    """Return the matches of the next round, and what it is called."""
    if rounds and rounds[0]:
        return (
            tuple(k for k, name in enumerate(rounds) if name == rounds[0]),
            f"round {rounds[0]}" if rounds[0].isdigit() else rounds[0],
        )
    seen: set[int] = set()
    found = []
    for k, pair in enumerate(to_come.tolist()):
        if seen & set(pair):
            break
        seen |= set(pair)
        found.append(k)
    return tuple(found), ""
