"""The fair-race sheet as an answer: the races, the ratings behind them, what was left out."""

from collections.abc import Iterator
from typing import Any

import numpy as np
import pandas as pd

from evenbreak.answers.kit.answer import Answer
from evenbreak.answers.kit.columns import column_of, columns_of, frame_table
from evenbreak.answers.kit.parts import Table
from evenbreak.answers.kit.remarks import Remark, Remarks, file_name, fingerprints
from evenbreak.answers.kit.scales import form_used_words, game_chance, like_scale_words, points_on
from evenbreak.answers.kit.wording import count_of, percent
from evenbreak.answers.league.prior import level_words, prior_warnings
from evenbreak.answers.league.rate import provisional_words
from evenbreak.answers.league.sheet import MOST_ON_SHEET, NO_RACE, Sheet, count_groups, dates_of
from evenbreak.files.csv_writer import rows_of
from evenbreak.ratings.fitted import Ratings
from evenbreak.words import race

MOST_ACROSS = 30
"""The most players whose races are shown as a table on a terminal; otherwise, only ratings are."""


def report_answer(sheet: Sheet, *, across: int = MOST_ACROSS, listed: int | None = None) -> Answer:
    """Return a fair-race sheet as an answer.

    Parameters
    ----------
    across
        the most players for which the races are shown as a table.
    listed
        how many players the output lists with their ratings, if these are other players.

    >>> from evenbreak.answers.league.roster_matchups import OfferedRaces
    >>> from evenbreak.files.results.results_file import ResultsFile
    >>> from evenbreak.ratings import Results, fit
    >>> season = Results.from_names(["Ann", "Bo"], ["Bo", "Cy"], [7, 7], [5, 4])
    >>> file = ResultsFile(season, "season.csv", (), (), "0123456789abcdef")
    >>> answer = report_answer(Sheet.of(file, fit(season), OfferedRaces(race_to=7), [0, 1, 2]))
    >>> answer.parts[1].title
    "Find your row and your opponent's column. 7:6 means that you need 7 games and your
    opponent needs 6."
    """
    shown = sheet.strongest(MOST_ON_SHEET)
    many = len(shown.listed)
    races = (
        _race_table(shown)
        if many <= across
        else f"sheet.pdf has the races between the {many} players listed below."
    )
    items = list(left_out(sheet, listed=listed, in_table=many))
    return Answer(
        "\n".join([*heading(sheet), played(sheet)]),
        [
            " ".join([sheet.offered.in_words, *how_even(shown.paired)]),
            races,
            " ".join([*about_ratings(sheet), how_rated(sheet)]),
            _ratings_table(shown),
            *([Remarks(items, "Left out")] if items else []),
        ],
        details=[rating_model(sheet)],
        warnings=list(prior_warnings(sheet.file, sheet.ratings, sheet.choice)),
        csv=frame_table("matchups", sheet.paired),
        data={
            "ratings": frame_table("", sheet.rated).to_dicts(),
            "summary": dict(rows_of(sheet.summary)),
            "left_out": [str(item) for item in items],
        },
    )


def _race_table(sheet: Sheet) -> Table:
    """Return the races with a row and a column for each player."""
    names = sheet.listed["player"].tolist()
    places = [sheet.places[row] for row in sheet.listed.index]
    wide = max(map(len, places))
    columns = columns_of("row_player")
    columns += [column_of("against_place", place=place) for place in places]
    rows = [
        (
            f"{place:>{wide}}  {name}",
            *(
                None if name == other else sheet.races.get((name, other), NO_RACE)
                for other in names
            ),
        )
        for place, name in zip(places, names, strict=True)
    ]
    return Table("", columns, rows, how_to_read(sheet.paired))


def _ratings_table(sheet: Sheet) -> Table:
    points, listed = points_on(sheet.ratings.scale), sheet.listed
    keys = "player rating standard_error games won lost"
    if count_groups(sheet.ratings) > 1:
        keys += " component"
    columns = columns_of(f"place_number {keys}", show={"rating": points, "standard_error": points})
    frame = listed[keys.split()]
    rows = [(sheet.places[at], *row) for at, row in zip(frame.index, rows_of(frame), strict=True)]
    more = len(sheet.rated) > len(listed)
    title = f"#: place among all {len(sheet.rated):,} players. " if more else ""
    return Table("", columns, rows, f"{title}Give or take: one standard error.")


