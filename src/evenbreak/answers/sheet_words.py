"""What a fair-race sheet says, on a screen and on paper."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

from evenbreak.answers.fair_pairs import RaceLimits
from evenbreak.answers.frames import count_groups, dates_of, file_name, scale_text
from evenbreak.files.results import ResultsFile
from evenbreak.ratings.fitted import Ratings
from evenbreak.ratings.scale import Scale

if TYPE_CHECKING:
    import pandas as pd

NO_RACE = "-"


def count_of(number: int, one: str, many: str) -> str:
    """Return a number with the noun that it counts.

    >>> count_of(1, "game", "games"), count_of(2599, "game", "games")
    ('1 game', '2,599 games')
    """
    return f"{number:,} {one if number == 1 else many}"


def decimals_of(scale: Scale) -> int:
    """Return how many decimals of a rating a person needs: about a hundredth of a doubling."""
    return max(0, 2 - math.floor(math.log10(scale.points_per_doubling)))


def source_and_dates(file: ResultsFile, ratings: Ratings) -> str:
    """Return the name of the results file and the days of the first and last match rated."""
    first, last = dates_of(file.results, ratings.as_of)
    days = f", {first}" if first else ""
    days += f" to {last}" if last != first else ""
    return f"{file_name(file)}{days}"


def played(ratings: Ratings) -> str:
    """Return how much was played, by how many."""
    players = int((~ratings.idle).sum())
    return (
        f"{count_of(ratings.matches, 'match', 'matches')} of {players:,} players, "
        f"{count_of(int(ratings.won.sum()), 'game', 'games')}."
    )


def left_out(ratings: Ratings) -> Iterator[str]:
    """Yield what was left out of the ratings, if anything was."""
    counts = (
        (ratings.forfeits, "forfeited"),
        (ratings.empty, "at 0-0"),
        (ratings.later, f"after {ratings.as_of}"),
    )
    told = [f"{count:,} {what}" for count, what in counts if count]
    if told:
        *most, last = told
        yield f"Left out: {', '.join(most)}{' and ' if most else ''}{last}."


def unlike_others(ratings: Ratings) -> Iterator[str]:
    """Yield whose ratings mean less than the others', if anybody's do."""
    idle = int(ratings.idle.sum())
    if idle:
        names = count_of(idle, "more player has", "more players have")
        yield f"{names} no game: rated in the middle for want of knowledge."
    groups = count_groups(ratings)
    if groups > 1:
        yield f"{groups:,} groups of players never met; ratings compare only within a group."


def scale_sentences(ratings: Ratings) -> str:
    """Return what the ratings' numbers mean, and that they are no official ones."""
    return (
        f"Ratings on {scale_text(ratings.scale)}, mean {ratings.anchor:g}. "
        "They are nobody's official ratings."
    )


def how_rated(ratings: Ratings) -> str:
    """Return by which prior, and with what weight of old matches, the ratings were made.

    >>> from evenbreak.ratings import Results, fit
    >>> season = Results.from_names(["Ann"], ["Bo"], [7], [5], date=["2026-01-31"])
    >>> how_rated(fit(season, half_life=180, as_of="2026-02-01"))
    'Prior: standard deviation 30 points; a match counts half after 180 days, as of 2026-02-01.'
    """
    told = f"Prior: standard deviation {ratings.scale.points(ratings.prior_sd):.4g} points"
    if ratings.half_life is not None:
        told += f"; a match counts half after {ratings.half_life:g} days"
    if ratings.as_of is not None:
        told += f", as of {ratings.as_of}"
    return f"{told}."


def pairs_of(paired: pd.DataFrame, names: set[str]) -> pd.DataFrame:
    """Return the pairs of which both players are among `names`."""
    return paired[paired["player_a"].isin(names) & paired["player_b"].isin(names)]


def races_by_name(paired: pd.DataFrame) -> dict[tuple[str, str], str]:
    """Return the race of each two players as text, from the side of the first."""
    races = {}
    rows: Any = paired.dropna(subset=["race_a"]).itertuples(index=False)
    for pair in rows:
        races[pair.player_a, pair.player_b] = f"{pair.race_a}:{pair.race_b}"
        races[pair.player_b, pair.player_a] = f"{pair.race_b}:{pair.race_a}"
    return races


def which_races(paired: pd.DataFrame, limits: RaceLimits) -> Iterator[str]:
    """Yield which races were to choose from, and why lengths differ where they do."""
    if limits.race_to is not None:
        needs = count_of(limits.race_to, "game", "games")
        yield f"The fairest races in which the stronger player needs {needs}."
    elif limits.games is not None:
        low, high = limits.games
        span = f"{low:,} to " if low < high else ""
        longest = count_of(high, "game", "games")
        yield f"The fairest races whose longest possible match has {span}{longest}."
        lengths = (paired["race_a"] + paired["race_b"]).dropna()
        if len(lengths) and lengths.min() < lengths.max():
            yield "Each pair gets the race nearest to even, whatever its length."


def how_to_read(paired: pd.DataFrame) -> str:
    """Return how the table of races is read, by the example of a race in it."""
    offered = paired.dropna(subset=["race_a"])
    uneven = offered[offered["race_a"] != offered["race_b"]]
    told = "Row: you. Column: your opponent."
    rows: Any = (uneven if len(uneven) else offered).head(1).itertuples(index=False)
    for pair in rows:
        needs = count_of(pair.race_a, "game", "games")
        told += f" {pair.race_a}:{pair.race_b}: you need {needs}, your opponent {pair.race_b}."
    return told


def remarks(paired: pd.DataFrame) -> Iterator[str]:
    """Yield what the numbers of the races come to."""
    offered = paired.dropna(subset=["race_a"])
    if len(offered):
        low, high = offered["p_win_a"].min(), offered["p_win_a"].max()
        yield (
            f"The stronger player wins these with a chance of {low:.3f}"
            + (f" to {high:.3f}." if high > low else ".")
        )
        yield (
            f"The longest of them lasts {offered['mean_games'].max():.1f} games on average; "
            f"9 of 10 end within {offered['games_p90'].max()}."
        )
    missing = len(paired) - len(offered)
    if missing:
        yield (
            f"{NO_RACE} is a pair without a race: no chain of opponents links the two, so that "
            f"their ratings cannot be compared ({count_of(missing, 'such pair', 'such pairs')})."
        )
