"""Scales in words: one that ratings come from, and one that a league's own ratings are put on."""

import math

from evenbreak.ratings.scale import NAMES, Scale

LIKE = {"npl": "an NPL-like scale", "fargo": "a Fargo-like scale", "elo": "an Elo-like scale"}


def scale_words(scale: Scale) -> str:
    """Return the scale of given ratings.

    >>> from evenbreak.ratings import scale_of
    >>> scale_words(scale_of("fargo"))
    'on the Fargo scale (100 points double the odds)'
    """
    return f"on the {NAMES.get(scale.name, scale.name)} scale ({_points(scale)})"


def like_scale_words(scale: Scale) -> str:
    """Return the scale of estimated ratings: like a named one, but never that one itself.

    >>> from evenbreak.ratings import scale_of
    >>> like_scale_words(scale_of("fargo"))
    'a Fargo-like scale (100 points double the odds)'
    >>> like_scale_words(scale_of(50))
    'a scale of its own (50 points double the odds)'
    """
    return f"{LIKE.get(scale.name, 'a scale of its own')} ({_points(scale)})"


def _points(scale: Scale) -> str:
    return f"{scale.points_per_doubling:.6g} points double the odds"


def decimals_of(scale: Scale) -> int:
    """Return how many decimals of a rating a person needs: about a hundredth of a doubling.

    >>> from evenbreak.ratings import scale_of
    >>> decimals_of(scale_of("npl")), decimals_of(scale_of("fargo"))
    (1, 0)
    """
    return max(0, 2 - math.floor(math.log10(scale.points_per_doubling)))


def game_chance(scale: Scale) -> str:
    """Return what a rating difference means, as a formula."""
    return (
        "a player rated d points higher wins a game with probability "
        f"1/(1 + 2^(\N{MINUS SIGN}d/{scale.points_per_doubling:.6g}))"
    )
