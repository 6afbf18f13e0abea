"""`evenbreak league table` and `league fixtures`: who is ahead, and who plays who."""

from __future__ import annotations

from dataclasses import replace
from datetime import date

import numpy as np

from evenbreak import files, league, ratings
from evenbreak.answers.kit.answer import Answer
from evenbreak.answers.kit.wording import count_of
from evenbreak.arrays import Floats
from evenbreak.cli.kit.asked import command_of
from evenbreak.cli.kit.terminal import write_file
from evenbreak.files.lists.fixtures import without_played
from evenbreak.files.results.races_by_chart import races_by_chart
from evenbreak.files.tables.names import same_name
from evenbreak.league.tables.fixtures import Fixture, nights
from evenbreak.league.tables.fixtures import fixtures as round_robin_fixtures
from evenbreak.questions.tables import Fixtures, LeagueTable


@command_of(LeagueTable, "table")
def table(asked: LeagueTable) -> Answer:
    """Make the table of a league."""
    from evenbreak.answers.league.standings import table_answer

    file = files.read_seasons(asked.results, **{**asked.reading, "chart": None}, unplayed=True)
    results, warnings = file.results, [*file.warnings]
    if asked.chart is not None and results.level_a is not None and results.level_b is not None:
        results, lines = races_by_chart(results, asked.chart, file.lines, file.source, points=True)
        warnings += lines
    rules = replace(asked.table_points, ties=asked.ties)
    matches, of_teams = _matches(asked, results, rules)
    start = None
    warnings += _left_out(matches)
    if asked.teams is not None:
        matches, start, lines = _with_teams(matches, asked.teams)
        warnings += lines
    if (day := asked.day("until")) is not None:
        if undated := int(np.isnat(matches.date).sum()):
            warnings.append(
                f"{count_of(undated, 'match', 'matches')} without a date left out, given --until"
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
        score="sets" if of_teams and asked.count != "games" else "games",
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
        return league.team_matches(results, count_games=asked.count == "games", rules=rules), True
    of_teams = asked.of == "teams" or (asked.of is None and asked.teams is not None)
    return league.player_matches(results), of_teams


def _left_out(matches: league.TableMatches) -> list[str]:
    """Return warnings about forfeits without a winner, and matches without a score."""
    found = []
    if matches.undecided:
        many = count_of(matches.undecided, "forfeit")
        found.append(f"{many} left out: the results don't say who won. Add the column winner.")
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
    more = [f"{path}: {name!r} isn't in it" for name in names[len(points) :]]
    return replace(matches, names=tuple(names), pairs=pairs), start, [*warnings, *more]


@command_of(Fixtures, "fixtures")
def fixtures(asked: Fixtures) -> Answer:
    """Make the fixtures of a league, or list those that are left."""
    from evenbreak.answers.league.fixtures import fixtures_answer

    listed, who, warnings = _made(asked) if asked.schedule is None else _read(asked)
    played = None
    if asked.left:
        listed, played, more = _without_played(asked, listed)
        warnings += more
    only = ""
    if asked.only is not None:
        wanted = same_name(asked.only)
        names = (name for one in listed for name in (one.home, one.away))
        only = next((name for name in names if same_name(name) == wanted), "")
        if not only:
            template = "{only} {name} has no match. Write the name as it is in the list."
            asked.refuse(template, name=asked.only)
        listed = [one for one in listed if only in (one.home, one.away)]
    if asked.ics is not None:
        from evenbreak.files.calendar import calendar_bytes

        calendar = calendar_bytes(
            listed,
            name=f"{asked.title}: {only}" if only else asked.title,
            venue=asked.venue or "",
            start=asked.time,
            minutes=asked.minutes,
        )
        write_file(asked.ics, calendar)
    return fixtures_answer(listed, who=who, played=played, only=only, warnings=warnings)


def _made(asked: Fixtures) -> tuple[list[Fixture], str, list[str]]:
    """Return new fixtures, who plays, and warnings."""
    sides = files.read_sides(asked.names or "", of=asked.of)
    names, venues = list(sides.names), list(sides.venues)
    if asked.draw is not None:
        order = np.random.default_rng(asked.draw).permutation(len(names)).tolist()
        names, venues = [names[k] for k in order], [venues[k] for k in order]
    venues = [venue or asked.venue or "" for venue in venues]
    tables = dict(sides.tables)
    if asked.tables is not None:
        tables.setdefault(asked.venue or "", asked.tables)
    rounds = (len(names) - 1 + len(names) % 2) * asked.meetings
    dates = []
    if (begins := asked.day("begins")) is not None:
        ends = asked.day("ends")
        dates = nights(
            -(-rounds // asked.rounds_a_night),
            date.fromisoformat(begins),
            weekdays=asked.weekdays,
            skipped=asked.skip,
            ends=None if ends is None else date.fromisoformat(ends),
        )
    listed = round_robin_fixtures(
        names,
        times=asked.meetings,
        dates=dates,
        rounds_a_night=asked.rounds_a_night,
        venues=venues,
        tables=tables,
        tables_a_match=asked.tables_a_match,
    )
    late = sum(one.turn > 1 for one in listed) if asked.rounds_a_night == 1 else 0
    warnings = [*sides.warnings]
    if late:
        many = count_of(late, "match waits", "matches wait")
        warnings.append(f"{many} for a table that night: there are fewer tables than matches")
    return listed, "team" if sides.of_teams else "player", warnings


def _read(asked: Fixtures) -> tuple[list[Fixture], str, list[str]]:
    """Return fixtures that are made already, who plays, and warnings."""
    listed, warnings = files.read_fixture_list(asked.schedule or "")
    return listed, "player" if asked.of == "players" else "team", [*warnings]


def _without_played(asked: Fixtures, listed: list[Fixture]) -> tuple[list[Fixture], int, list[str]]:
    """Return the fixtures that results leave, how many were played, and warnings."""
    file = files.read_seasons(asked.left, **asked.reading, unplayed=True)
    kept, unknown, extra = without_played(listed, file.results)
    warnings = [*file.warnings]
    if extra:
        many = count_of(extra, "played match isn't", "played matches aren't")
        warnings.append(f"{many} in the fixtures, {_first(unknown)}")
    return kept, len(listed) - len(kept), warnings


def _first(unknown: set[str]) -> str:
    return f"such as those of {min(unknown)!r}" if unknown else "since the two had met before"
