"""Team leagues: `evenbreak round`, `caps` and `season`, and what team lists have in common."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from pathlib import PurePath
from typing import TYPE_CHECKING, Any

from evenbreak import files, handicaps, ratings, teams
from evenbreak.answers.kit.answer import Answer
from evenbreak.cli.kit.asked import command_of
from evenbreak.cli.kit.progress import Progress
from evenbreak.cli.kit.said import SAY_WHICH, refuse
from evenbreak.cli.kit.systems import (
    chart_by_difference,
    refuse_levels,
    refuse_other_scale,
    with_starters,
)
from evenbreak.files.lists.roster import refuse_to_read
from evenbreak.files.lists.teams import form_of_lists
from evenbreak.questions.teams import Capped, Caps, Lineup, OfTeams, Round, Season
from evenbreak.ratings.scale import Scale, unstated_scale
from evenbreak.words import Parameter

if TYPE_CHECKING:
    from evenbreak.files.lists.teams import TeamList

MOST_TEAMS = 40
MOST_PAIRS = 400


@command_of(Round, "round")
def round_(asked: Round) -> Answer:
    """Find who wins a round between two teams."""
    from evenbreak.answers.kit.wording import count_of
    from evenbreak.answers.league.prior import starters_words
    from evenbreak.answers.team.lineup import race_words
    from evenbreak.answers.team.round import team_round_answer

    lists, scale, warnings, rosters = two_teams(asked)
    games = asked.single_games
    race = None if games is not None else race_of(asked)
    if not asked.everybody and len(rosters[0]) != len(rosters[1]):
        asked.refuse(
            "{first} has {m} players and {second} {n}; leave out those who do not play, or give "
            "{everybody}",
            first=asked.ours,
            m=len(rosters[0]),
            second=asked.theirs,
            n=len(rosters[1]),
        )
    if (pairs := len(rosters[0]) * len(rosters[1])) > MOST_PAIRS:
        refuse(f"the files have {pairs:,} pairs of players; name the players of one round only")
    law = teams.round_law(
        *rosters,
        games=games,
        race=race,
        everybody=asked.everybody,
        scale=scale,
        form=form_of_lists(each.file.form for each in lists),
    )
    for each, roster in zip(lists, rosters, strict=True):
        warnings += filter(None, [starters_words(each.file.roster, roster)])
    names = PurePath(asked.ours).stem, PurePath(asked.theirs).stem
    return team_round_answer(
        (rosters[0], rosters[1]),
        law,
        played=f"{count_of(games or 1, 'game')} a match" if race is None else race_words(race),
        scale=scale,
        games=games,
        everybody=asked.everybody,
        names=names if names[0] != names[1] else ("the first team", "the second team"),
        warnings=warnings,
    )


@command_of(Caps, "caps")
def caps(asked: Caps) -> Answer:
    """Find what a cap and the order of nomination do to a team league."""
    from evenbreak.answers.league.prior import starters_words
    from evenbreak.answers.team.round import LeagueRules, team_rules_answer

    lists = files.read_squads(asked.roster)
    if len(lists) > MOST_TEAMS:
        refuse(f"{asked.roster} has {len(lists)} teams; ask about at most {MOST_TEAMS}")
    scale, warnings = scale_of_teams(list(lists.values()), asked.scale)
    rosters: dict[str, ratings.Roster] = {}
    squads: dict[str, teams.Squad] = {}
    for team, one in lists.items():
        rosters[team] = with_starters(one.file.roster, scale, asked.starter, asked.starter_sd)
        warnings += filter(None, [starters_words(one.file.roster, rosters[team])])
    for team, one in lists.items():
        refuse_without_level(asked, one)
        limits = teams.caps_of(one.weights.tolist(), asked.cap, asked.at_most)
        squads[team] = teams.Squad(rosters[team].players, limits)
    sets = asked.sets or min(5, *(len(one) for one in rosters.values()))
    rules = LeagueRules(
        rosters,
        squads,
        {team: one.levels for team, one in lists.items()},
        race_of(asked),
        scale,
        sets,
        teams.order_of(asked.order, sets),
        form_of_lists(one.file.form for one in lists.values()),
    )
    return team_rules_answer(rules, source=asked.roster, warnings=warnings)


@command_of(Season, "season")
def season(asked: Season) -> Answer:
    """Find each team's chances of title, promotion and relegation."""
    import numpy as np

    from evenbreak.answers.team.season import team_season_answer

    names, start, played, ahead, warnings = _matches(asked)
    count = len(names)
    for option, many in (("up", asked.up), ("down", asked.down)):
        if many is not None and many >= count:
            asked.refuse(
                "{part} is {many}, but there are {count} teams; give fewer",
                part=Parameter(option),
                many=many,
                count=count,
            )
    if (asked.up or 0) + (asked.down or 0) > count:
        asked.refuse(
            "{up} {m} and {down} {n} are more than the {count} teams; give fewer",
            m=asked.up,
            n=asked.down,
            count=count,
        )
    rows = np.hstack([played.pairs, played.scores])
    strengths = teams.team_strengths(names, rows)
    scores = teams.scores_of(**_length(asked, played.scores))
    watched, words = _next(*ahead)
    places = [1, *([asked.up] if asked.up else []), *([count - asked.down] if asked.down else [])]
    with Progress("seasons") as progress:
        chances = teams.season_chances(
            teams.TeamSeason(
                names,
                rows,
                ahead[0],
                scores,
                teams.score_chances(strengths.estimate[None], ahead[0], scores),
                rules=replace(asked.table_points, ties=asked.ties),
                head_start=start,
            ),
            places=tuple(dict.fromkeys(places)),
            matches=watched,
            strengths=None if asked.sure else strengths,
            seasons=asked.seasons,
            seed=asked.seed,
            jobs=asked.jobs,
            progress=progress,
        )
    return team_season_answer(
        chances, up=asked.up, down=asked.down, rounds=words, known=asked.sure, warnings=warnings
    )


