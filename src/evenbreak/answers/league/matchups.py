"""The race for each pair in a round, who wins it how often, and how long it takes."""

from collections.abc import Iterator, Sequence
from dataclasses import asdict, dataclass, replace
from typing import Any

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from evenbreak.answers.kit.answer import Answer
from evenbreak.answers.kit.columns import columns_of
from evenbreak.answers.kit.parts import Column, Part, Table
from evenbreak.answers.kit.remarks import Remark, Remarks, file_name
from evenbreak.answers.kit.scales import form_used_words, game_chance, scale_words
from evenbreak.answers.kit.wording import clock, count_of, percent
from evenbreak.answers.league.roster_matchups import FAIR_WITHIN, OfferedRaces, unfair
from evenbreak.answers.league.round import AT_A_TIME, EveningEnd, Round
from evenbreak.arrays import Ints
from evenbreak.files.csv_writer import rows_of
from evenbreak.files.lists.roster import RosterFile
from evenbreak.handicaps.charts.chart import Chart
from evenbreak.handicaps.charts.level_audit import INNINGS
from evenbreak.handicaps.charts.level_chart import LevelChart, PointsChart
from evenbreak.handicaps.charts.level_skills import LevelSkills
from evenbreak.handicaps.charts.points_odds import PointsOdds, points_odds
from evenbreak.matches.pace import Pace
from evenbreak.ratings.roster import NOT_STATED
from evenbreak.words import race


def matchups_answer(tonight: Round, *, warnings: Sequence[str] = ()) -> Answer:
    """Return a round's races.

    With more than 20,000 pairs, the rows are calculated as they are read, and sentences that depend
    on all of them are left out.

    >>> import numpy as np
    >>> from evenbreak.answers.league.roster_matchups import all_pairs
    >>> from evenbreak.files.lists.roster import RosterFile
    >>> from evenbreak.handicaps import chart
    >>> from evenbreak.ratings import SCALES
    >>> from evenbreak.ratings.roster import Roster
    >>> club = Roster(["Ann", "Bo"], [92, 71])
    >>> file = RosterFile(club, np.array([2, 3]), "club.csv", (), "0123456789abcdef")
    >>> asked = {"scale": SCALES["npl"], "chart": chart("npl_10")}
    >>> tonight = Round(file=file, roster=club, pairs=all_pairs(club), **asked)
    >>> matchups_answer(tonight).sentences[0]
    'The races come from the chart npl_10. The race is 6:4 for Ann against Bo: Ann wins 53% of
    the time.'
    """
    at_once = len(tonight.pairs) <= AT_A_TIME
    frame = tonight.matchups.frame if at_once else None
    table = _table(tonight)
    parts: list[Part] = []
    for prefix in tonight.kinds:
        least = "" if frame is None else least_even(races_of(frame, prefix))
        parts.append(f"{which_races(tonight, prefix)} {least}".rstrip())
    if tonight.evening:
        parts.append("\n".join([*map(evening_words, tonight.evening), about_time(tonight)]))
    parts.append(table)
    if tonight.pace is not None and not tonight.evening:
        parts.append(about_time(tonight))
    if doubtful(tonight):
        whose = "ratings" if tonight.levels is None else "levels"
        parts.append(f"'A wins' allows for how uncertain the {whose} are.")
    parts += filter(None, [form_used_words(tonight.form, tonight.scale)])
    parts += [tonight.levels.why] if tonight.levels is not None else []
    remarks = [*([] if frame is None else about_pairs(frame)), *about_players(tonight)]
    parts += [Remarks(remarks)] if remarks else []
    method = list(about_method(tonight))
    return Answer(
        f"Races for {file_name(tonight.file)}\n{ratings_words(tonight)}",
        parts,
        details=[*([Remarks(method)] if method else []), game_model(tonight)],
        warnings=[*tonight.file.warnings, *warnings],
        data={
            "evening": tonight.evening,
            "pace": _pace(tonight),
            "form": tonight.form,
            "levels": None if tonight.levels is None else levels_data(tonight.levels),
        },
        csv=table,
    )


def _pace(tonight: Round) -> dict[str, Any] | None:
    """Return what the minutes assume, in minutes and standard deviations of logarithms."""
    if tonight.pace is None:
        return None
    return {**asdict(tonight.pace), "turnover": tonight.turnover.mean}