NOTHING_LEFT_OUT = (
    "Nothing was left out: every match in the file was used, and every player is on this sheet."
)


def left_out(
    sheet: Sheet, *, listed: int | None = None, in_table: int | None = None
) -> Iterator[Remark]:
    """Yield what the numbers don't include; if the number of players shown is None, all are."""
    if skipped := sheet.file.skipped:
        yield Remark(count_of(skipped, "bad row"), "left out, as asked")
    yield from _uncounted_matches(sheet.ratings)
    yield from _unlinked(sheet)
    yield from _not_shown(sheet, listed, in_table)


def _uncounted_matches(ratings: Ratings) -> Iterator[Remark]:
    if ratings.forfeits:
        yield Remark(
            count_of(ratings.forfeits, "forfeited match", "forfeited matches"),
            "no games were played",
        )
    if ratings.empty:
        yield Remark(
            count_of(ratings.empty, "match at 0-0", "matches at 0-0"), "no games were entered"
        )
    if ratings.later:
        yield Remark(
            count_of(ratings.later, "later match", "later matches"),
            f"the ratings are as of {ratings.as_of}",
        )


def _unlinked(sheet: Sheet) -> Iterator[Remark]:
    ratings = sheet.ratings
    idle = [name for name, none in zip(ratings.players, ratings.idle, strict=True) if none]
    if idle:
        yield Remark(
            f"{count_of(len(idle), 'player')} without a result",
            "rated as expected before any result",
            idle,
        )
    why = "no chain of opponents links them"
    if apart := int(sheet.paired["race_a"].isna().sum()):
        yield Remark(f"the races for {count_of(apart, 'pair')}", why)
    elif (groups := count_groups(ratings)) > 1:
        yield Remark(f"comparisons between {groups:,} groups of players", why)


def _not_shown(sheet: Sheet, listed: int | None, in_table: int | None) -> Iterator[Remark]:
    rated = len(sheet.rated)
    paired = len(np.unique([*sheet.paired["player_a"], *sheet.paired["player_b"]]))
    if listed is not None and listed < rated:
        yield Remark(
            f"{rated - listed:,} of {rated:,} rated players",
            f"the list ends with the first {listed:,}; ratings.csv has all of them",
        )
    if in_table is not None and in_table < paired:
        yield Remark(
            f"the races for {paired - in_table:,} of {paired:,} paired players",
            f"the table holds the first {in_table:,} on the list; matchups.csv has all of them",
        )
    if paired < rated:
        yield Remark(
            f"the races for {count_of(rated - paired, 'rated player')}",
            "these players were not chosen; ratings.csv has their ratings",
        )


def source_and_dates(sheet: Sheet) -> str:
    """Return the results file's name, and the dates of the first and last rated matches."""
    first, last = dates_of(sheet.file.results, sheet.ratings.as_of)
    days = f", {first}" if first else ""
    days += f" to {last}" if last != first else ""
    return f"{file_name(sheet.file)}{days}"


def heading(sheet: Sheet) -> list[str]:
    """Return the title, if any, and what the sheet is."""
    return [*filter(None, [sheet.title]), f"Fair races from {source_and_dates(sheet)}"]


def played(sheet: Sheet) -> str:
    """Return how many games were played, and by how many players."""
    ratings = sheet.ratings
    return (
        f"{count_of(ratings.matches, 'match', 'matches')} between {int((~ratings.idle).sum()):,} "
        f"players, {count_of(int(ratings.won.sum()), 'game')}."
    )


def how_to_read(paired: pd.DataFrame) -> str:
    """Return how to read the table of races, using one of its races as an example."""
    offered = paired.dropna(subset=["race_a"])
    uneven = offered[offered["race_a"] != offered["race_b"]]
    text = "Find your row and your opponent's column."
    rows: Any = (uneven if len(uneven) else offered).head(1).itertuples(index=False)
    for pair in rows:
        text += (
            f" {race((pair.race_a, pair.race_b))} means that you need "
            f"{count_of(pair.race_a, 'game')} and your opponent needs {pair.race_b}."
        )
    return text