def _matches(asked: Season) -> tuple[Any, Any, Any, tuple[Any, tuple[str, ...]], list[str]]:
    """Return the teams, their points besides, the matches played and to come, and warnings."""
    from evenbreak.answers.kit.wording import count_of

    warnings: list[str] = []
    known, start = files.TeamNames([]), None
    if asked.teams is not None:
        known, start, lines = files.read_teams(asked.teams)
        warnings += lines
    played, ahead = files.read_team_results(asked.results, known)
    warnings += played.warnings
    if asked.schedule is not None:
        if unplayed := len(ahead.pairs):
            left = count_of(unplayed, "match without a score", "matches without a score")
            warnings.append(f"{asked.results}: {left} left out; the schedule says what is to come")
        ahead = files.read_fixtures(asked.schedule, known)
        warnings += ahead.warnings
    to_come = ahead.pairs, ahead.rounds
    if asked.meetings is not None:
        to_come = teams.still_to_play(known.names, asked.meetings, played.pairs), ()
    elif not len(ahead.pairs):
        asked.refuse(
            "say which matches are to come: give a schedule, or {meetings} K, or list them in "
            "RESULTS.csv without a score"
        )
    return known.names, start, played, to_come, warnings


def _length(asked: Season, scores: Any) -> dict[str, int]:
    """Return how long a match is, as asked or as in the results."""
    totals, most = scores.sum(axis=1), scores.max(axis=1)
    for name, stated, sizes in (("sets", asked.sets, totals), ("race", asked.race, most)):
        if stated is None:
            continue
        if (sizes != stated).any():
            a, b = scores[int((sizes != stated).argmax())].tolist()
            asked.refuse(
                "{part} {stated} does not fit the score {a}:{b} in the results",
                part=Parameter(name),
                stated=stated,
                a=a,
                b=b,
            )
        return {name: stated}
    if len(set(totals.tolist())) == 1:
        return {"sets": int(totals[0])}
    if len(set(most.tolist())) == 1:
        return {"race": int(most[0])}
    return asked.refuse(
        "the results have matches of different lengths; say with {sets} or {race} how long the "
        "matches to come are, and leave out what was not played to the end"
    )


def _next(to_come: Any, rounds: tuple[str, ...]) -> tuple[tuple[int, ...], str]:
    """Return the matches of the next round, and what it is called."""
    if rounds and rounds[0]:
        return (
            tuple(k for k, name in enumerate(rounds) if name == rounds[0]),
            f"round {rounds[0]}" if rounds[0].isdigit() else rounds[0],
        )
    seen: set[int] = set()
    first = []
    for k, pair in enumerate(to_come.tolist()):
        if seen & set(pair):
            break
        seen |= set(pair)
        first.append(k)
    return tuple(first), ""


# What team lists have in common, for `evenbreak lineup` too.


def two_teams(
    asked: Lineup | Round,
) -> tuple[tuple[TeamList, TeamList], Scale, list[str], list[ratings.Roster]]:
    """Return the lists of two teams, the scale, the warnings, and the players with ratings."""
    lists = files.read_team(asked.ours), files.read_team(asked.theirs)
    scale, warnings = scale_of_teams(lists, asked.scale)
    rosters = [
        with_starters(each.file.roster, scale, asked.starter, asked.starter_sd) for each in lists
    ]
    if asked.sure:
        rosters = [ratings.Roster(each.players, each.rating) for each in rosters]
    return lists, scale, warnings, rosters


def scale_of_teams(lists: Sequence[TeamList], stated: Scale | None) -> tuple[Scale, list[str]]:
    """Return the scale of the teams' ratings, and the warnings about their files."""
    import numpy as np

    from evenbreak.answers.kit.scales import league_doubts

    for each in lists:
        if stated is not None:
            refuse_other_scale(
                each.file, stated, "--scale", "leave --scale out, or correct the file", stated=True
            )
        else:
            refuse_levels(each.file, "say with --scale how many levels double the odds")
    scales = [each.file.scale for each in lists if each.file.scale is not None]
    if any(not scales[0].same_points(other) for other in scales[1:]):
        sources = " and ".join(dict.fromkeys(each.file.source for each in lists))
        refuse(f"{sources}: different scales are stated; put all ratings on one")
    rated = np.concatenate([each.file.roster.rating for each in lists])
    names = [name for each in lists for name in each.file.roster.players]
    scale = stated or next(iter(scales), None)
    if scale is None:
        scale = unstated_scale(rated.tolist(), names, SAY_WHICH)
    elif stated is None:
        for each in lists:
            refuse_to_read(each.file, scale, "the other team's list", SAY_WHICH)
    warnings = list(dict.fromkeys(line for each in lists for line in each.file.warnings))
    if not scales:
        warnings += league_doubts(scale, rated, "is it the right scale?")
    return scale, warnings


def race_of(asked: OfTeams) -> Any:
    """Return the race that is asked for."""
    if asked.chart is not None:
        return chart_by_difference("--chart", asked.chart)
    return handicaps.Fairest(asked.race_to) if asked.race_to is not None else asked.race


def refuse_without_level(asked: Capped, team: TeamList) -> None:
    """Refuse caps where a player has nothing to count."""
    capped = asked.cap is not None or asked.at_most is not None
    if capped and (name := team.without_weight):
        refuse(f"{team.file.source} has no level for {name!r}; the caps need one for everybody")
