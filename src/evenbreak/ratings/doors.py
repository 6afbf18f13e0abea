"""Argument check shared by all functions that take `Results`."""

from __future__ import annotations

from evenbreak.errors import InputError


def check_results(results: object) -> None:
    """Raise an error unless the argument is a `Results`.

    >>> check_results("season.csv")
    Traceback (most recent call last):
    ...
    evenbreak.errors.InputError: this is str 'season.csv', not Results. Give
        Results.from_frame(frame) or, for a file, read_results(path).results.
    """
    if not hasattr(results, "won_only"):
        raise InputError(
            "this is {name} {results!r:.60}, not Results. Give Results.from_frame(frame) or, "
            "for a file, read_results(path).results.",
            name=type(results).__name__,
            results=results,
        )
