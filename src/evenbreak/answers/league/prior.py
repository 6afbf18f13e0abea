"""What ratings start from: the prior, levels and groups, and unrated players."""

from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np

from evenbreak.answers.kit.columns import columns_of
from evenbreak.answers.kit.parts import Part, Show, Table
from evenbreak.answers.kit.remarks import MOST_NAMES
from evenbreak.answers.kit.wording import count_of, decimals, some_of
from evenbreak.files.results.results_file import ResultsFile
from evenbreak.ratings.fitted import Group, Ratings
from evenbreak.ratings.levels import GROUPS, OPENING, SETTLED, too_many_groups
from evenbreak.ratings.prior import Evidence, PriorChoice
from evenbreak.ratings.roster import NOT_STATED, Roster
from evenbreak.ratings.scale import Scale
from evenbreak.words import Figure, Sentence, joined, listed, say, say_count

_ONE = decimals(1)
_FEW = 5  # names that are listed

NAMES = {
    "joined": "joined late",
    "newcomers": "first games",
    "field": "field at the first event",
    "race": "stated races",
    "team_sd": "teams",
    "division_sd": "divisions",
    "half_life": "half-life",
    "brought_sd": "ratings from elsewhere",
}
"""Names for what a search may add."""

_SUBJECTS = {
    "joined": say("Joining late"),
    "newcomers": say("A player's experience"),
    "field": say("The field at the first event"),
    "race": say("The handicap in each race"),
    "team_sd": say("The difference between teams"),
    "division_sd": say("The difference between divisions"),
    "half_life": say("The age of the games"),
    "brought_sd": say("Ratings from elsewhere"),
}
"""The same at the start of a sentence."""


def level_words(ratings: Ratings, choice: PriorChoice | None) -> Iterator[str]:
    """Yield what is assumed about newcomers, handicaps, teams and divisions.

    >>> from evenbreak.ratings import Levels, Results, fit
    >>> night = Results.from_names(["Ann"], ["Bo"], [50], [50])
    >>> print(*level_words(fit(night, scale="fargo", levels=Levels(newcomers=0.5)), None))
    A player's first games are predicted best if the player starts 48.1 points below the average
    player; half of that gap is gone after 50 games.
    """
    levels, points = ratings.levels, ratings.scale.points
    if levels.beginning is not None:
        yield from _beginning_words(ratings)
    if levels.joined:
        side = "below" if levels.joined > 0 else "above"
        error = _error(choice, "joined", points(1.0), _ONE, "")
        yield (
            f"Players who joined after the first {OPENING / 7:.0f} weeks are expected to be "
            f"{_ONE(abs(points(levels.joined)))}{error} points {side} those who were there "
            f"from the start."
        )
    if levels.newcomers:
        below = ratings.newcomer
        side = "below" if below > 0 else "above"
        error = _error(choice, "newcomers", points(1.0) * ratings.newcomer_share, _ONE, "")
        yield (
            f"A player's first games are predicted best if the player starts "
            f"{_ONE(abs(below))}{error} "
            f"points {side} the average player; half of that gap is gone after {SETTLED:g} games."
        )
    if levels.field:
        yield _field_words(levels.field, _error_of(choice, "field"))
    if levels.race:
        error = _error(choice, "race", 1.0, decimals(2), "")
        yield (
            f"The handicap races were used too: players are assumed to differ by {levels.race:.2f}"
            f"{error} times what their races make up for."
        )
    for kind in GROUPS:
        groups = [group for group in ratings.groups if group.kind == kind]
        if groups:
            ends = [groups[0], groups[-1]]
            yield f"{kind.capitalize()}s differ: {', and '.join(map(_group_words, ends))}."
    if choice is not None:
        yield from (_too_few_words(found) for found in choice.evidence if found.too_few)


