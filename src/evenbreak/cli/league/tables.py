"""`evenbreak league table` and `league fixtures`: who is ahead of whom, and who plays whom."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from evenbreak import files, league, ratings
from evenbreak.answers.kit.answer import Answer
from evenbreak.answers.kit.wording import count_of
from evenbreak.arrays import Floats
from evenbreak.cli.kit.asked import command_of
from evenbreak.files.tables.names import same_name
from evenbreak.questions.tables import LeagueTable


@command_of(LeagueTable, "table")
def table(asked: LeagueTable) -> Answer:
    """Make the table of a league."""
    from evenbreak.answers.league.standings import table_answer

    file = files.read_seasons(asked.results, **asked.reading, unplayed=True)
    rules = replace(asked.table_points, ties=asked.ties)
    matches, of_teams = _matches(asked, file.results, rules)
    start = None
    warnings = [*file.warnings, *_left_out(matches)]
    if asked.teams is not None:
        matches, start, lines = _with_teams(matches, asked.teams)
        warnings += lines
    if (day := asked.day("until")) is not None:
        if undated := int(np.isnat(matches.date).sum()):
            warnings.append(
                f"{count_of(undated, 'match', 'matches')} without a date left out, as --until asks"
            )
        matches = matches.until(day)
    found = league.league_table(matches, rules, head_start=start, side=asked.side)
    earlier = None
    days = matches.date[~np.isnat(matches.date)]
    if len(days) and days.min() < days.max():
        before = matches.among((matches.date < days.max()) | np.isnat(matches.date))
        earlier = league.league_table(before, rules, head_start=start, side=asked.side)
    about = [] if asked.side == "both" else ["at home" if asked.side == "home" else "away"]
    about += [] if day is None else [f"until {day}"]
    return table_answer(
        found,
        earlier=earlier,
        who="team" if of_teams else "player",
        score="sets" if of_teams and not asked.count_games else "games",
        about=", ".join(about),
        warnings=warnings,
    )


def _matches(
    asked: LeagueTable, results: ratings.Results, rules: league.TableRules
) -> tuple[league.TableMatches, bool]:
    """Return the matches of teams or players, and whether they are those of teams."""
    teams = results.team_a, results.team_b
    named = all(one is not None and (one != "").any() for one in teams)
    if named and asked.of != "players":
        return league.team_matches(results, count_games=asked.count_games, rules=rules), True
    return league.player_matches(results), asked.of == "teams"


def _left_out(matches: league.TableMatches) -> list[str]:
    """Return warnings about forfeits without a winner, and matches without a score."""
    found = []
    if matches.undecided:
        many = count_of(matches.undecided, "forfeit")
        found.append(f"{many} left out: the results do not say who won; add the column winner")
    if matches.unscored:
        many = count_of(matches.unscored, "match has", "matches have")
        found.append(f"{many} a winner but no score, which counts as 0-0 in games")
    return found


def _with_teams(
    matches: league.TableMatches, path: str
) -> tuple[league.TableMatches, Floats, list[str]]:
    """Return the matches between all that a file lists, and the points that they have besides."""
    known, points, warnings = files.read_teams(path)
    place = {same_name(name): k for k, name in enumerate(known.names)}
    names = [*known.names, *(name for name in matches.names if same_name(name) not in place)]
    place = {same_name(name): k for k, name in enumerate(names)}
    where = np.array([place[same_name(name)] for name in matches.names], dtype=np.int64)
    pairs = where[matches.pairs].reshape(-1, 2)
    start = np.append(points, np.zeros(len(names) - len(points)))
    more = [f"{path}: {name!r} is not in it" for name in names[len(points) :]]
    return replace(matches, names=tuple(names), pairs=pairs), start, [*warnings, *more]
