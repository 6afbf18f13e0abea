"""What is kept of simulated seasons: counts that add up, whatever part of them is counted where."""

from __future__ import annotations

from dataclasses import dataclass, fields
from typing import Any

import numpy as np
from numpy.typing import NDArray

from evenbreak.errors import InputError

__all__ = ["FIFTHS", "GAP_COLUMNS", "WEEK_COLUMNS", "Tally", "fifths_of"]

Counts = NDArray[np.int64]
Floats = NDArray[np.float64]

GAP_COLUMNS = ("matches", "stronger_won", "hill_hill", "shutouts", "games")
"""What is summed for each gap of the two skills."""

WEEK_COLUMNS = ("players", "error", "error_squared")
"""What is summed for each week."""

FIFTHS = 5
"""Groups of players by true skill, the weakest first."""


@dataclass(frozen=True, eq=False)
class Tally:
    """What replicas of a season came to; two tallies of one season add up to one with `+`.

    All counts are whole numbers, so that sums of tallies do not depend on how they are
    bracketed; what is kept chunk by chunk keeps the order in which tallies are added.

    The replicas of one chunk share the pairings that are drawn by lot, and chunks draw their
    own: chunks are independent, and replicas of a chunk are so given its pairings. So standard
    errors come from how sums vary from chunk to chunk.

    Parameters
    ----------
    replicas
        seasons counted in each chunk, shape (chunks,).
    matches, wins, wins_squared
        of each player, summed over the replicas: matches played, matches won, and the square
        of those won in a season; shape (players,).
    rating, rating_squared
        of each player, summed over the replicas: the rating after the season, in points less
        his rating at the start, and the square of that.
    games
        games that each player won, summed over the replicas; None where matches are not played
        rack by rack.
    wins_counts
        in how many replicas each player won 0, 1, 2, ... matches: shape (players, most + 1).
        None where it would be large.
    rating_counts
        in how many replicas each player's rating moved by -most, ..., most points: shape
        (players, 2 * most + 1); what moved further stands at the ends. None where it would be
        large.
    errors
        how many players stood at each rating error (rating less true skill, rounded to whole
        points) at the start and after each week, its drift included: shape (weeks + 1,
        2 * widest + 1), from -widest to widest, where what is further off stands too.
    gap_width
        points of a bin of `gaps`.
    gaps
        shape (chunks, bins, 5), the columns of `GAP_COLUMNS` for matches in which the skills of
        the day lie [k * gap_width, (k + 1) * gap_width) points apart, k the bin: matches, those
        that the stronger won (of equals: half of them), hill-hill, shutouts (the loser won no
        game), and games in all. Where matches are not played rack by rack the last three are
        means given the two ratings and skills of each match, and not drawn.
    weeks
        shape (chunks, weeks + 1, 3), the columns of `WEEK_COLUMNS`: players in the league, and
        their rating errors (as `errors` counts them) and squares of these, summed.
    fifths
        shape (chunks, 5, 2): matches and wins by fifth of true skill at the start.

    >>> from evenbreak.league import LeaguePlayers, Season, run_chunk
    >>> season = Season(LeaguePlayers.of([60, 50], skill=[50, 50]), "npl", weeks=100)
    >>> one, two = (run_chunk(season, 50, seed) for seed in np.random.SeedSequence(1).spawn(2))
    >>> both = one + two
    >>> both.replicas, both.matches, both.weeks.shape
    (array([50, 50]), array([10000, 10000]), (2, 101, 3))
    """

    replicas: Counts
    matches: Counts
    wins: Counts
    wins_squared: Counts
    rating: Counts
    rating_squared: Counts
    games: Counts | None
    wins_counts: Counts | None
    rating_counts: Counts | None
    errors: Counts
    gap_width: int
    gaps: Floats
    weeks: Floats
    fifths: Counts

    def __add__(self, other: Tally) -> Tally:
        if not isinstance(other, Tally):
            return NotImplemented
        if len(self.matches) != len(other.matches) or self.errors.shape != other.errors.shape:
            raise InputError("the two tallies are of different seasons; add those of one season")
        return Tally(**{field.name: _added(self, other, field.name) for field in fields(Tally)})

    @property
    def error_values(self) -> NDArray[np.int64]:
        """The rating errors of the columns of `errors`, in points."""
        most = self.errors.shape[1] // 2
        return np.arange(-most, most + 1)

    def mean_and_error(self, above: Any, below: Any) -> tuple[Any, Any]:
        """Return sum(above) / sum(below) and its Monte Carlo standard error.

        Parameters
        ----------
        above, below
            sums for each chunk, of shape (chunks, ...), such as wins and matches.

        Returns
        -------
        mean, standard error
            arrays of the shape of one chunk; NaN where nothing was counted, and for the error
            where there are fewer than two chunks.

        Notes
        -----
        The standard error of a ratio of means, to first order, from chunks as batches:
        sqrt(k / (k - 1) sum (above - mean * below)^2) / sum(below) for k chunks.
        """
        above, below = np.asarray(above, dtype=float), np.asarray(below, dtype=float)
        chunks = len(above)
        total = below.sum(axis=0)
        with np.errstate(invalid="ignore", divide="ignore"):
            mean = above.sum(axis=0) / total
            if chunks < 2:
                return mean, np.full_like(mean, np.nan)
            off = ((above - mean * below) ** 2).sum(axis=0)
            return mean, np.sqrt(chunks / (chunks - 1) * off) / total


def fifths_of(skill: NDArray[Any]) -> NDArray[np.int64]:
    """Return each player's fifth by skill, 0 the weakest; equals by their position.

    Parameters
    ----------
    skill
        players down, replicas across.

    >>> fifths_of(np.array([[50.0], [90.0], [70.0], [60.0], [80.0]])).ravel()
    array([0, 4, 2, 1, 3])
    """
    many = len(skill)
    order = np.argsort(skill, axis=0, kind="stable")
    fifth: NDArray[np.int64] = np.empty(skill.shape, dtype=np.int64)
    ranks = (np.arange(many) * FIFTHS // many)[:, None]
    np.put_along_axis(fifth, order, np.broadcast_to(ranks, skill.shape), axis=0)
    return fifth


_IN_CHUNKS = ("replicas", "gaps", "weeks", "fifths")
_WIDENED = ("wins_counts",)


def _added(one: Tally, other: Tally, name: str) -> Any:
    mine, theirs = getattr(one, name), getattr(other, name)
    if name == "gap_width":
        return mine
    if mine is None or theirs is None:
        return None
    if name in _IN_CHUNKS:
        return np.concatenate([mine, theirs])
    if name in _WIDENED and mine.shape != theirs.shape:
        most = max(mine.shape[1], theirs.shape[1])
        mine, theirs = (np.pad(x, ((0, 0), (0, most - x.shape[1]))) for x in (mine, theirs))
    return mine + theirs