def _beginning_words(ratings: Ratings) -> Iterator[str]:
    """Yield how many players bring a rating with them, and its assumed uncertainty."""
    beginning, off = ratings.levels.beginning, ratings.levels.brought_sd
    if beginning is None:
        return
    others = [name for name in ratings.players if name not in set(beginning.players)]
    known = len(ratings.players) - len(others)
    if beginning.unknown_error and not off:
        yield "The ratings from elsewhere don't help predict these results, so they aren't used."
        return
    text = f"{known:,} of {count_of(len(ratings.players), 'player')} came with a rating"
    if 0 < len(others) <= _FEW:
        text += f"; {listed(others)} didn't"
    text += "."
    if beginning.unknown_error:
        points, by_games = _ONE(ratings.scale.points(off)), beginning.by_games.any()
        on_top = ", on top of the uncertainty from its number of games" if by_games else ""
        text += f" Each rating is assumed to be off by {points} points or so{on_top}."
    yield text


def _group_words(group: Group) -> str:
    side = "above" if group.above >= 0 else "below"
    return (
        f"{group.name} is {_ONE(abs(group.above))} ± {_ONE(group.standard_error)} points "
        f"{side} the average {group.kind}"
    )


def _error(choice: PriorChoice | None, of: str, unit: float, show: Show, sign: str) -> str:
    """Return how far off a choice may be; '' if that isn't known."""
    known = _error_of(choice, of)
    return "" if known is None else f" ± {show(unit * known)}{sign}"


def _error_of(choice: PriorChoice | None, of: str) -> float | None:
    errors = [found.standard_error for found in choice.evidence if found.of == of] if choice else []
    return next((error for error in errors if error is not None), None)


def _too_few_words(found: Evidence) -> Sentence:
    return say_count(
        "{what} was not used: the evidence for it comes from {n} player.",
        "{what} was not used: the evidence for it comes from {n} players.",
        found.players,
        what=_SUBJECTS[found.of],
    )


def _field_words(share: float, error: float | None) -> Sentence:
    if error is None:
        return say(
            "Where newcomers start depends on the field at their first event: {share} of the "
            "difference between that field and the usual one is added to their starting rating.",
            share=Figure(share, ".0%"),
        )
    return say(
        "Where newcomers start depends on the field at their first event: {share} (± {error}) "
        "of the difference between that field and the usual one is added to their starting rating.",
        share=Figure(share, ".0%"),
        error=Figure(error, ".0%"),
    )


def prior_details(ratings: Ratings, choice: PriorChoice | None) -> Iterator[Part]:
    """Yield the prior, how it was chosen, and how much each option tried gained."""
    yield prior_words(ratings)
    if choice is None or not choice.learned:
        return
    yield choice_words(ratings, choice)
    if choice.evidence:
        yield evidence_table(choice)


def evidence_table(choice: PriorChoice) -> Table:
    """Return the gain from including newcomers, teams and so on."""
    columns = columns_of("of log_loss_gain used")
    rows = [(NAMES[found.of], found.gain, found.used) for found in choice.evidence]
    title = (
        "What each piece of information gains on top of those above it, with 95% intervals from "
        "resampling stretches of the season. It is used only if it rests on more than a few "
        "players and its gain is above 0 with 99% confidence; 90% is enough if it makes the "
        "results 20 times likelier:"
    )
    return Table("", columns, rows, title)


def groups_table(ratings: Ratings) -> Iterator[Table]:
    """Yield how far each team and division is above the average one, if they are included."""
    if ratings.groups:
        columns = columns_of("group_kind group_name above standard_error")
        yield Table("", columns, list(ratings.groups))


def group_rows(ratings: Ratings) -> list[dict[str, Any]]:
    """Return how far each team and division is above the average one, in points."""
    return [group._asdict() for group in ratings.groups]


