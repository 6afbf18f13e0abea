"""The sentences of a fair-race sheet, each said once for text, paper, page and workbook."""

from collections.abc import Iterator
from typing import Any

import pandas as pd

from evenbreak.answers.file_words import file_name, fingerprints
from evenbreak.answers.form_words import form_used_words
from evenbreak.answers.prior_words import level_words
from evenbreak.answers.report_frames import count_groups, dates_of
from evenbreak.answers.scale_words import game_chance, like_scale_words
from evenbreak.answers.sheet import Sheet
from evenbreak.answers.wording import count_of, percent, race


def source_and_dates(sheet: Sheet) -> str:
    """Return the name of the results file and the days of the first and last match rated."""
    first, last = dates_of(sheet.file.results, sheet.ratings.as_of)
    days = f", {first}" if first else ""
    days += f" to {last}" if last != first else ""
    return f"{file_name(sheet.file)}{days}"


def heading(sheet: Sheet) -> list[str]:
    """Return the title that was given, if any, and what the sheet is."""
    return [*filter(None, [sheet.title]), f"Fair races from {source_and_dates(sheet)}"]


def played(sheet: Sheet) -> str:
    """Return how much was played, by how many."""
    ratings = sheet.ratings
    return (
        f"{count_of(ratings.matches, 'match', 'matches')} between {int((~ratings.idle).sum()):,} "
        f"players, {count_of(int(ratings.won.sum()), 'game')}."
    )


def how_to_read(paired: pd.DataFrame) -> str:
    """Return how the table of races is read, by the example of a race in it."""
    offered = paired.dropna(subset=["race_a"])
    uneven = offered[offered["race_a"] != offered["race_b"]]
    text = "Find your row and your opponent's column."
    rows: Any = (uneven if len(uneven) else offered).head(1).itertuples(index=False)
    for pair in rows:
        text += (
            f" {race((pair.race_a, pair.race_b))} means that you need "
            f"{count_of(pair.race_a, 'game')} and your opponent {pair.race_b}."
        )
    return text


def how_even(paired: pd.DataFrame) -> Iterator[str]:
    """Yield how even and how long the races are, and which pairs have none."""
    offered = paired.dropna(subset=["race_a"])
    if len(offered):
        low, high = percent(offered["p_win_a"].min()), percent(offered["p_win_a"].max())
        wins = f"{low} of the time" if low == high else f"between {low} and {high} of the time"
        yield (f"The stronger player wins {wins}, averaged over how far the ratings may be off.")
        which = "The longest of these races" if len(offered) > 1 else "The race"
        yield (
            f"{which} lasts {offered['mean_games'].max():.1f} games on average; 9 out of 10 such "
            f"matches end within {offered['games_p90'].max()}."
        )
    if missing := len(paired) - len(offered):
        yield (
            f"A dash marks {count_of(missing, 'pair')} without a race: no chain of "
            "opponents links the two players, so their ratings cannot be compared."
        )


def about_ratings(sheet: Sheet) -> Iterator[str]:
    """Yield what the numbers of the ratings mean, and which of them mean less."""
    ratings = sheet.ratings
    yield (
        f"Ratings are on {like_scale_words(ratings.scale)}, with a mean of "
        f"{round(ratings.anchor, 1):g}; they are not official ratings."
    )
    if (groups := count_groups(ratings)) > 1:
        yield (f"{groups:,} groups of players have never met: compare ratings within a group only.")
    if idle := int(ratings.idle.sum()):
        yield f"{count_of(idle, 'more player has', 'more players have')} no games yet."


def how_rated(sheet: Sheet) -> str:
    """Return where ratings start, and what old matches count.

    >>> from evenbreak.answers.offered_races import OfferedRaces
    >>> from evenbreak.files.results.results_file import ResultsFile
    >>> from evenbreak.ratings import Results, fit
    >>> season = Results.from_names(["Ann"], ["Bo"], [7], [5], date=["2026-01-31"])
    >>> ratings = fit(season, half_life=180, as_of="2026-02-01")
    >>> file = ResultsFile(season, "season.csv", (), (), "0123456789abcdef")
    >>> print(how_rated(Sheet.of(file, ratings, OfferedRaces(race_to=7), [0, 1])))
    Every player starts at 80, give or take 30. A match counts half after 180 days, as of
    2026-02-01.
    """
    ratings = sheet.ratings
    prior = float(ratings.scale.points(ratings.prior_sd))
    who = "Apart from what is known beforehand, every player" if ratings.levels else "Every player"
    text = f"{who} starts at {round(ratings.anchor, 1):g}, give or take {prior:.4g}"
    if sheet.choice is not None and sheet.choice.learnt:
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
    alike = ", and early and late matches count alike" if ratings.half_life is None else ""
    races = ", and on the chance of a race where only its winner is known"
    if not ratings.races_won.any():
        races = ""
    breaks = "whoever breaks"
    if ratings.break_advantage is not None:
        breaks = f"the breaker playing {ratings.break_advantage:.3g} points better"
    return (
        f"Bradley\N{EN DASH}Terry on games{races}: {game_chance(ratings.scale)}, {breaks}; games "
        f"are independent of each other{alike}. The starting rating is a normal prior, and the "
        "give or take its standard deviation."
    )


def version_and_source(sheet: Sheet) -> str:
    """Return what the sheet was made by, and from which bytes."""
    from evenbreak import __version__

    return f"evenbreak {__version__}, from results with the SHA-256 {fingerprints(sheet.file, 12)}"
