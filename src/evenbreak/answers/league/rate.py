"""Ratings with their uncertainty, or the difference between two players."""

from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np

from evenbreak.answers.kit.answer import Answer
from evenbreak.answers.kit.columns import column_of, columns_of, table_by_column
from evenbreak.answers.kit.parts import Table
from evenbreak.answers.kit.scales import form_data, form_details, form_words, like_scale_words
from evenbreak.answers.kit.wording import count_of, decimals, percent
from evenbreak.answers.league.prior import (
    evidence_rows,
    group_rows,
    groups_table,
    level_words,
    levels_data,
    prior_details,
    prior_warnings,
)
from evenbreak.files.results.results_file import ResultsFile
from evenbreak.ratings.fitted import Ratings
from evenbreak.ratings.prior import PriorChoice
from evenbreak.words import listed

NOT_LINKED = "no chain of opponents links the two"

SIZES = 6
"""How many groups of players are listed with their sizes."""

_ONE = decimals(1)


def rate_answer(
    file: ResultsFile,
    ratings: Ratings,
    choice: PriorChoice | None = None,
    *,
    pairs: Sequence[tuple[int, int]] = (),
    warnings: Sequence[str] = (),
) -> Answer:
    """Return a league's ratings, or the differences between the players in some pairs.

    Parameters
    ----------
    file, ratings
        the results, and the ratings from `fit`.
    choice
        how the prior was chosen, if it was chosen by prediction.
    pairs
        positions in `ratings.players`; if given, the answer is about these pairs.
    warnings
        anything else that may be wrong.

    >>> from evenbreak.files.results.results_file import ResultsFile
    >>> from evenbreak.ratings import Results, fit
    >>> night = Results.from_names(["Ann"], ["Bo"], [7], [4])
    >>> answer = rate_answer(ResultsFile(night, "r.csv", (), (), ""), fit(night), pairs=[(0, 1)])
    >>> print(answer.sentences[0])
    Ann is rated 17.3 points above Bo (± 22.6) and wins a game between them 60% of the
    time.
    """
    if pairs:
        rows = [_pair(ratings, *pair) for pair in pairs]
        first, table = "\n".join(map(_pair_in_words, rows)), Table("pairs", _PAIR_COLUMNS, rows)
    else:
        first, table = _highest_in_words(ratings), _players_table(ratings)
    return Answer(
        f"{file.source}: {_counted(file, ratings)}\nRatings on {like_scale_words(ratings.scale)}",
        [
            first,
            *([] if pairs else provisional_words(ratings)),
            *_fit_in_words(ratings, choice),
            *form_words(ratings.form, ratings.scale),
            *unlinked_words(ratings),
            table,
        ],
        details=[
            *([] if pairs else [_ERRORS_IN_WORDS, *_error_of_errors_in_words(ratings)]),
            *prior_details(ratings, choice),
            *form_details(ratings.form, ratings.scale),
            *groups_table(ratings),
        ],
        csv=table,
        warnings=[*file.warnings, *file.ties, *prior_warnings(file, ratings, choice), *warnings],
        data={
            **_how(ratings, choice),
            "form": form_data(ratings.form),
            "rows_left_out": file.skipped,
        },
    )


_ERRORS_IN_WORDS = (
    "'Give or take' is the standard error of a rating on its own. 'In comparisons' is the "
    "quasi-standard error: add the squares of two players' quasi-standard errors and take the "
    "square root for the standard error of the difference between them. It is smaller because "
    "the uncertainty that the whole league shares cancels out."
)


def _error_of_errors_in_words(ratings: Ratings) -> Iterator[str]:
    """Yield how far off the standard errors are, if they are sampled."""
    if ratings.error_of_errors:
        yield (
            "With this many players, the standard errors are estimated from random draws: for "
            f"every player, the estimate is within {percent(ratings.error_of_errors)} of the exact "
            "value at least two times in three."
        )


