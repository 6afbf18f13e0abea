"""The odds of a tournament, whatever of it is still to be drawn."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from evenbreak.answers.tournament import Tournament
from evenbreak.arrays import Floats
from evenbreak.tournaments.brackets.double import losers_qualifiers, redrawn
from evenbreak.tournaments.brackets.standing import standing
from evenbreak.tournaments.brackets.swiss import swiss
from evenbreak.tournaments.odds.blind import blind_draw_odds
from evenbreak.tournaments.odds.chances import Wins, chances_of
from evenbreak.tournaments.odds.races import chances_given
from evenbreak.tournaments.odds.redraws import redraw_odds
from evenbreak.tournaments.odds.swiss_odds import swiss_odds
from evenbreak.tournaments.odds.title import PlaceOdds, title_odds
from evenbreak.tournaments.odds.uncertain import drawn_chances, over_ratings

_REDRAWS = 6
_RATINGS = 400  # draws of the ratings, each with a draw of the lines or a Swiss of its own


class Solved(NamedTuple):
    """The odds if the ratings are right, and averaged over how far they may be off."""

    plug_in: PlaceOdds
    odds: PlaceOdds

    @property
    def averaged(self) -> bool:
        """Whether there is anything to average over."""
        return self.odds is not self.plug_in


def solved(tournament: Tournament, *, sure: bool, walkovers: float, seed: int) -> Solved:
    """Return the odds of a tournament before its first match.

    Parameters
    ----------
    tournament
        who plays what.
    sure
        whether to take the ratings as right.
    walkovers
        the chance that a match is a walkover.
    seed
        of what has to be sampled.
    """
    bracket = tournament.bracket
    errors = np.nan_to_num(tournament.roster.standard_error)
    uncertain = bool(errors.any()) and not sure
    win_of = chances_given(bracket, tournament.ratings, tournament.races, scale=tournament.scale)
    asked: Any = {"walkovers": walkovers, "rng": np.random.default_rng(seed)}
    if not tournament.to_draw:
        if not uncertain:
            odds = title_odds(bracket, tournament.laws, **asked)
            return Solved(odds, odds)
        both = over_ratings(bracket, win_of, tournament.ratings, errors, **asked)
        return Solved(both.as_if_sure, both.averaged)
    plug_in = _drawn_later(tournament, tournament.laws, asked)
    if not uncertain:
        return Solved(plug_in, plug_in)
    if tournament.to_draw == "qualifiers":
        return Solved(plug_in, _redrawn(tournament, win_of, errors, asked))
    every = drawn_chances(bracket, win_of, tournament.ratings, errors, samples=_RATINGS, **asked)
    return Solved(plug_in, _drawn_later(tournament, every, {**asked, "walkovers": 0.0}))


def _drawn_later(tournament: Tournament, win: Wins, asked: Any) -> PlaceOdds:
    bracket = tournament.bracket
    if tournament.to_draw == "lines":
        return blind_draw_odds(bracket, win, **asked)
    if tournament.to_draw == "qualifiers":
        return redraw_odds(bracket, win, **asked)
    chances = chances_of(standing(bracket), win, walkovers=asked["walkovers"])
    first = bracket.matches[0].name
    rounds = max(match.round for match in bracket.matches)
    table = chances.of(first)[:-1, :-1]
    return swiss_odds(swiss(bracket.players, rounds), table, rng=asked["rng"])


def _redrawn(tournament: Tournament, win_of: Any, errors: Floats, asked: Any) -> PlaceOdds:
    """Return the odds averaged over the ratings and over some redraws."""
    bracket = tournament.bracket
    qualifiers = losers_qualifiers(bracket)
    laws = []
    for _ in range(_REDRAWS):
        order = [qualifiers[k] for k in asked["rng"].permutation(len(qualifiers)).tolist()]
        ratings = tournament.ratings
        both = over_ratings(redrawn(bracket, order), win_of, ratings, errors, samples=100, **asked)
        laws.append(both.averaged.p_place)
    # How the redraws differ holds both kinds of luck: theirs, and that of the ratings within each.
    error = np.std(laws, axis=0, ddof=1) / np.sqrt(_REDRAWS)
    return PlaceOdds(bracket, np.mean(laws, axis=0), error, 100 * _REDRAWS)
