"""Small leagues, and the sheets and rounds made from them."""

import itertools
from functools import cache

import numpy as np

from evenbreak.answers.league.roster_matchups import OfferedRaces, all_pairs
from evenbreak.answers.league.round import Round
from evenbreak.answers.league.sheet import Sheet, most_active
from evenbreak.files.lists.roster import RosterFile
from evenbreak.files.results.results_file import ResultsFile
from evenbreak.handicaps import chart
from evenbreak.ratings import Results, fit
from evenbreak.ratings.roster import Roster
from evenbreak.ratings.scale import SCALES

SHA = "0123456789abcdef" * 4
TO_SEVEN = OfferedRaces(race_to=7)

HOSTILE = (
    "<script>alert(1)</script>",
    '"><img src=x onerror=alert(1)>',
    "O'Brien & Sons",
    "=cmd()",
    "مريم الخطيب",
    "👨‍👩‍👧",
    "a\x01b",
    "{{ 7 * 7 }}",
)
"""Names that a page must show as text."""


@cache
def league(players, name="Player {}"):
    """Everybody plays everybody once; `players` is a tuple of names, or how many there are."""
    names = (
        [name.format(f"{k:02}") for k in range(players)] if isinstance(players, int) else players
    )
    pairs = list(itertools.combinations(range(len(names)), 2))
    return Results.from_names(
        [names[a] for a, _ in pairs],
        [names[b] for _, b in pairs],
        [7] * len(pairs),
        [(a + 2 * b) % 7 for a, b in pairs],
    )


def two_groups():
    """Ann and Bo never meet Cy and Di."""
    return Results.from_names(["Ann", "Cy"], ["Bo", "Di"], [7, 7], [5, 4])


def sheet_of(
    season,
    *,
    offered=TO_SEVEN,
    top=9999,
    players=None,
    warnings=(),
    source="folder/season.csv",
    **how,
):
    """Return the sheet of a season that pairs its most active players, or the named ones."""
    ratings = fit(season, **how)
    chosen = most_active(ratings, top)
    if players is not None:
        chosen = [ratings.players.index(name) for name in players]
    file = ResultsFile(season, source, warnings, (), SHA)
    return Sheet.of(file, ratings, offered, chosen)


CLUB = Roster(["Ann", "Bo", "Cy", "Di"], [92, 71, 80, 60], [5, 6, np.nan, 4], [140, 60, 9, 30])


def round_of(roster=CLUB, pairs=None, *, read=None, warnings=(), **asked):
    """Return a round by the chart npl_10, unless other races are asked for."""
    file = RosterFile(read or roster, np.arange(2, 2 + len(roster)), "in/club.csv", warnings, SHA)
    races = {"scale": SCALES["npl"], "chart": chart("npl_10"), **asked}
    meet = all_pairs(roster) if pairs is None else np.array(pairs)
    return Round(file=file, roster=roster, pairs=meet, listed=pairs is not None, **races)