def levels_data(ratings: Ratings, choice: PriorChoice | None) -> dict[str, Any]:
    """Return the included levels in points, with their standard errors where known."""
    levels, points = ratings.levels, ratings.scale.points
    errors = {found.of: found.standard_error for found in choice.evidence} if choice else {}
    newcomers, joined = errors.get("newcomers"), errors.get("joined")
    return {
        "joined_below": points(levels.joined),
        "joined_below_standard_error": None if joined is None else points(joined),
        "newcomers_below": ratings.newcomer,
        "newcomers_below_standard_error": None
        if newcomers is None
        else points(newcomers) * ratings.newcomer_share,
        "field": levels.field,
        "field_standard_error": errors.get("field"),
        "race": levels.race,
        "race_standard_error": errors.get("race"),
        "team_sd": points(levels.team_sd),
        "division_sd": points(levels.division_sd),
    }


def evidence_rows(choice: PriorChoice | None) -> list[dict[str, Any]]:
    """Return each tried option's gain in log-loss per game."""
    return [] if choice is None else [_evidence(found) for found in choice.evidence]


def _evidence(found: Evidence) -> dict[str, Any]:
    return {
        "of": found.of,
        "tried": list(found.tried),
        "gain": found.gain.value,
        "low": found.gain.low,
        "high": found.gain.high,
        "used": found.used,
        "players": found.players,
        "value": found.value,
        "standard_error": found.standard_error,
    }


def prior_words(ratings: Ratings) -> str:
    """Return the assumptions about players before any result."""
    width = _ONE(ratings.scale.points(ratings.prior_sd))
    start = "average" if ratings.named else f"at {round(ratings.anchor, 1):g}"
    apart = ", and apart from what is known about them" if ratings.levels else ""
    return (
        f"Before any result{apart}, every player is assumed to be {start}, ± {width} "
        "points (the prior)."
    )


def choice_words(ratings: Ratings, choice: PriorChoice) -> str:
    """Return how the prior was chosen by prediction."""
    width = _ONE(ratings.scale.points(choice.prior_sd))
    text = (
        f"Of the {len(choice.tried)} values tried for the prior, {width} points predicted the "
        f"{choice.predicted:,} later results best."
    )
    if choice.prior_sd in (choice.tried[0], choice.tried[-1]):
        end = "smallest" if choice.prior_sd == choice.tried[0] else "largest"
        beyond = "smaller" if end == "smallest" else "larger"
        text += f" It is the {end} value tried, so a {beyond} one may be better still."
    if choice.part is not None:
        text += (
            f" To choose it, {choice.part:,} of the {ratings.matches:,} matches were enough: "
            f"those in some groups of players who often play each other."
        )
    return text


def prior_warnings(
    file: ResultsFile, ratings: Ratings, choice: PriorChoice | None
) -> Iterator[str]:
    """Yield a warning if too few results, or no groups, are available for choosing the prior."""
    if choice is not None and not choice.learned:
        yield f"{file.source}: {too_few_for_prior_words(choice, ratings.scale)}"
    yield from groups_warnings(file, choice)


def groups_warnings(file: ResultsFile, choice: PriorChoice | None) -> Iterator[Sentence]:
    """Yield a warning if there are too many teams, or divisions, to include them."""
    if choice is None or not choice.learned:
        return
    for kind, many in too_many_groups(file.results).items():
        yield say(
            "{what} was not used: {groups:,} for {players:,} players are too many to compare.",
            what=_SUBJECTS[f"{kind}_sd"],
            groups=many,
            players=len(file.results.players),
        )


def too_few_for_prior_words(choice: PriorChoice, scale: Scale) -> str:
    """Return that the results can't be used to choose a prior, and which prior is used.

    >>> from evenbreak.ratings import scale_of
    >>> few = PriorChoice(0.693, (0.1, 0.693), (0.6, 0.6), 22, 0.1, 0.693, False, 0.6)
    >>> print(too_few_for_prior_words(few, scale_of("npl")))
    22 later results aren't enough to choose a prior; the default of 30.0 points is used.
    """
    few = "isn't enough" if choice.predicted == 1 else "aren't enough"
    return (
        f"{count_of(choice.predicted, 'later result')} {few} to choose a prior; the default of "
        f"{_ONE(scale.points(choice.prior_sd))} points is used."
    )


