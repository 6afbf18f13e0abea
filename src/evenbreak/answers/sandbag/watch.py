"""Players whose results look like sandbagging, and how much each of a player's matches counts."""

import math
from collections.abc import Iterator, Sequence
from typing import Any, NamedTuple

import numpy as np

from evenbreak.answers.columns.shown import evidence
from evenbreak.answers.kit.answer import Answer
from evenbreak.answers.kit.columns import columns_of, in_files
from evenbreak.answers.kit.parts import Table
from evenbreak.answers.kit.wording import count_of, percent, some_of
from evenbreak.league.sandbag_watch import PlayedNight, Watched
from evenbreak.ratings.day_form import with_form
from evenbreak.ratings.fit import fit
from evenbreak.ratings.results import Results
from evenbreak.ratings.roster import Roster
from evenbreak.ratings.scale import Scale, scale_of
from evenbreak.words import listed, race, say

SHOWN = 10
"""How many players are shown on a terminal, if no more are flagged."""

FEW_NEW = 0.1
"""The share of players without a rating of their own from which there is a warning."""

NAMED = 3
"""How many flagged players the first sentence names."""

HONEST_PLAYER = {
    "any": "an honest player of any skill",
    "established": "an honest player whose rating is as accurate as ratings are in the long run",
}
"""Which honest players are meant, by kind."""


class WatchRow(NamedTuple):
    """A row for a player: matches, the evidence against them, and when they were flagged.

    `e_value` is the evidence after the last match, `largest_e` its maximum, `p_value` the smallest
    alpha at which the player would be flagged; `e_any` and `e_established` are the evidence against
    honest players of each kind. `alarm_match` counts from 1; `league_wide` is for alpha divided by
    the number of players. `event` is the event whose results look dumped; None if no single event's
    do.
    """

    player: str
    matches: int
    won: int
    e_value: float
    largest_e: float
    p_value: float
    e_any: float
    e_established: float
    flagged: bool
    alarm_match: int | None
    alarm_date: str | None
    league_wide: bool
    event: str | None = None