def _table(tonight: Round) -> Table:
    columns = columns_of(
        "player_a player_b -difference difference_error -p_game_a p_game_a_plug_in"
    )
    both = len(tonight.kinds) > 1
    for prefix in tonight.kinds:
        columns += _race_columns(tonight, prefix, both=both)
    return Table("pairs", [*columns, *columns_of("note")], _Rows(tonight, columns))


def _race_columns(tonight: Round, prefix: str, *, both: bool) -> list[Column]:
    """Return the columns for the fair race, or the chart's; fewer of each if there are both."""
    timed = tonight.pace is not None
    keys = [
        ("chart_race" if prefix else "fair_race_ab") if both else "race_pair",
        "p_win_a_pair",
        "p_win_a_plug_in" if doubtful(tonight) and not both else "-p_win_a_plug_in",
        *(["unfairness_pair"] if prefix else []),
        ("-" if timed else "") + ("mean_games_short" if both else "mean_games_pair"),
        "-games_p90" if timed or both else "games_p90",
    ]
    if timed:
        keys += ["mean_minutes_short", "-minutes_p90"] if both else ["mean_minutes", "minutes_p90"]
    return [
        replace(column, name=tuple(prefix + name for name in column.names))
        for column in columns_of(" ".join(keys))
    ]


@dataclass(frozen=True, eq=False)
class _Rows:
    """The table's rows, calculated each time they are read."""

    round: Round
    columns: Sequence[Column]

    def __iter__(self) -> Iterator[Sequence[Any]]:
        small = len(self.round.pairs) <= AT_A_TIME
        for part in [self.round.matchups] if small else self.round.in_parts():
            yield from self._rows(part.frame)

    def _rows(self, frame: pd.DataFrame) -> Iterator[Sequence[Any]]:
        by_name = dict(zip(frame.columns, zip(*rows_of(frame), strict=True), strict=True))
        columns: list[Sequence[Any]] = []
        for column in [*self.columns, *columns_of("note")]:
            values = [by_name[name] for name in column.names]
            columns.append(values[0] if len(values) == 1 else _races(*values))
        return zip(*columns, strict=True)


def _races(m: Sequence[Any], n: Sequence[Any]) -> list[tuple[int, int] | None]:
    return [None if need is None else (need, other) for need, other in zip(m, n, strict=True)]


KINDS = {"chart": "By the chart", "best": "With the fairest races"}


def races_of(frame: pd.DataFrame, prefix: str) -> pd.DataFrame:
    """Return the races of one kind, with the names used in `matchups_frame`."""
    names = ("race_a", "race_b", "p_win_a", "mean_games", "games_p90")
    columns = {"player_a": "player_a", "player_b": "player_b"}
    columns |= {prefix + name: name for name in names}
    return frame[list(columns)].rename(columns=columns)


def which_races(tonight: Round, prefix: str) -> str:
    """Return where the races of one kind come from."""
    way = tonight.kinds[prefix]
    return (
        way.in_words
        if isinstance(way, OfferedRaces)
        else f"The races come from the chart {way.name}."
    )


def least_even(paired: pd.DataFrame) -> str:
    """Return the most lopsided of the pairs in `races_of`.

    >>> import pandas as pd
    >>> pairs = {"player_a": ["Ann", "Cy"], "player_b": ["Bo", "Di"]}
    >>> races = {"race_a": [7, 4], "race_b": [5, 6], "p_win_a": [0.52, 0.41]}
    >>> print(least_even(pd.DataFrame(pairs | races)))
    The least even race is 4:6 for Cy against Di: Di wins 59% of the time.
    """
    offered = paired.dropna(subset=["race_a"])
    if not len(offered):
        return ""
    worst: Any = offered.iloc[int((offered["p_win_a"] - 0.5).abs().argmax())]
    a, b, needs, p = worst.player_a, worst.player_b, (worst.race_a, worst.race_b), worst.p_win_a
    winner, p = (a, p) if p >= 0.5 else (b, 1.0 - p)
    which = "The least even race is" if len(offered) > 1 else "The race is"
    return f"{which} {race(needs)} for {a} against {b}: {winner} wins {percent(p)} of the time."


def evening_words(end: EveningEnd) -> str:
    """Return when an evening ends.

    >>> print(evening_words(EveningEnd("chart", 4, 2, 110.2, 120.0, True, 0, 0.0, 0.0)))
    By the chart, 4 matches on 2 tables take 1 h 50 on average; 9 out of 10 evenings end within
    2 h 00.
    """
    return (
        f"{KINDS[end.races]}, {count_of(end.matches, 'match', 'matches')} on "
        f"{count_of(end.tables, 'table')} {'take' if end.matches > 1 else 'takes'} "
        f"{clock(end.mean_minutes)} on average; 9 out of 10 evenings end within "
        f"{clock(end.minutes_p90)}."
    )