def how_even(paired: pd.DataFrame) -> Iterator[str]:
    """Yield how even and how long the races are, and which pairs have no race."""
    offered = paired.dropna(subset=["race_a"])
    if len(offered):
        low, high = percent(offered["p_win_a"].min()), percent(offered["p_win_a"].max())
        wins = f"{low} of the time" if low == high else f"between {low} and {high} of the time"
        yield (f"The stronger player wins {wins}; this allows for rating uncertainty.")
        which = "The longest of these races" if len(offered) > 1 else "The race"
        yield (
            f"{which} lasts {offered['mean_games'].max():.1f} games on average; 9 out of 10 such "
            f"matches end within {offered['games_p90'].max()}."
        )
    if missing := len(paired) - len(offered):
        yield (
            f"A dash marks {count_of(missing, 'pair')} without a race: no chain of "
            "opponents links the two players, so their ratings can't be compared."
        )


def about_ratings(sheet: Sheet) -> Iterator[str]:
    """Yield what the ratings' numbers mean, and which ratings mean less."""
    ratings = sheet.ratings
    yield (
        f"Ratings are on {like_scale_words(ratings.scale)}, with a mean of "
        f"{round(ratings.anchor, 1):g}; they are not official ratings."
    )
    if (groups := count_groups(ratings)) > 1:
        yield (f"{groups:,} groups of players have never met: compare ratings only within a group.")
    yield from provisional_words(ratings, "P")
    if idle := int(ratings.idle.sum()):
        yield f"{count_of(idle, 'more player has', 'more players have')} no games yet."


def how_rated(sheet: Sheet) -> str:
    """Return where ratings start, and how much old matches count.

    >>> from evenbreak.answers.league.roster_matchups import OfferedRaces
    >>> from evenbreak.files.results.results_file import ResultsFile
    >>> from evenbreak.ratings import Results, fit
    >>> season = Results.from_names(["Ann"], ["Bo"], [7], [5], date=["2026-01-31"])
    >>> ratings = fit(season, half_life=180, as_of="2026-02-01")
    >>> file = ResultsFile(season, "season.csv", (), (), "0123456789abcdef")
    >>> print(how_rated(Sheet.of(file, ratings, OfferedRaces(race_to=7), [0, 1])))
    Every player starts at 80 ± 30. A match counts half after 180 days, as of
    2026-02-01.
    """
    ratings = sheet.ratings
    prior = float(ratings.scale.points(ratings.prior_sd))
    who = "Apart from what is known beforehand, every player" if ratings.levels else "Every player"
    text = f"{who} starts at {round(ratings.anchor, 1):g} ± {round(prior, 1):g}"
    if sheet.choice is not None and sheet.choice.learned:
        text += (
            f": of {len(sheet.choice.tried)} values tried, this one predicted "
            f"{sheet.choice.predicted:,} later results best"
        )
    as_of = "" if ratings.as_of is None else f", as of {ratings.as_of}"
    if ratings.half_life is not None:
        text += f". A match counts half after {ratings.half_life:g} days"
    form = form_used_words(ratings.match_form, ratings.scale)
    return " ".join([f"{text}{as_of}.", *level_words(ratings, sheet.choice), *filter(None, [form])])


def rating_model(sheet: Sheet) -> str:
    """Return how the ratings were estimated, in a sentence or two."""
    ratings = sheet.ratings
    alike = "; early and late matches count the same" if ratings.half_life is None else ""
    races = ", and on the chance of winning the race where only the winner is known"
    if not ratings.races_won.any():
        races = ""
    breaks = "whoever breaks"
    together = "games are independent of each other"
    if ratings.match_form:
        together = "games in a match share the players' form that day"
    if ratings.break_advantage is not None:
        breaks = f"the breaker playing {ratings.break_advantage:.3g} points better"
    return (
        f"Bradley\N{EN DASH}Terry on games{races}: {game_chance(ratings.scale)}, {breaks}; "
        f"{together}{alike}. The starting rating is a normal prior, and ± is its standard "
        f"deviation."
    )


def version_and_source(sheet: Sheet) -> str:
    """Return what made the sheet, and the fingerprint of the data it came from."""
    from evenbreak import __version__

    return f"evenbreak {__version__}, from results with the SHA-256 {fingerprints(sheet.file, 12)}"