def sandbag_watch_answer(
    watched: Sequence[Watched], results: Results, source: str, *, warnings: Sequence[str] = ()
) -> Answer:
    """Return players whose results look like sandbagging; in files, a `WatchRow` per player."""
    rows = watch_rows(watched, results)
    players = Table(
        "players",
        columns_of(
            "player matches won e_value_now largest_e -p_value -e_any -e_established -flagged "
            "alarm_match alarm_date -league_wide -event"
        ),
        rows,
        most=max(SHOWN, sum(row.flagged for row in rows)),
    )
    if not rows:
        data: dict[str, Any] = {"alpha": None, "honest": None, "tried_events": []}
        return Answer(source, ["No match was played."], warnings=warnings, data=data, csv=players)
    alpha, honest = watched[0].alpha, watched[0].honest
    matches = count_of(sum(row.matches for row in rows) // 2, "match", "matches")
    return Answer(
        f"{source}: {matches} of {count_of(len(rows), 'player')}",
        [
            " ".join([_who_is_flagged(rows), *_where(rows)]),
            players,
            *_more(len(rows) - (players.most or 0)),
            say(
                "A player is flagged when the evidence reaches {evidence}. It starts at 1, rises "
                "with each result that is likelier from a sandbagger than from an honest player, "
                "and falls with the others. It isn't a verdict: look at the player's matches "
                "({player}), and ask.",
                evidence=evidence(1.0 / alpha),
            ),
            say(
                "The chance that {honest} is ever flagged is at most {alpha}. If all {n:,} "
                "players are honest, at most {flagged:.2g} of them are flagged on average. "
                "This holds as long as form varies by no more than {day_sd} allows.",
                honest=HONEST_PLAYER[honest],
                alpha=percent(alpha),
                n=len(rows),
                flagged=alpha * len(rows),
            ),
        ],
        details=[
            f"If players were flagged only at {evidence(len(rows) / alpha)}, the chance that even "
            f"one honest player in the league is flagged would be at most {percent(alpha)}. The "
            "evidence is an e-value: its mean over honest players is at most 1 after any number "
            "of matches.",
            *_tried(watched[0]),
        ],
        warnings=warnings,
        data={"alpha": alpha, "honest": honest, "tried_events": _events(watched[0])},
    )


def day_sd_doubts(results: Results, scale: Scale | str) -> list[str]:
    """Return a warning if results show day-to-day form, and the `day_sd` that fits it.

    >>> day_sd_doubts(Results.from_names(["Ann"], ["Bo"], [7], [5]), "npl")
    []
    """
    ratings = fit(results, scale=scale)
    form = with_form(results, ratings).match_form if ratings.matches else 0.0
    if not form:
        return []
    # Two players' forms, alike and independent, make up that of their difference.
    points = scale_of(scale).points(form) / math.sqrt(2.0)
    return [
        say(
            "honest players are assumed to play at the same strength every day, but in these "
            "results their form varies by about {points:.0f} points from match to match. Give "
            "{day_sd} {points:.0f}, or players may be flagged for having a good or bad day.",
            points=points,
        )
    ]


def unrated_doubts(roster: Roster, results: Results) -> list[str]:
    """Return a warning if too many players start without a rating of their own.

    These are players whose rating is based on no games, or who have the same rating as most
    players.

    >>> club = Roster(["Ann", "Bo", "Cy"], [80, 80, 80])
    >>> len(unrated_doubts(club, Results.from_names(["Ann"], ["Bo"], [7], [5])))
    1
    """
    seen = {results.players[place] for place in (*results.player_a, *results.player_b)}
    playing = np.array([name in seen for name in roster.players])
    rated = roster.rating[playing]
    same, many = np.unique(rated[~np.isnan(rated)], return_counts=True)
    shared = np.isin(rated, same[many > len(rated) / 2])
    new = int((shared | (roster.games[playing] == 0) | np.isnan(rated)).sum())
    if not new or new < FEW_NEW * len(rated):
        return []
    return [
        say(
            "{new:,} of {players} start without a rating of their own, but {honest} established "
            "assumes that all ratings are as accurate as in the long run; strong newcomers may "
            "be flagged for winning, so use {honest} any",
            new=new,
            players=count_of(len(rated), "player"),
        )
    ]


def watch_rows(watched: Sequence[Watched], results: Results) -> list[WatchRow]:
    """Return a row for each player, with the largest evidence first."""
    rows = []
    for one in watched:
        alarm = one.alarm
        rows.append(
            WatchRow(
                one.player,
                len(one.rows),
                int(one.won.sum()),
                one.e_value,
                one.largest_e,
                one.p_value,
                _e(one.any[-1]),
                _e(one.established[-1]),
                alarm is not None,
                None if alarm is None else alarm + 1,
                None if alarm is None else _date(results, int(one.rows[alarm])),
                one.largest_e >= len(watched) / one.alpha,
                one.event,
            )
        )
    return sorted(rows, key=lambda row: (-row.largest_e, row.player))


def _yes(value: Any) -> Any:
    """Return a value as in CSV: a truth value as 'yes' or nothing."""
    return ("yes" if value else "") if isinstance(value, bool) else value


def _who_is_flagged(rows: Sequence[WatchRow]) -> str:
    flagged = [row for row in rows if row.flagged]
    if not flagged:
        return f"None of {count_of(len(rows), 'player')} is flagged."
    named = [
        f"{row.player} after match {row.alarm_match}"
        + f" ({row.alarm_date})" * bool(row.alarm_date)
        for row in flagged[:NAMED]
    ]
    if len(flagged) > NAMED:
        named.append(f"{len(flagged) - NAMED:,} more")
    verb = "is" if len(flagged) == 1 else "are"
    return f"{len(flagged):,} of {count_of(len(rows), 'player')} {verb} flagged: {listed(named)}."


def _where(rows: Sequence[WatchRow]) -> Iterator[str]:
    """Yield the flagged players for each event in which they seem to have dumped matches."""
    found: dict[str, list[str]] = {}
    for row in rows:
        if row.event is not None:
            found.setdefault(row.event, []).append(row.player)
    for event, names in found.items():
        yield f"The results of {some_of(names, NAMED)} look like dumping in {event}."


def _events(one: Watched) -> list[str]:
    return [event for event in one.tried if event is not None]


def _tried(one: Watched) -> Iterator[str]:
    """Yield how the events tried count in the evidence."""
    events = _events(one)
    if events:
        yield say(
            "The test looked for dumping in all events together, and then for dumping in each "
            "of the {events} alone ({names}). The evidence is the average of these {tried} "
            "e-values, which is an e-value too, so honest players are flagged no more often. "
            "With {dumps_in}, only the event that you name is tested. Choose it before you "
            "look at the results.",
            events=count_of(len(events), "event"),
            names=some_of(events, NAMED),
            tried=len(one.tried),
        )


def _more(players: int) -> Iterator[str]:
    if players > 0:
        more = count_of(players, "more player has", "more players have")
        yield f"{more} less evidence against them."


def sandbag_player_answer(
    one: Watched, nights: Sequence[PlayedNight], results: Results, *, warnings: Sequence[str] = ()
) -> Answer:
    """Return how much each of a player's matches counts; in files, a row for each match."""
    dates = results.date
    rows = [
        (None if dates is None else str(dates[row[0]]), *row[1:]) for row in match_rows(one, nights)
    ]
    names = ("date", "opponent", "rating", "opponent_rating", "games_won", "games_lost")
    needs = ("needs", "opponent_needs", "won", "e_value", "factor")
    matches = Table("matches", in_files((*names, *needs), cell=_yes), rows)
    limit = evidence(1.0 / one.alpha)
    said = (
        f"Not flagged: the evidence is {evidence(one.e_value)} now and was never above "
        f"{evidence(one.largest_e)}; a player is flagged at {limit}."
        if one.alarm is None
        else f"Flagged after match {one.alarm + 1}, when the evidence reached {limit}; it is "
        f"{evidence(one.e_value)} now."
    )
    return Answer(
        f"{one.player}: {count_of(len(rows), 'match', 'matches')}",
        [
            said if one.event is None else f"{said} The results look like dumping in {one.event}.",
            _matches(rows),
            "'Weight' is what the match multiplies the evidence by: above 1, the result is "
            "likelier from a sandbagger than from an honest player.",
        ],
        warnings=warnings,
        data={
            "player": one.player,
            "alpha": one.alpha,
            "honest": one.honest,
            "alarm_match": None if one.alarm is None else one.alarm + 1,
            "event": one.event,
        },
        csv=matches,
    )


def _matches(rows: Sequence[tuple[Any, ...]]) -> Table:
    columns = columns_of("date opponent ratings race_text score factor e_value")
    view = [
        (
            date,
            opponent,
            f"{mine:g} - {theirs:g}",
            None if needs is None else race((needs, needed)),
            ("won" if won else "lost") if games is None else f"{games}-{lost}",
            factor,
            e,
        )
        for date, opponent, mine, theirs, games, lost, needs, needed, won, e, factor in rows
    ]
    return Table("", columns, view)


def match_rows(one: Watched, nights: Sequence[PlayedNight]) -> list[tuple[Any, ...]]:
    """Return a tuple for each of a player's matches: what it was, and its effect on the evidence.

    The fields are: row in the results, opponent, rating, opponent's rating, games won, games lost,
    games needed, games the opponent needed, won, e after it, factor of e.
    """
    found, place = [], 0
    for night in nights:
        players, rating = night.changes.before.players, night.changes.before.rating
        for match in night.changes.matches:
            sides = (match.winner, match.loser)
            if one.player not in (players[sides[0]], players[sides[1]]):
                continue
            won = players[match.winner] == one.player
            me, other = sides if won else sides[::-1]
            games, needs = (
                (None, None) if pair is None else (pair if won else pair[::-1])
                for pair in (match.games, match.race)
            )
            before = float(one.log_e[place - 1]) if place else 0.0
            after = float(one.log_e[place])
            found.append(
                (
                    int(night.rows[match.row]),
                    players[other],
                    float(rating[me]),
                    float(rating[other]),
                    *games,
                    *needs,
                    won,
                    _e(after),
                    _e(after - before),
                )
            )
            place += 1
    return found


def _e(log_e: float) -> float:
    return math.exp(min(float(log_e), 700.0))


def _date(results: Results, row: int) -> str | None:
    if results.date is None or np.isnat(results.date[row]):
        return None
    return str(results.date[row])