def about_time(tonight: Round) -> str:
    """Return what the minutes assume, in a sentence; '' if there are no minutes."""
    if tonight.pace is None:
        return ""
    between = tonight.turnover.mean if tonight.evening else None
    return time_words(tonight.pace, between)


def time_words(pace: Pace, turnover: float | None = None) -> str:
    """Return what a pace and a turnover assume.

    >>> from evenbreak.matches import PACES
    >>> print(time_words(PACES["9-ball"]))
    Times assume 9-ball: 5.6 minutes a game plus 3.8 a match on average; two matches in
    three finish within 29% of their expected time.
    """
    which = f"{pace.discipline}: " if pace.discipline else ""
    more = f" plus {pace.overhead:.2g} a match" if pace.overhead else ""
    text = (
        f"Times assume {which}{pace.per_game:.2g} minutes a game{more} on average; two "
        f"matches in three finish within {percent(pace.log_sd)} of their expected time"
    )
    if turnover is None:
        return f"{text}."
    return f"{text}, and the next match on a table starts {turnover:.3g} minutes later."


def about_pairs(frame: pd.DataFrame) -> Iterator[Remark]:
    """Yield the pairs that have no race, or no fair race."""
    apart = _pairs(frame[frame["p_game_a"].isna()])
    if apart:
        yield Remark(
            f"{count_of(len(apart), 'pair')} without a race",
            "no chain of opponents links the two players, so their ratings can't be compared",
            apart,
        )
    if "p_win_a" in frame and (uneven := _pairs(frame[unfair(frame["p_win_a"])])):
        yield Remark(
            f"{count_of(len(uneven), 'pair')} without a fair race",
            f"even the fairest race allowed leaves one player below {percent(0.5 - FAIR_WITHIN)}",
            uneven,
        )


def _pairs(rows: pd.DataFrame) -> list[str]:
    return [f"{a} \N{EN DASH} {b}" for a, b in zip(rows["player_a"], rows["player_b"], strict=True)]


def about_players(tonight: Round) -> Iterator[Remark]:
    """Yield players in these pairs whose rating or standard error was filled in or is missing."""
    if tonight.levels is not None:
        return
    read, started = tonight.file.roster, tonight.roster
    here = np.zeros(len(started), dtype=bool)
    here[np.unique(tonight.pairs)] = True
    unrated, silent = np.isnan(read.rating), np.isnan(started.standard_error)
    filled = np.isnan(read.standard_error) & ~silent
    by_level = unrated & isinstance(tonight.chart, LevelChart)
    for which, what, why in (
        (by_level & filled, "without a rating", "rated by skill level, such as {0:.4g} ± {1:.3g}"),
        (unrated & filled & ~by_level, "without a rating", "assumed to be {0:g} ± {1:g}"),
        (unrated & ~filled, "without a rating", "assumed to be {0:g}"),
        (
            ~unrated & filled & (read.games == 0),
            "without games",
            "rating error assumed to be ± {1:g}",
        ),
        (
            ~unrated & filled & (read.games == NOT_STATED),
            "without a number of games",
            "rating assumed to be as uncertain as a new player's, ± {1:g}",
        ),
    ):
        for place in np.flatnonzero(which & here)[:1]:
            filled_in = why.format(started.rating[place], started.standard_error[place])
            yield _remark(tonight, which & here, what, filled_in)
    if silent[here].all():
        yield Remark("No standard errors are given", "all ratings are treated as exact")
    elif (silent & here).any():
        yield _remark(tonight, silent & here, "without a standard error", "rating treated as exact")
    by_games = ~unrated & filled & (read.games > 0) & here
    for place in np.flatnonzero(by_games)[:1]:
        error = f"{started.standard_error[place]:.3g}"
        how = f"calculated from the number of games, such as ± {error} after "
        yield _remark(tonight, by_games, "without a standard error", f"{how}{read.games[place]:,}")


def _remark(tonight: Round, which: NDArray[np.bool_], what: str, why: str) -> Remark:
    names = [tonight.roster.players[place] for place in np.flatnonzero(which).tolist()]
    return Remark(f"{count_of(len(names), 'player')} {what}", why, names)