def _players_table(ratings: Ratings) -> Table:
    """Return every player, group by group, strongest first; provisional players come last."""
    by_winner = bool(ratings.races_won.any() or ratings.races_lost.any())
    columns = [
        *columns_of("rating standard_error quasi_error", show={"rating": decimals(1)}),
        *columns_of("games won lost" if ratings.games.any() else "-games -won -lost"),
        *columns_of("races_won races_lost" if by_winner else "-races_won -races_lost"),
        column_of("component" if ratings.component.max() > 1 else "-component"),
        column_of("provisional" if ratings.provisional.any() else "-provisional"),
    ]
    values: dict[Any, Any] = {"player": ratings.players}
    values |= {column: np.asarray(getattr(ratings, column.names[0])) for column in columns}
    if ratings.match_form:
        values["match_form"] = [ratings.match_form] * len(ratings.players)
    values["scale"] = [ratings.scale.text] * len(ratings.players)
    provisional, component = ratings.provisional, ratings.component
    order = sorted(ratings.strongest_first(), key=lambda k: (provisional[k], component[k]))
    return table_by_column("players", values, order=order)


_PAIR_COLUMNS = columns_of(
    "player_a player_b a_above_b standard_error p_game_a note",
    show={"p_game_a": decimals(3)},
    a="A",
)


def _pair(ratings: Ratings, first: int, second: int) -> tuple[Any, ...]:
    names = ratings.players[first], ratings.players[second]
    if ratings.component[first] != ratings.component[second]:
        return (*names, None, None, None, NOT_LINKED)
    difference = float(ratings.rating[first] - ratings.rating[second])
    p_game = ratings.scale.win_probability(difference)
    return (*names, difference, ratings.difference_error(*names), p_game, None)


def _pair_in_words(row: Sequence[Any]) -> str:
    a, b, difference, error, p_game, note = row
    if note is not None:
        return f"{a} and {b} can't be compared: {note}."
    strong, weak, p = (a, b, p_game) if difference >= 0 else (b, a, 1.0 - p_game)
    return (
        f"{strong} is rated {_ONE(abs(difference))} points above {weak} (± "
        f"{_ONE(error)}) and wins a game between them {percent(p)} of the time."
    )


def _highest_in_words(ratings: Ratings) -> str:
    first = (k for k in ratings.strongest_first() if ratings.component[k] == 1)
    best = next((k for k in first if not ratings.provisional[k]), None)
    where = " in the largest group" if ratings.component.max() > 1 else ""
    if best is None:
        return f"No one{where} is ranked yet."
    return (
        f"{ratings.players[best]} is rated highest{where}: {_ONE(ratings.rating[best])} ± "
        f"{_ONE(ratings.standard_error[best])}. The ± covers a player's true rating about two "
        f"times in three."
    )


def provisional_words(ratings: Ratings, mark: str = "") -> list[str]:
    """Return which ratings are provisional, in a sentence; '' if none are.

    `mark` is what lists show instead of a place.

    >>> from evenbreak.ratings import Results, fit
    >>> season = Results.from_names(["Ann", "Cy"], ["Bo", "Bo"], [50, 2], [40, 0])
    >>> print(*provisional_words(fit(season)))
    1 player with fewer than 31 games is listed last, unranked: the rating is provisional.
    """
    few = int(ratings.provisional.sum())
    if not few:
        return []
    are, rating = ("is", "the rating is") if few == 1 else ("are", "their ratings are")
    marked = f" ({mark}1{f' to {mark}{few:,}' if few > 1 else ''})" if mark else ""
    games = count_of(ratings.established_from, "game")
    return [
        f"{count_of(few, 'player')}{marked} with fewer than {games} {are} listed last, unranked: "
        f"{rating} provisional."
    ]


def _counted(file: ResultsFile, ratings: Ratings) -> str:
    """Return what the ratings are based on."""
    games, races = int(ratings.won.sum()), int(ratings.races_won.sum())
    made = [count_of(int((~ratings.idle).sum()), "player")]
    if games:
        made += [count_of(ratings.matches - races, "match", "matches"), count_of(games, "game")]
    if races:
        made.append(f"{count_of(races, 'match', 'matches')} with only the winner known")
    left_out = [
        count_of(file.skipped, "bad row") if file.skipped else "",
        count_of(ratings.forfeits, "forfeit") if ratings.forfeits else "",
        f"{ratings.empty:,} at 0-0" if ratings.empty else "",
        f"{ratings.later:,} after {ratings.as_of}" if ratings.later else "",
    ]
    out = ", ".join(filter(None, left_out))
    return ", ".join(made) + (f" (left out: {out})" if out else "")


