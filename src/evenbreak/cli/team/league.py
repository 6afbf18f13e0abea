"""Team leagues: `evenbreak round`, `caps` and `season`, and what team lists have in common."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path, PurePath
from typing import TYPE_CHECKING, Any, NamedTuple

from evenbreak import files, handicaps, league, ratings, teams
from evenbreak.answers.kit.answer import Answer
from evenbreak.answers.kit.systems import (
    CHART_OR_SCALE,
    LEAVE_OUT,
    SAY_WHICH,
    refuse_levels,
    refuse_other_scale,
    with_starters,
)
from evenbreak.cli.kit.asked import command_of
from evenbreak.cli.kit.progress import Progress
from evenbreak.cli.kit.said import refuse
from evenbreak.errors import InputError
from evenbreak.files.lists.roster import refuse_to_read
from evenbreak.files.lists.teams import form_of_lists
from evenbreak.files.tables.names import KnownNames
from evenbreak.handicaps.charts.level_skills import FARGO
from evenbreak.questions.results import in_one
from evenbreak.questions.teams import Caps, Lineup, OfTeams, Round, Season
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
    from evenbreak.answers.team.strengths import level_words, strengths_words

    games = asked.single_games
    race = None if games is not None else race_of(asked)
    lists, found = two_teams(asked, race)
    rosters, warnings = found.rosters, found.warnings
    if not asked.everybody and len(rosters[0]) != len(rosters[1]):
        asked.refuse(
            "{first} has {m} players, and {second} has {n}. Leave out those who don't play, "
            "or give {everybody}.",
            first=asked.ours,
            m=len(rosters[0]),
            second=asked.theirs,
            n=len(rosters[1]),
        )
    if (pairs := len(rosters[0]) * len(rosters[1])) > MOST_PAIRS:
        refuse(f"the files have {pairs:,} pairs of players. Name the players of one round only.")
    law = teams.round_law(
        *rosters,
        games=games,
        race=race,
        everybody=asked.everybody,
        count="games" if race is None else teams.count_by(asked.count, race),
        scale=found.scale,
        form=form_of_lists(each.file.form for each in lists),
        levels=found.levels,
    )
    for each, roster in zip(lists, rosters, strict=True):
        warnings += filter(None, [starters_words(each.file.roster, roster)])
    names = PurePath(asked.ours).stem, PurePath(asked.theirs).stem
    return team_round_answer(
        (rosters[0], rosters[1]),
        law,
        played=f"{count_of(games or 1, 'game')} a match" if race is None else race_words(race),
        strengths=strengths_words(race or 1, found.levels, found.scale),
        rests_on=level_words(race or 1, found.levels),
        scale=found.scale,
        games=games,
        unit=asked.count.removesuffix("s"),
        everybody=asked.everybody,
        names=names if names[0] != names[1] else ("the first team", "the second team"),
        warnings=warnings,
    )


@command_of(Caps, "caps")
def caps(asked: Caps) -> Answer:
    """Find what a cap and the order of putting up players do to a team league."""
    from evenbreak.answers.league.prior import starters_words
    from evenbreak.answers.team.round import LeagueRules, team_rules_answer

    lists = files.read_squads(asked.roster)
    if len(lists) > MOST_TEAMS:
        refuse(f"{asked.roster} has {len(lists)} teams. Ask about at most {MOST_TEAMS}.")
    race = race_of(asked)
    found = strengths_of(asked, list(lists.values()), race)
    rosters, warnings = dict(zip(lists, found.rosters, strict=True)), found.warnings
    squads: dict[str, teams.Squad] = {}
    for team, one in lists.items():
        warnings += filter(None, [starters_words(one.file.roster, rosters[team])])
    for team, one in lists.items():
        limits = teams.caps_of(weights_of(asked, one), asked.cap, asked.at_most)
        squads[team] = teams.Squad(rosters[team].players, limits)
    sets = asked.sets or min(5, *(len(one) for one in rosters.values()))
    rules = LeagueRules(
        rosters,
        squads,
        {team: one.levels for team, one in lists.items()},
        race,
        found.scale,
        sets,
        teams.order_of(asked.order, sets),
        form_of_lists(one.file.form for one in lists.values()),
        found.levels,
        teams.count_by(asked.count, race),
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
                "{part} must be fewer than the {count} teams; you gave {many}",
                part=Parameter(option),
                many=many,
                count=count,
            )
    if (asked.up or 0) + (asked.down or 0) > count:
        asked.refuse(
            "{up} {m} and {down} {n} add up to more than the {count} teams. Give fewer.",
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
    played, ahead = files.read_team_results(asked.results, known, columns=in_one(asked.columns))
    warnings += played.warnings
    if asked.schedule is not None:
        if unplayed := len(ahead.pairs):
            left = count_of(unplayed, "match without a score", "matches without a score")
            warnings.append(
                f"{asked.results}: {left} left out; the schedule says which matches remain"
            )
        ahead = files.read_fixtures(asked.schedule, known)
        warnings += ahead.warnings
    to_come = ahead.pairs, ahead.rounds
    if asked.meetings is not None:
        to_come = league.still_to_play(known.names, asked.meetings, played.pairs), ()
    elif not len(ahead.pairs):
        asked.refuse(
            "say which matches are still to be played: give a schedule, or {meetings} K, "
            "or list them in RESULTS.csv without a score"
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
                "{part} {stated} doesn't fit the score {a}-{b} in the results",
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
        "the results have matches of different lengths. Use {sets} or {race} to set the length "
        "of the matches still to be played, and leave out any that weren't finished."
    )


def _next(to_come: Any, rounds: tuple[str, ...]) -> tuple[tuple[int, ...], str]:
    """Return the matches of the next round, and its name."""
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


class Strengths(NamedTuple):
    """The strengths of teams' players, and what is doubtful about their lists.

    `levels` are the strengths of skill levels, if the chances come from those.
    """

    rosters: list[ratings.Roster]
    scale: Scale
    levels: handicaps.LevelSkills | None
    warnings: list[str]


def two_teams(asked: Lineup | Round, race: Any) -> tuple[tuple[TeamList, TeamList], Strengths]:
    """Return the lists of two teams, and how strong their players are."""
    lists = _team(asked, "ours"), _team(asked, "theirs")
    if isinstance(asked, Lineup) and asked.absent:
        lists = _without_absent(asked, lists)
    found = strengths_of(asked, lists, race)
    if asked.sure:
        sure = [ratings.Roster(one.players, one.rating, level=one.level) for one in found.rosters]
        found = found._replace(rosters=sure)
    return lists, found


def _without_absent(asked: Lineup, lists: tuple[TeamList, TeamList]) -> tuple[TeamList, TeamList]:
    """Return the lists without those who are not there tonight."""
    known = [KnownNames(one.file.roster.players) for one in lists]
    gone: tuple[set[int], set[int]] = set(), set()
    for name in asked.absent:
        places = [each.place(name) for each in known]
        if places == [None, None]:
            every = KnownNames([name for one in lists for name in one.file.roster.players])
            asked.refuse(
                "{part}: {name!r} is in neither team{hint}",
                part=Parameter("absent"),
                name=name,
                hint=every.hint(name),
            )
        for side, place in zip(gone, places, strict=True):
            side |= set() if place is None else {place}
    ours, theirs = (one.without(side) for one, side in zip(lists, gone, strict=True))
    return ours, theirs


def _team(asked: Lineup | Round, side: str) -> TeamList:
    """Return the list of a team: of a file, or by its name in the list of all teams."""
    name: str = getattr(asked, side)
    if asked.roster is None or name == "-" or (Path(name).exists() and not Path(name).is_dir()):
        return files.read_team(name)
    squads = files.read_squads(asked.roster)
    known = KnownNames(list(squads))
    place = known.place(name)
    if place is None:
        asked.refuse(
            "{part} {name!r} is neither a file nor a team of {roster}{hint}",
            part=Parameter(side),
            name=name,
            roster=asked.roster,
            hint=known.hint(name),
        )
    return list(squads.values())[place]


def strengths_of(asked: OfTeams, lists: Sequence[TeamList], race: Any) -> Strengths:
    """Return how strong the players of teams are, by ratings or by the levels of a chart."""
    from evenbreak.answers.league.by_level import SCALE_OF_LEVELS, with_level
    from evenbreak.answers.team.strengths import lists_by_level

    every, levels = [one.file for one in lists], None
    if isinstance(race, handicaps.LevelChart | handicaps.PointsChart):
        every, levels = lists_by_level(
            [with_level(file, asked.starter if file.levels else None) for file in every],
            race,
            asked.results,
        )
    elif asked.results is not None:
        asked.refuse(
            "{results} is for chances based on skill levels. Add a chart of levels, such as "
            "{chart} apa_8ball."
        )
    if levels is not None or isinstance(race, handicaps.PointsChart):
        if asked.scale is not None:
            raise InputError(SCALE_OF_LEVELS)
        warnings = list(dict.fromkeys(line for file in every for line in file.warnings))
        if asked.results is not None and levels is None:
            warnings.append("the results are not used: a points chart sets the chances itself")
        return Strengths([file.roster for file in every], FARGO, levels, warnings)
    scale, warnings = scale_of_teams(lists, asked.scale)
    if asked.results is not None:
        warnings.append("the results are not used: the chances come from the ratings in the lists")
    rosters = [with_starters(file.roster, scale, asked.starter, asked.starter_sd) for file in every]
    return Strengths(rosters, scale, None, warnings)


def scale_of_teams(lists: Sequence[TeamList], stated: Scale | None) -> tuple[Scale, list[str]]:
    """Return the scale of the teams' ratings, and the warnings about their files."""
    import numpy as np

    from evenbreak.answers.kit.scales import league_doubts

    for each in lists:
        if stated is not None:
            refuse_other_scale(each.file, stated, Parameter("scale"), LEAVE_OUT, stated=True)
        else:
            refuse_levels(each.file)
    scales = [each.file.scale for each in lists if each.file.scale is not None]
    if any(not scales[0].same_points(other) for other in scales[1:]):
        sources = " and ".join(dict.fromkeys(each.file.source for each in lists))
        refuse(f"{sources}: the ratings are on different scales. Put all of them on one.")
    rated = np.concatenate([each.file.roster.rating for each in lists])
    names = [name for each in lists for name in each.file.roster.players]
    scale = stated or next(iter(scales), None)
    if scale is None:
        scale = unstated_scale(rated.tolist(), names, SAY_WHICH, levels=CHART_OR_SCALE)
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
        return files.find_chart(asked.chart)
    return handicaps.Fairest(asked.race_to) if asked.race_to is not None else asked.race


def weights_of(asked: Lineup | Caps, team: TeamList) -> list[float]:
    """Return what caps count of each player, of a new one the starter; refuse who has nothing."""
    import numpy as np

    weights = team.weights
    if team.file.levels and asked.starter is not None:
        weights = np.where(np.isnan(weights), asked.starter, weights)
    if (asked.cap is not None or asked.at_most is not None) and np.isnan(weights).any():
        new = " (new players can get one with --starter)" if team.file.levels else ""
        name = team.without_weight
        refuse(f"{team.file.source} has no level for {name!r}; the caps need one for everyone{new}")
    return [float(weight) for weight in weights]