def about_method(tonight: Round) -> Iterator[Remark]:
    """Yield what the numbers are based on."""
    if isinstance(tonight.chart, Chart):
        yield Remark(
            f"Chart {tonight.chart.name}", "looked up with ratings rounded to whole points"
        )
    elif tonight.chart is not None and tonight.levels is None:
        yield Remark(
            f"Chart {tonight.chart.name}",
            "looked up with the skill levels; the chances come from the ratings",
        )
    if doubtful(tonight):
        yield Remark(
            "Uncertainty of the ratings (±, one standard error)",
            "the chances and lengths allow for it; two players' errors are treated as "
            "independent and normally distributed",
        )
    if tonight.form:
        yield Remark(
            "Day-to-day form",
            "the chances and lengths allow for it; the chance of winning a single game stays "
            "the same",
        )
    for end in tonight.evening:
        if not end.exact:
            yield Remark(
                f"When the evening ends {KINDS[end.races][:1].lower()}{KINDS[end.races][1:]}",
                f"from {end.runs:,} simulated evenings; the standard error is "
                f"{end.mean_minutes_error:.2g} minutes for the average and "
                f"{end.minutes_p90_error:.2g} for the 90% point",
            )


def doubtful(tonight: Round) -> bool:
    """Return whether any rating error is stated, or the levels' uncertainty is known."""
    if tonight.levels is not None:
        return tonight.levels.is_known
    return bool((tonight.roster.standard_error[np.unique(tonight.pairs)] > 0.0).any())


def ratings_words(tonight: Round) -> str:
    """Return what the ratings are, in a few words."""
    if tonight.levels is not None:
        return f"Skill levels from {tonight.levels.chart.name}"
    return f"Ratings {scale_words(tonight.scale)}"


def levels_data(levels: LevelSkills) -> dict[str, Any]:
    """Return what the chances are based on if they come from skill levels, for JSON."""
    off = [None if np.isnan(error) else float(error) for error in levels.standard_error]
    return {
        "chart": levels.chart.name,
        "source": levels.source,
        "matches": levels.matches,
        "spread": levels.spread,
        "fargo_points": dict(zip(levels.levels, levels.points.tolist(), strict=True)),
        "standard_error": dict(zip(levels.levels, off, strict=True)),
    }


def game_model(tonight: Round) -> str:
    """Return how the chance of winning a game follows from two ratings, in a sentence."""
    alone = "independently of every other game"
    alone += " apart from day-to-day form, whoever breaks." if tonight.form else ", whoever breaks."
    if tonight.levels is not None:
        placed = ", ".join(
            f"{level} at {points:.0f}"
            for level, points in zip(
                tonight.levels.levels, tonight.levels.points.tolist(), strict=True
            )
        )
        spread = f", and players at the same level differ by {tonight.levels.spread:.0f} points"
        return (
            f"Levels on the Fargo scale (only differences matter): {placed}"
            f"{spread if tonight.levels.spread else ''}. {game_chance(tonight.scale)[:1].upper()}"
            f"{game_chance(tonight.scale)[1:]}, {alone}"
        )
    text = game_chance(tonight.scale)
    return f"{text[:1].upper()}{text[1:]}, {alone}"


def points_matchups_answer(
    file: RosterFile, pairs: Ints, chart: PointsChart, *, warnings: Sequence[str] = ()
) -> Answer:
    """Return the points that each pair's players need, and each player's chance.

    All levels in the list must be on the chart; pairs are places in the list's roster, shape (k,
    2).
    """
    roster = file.roster
    known: dict[tuple[int, int], PointsOdds] = {}
    rows = []
    for a, b in pairs.tolist():
        levels = int(roster.level[a]), int(roster.level[b])
        if levels not in known:
            known[levels] = points_odds(chart, *levels)
        odds = known[levels]
        names = roster.players[a], roster.players[b]
        rows.append((*names, odds.needs, odds.p_win_1, odds.share_1, odds.share_2))
    shared = bool(rows) and rows[0][-1] is not None
    keys = "player_a player_b needs_pair p_win_a_pair"
    keys += " mean_match_points_a mean_match_points_b" if shared else ""
    table = Table("pairs", columns_of(keys), rows if shared else [row[:-2] for row in rows])
    return Answer(
        f"Points for {file_name(file)}\nSkill levels from {chart.name}",
        [
            f"The points come from the chart {chart.name}.",
            table,
            "The chances are based on an assumption, not on measurements: players of every "
            "level are "
            f"assumed to need about {INNINGS:.0f} innings to reach their points, and to have "
            f"the same chance on each shot.",
        ],
        warnings=[*file.warnings, *warnings],
        data={"chart": chart.name, "innings": INNINGS},
        csv=table,
    )