def starters_words(listed: Roster, filled: Roster) -> str:
    """Return the unrated players on the list and what is assumed about them; '' if none.

    >>> listed = Roster(["Ann", "Bo"], [600, np.nan])
    >>> starters_words(listed, listed.with_starters(500.0, 100.0, "fargo"))
    '1 player without a rating (Bo): assumed to be 500 ± 100.'
    """
    new = np.flatnonzero(np.isnan(listed.rating))
    said = [games_words(listed, filled)]
    if new.size:
        rating, error = float(filled.rating[new[0]]), float(filled.standard_error[new[0]])
        off = 0.0 if np.isnan(error) else error
        said.insert(0, unrated_words([listed.players[place] for place in new], rating, off))
    return joined(filter(None, said))


def unrated_words(names: Sequence[str], rating: float, error: float) -> Sentence:
    """Return what is assumed about players without a rating.

    >>> unrated_words(["Ann"], 80.0, 30.0)
    '1 player without a rating (Ann): assumed to be 80 ± 30.'
    """
    points = say("{rating:g}", rating=rating)
    if error > 0.0:
        points = say("{rating:g} ± {error:g}", rating=rating, error=error)
    return say_count(
        "{n} player without a rating ({players}): assumed to be {points}.",
        "{n} players without a rating ({players}): assumed to be {points}.",
        len(names),
        players=some_of(names, MOST_NAMES),
        points=points,
    )


def games_words(listed: Roster, filled: Roster) -> str:
    """Return whose error comes from the games behind their rating; '' if no one's does.

    >>> listed = Roster(["Ann", "Bo"], [600, 500], games=[300, 12])
    >>> games_words(listed, listed.with_starters(500.0, 100.0, "fargo"))
    'The errors of 2 ratings were worked out from the number of games behind each; for example,
    ± 83 for Bo, after 12 games.'
    >>> listed = Roster(["Ann", "Bo"], [600, 500], games=[300, NOT_STATED])
    >>> games_words(listed, listed.with_starters(500.0, 100.0, "fargo"))
    "The error of 1 rating was worked out from the number of games behind it: ± 17 for Ann, after
    300 games. The number of games behind 1 rating (Bo) isn't given. That rating is assumed to be
    as uncertain as a new player's, ± 100."
    """
    rated = ~np.isnan(listed.rating) & np.isnan(listed.standard_error)
    by_games = np.flatnonzero(rated & (listed.games != NOT_STATED))
    said = []
    if by_games.size:
        least = by_games[listed.games[by_games].argmin()]
        name = listed.players[least]
        error = filled.standard_error[filled.position(name)]
        said.append(
            say_count(
                "The error of {n} rating was worked out from the number of games behind it: ± "
                "{error} for {player}, after {games:,} games.",
                "The errors of {n:,} ratings were worked out from the number of games behind "
                "each; for example, ± {error} for {player}, after {games:,} games.",
                int(by_games.size),
                error=Figure(error, f".{0 if error >= 10 else 1}f"),
                player=name,
                games=int(listed.games[least]),
            )
        )
    silent = [listed.players[k] for k in np.flatnonzero(rated & (listed.games == NOT_STATED))]
    error = filled.standard_error[filled.position(silent[0])] if silent else np.nan
    if not np.isnan(error):
        said.append(
            say_count(
                "The number of games behind {n} rating ({players}) isn't given. That rating is "
                "assumed to be as uncertain as a new player's, ± {error:.4g}.",
                "The number of games behind {n:,} ratings ({players}) isn't given. Those "
                "ratings are assumed to be as uncertain as a new player's, ± {error:.4g}.",
                len(silent),
                players=some_of(silent),
                error=float(error),
            )
        )
    return joined(said)