def _fit_in_words(ratings: Ratings, choice: PriorChoice | None) -> Iterator[str]:
    """Yield what the ratings are based on besides the results, if anything was requested."""
    yield from level_words(ratings, choice)
    if ratings.named:
        names = [f"{name} has {points:g}" for name, points in ratings.named]
        on_average, other = (" on average", "their mean") if names[1:] else ("", "that player")
        yield (
            f"Ratings are set so that {listed(names)}{on_average}; '±' is the "
            f"uncertainty of the difference from {other}."
        )
    if ratings.half_life is not None:
        yield (
            f"A match counts half after {ratings.half_life:g} days; weighted this way, the "
            f"history is worth {ratings.weight:,.0f} recent games."
        )
    if ratings.break_advantage is not None:
        points, error = ratings.break_advantage, ratings.break_error
        stronger = "higher" if points >= 0 else "lower"
        known = ", as given" if error is None else f", ± {_ONE(error)}"
        yield f"The breaker plays as if rated {_ONE(abs(points))} points {stronger}{known}."


def unlinked_words(ratings: Ratings) -> Iterator[str]:
    """Yield what to know about players who aren't linked by a chain of opponents.

    >>> from evenbreak.ratings import Results, fit
    >>> season = Results.from_names(["A", "C", "D"], ["B", "D", "E"], [7, 7, 7], [2, 3, 6])
    >>> print(*unlinked_words(fit(season)))
    2 groups of players (3 and 2) have never met: compare ratings only within a group. All
    groups are assumed to be equally strong on average; a match or two between them would link
    them.
    """
    sizes = [int(size) for size in np.bincount(ratings.component)[1:] if size > 1]
    if len(sizes) > 1:
        more = [f"{len(sizes) - SIZES:,} more"] if len(sizes) > SIZES else []
        yield (
            f"{len(sizes):,} groups of players "
            f"({listed([*(f'{size:,}' for size in sizes[:SIZES]), *more])}) have never "
            "met: compare ratings only within a group. All groups are assumed to be equally "
            "strong on average; a match or two between them would link them."
        )
    idle = int(ratings.idle.sum())
    if idle:
        have, their = ("has", "the rating is") if idle == 1 else ("have", "their rating is")
        yield (
            f"{count_of(idle, 'player')} {have} no games that count; {their} the one assumed "
            "before any result."
        )


def _how(ratings: Ratings, choice: PriorChoice | None) -> dict[str, Any]:
    scale = ratings.scale
    return {
        "scale": scale.name,
        "points_per_doubling": scale.points_per_doubling,
        "anchor": ratings.anchor,
        "anchored_at": dict(ratings.named),
        "provisional_below_games": ratings.established_from,
        "prior_sd_points": scale.points(ratings.prior_sd),
        "prior_sd_log_odds": ratings.prior_sd,
        "priors_tried": None
        if choice is None
        else [
            {"prior_sd_points": scale.points(width), "log_loss": loss}
            for width, loss in zip(choice.tried, choice.log_loss, strict=True)
        ],
        "prior_learned": None if choice is None else choice.learned,
        "group_effects": levels_data(ratings, choice),
        "groups": group_rows(ratings),
        "evidence": evidence_rows(choice),
        "half_life_days": ratings.half_life,
        "played_by_weight": ratings.weight,
        "as_of": None if ratings.as_of is None else str(ratings.as_of),
        "break_advantage": ratings.break_advantage,
        "break_advantage_standard_error": ratings.break_error,
        "matches": ratings.matches,
        "forfeits_left_out": ratings.forfeits,
        "empty_left_out": ratings.empty,
        "later_left_out": ratings.later,
    }
